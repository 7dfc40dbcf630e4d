// SPDX-License-Identifier: Apache-2.0
//
// Which operands a larger one decides (decided_operands.h), against distances from round ones.

#include <trisect/bsp/many_meshes/decided_operands.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/many_meshes/outlines/nested_formula.h>

namespace {

using trisect::Point3d;
using trisect::detail::NestedFormula;
using trisect::detail::Residual;
using trisect::detail::Source;
using Kind = Residual::Kind;
using Decided = std::vector<std::uint8_t>;

constexpr double half = 0.02;  // of the length of a small box
const std::array<Point3d, 2> centres{{{0.31, 0.02, 0.11}, {-0.35, 0.13, -0.17}}};
constexpr double large_radius = 0.8;

// Two large spheres, and small boxes.
class DecidedOperands : public testing::Test {
protected:
    DecidedOperands() {
        for (const Point3d& c : centres) add(trisect::make_icosphere(large_radius, 4), c);
        std::mt19937 random(21511);
        std::uniform_real_distribution<double> at(-1.3, 1.3);
        for (int i = 0; i < 200; ++i) {
            small_.push_back({at(random), at(random), at(random)});
            add(trisect::make_box({-half, -half, -half}, {half, half, half}), small_.back());
        }
    }
    void add(trisect::PolygonMesh mesh, const Point3d& centre) {
        for (Point3d& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] += centre[k];
        trisect::ImportOptions options;
        options.lattice = trisect::Lattice{-50};
        sources_.push_back(Source::make(trisect::import_mesh(mesh, options).mesh));
        in_use_.push_back(sources_.back().get());
    }
    [[nodiscard]] static Residual::Ref large(std::size_t i) {
        return Residual::of_slot(static_cast<int>(i));
    }
    [[nodiscard]] Residual::Ref union_of_small() const {
        std::vector<Residual::Ref> terms;
        for (std::size_t i = 0; i < small_.size(); ++i)
            terms.push_back(Residual::of_slot(static_cast<int>(centres.size() + i)));
        return Residual::of_distinct(Kind::Or, std::move(terms));
    }
    [[nodiscard]] static Residual::Ref all(Kind kind, std::vector<Residual::Ref> terms) {
        return Residual::of_distinct(kind, std::move(terms));
    }
    // Of the small ones.
    [[nodiscard]] Decided decided(const Residual::Ref& formula) {
        const auto nested = NestedFormula::read(*formula, in_use_.size());
        EXPECT_TRUE(nested.has_value());
        if (!nested) return {};
        std::vector<std::uint8_t> open_far_out;
        for (std::size_t s = 0; s < in_use_.size(); ++s)
            open_far_out.push_back(nested->is_positive(s) ? 0 : 1);
        Decided out = decided_operands(*nested, in_use_, open_far_out, 2);
        EXPECT_EQ(out[0] + out[1], 0);
        out.erase(out.begin(), out.begin() + 2);
        return out;
    }
    // From the centre of a large one to the box, at least and at most.
    [[nodiscard]] std::array<double, 2> distances(std::size_t small, std::size_t large) const {
        double nearest = 0;
        double farthest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double d = std::fabs(small_[small][k] - centres[large][k]);
            nearest += std::pow(std::max(0.0, d - half), 2);
            farthest += std::pow(d + half, 2);
        }
        return {std::sqrt(nearest), std::sqrt(farthest)};
    }
    [[nodiscard]] bool is_outside(std::size_t small, std::size_t large) const {
        return distances(small, large)[0] > 0.99 * large_radius;  // of the faces of the sphere
    }
    [[nodiscard]] bool is_far_outside(std::size_t small, std::size_t large) const {
        return distances(small, large)[0] > large_radius + 0.15;
    }

    std::vector<Point3d> small_;
    std::vector<std::shared_ptr<const Source>> sources_;
    std::vector<const Source*> in_use_;
};

TEST_F(DecidedOperands, OutsideOfAUnion) {
    const Decided found =
        decided(all(Kind::And, {all(Kind::Or, {large(0), large(1)}), union_of_small()}));
    for (std::size_t i = 0; i < small_.size(); ++i) {
        if (found[i] != 0) {
            EXPECT_TRUE(is_outside(i, 0) && is_outside(i, 1)) << i;
        }
        if (is_far_outside(i, 0) && is_far_outside(i, 1)) {
            EXPECT_EQ(found[i], 1) << i;
        }
    }
    EXPECT_GT(std::ranges::count(found, 1), 20);
}

TEST_F(DecidedOperands, OutsideOfOneOfTwo) {
    const Decided found = decided(all(Kind::And, {large(0), large(1), union_of_small()}));
    for (std::size_t i = 0; i < small_.size(); ++i) {
        if (found[i] != 0) {
            EXPECT_TRUE(is_outside(i, 0) || is_outside(i, 1)) << i;
        }
        if (is_far_outside(i, 0) || is_far_outside(i, 1)) {
            EXPECT_EQ(found[i], 1) << i;
        }
    }
}

TEST_F(DecidedOperands, SubtractedFromAUnion) {
    const Decided found = decided(all(
        Kind::And, {all(Kind::Or, {large(0), large(1)}), Residual::negation(union_of_small())}));
    for (std::size_t i = 0; i < small_.size(); ++i) {
        if (found[i] != 0) {
            EXPECT_TRUE(is_outside(i, 0) && is_outside(i, 1)) << i;
        }
        if (is_far_outside(i, 0) && is_far_outside(i, 1)) {
            EXPECT_EQ(found[i], 1) << i;
        }
    }
}

// Outside of the large one they stay.
TEST_F(DecidedOperands, NoneThatAreUnitedOrLessLargeOnes) {
    for (const Residual::Ref& formula :
         {all(Kind::Or, {all(Kind::And, {large(0), large(1)}), union_of_small()}),
          all(Kind::And,
              {Residual::negation(large(0)), Residual::negation(large(1)), union_of_small()})}) {
        const Decided found = decided(formula);
        EXPECT_EQ(std::ranges::count(found, 1), 0);
    }
}

}  // namespace
