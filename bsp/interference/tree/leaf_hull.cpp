// SPDX-License-Identifier: Apache-2.0
//
// The frame is that of some of the polygons, as any frame will do; all corners are in the box.
//
// Errors: a corner's difference p from the origin is rounded once in doubles and once to floats,
// and has its own error, for which fragments have a number. For a float axis u, |u| < 1.01, the
// product u · p in floats is off by at most 4·2^-24 |u| |p| and |p| is below 1.01 · 3^1/2 M, M the
// largest product along the three axes: by less than 2^-21 M. The halves' factors are those of
// obb_parts.cpp.

#include <trisect/bsp/interference/tree/leaf_hull.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/cells/deferred_leaf.h>
#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/float4.h>

namespace trisect::detail {

namespace {

// Calls visit(list) for the lists that hold the polygons.
template <class Visit>
void for_lists(const CellNode& leaf, const Visit& visit) {
    if (const DeferredLeaf* const deferred = leaf.deferred()) {
        for (const DeferredLeaf::Operand& operand : deferred->operands) visit(operand.polygons);
    } else {
        visit(leaf.polygons());
    }
}

// The corners of polygons with their errors.
class CornersOf {
public:
    explicit CornersOf(const PolygonRef& polygon) {
        if (polygon.fragment != nullptr) {
            fragment_ = polygon.fragment->vertices();
            return;
        }
        if (polygon.source->is_half_space()) {
            is_unbounded_ = true;
            return;
        }
        for (int i = 0; i < 3; ++i)
            triangle_[static_cast<std::size_t>(i)] =
                polygon.source->corner(polygon.facet, i).doubles();
    }
    [[nodiscard]] bool is_unbounded() const { return is_unbounded_; }
    [[nodiscard]] std::size_t size() const { return fragment_.empty() ? 3 : fragment_.size(); }
    [[nodiscard]] const Vector3& at(std::size_t i) const {
        return fragment_.empty() ? triangle_[i] : fragment_[i].c;
    }
    [[nodiscard]] double error() const {
        double e = 0;
        for (const Approximation& a : fragment_) e = std::max(e, a.error);
        return e;
    }

private:
    std::span<const Approximation> fragment_;
    std::array<Vector3, 3> triangle_{};
    bool is_unbounded_ = false;
};

constexpr std::size_t samples = 48;

class HullFitter {
public:
    explicit HullFitter(const CellNode& leaf) : leaf_(leaf) {}

    [[nodiscard]] LeafHull fit() {
        if (!find_frame()) return {};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                hull_.box.axis[i][k] = static_cast<float>(frame_.axis[i][k]);
                axis_[i][k] = static_cast<double>(hull_.box.axis[i][k]);
                along_[k][static_cast<int>(i)] = hull_.box.axis[i][k];
            }
        find_reach();
        if (!is_bounded_) return {};
        set_box();
        hull_.is_known = true;
        return hull_;
    }

private:
    [[nodiscard]] bool find_frame() {
        std::size_t count = 0;
        bool is_bounded = true;
        Vector3 lo{};
        Vector3 hi{};
        lo.fill(HUGE_VAL);
        hi.fill(-HUGE_VAL);
        const auto take_box = [&](const Vector3& p) {
            for (std::size_t k = 0; k < 3; ++k) {
                lo[k] = std::min(lo[k], p[k]);
                hi[k] = std::max(hi[k], p[k]);
            }
        };
        for_lists(leaf_, [&](const PolygonList& list) { count += list.size(); });
        if (count == 0) return false;
        const std::size_t step = 1 + count / samples;
        for_lists(leaf_, [&](const PolygonList& list) {
            for (std::size_t i = 0; i < list.size(); i += step) {
                const CornersOf corners(list[i]);
                is_bounded = is_bounded && !corners.is_unbounded();
                for (std::size_t j = 0; j < corners.size(); ++j) take_box(corners.at(j));
            }
        });
        if (!is_bounded) return false;
        double extent = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            hull_.origin[k] = lo[k] + 0.5 * (hi[k] - lo[k]);
            extent = std::max(extent, hi[k] - lo[k]);
        }
        hull_.unit = extent > 0 ? std::ldexp(1.0, std::ilogb(extent)) : 1.0;
        AreaMoments moments;
        for_lists(leaf_, [&](const PolygonList& list) {
            for (std::size_t i = 0; i < list.size(); i += step) {
                const CornersOf corners(list[i]);
                for (std::size_t j = 2; j < corners.size(); ++j)
                    moments.add(in_units(corners.at(0)), in_units(corners.at(j - 1)),
                                in_units(corners.at(j)));
            }
        });
        frame_ = principal_frame(moments);
        return true;
    }

