// SPDX-License-Identifier: Apache-2.0
//
// Facets of a leaf in doubles, for leaves whose polygons are in general position (plain_leaf.h).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <trisect/bsp/detail/leaf_problem.h>
#include <trisect/bsp/detail/leaf_work.h>
#include <trisect/bsp/detail/stamp_map.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

using Vector3 = std::array<double, 3>;

/// The support of a facet: points p with normal · (p - origin) = 0. Exact points of the leaf have a
/// value within `bound` of the computed one; points with an error add `slope` times that.
struct PlainPlane {
    Vector3 origin{};
    Vector3 normal{};
    double slope = 0;
    double bound = -1;  ///< -1: not made yet

    [[nodiscard]] double value(const Vector3& p) const {
        return (normal[0] * (p[0] - origin[0]) + normal[1] * (p[1] - origin[1])) +
               normal[2] * (p[2] - origin[2]);
    }
    [[nodiscard]] double error(const Approximation& p) const { return bound + slope * p.error; }
    /// -1 below, 1 above; 0 when doubles cannot tell.
    [[nodiscard]] int sign(const Approximation& p) const {
        const double v = value(p.c);
        const double e = error(p);
        return v > e ? 1 : (v < -e ? -1 : 0);
    }
};

/// A whole facet of an embedded operand. Corners are lattice points, taken from an origin of the
/// leaf, so that doubles hold them exactly and constructed points have the errors of the leaf's
/// size and not of its place.
struct PlainFacet {
    PolygonRef ref;
    LeafIndex operand = 0;
    LeafIndex sheet = 0;  ///< one number for each operand and source in it
    std::int8_t orientation = 1;
    std::int8_t side_of_reference = 2;  ///< of the support; 0: cannot tell, 2: not computed
    bool contained = false;             ///< lies in the cell
    std::array<std::uint32_t, 3> vertices{};
    std::array<Vector3, 3> corners{};
    Vector3 lo{};  ///< of the box, within the cell
    Vector3 hi{};
    PlainPlane plane;

    [[nodiscard]] bool has_vertex(std::uint32_t v) const {
        return v == vertices[0] || v == vertices[1] || v == vertices[2];
    }
    [[nodiscard]] bool meets(const Vector3& low, const Vector3& high) const {
        return lo[0] <= high[0] && low[0] <= hi[0] && lo[1] <= high[1] && low[1] <= hi[1] &&
               lo[2] <= high[2] && low[2] <= hi[2];
    }
};

/// The facets of one leaf after the other; keeps its memory.
class PlainFacets {
public:
    /// False when something else than whole facets of embedded operands is listed, or the leaf is
    /// too large for doubles.
    [[nodiscard]] bool list(const LeafProblem& leaf);

    [[nodiscard]] LeafIndex size() const { return static_cast<LeafIndex>(facets_.size()); }
    [[nodiscard]] PlainFacet& operator[](LeafIndex i) { return facets_[LeafWork::u(i)]; }
    [[nodiscard]] const PlainFacet& operator[](LeafIndex i) const {
        return facets_[LeafWork::u(i)];
    }
    [[nodiscard]] const PlainPlane& plane(LeafIndex i) {
        PlainFacet& f = facets_[LeafWork::u(i)];
        if (f.plane.bound < 0) make_plane(f);
        return f.plane;
    }
    [[nodiscard]] const LeafProblem& problem() const { return *problem_; }
    [[nodiscard]] std::size_t operand_count() const { return problem_->operands.size(); }
    /// Whether a lattice point lies in the cell.
    [[nodiscard]] bool in_cell(const Vector3& p) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] < inner_lo_[k] || p[k] > inner_hi_[k]) return false;
        return true;
    }
    /// The lattice positions next to the cell's walls, inside of them; exact as far as corners go.
    [[nodiscard]] const Vector3& inner_lo() const { return inner_lo_; }
    [[nodiscard]] const Vector3& inner_hi() const { return inner_hi_; }
    /// The walls themselves, rounded.
    [[nodiscard]] const Vector3& wall_lo() const { return wall_lo_; }
    [[nodiscard]] const Vector3& wall_hi() const { return wall_hi_; }
    [[nodiscard]] const Approximation& reference() const { return reference_; }
    /// From where coordinates of this leaf count, in lattice units.
    [[nodiscard]] const std::array<std::int64_t, 3>& origin() const { return origin_; }

    /// A point of the leaf in the lattice's coordinates.
    [[nodiscard]] Approximation in_lattice(Approximation at) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto origin = static_cast<double>(origin_[k]);
            at.c[k] += origin;
            at.error += 0x1p-51 * (std::fabs(at.c[k]) + std::fabs(origin));
        }
        return at;
    }

private:
    void set_origin(const LatticePoint& origin);
    void add(const PolygonRef& ref, const LeafOperand& operand, LeafIndex number, LeafIndex sheet);
    void make_plane(PlainFacet& f) const;

    const LeafProblem* problem_ = nullptr;
    std::vector<PlainFacet> facets_;
    StampMap sheets_;
    std::array<std::int64_t, 3> origin_{};
    Approximation reference_;
    Vector3 inner_lo_{};
    Vector3 inner_hi_{};
    Vector3 wall_lo_{};
    Vector3 wall_hi_{};
    Vector3 extent_{};  // of all facets, unclipped, and the reference point
};

/// Sign of the determinant of (a - d, b - d, c - d); 0 when doubles cannot tell.
[[nodiscard]] int orientation(const Vector3& a, const Vector3& b, const Vector3& c,
                              const Vector3& d);

/// The point between u and w where a linear function is 0. Its values there are known up to
/// `error` in sum and have different signs. False when that says too little.
[[nodiscard]] inline bool interpolate(const Approximation& u, double at_u, const Approximation& w,
                                      double at_w, double error, Approximation& x) {
    const double spread = std::fabs(at_u) + std::fabs(at_w);
    if (!(spread > 4 * error)) return false;
    const double lambda = std::fabs(at_u) / spread;
    // See approximate_crossing() in trace.cpp for the bound.
    const double lambda_error = 2 * error / spread + 0x1p-50;
    double span = 0;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double step = w.c[k] - u.c[k];
        x.c[k] = u.c[k] + lambda * step;
        span = std::max(span, std::fabs(step));
        largest = std::max({largest, std::fabs(u.c[k]), std::fabs(w.c[k])});
    }
    x.error = (span * lambda_error + u.error + w.error + largest * 0x1p-50) * 1.001;
    return true;
}

}  // namespace trisect::detail
