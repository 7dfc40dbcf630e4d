// SPDX-License-Identifier: Apache-2.0
//
// Facets with a common corner, of which the second one's corners move, in doubles of their cell,
// against integers.

#include <trisect/bsp/two_meshes/corner_pairs.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/shift/corner_moves.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/two_meshes/outward_moves.h>

namespace corner_pairs_test {
namespace {

using trisect::LatticeMesh;
using trisect::detail::CommonCorners;
using trisect::detail::CornerMoves;
using trisect::detail::FacetCorners;
using trisect::detail::FilteredFacet;
using trisect::detail::FilteredFacets;
using trisect::detail::InfinitesimalShift;
using trisect::detail::LeafIndex;
using trisect::detail::LeafOperand;
using trisect::detail::LeafProblem;
using trisect::detail::PolygonRef;
using trisect::detail::ShiftedPair;
using trisect::detail::Source;

// All facets of two meshes in one cell.
class TwoMeshes {
public:
    TwoMeshes(LatticeMesh a, LatticeMesh b)
        : sources_{Source::make(std::move(a)), Source::make(std::move(b))} {
        std::array<LeafOperand, 2> operands;
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::uint32_t f = 0; f < sources_[i]->facet_count(); ++f)
                polygons_[i].push_back({sources_[i].get(), nullptr, f, false, false});
            operands[i] = {static_cast<std::int32_t>(i), polygons_[i], false, true, 0};
        }
        LeafProblem problem;
        problem.operands = operands;
        problem.options = &settings_;
        is_listed_ = facets_.list(problem);
    }
    [[nodiscard]] bool is_listed() const { return is_listed_; }
    [[nodiscard]] FilteredFacets& facets() { return facets_; }
    [[nodiscard]] LeafIndex first_of_second() const { return facets_.first_of(1); }
    [[nodiscard]] const LatticeMesh& second() const { return sources_[1]->mesh(); }

private:
    std::array<std::shared_ptr<const Source>, 2> sources_;
    std::array<std::vector<PolygonRef>, 2> polygons_;
    trisect::detail::EvaluateSettings settings_;
    FilteredFacets facets_;
    bool is_listed_ = false;
};

FacetCorners corners_of(const FilteredFacet& f) {
    const auto at = [&](int i) { return &f.ref.source->corner(f.ref.facet, i); };
    return {at(0), at(1), at(2)};
}

void expect_equal(const ShiftedPair& pair, const ShiftedPair& exact) {
    ASSERT_EQ(pair.kind, exact.kind);
    EXPECT_EQ(pair.touches, exact.touches);
    EXPECT_FALSE(exact.is_torn);
    if (pair.kind != ShiftedPair::Kind::Crossing) return;
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(pair.ends[k].of_second, exact.ends[k].of_second);
        EXPECT_EQ(pair.ends[k].edge, exact.ends[k].edge);
        EXPECT_EQ(pair.ends[k].corner, exact.ends[k].corner);
        const double error = pair.ends[k].at.error + exact.ends[k].at.error;
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LE(std::fabs(pair.ends[k].at.c[i] - exact.ends[k].at.c[i]), error);
    }
}

struct Found {
    std::size_t pairs = 0;  // with a common corner, or two
    std::size_t decided = 0;
    std::size_t crossing = 0;
};

// Every pair.
Found compare(TwoMeshes& two, const InfinitesimalShift& shift) {
    Found found;
    FilteredFacets& facets = two.facets();
    for (LeafIndex i = 0; i < two.first_of_second(); ++i)
        for (LeafIndex j = two.first_of_second(); j < facets.size(); ++j) {
            const CommonCorners common(facets[i], facets[j]);
            const auto pair = relate_at_corners(facets, i, j, common, shift);
            EXPECT_TRUE(common.count > 0 || !pair);
            if (common.count == 0) continue;
            const ShiftedPair exact =
                relate_exactly(corners_of(facets[i]), corners_of(facets[j]), shift);
            if (exact.kind == ShiftedPair::Kind::Equal) {
                EXPECT_FALSE(pair.has_value());
                continue;
            }
            ++found.pairs;
            if (!pair) continue;
            ++found.decided;
            found.crossing += pair->kind == ShiftedPair::Kind::Crossing ? 1U : 0U;
            expect_equal(*pair, exact);
        }
    return found;
}

TEST(CornerPairs, OfAMeshAndItsMirrorImageAreNearlyAllDecided) {
    const LatticeMesh torus = trisect::import_mesh(trisect::make_torus(0.7, 0.3, 30, 15)).mesh;
    LatticeMesh image = torus;
    for (auto& p : image.points) p.x = trisect::Coordinate(-p.x.to_double());
    for (auto& t : image.triangles) std::swap(t[1], t[2]);
    TwoMeshes two(torus, image);
    ASSERT_TRUE(two.is_listed());
    std::vector<std::uint32_t> all(two.second().triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto moves = trisect::detail::outward_moves(two.second(), all, false);
    InfinitesimalShift shift;
    shift.moves = moves.get();
    const Found found = compare(two, shift);
    EXPECT_GT(found.pairs, 5000U);
    EXPECT_GT(found.crossing, 100U);
    EXPECT_GT(10 * found.decided, 9 * found.pairs);
}

// Triangles of a few points, in any position to each other, and any moves.
TEST(CornerPairs, OfPointsOfASmallGrid) {
    std::mt19937 random(5);
    Found all;
    for (int turn = 0; turn < 60; ++turn) {
        LatticeMesh mesh;
        for (int i = 0; i < 12; ++i) {
            const auto at = [&] { return static_cast<std::int64_t>(random() % 4); };
            mesh.points.push_back({at(), at(), at()});
        }
        std::array<LatticeMesh, 2> meshes{mesh, mesh};
        for (LatticeMesh& m : meshes)
            while (m.triangles.size() < 20) {
                const auto at = [&] { return static_cast<std::uint32_t>(random() % 12); };
                const std::array<std::uint32_t, 3> t{at(), at(), at()};
                const FacetCorners f{&m.points[t[0]], &m.points[t[1]], &m.points[t[2]]};
                if (trisect::detail::normal_signs(f) != std::array<int, 3>{})
                    m.triangles.push_back(t);
            }
        TwoMeshes two(std::move(meshes[0]), std::move(meshes[1]));
        ASSERT_TRUE(two.is_listed());
        CornerMoves moves;
        moves.points = two.second().points.data();
        for (std::size_t i = 0; i < 12; ++i) {
            const auto by = [&] { return static_cast<std::int32_t>(random() % 7) - 3; };
            moves.vectors.push_back({by(), by(), by()});
        }
        InfinitesimalShift shift;
        shift.moves = &moves;
        const Found found = compare(two, shift);
        all.pairs += found.pairs;
        all.decided += found.decided;
        all.crossing += found.crossing;
    }
    EXPECT_GT(all.decided, 1000U);
    EXPECT_GT(all.crossing, 100U);
}

}  // namespace
}  // namespace corner_pairs_test
