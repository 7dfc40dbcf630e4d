// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/measure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace trisect {

namespace {

class BoundsCollector {
public:
    void add(const std::array<double, 3>& p) {
        if (!box_) box_ = Bounds{p, p};
        for (std::size_t i = 0; i < 3; ++i) {
            box_->lo[i] = std::min(box_->lo[i], p[i]);
            box_->hi[i] = std::max(box_->hi[i], p[i]);
        }
    }
    [[nodiscard]] const std::optional<Bounds>& box() const { return box_; }
    std::optional<Bounds> in_units_of(Lattice lattice) const {
        if (!box_) return std::nullopt;
        Bounds b = *box_;
        for (std::size_t i = 0; i < 3; ++i) {
            b.lo[i] = lattice.to_double(b.lo[i]);
            b.hi[i] = lattice.to_double(b.hi[i]);
        }
        return b;
    }

private:
    std::optional<Bounds> box_;  // lattice units
};

// With what sums of a coordinate and this are rounded.
double error_along(const Approximation& a, std::size_t axis) {
    return a.error + 0x1p-50 * (std::fabs(a.c[axis]) + a.error);
}

// Only points that may be extremes are rounded: an end of the box lies at most where some point
// surely is.
std::optional<Bounds> bounds_of(std::span<const Point> points, Lattice lattice) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> lo{infinity, infinity, infinity};
    std::array<double, 3> hi{-infinity, -infinity, -infinity};
    for (const Point& p : points) {
        const Approximation& a = p.approximation();
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], a.c[k] + error_along(a, k));
            hi[k] = std::max(hi[k], a.c[k] - error_along(a, k));
        }
    }
    BoundsCollector box;
    for (const Point& p : points) {
        const Approximation& a = p.approximation();
        bool may_be_end = false;
        for (std::size_t k = 0; k < 3; ++k)
            may_be_end = may_be_end || a.c[k] - error_along(a, k) <= lo[k] ||
                         a.c[k] + error_along(a, k) >= hi[k];
        if (may_be_end) box.add(p.nearest());
    }
    return box.in_units_of(lattice);
}

}  // namespace

std::optional<Bounds> bounds(const Brep& brep) { return bounds_of(brep.points(), brep.lattice()); }

std::optional<Bounds> bounds(const ExactMesh& mesh) { return bounds_of(mesh.points, mesh.lattice); }

std::optional<Bounds> bounds(const PolygonMesh& mesh) {
    BoundsCollector box;
    for (const std::uint32_t v : mesh.corners) box.add(mesh.points[v]);
    return box.box();
}

std::optional<Bounds> bounds(const LatticeMesh& mesh) {
    BoundsCollector box;
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t) box.add(approximate(mesh.points[v]).c);
    return box.in_units_of(mesh.lattice);
}

}  // namespace trisect
