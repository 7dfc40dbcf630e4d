// SPDX-License-Identifier: Apache-2.0
//
// Facets around a common face that need no comparison with it (beside_covering.h): those of boxes
// side by side, and what is beside a box whose face the other one covers in part of its plane.

#include <trisect/bsp/two_meshes/conforming/beside_covering.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>

namespace {

using trisect::LatticeMesh;
using trisect::PolygonMesh;

using trisect::detail::BesideCovering;
using trisect::detail::CornerNames;
using trisect::detail::Patches;
using trisect::detail::StackArena;

// Two meshes of which all facets in the plane x = 2 are one covered set.
class SideBySide {
public:
    SideBySide(const PolygonMesh& a, const PolygonMesh& b)
        : first_(trisect::import_mesh(a).mesh), second_(trisect::import_mesh(b).mesh) {
        for (std::size_t i = 0; i < 2; ++i) {
            facets_[i].resize((i == 0 ? first_ : second_).triangles.size());
            std::iota(facets_[i].begin(), facets_[i].end(), 0U);
        }
    }
    void look() {
        const std::array<const LatticeMesh*, 2> meshes{&first_, &second_};
        names_.emplace(
            meshes, std::array<std::span<const std::uint32_t>, 2>{facets_[0], facets_[1]}, arena_);
        patches_.emplace(names_->item_count(), arena_);
        const std::vector<double> all = xs(0);
        const double at = *std::ranges::max_element(all);
        for (std::uint32_t item = 0; item < names_->item_count(); ++item)
            if (std::ranges::all_of(xs_of(item), [&](double x) { return x == at; }))
                covered_.push_back(item);
        for (const std::uint32_t item : covered_) patches_->join_covering(covered_[0], item);
        patches_->flatten();
        beside_.emplace(*names_, *patches_);
        at_ = at;
    }
    [[nodiscard]] int corners_at_plane(std::uint32_t item) const {
        return static_cast<int>(std::ranges::count(xs_of(item), at_));
    }
    [[nodiscard]] std::uint32_t item_count() const { return names_->item_count(); }
    [[nodiscard]] const std::vector<std::uint32_t>& covered() const { return covered_; }
    [[nodiscard]] bool is_covered(std::uint32_t item) const { return patches_->is_covered(item); }
    [[nodiscard]] const BesideCovering& beside() const { return *beside_; }

private:
    [[nodiscard]] std::vector<double> xs_of(std::uint32_t item) const {
        std::vector<double> out;
        for (const std::uint32_t name : names_->corners(item))
            out.push_back(names_->point(name).doubles()[0]);
        return out;
    }
    [[nodiscard]] std::vector<double> xs(std::size_t mesh) const {
        std::vector<double> out;
        for (const auto& p : (mesh == 0 ? first_ : second_).points) out.push_back(p.doubles()[0]);
        return out;
    }

    LatticeMesh first_;
    LatticeMesh second_;
    std::array<std::vector<std::uint32_t>, 2> facets_;
    StackArena arena_;
    std::optional<CornerNames> names_;
    std::optional<Patches> patches_;
    std::optional<BesideCovering> beside_;
    std::vector<std::uint32_t> covered_;
    double at_ = 0;
};

PolygonMesh cube_at(double x, double y, double z) {
    return trisect::make_box({x, y, z}, {x + 2, y + 2, z + 2});
}

TEST(BesideCovering, HasTheFacetsAroundACommonFace) {
    SideBySide boxes(cube_at(0, 0, 0), cube_at(2, 0, 0));
    boxes.look();
    ASSERT_EQ(boxes.covered().size(), 4U);
    int beside = 0;
    for (std::uint32_t item = 0; item < boxes.item_count(); ++item) {
        if (boxes.is_covered(item)) continue;
        const bool touches = boxes.corners_at_plane(item) > 0;
        EXPECT_EQ(boxes.beside().is_clear(item), touches) << item;
        beside += touches ? 1 : 0;
        for (const std::uint32_t covered : boxes.covered()) {
            EXPECT_EQ(boxes.beside().meets_properly(item, covered), touches);
            EXPECT_EQ(boxes.beside().meets_properly(covered, item), touches);
        }
    }
    EXPECT_EQ(beside, 16);
}

// The corner of a facet in the plane is none of the part that both cover.
TEST(BesideCovering, LeavesFacetsThatReachThePlaneElsewhere) {
    SideBySide boxes(cube_at(0, 0, 0), trisect::make_box({2, 0, 0}, {4, 4, 2}));
    boxes.look();
    for (std::uint32_t item = 0; item < boxes.item_count(); ++item) {
        if (boxes.is_covered(item) || boxes.corners_at_plane(item) < 2) continue;
        if (!boxes.beside().is_clear(item)) return;
    }
    FAIL() << "the second box has edges in the plane that the first one has not";
}

}  // namespace
