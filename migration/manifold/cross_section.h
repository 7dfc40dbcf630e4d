// SPDX-License-Identifier: Apache-2.0
//
// CrossSection: a region of the plane.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <manifold/common.h>
#include <manifold/vec_view.h>

// NOLINTBEGIN(readability-identifier-naming): names are those of another library
namespace manifold {

/// A region, by its outlines. Booleans are those of prisms over the regions, exact, and rounded
/// once. What is given may overlap itself: inside is where the winding number is positive.
class CrossSection {
public:
    using JoinType = ::manifold::JoinType;

    CrossSection() = default;
    CrossSection(const SimplePolygon& contour);  // NOLINT(google-explicit-constructor)
    CrossSection(const Polygons& contours);      // NOLINT(google-explicit-constructor)
    CrossSection(const Rect& rect);              // NOLINT(google-explicit-constructor)
    /// The points about which the contours wind an odd number of times, whichever way they run.
    static CrossSection EvenOdd(const SimplePolygon& contour) { return EvenOdd(Polygons{contour}); }
    static CrossSection EvenOdd(const Polygons& contours);
    /// Regions that have no points in common but corners, each with its holes.
    [[nodiscard]] std::vector<CrossSection> Decompose() const;
    static CrossSection Square(vec2 dims, bool center = false);
    static CrossSection Circle(double radius, int circularSegments = 0);
    [[nodiscard]] Polygons ToPolygons() const { return polygons_; }

    [[nodiscard]] bool IsEmpty() const { return polygons_.empty(); }
    [[nodiscard]] std::size_t NumVert() const;
    [[nodiscard]] std::size_t NumContour() const { return polygons_.size(); }
    [[nodiscard]] Rect Bounds() const;
    [[nodiscard]] double Area() const;

    /// There is no tolerance: nothing is nearer than what doubles distinguish.
    [[nodiscard]] double GetTolerance() const { return 0; }
    [[nodiscard]] CrossSection SetTolerance(double /*tolerance*/) const { return *this; }

    [[nodiscard]] CrossSection Translate(vec2 by) const;
    [[nodiscard]] CrossSection Rotate(double degrees) const;
    [[nodiscard]] CrossSection Scale(vec2 by) const;
    [[nodiscard]] CrossSection Mirror(vec2 axis) const;
    [[nodiscard]] CrossSection Transform(const mat2x3& m) const;
    /// Without corners that are nearer than `tolerance` to the line between their neighbours.
    [[nodiscard]] CrossSection Simplify(double tolerance = 0) const;
    [[nodiscard]] CrossSection Warp(const std::function<void(vec2&)>& warp) const;

    [[nodiscard]] CrossSection WarpBatch(const std::function<void(VecView<vec2>)>& warp) const;

    [[nodiscard]] CrossSection Boolean(const CrossSection& second, OpType op) const {
        return BatchBoolean({*this, second}, op);
    }
    static CrossSection BatchBoolean(const std::vector<CrossSection>& sections, OpType op);
    CrossSection operator+(const CrossSection& o) const { return Boolean(o, OpType::Add); }
    CrossSection operator-(const CrossSection& o) const { return Boolean(o, OpType::Subtract); }
    CrossSection operator^(const CrossSection& o) const { return Boolean(o, OpType::Intersect); }
    CrossSection& operator+=(const CrossSection& o) { return *this = *this + o; }
    CrossSection& operator-=(const CrossSection& o) { return *this = *this - o; }
    CrossSection& operator^=(const CrossSection& o) { return *this = *this ^ o; }

    [[nodiscard]] CrossSection Hull() const;
    static CrossSection Hull(const SimplePolygon& points);
    static CrossSection Hull(const Polygons& polygons);
    static CrossSection Hull(const std::vector<CrossSection>& sections);
    /// Corners are rounded once, and the result again. A bevel is a cut between the ends of the
    /// moved edges; beyond the limit a miter is a square join.
    [[nodiscard]] CrossSection Offset(double delta, JoinType joins = JoinType::Round,
                                      double miterLimit = 2, int circularSegments = 0) const;

private:
    Polygons polygons_;
};

}  // namespace manifold
// NOLINTEND(readability-identifier-naming)