    // In lattice units about the origin, as far as this is a matter of every corner.
    void find_reach() {
        for_lists(leaf_, [&](const PolygonList& list) {
            if (const Source* const source = list.whole_source();
                source != nullptr && !source->is_half_space()) {
                const LatticeMesh& mesh = source->mesh();
                for (std::size_t i = 0; i < list.size(); ++i)
                    for (const std::uint32_t corner : mesh.triangles[list[i].facet])
                        take(mesh.points[corner].doubles());
                return;
            }
            for (const PolygonRef polygon : list) {
                const CornersOf corners(polygon);
                is_bounded_ = is_bounded_ && !corners.is_unbounded();
                error_ = std::max(error_, corners.error());
                for (std::size_t j = 0; j < corners.size(); ++j) take(corners.at(j));
            }
        });
        const double per_unit = 1 / hull_.unit;  // a power of two
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = -static_cast<double>(below_[static_cast<int>(k)]) * per_unit;
            hi_[k] = static_cast<double>(above_[static_cast<int>(k)]) * per_unit;
            largest_ = std::max({largest_, std::fabs(lo_[k]), std::fabs(hi_[k])});
        }
    }
    void take(const Vector3& corner) {
        const auto part = [&](std::size_t k) {
            return along_[k] * all_lanes(static_cast<float>(corner[k] - hull_.origin[k]));
        };
        const Float4 c = (part(0) + part(1)) + part(2);
        above_ = larger(c, above_);
        below_ = larger(-c, below_);
    }

    void set_box() {
        Vector3 center{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i) center[k] += 0.5 * (lo_[i] + hi_[i]) * axis_[i][k];
        for (std::size_t k = 0; k < 3; ++k) {
            hull_.box.center[k] = static_cast<float>(center[k]);
            center[k] = static_cast<double>(hull_.box.center[k]);
        }
        Vector3 half{};
        // Samples may be much smaller than the rest.
        const double slack = (0x1p-48 + 0x1p-21 * largest_) + 2.01 * error_ / hull_.unit;
        for (std::size_t k = 0; k < 3; ++k) {
            const double c = dot(axis_[k], center);
            half[k] = std::max(hi_[k] - c, c - lo_[k]) + slack;
        }
        const double sum = half[0] + half[1] + half[2];
        for (std::size_t k = 0; k < 3; ++k) {
            const double wanted = (half[k] + 0x1p-22 * sum) * (1 + 0x1p-20);
            hull_.box.half[k] =
                std::nextafter(static_cast<float>(wanted), std::numeric_limits<float>::infinity());
        }
    }

    [[nodiscard]] Vector3 in_units(const Vector3& p) const {
        Vector3 q = minus(p, hull_.origin);
        for (double& c : q) c /= hull_.unit;
        return q;
    }

    const CellNode& leaf_;
    LeafHull hull_;
    AreaFrame frame_;
    std::array<Vector3, 3> axis_{};
    std::array<Float4, 3> along_{};  // by coordinate; lane by axis
    Float4 above_ = all_lanes(-std::numeric_limits<float>::infinity());
    Float4 below_ = above_;  // of the negative products
    Vector3 lo_{};
    Vector3 hi_{};
    double error_ = 0;
    double largest_ = 0;
    bool is_bounded_ = true;
};

}  // namespace

LeafHull hull_of(const CellNode& leaf) { return HullFitter(leaf).fit(); }

}  // namespace trisect::detail
