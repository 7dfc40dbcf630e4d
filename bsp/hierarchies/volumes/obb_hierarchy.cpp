// SPDX-License-Identifier: Apache-2.0
//
// Oriented boxes in binary trees and trees of four children, each in doubles (Gottschalk, Lin and
// Manocha 1996: fifteen axes; directions from the covariance of the surface).
//
// A box stands for the slabs |u_i · (x - c)| <= h_i. In coordinates y = U (x - c) of A's box the
// slabs are |y_i| <= h_i exactly, whatever U is, and the image of B's box is t + Σ s_j b_j r_j,
// |s_j| <= 1, with r_j = U M v_j / s, b_j = s h_j, s the stretch of M. For any vector L
//
//     |L·t| > Σ h_i |L_i| + Σ b_j |L·r_j|
//
// proves them apart. L runs through the unit vectors, the r_j, and the products of both. Where M is
// a similarity and U, V are orthonormal up to 2^-48, r_j·r_k = δ_jk and r_j × r_k = ± r_l up to
// 2^-38; so the last sum is read off the matrix r for all fifteen. For other maps the first three
// axes are used alone.
//
// All vectors are below Λ = |t_AB| + 2 + 2 s long. Every sum has at most 15 terms and doubles lose
// less than 2^-47 Λ in it; t is off by 2 (t_error + 6 m_error), r by 3 m_error / s. One margin of
// 2^-35 Λ + 4 t_error + 24 m_error covers all that. Contents: projections onto a float axis have
// an error below 2^-49 and 1.8 of the points'; that slabs of B are within c + Σ s_j h_j v_j takes
// another 2^-46.

#include <cmath>

#include <trisect/bsp/hierarchies/volumes/frame_hull.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchy.h>
#include <trisect/bsp/interference/boxes/obb_fit.h>

namespace trisect::hierarchies {

namespace {

using detail::dot;
using detail::Vector3;

struct Box {
    std::array<Vector3, 3> axis{};
    Vector3 center{};
    Vector3 half{};
};

struct BoxKind {
    using Volume = Box;
    // In A's frame, axes divided by the stretch, halves times it.
    using Moved = Box;

    class Pose {
    public:
        explicit Pose(const FrameMap& map) : map_(map) {
            double length = 0;
            for (const double t : map.t) length += std::abs(t);
            margin_ = 0x1p-35 * (length + 2 + 2 * map.stretch) + 4 * map.t_error + 24 * map.m_error;
            const double square = map.stretch * map.stretch;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) {
                    double g = 0;
                    for (std::size_t k = 0; k < 3; ++k) g += map.m[k][i] * map.m[k][j];
                    if (!(std::abs(g / square - (i == j ? 1 : 0)) <= 0x1p-38)) similar_ = false;
                }
            if (!(map.m_error <= 0x1p-40 * map.stretch)) similar_ = false;
        }
        [[nodiscard]] Moved moved(const Volume& v) const {
            Moved r;
            r.center = map_(v.center);
            for (std::size_t j = 0; j < 3; ++j) {
                for (std::size_t k = 0; k < 3; ++k)
                    r.axis[j][k] = dot(map_.m[k], v.axis[j]) / map_.stretch;
                r.half[j] = v.half[j] * map_.stretch;
            }
            return r;
        }
        [[nodiscard]] bool meet(const Volume& a, const Moved& b) const {
            const Vector3 way = detail::minus(b.center, a.center);
            Vector3 t;
            std::array<Vector3, 3> r;
            std::array<Vector3, 3> q;
            for (std::size_t i = 0; i < 3; ++i) {
                t[i] = dot(a.axis[i], way);
                for (std::size_t j = 0; j < 3; ++j) {
                    r[i][j] = dot(a.axis[i], b.axis[j]);
                    q[i][j] = std::abs(r[i][j]);
                }
                if (std::abs(t[i]) > a.half[i] + dot(q[i], b.half) + margin_) return false;
            }
            if (!similar_) return true;
            for (std::size_t j = 0; j < 3; ++j) {
                const double along = t[0] * r[0][j] + t[1] * r[1][j] + t[2] * r[2][j];
                const double reach =
                    a.half[0] * q[0][j] + a.half[1] * q[1][j] + a.half[2] * q[2][j] + b.half[j];
                if (std::abs(along) > reach + margin_) return false;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t i1 = (i + 1) % 3;
                const std::size_t i2 = (i + 2) % 3;
                for (std::size_t j = 0; j < 3; ++j) {
                    const std::size_t j1 = (j + 1) % 3;
                    const std::size_t j2 = (j + 2) % 3;
                    const double along = t[i2] * r[i1][j] - t[i1] * r[i2][j];
                    const double reach = a.half[i1] * q[i2][j] + a.half[i2] * q[i1][j] +
                                         b.half[j1] * q[i][j2] + b.half[j2] * q[i][j1];
                    if (std::abs(along) > reach + margin_) return false;
                }
            }
            return true;
        }
        // Along the normals of both boxes and the line of centres.
        [[nodiscard]] double gap(const Volume& a, const Moved& b) const {
            const Vector3 way = detail::minus(b.center, a.center);
            Vector3 t;
            std::array<Vector3, 3> r;
            double best = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                t[i] = dot(a.axis[i], way);
                double reach = a.half[i];
                for (std::size_t j = 0; j < 3; ++j) {
                    r[i][j] = dot(a.axis[i], b.axis[j]);
                    reach += std::abs(r[i][j]) * b.half[j];
                }
                best = std::max(best, std::abs(t[i]) - reach);
            }
            double across = 0;
            for (std::size_t j = 0; j < 3; ++j) {
                const double along = t[0] * r[0][j] + t[1] * r[1][j] + t[2] * r[2][j];
                across += std::abs(along) * b.half[j] + std::abs(t[j]) * a.half[j];
                if (!similar_) continue;
                double reach = b.half[j];
                for (std::size_t i = 0; i < 3; ++i) reach += a.half[i] * std::abs(r[i][j]);
                best = std::max(best, std::abs(along) - reach);
            }
            const double length = std::sqrt(dot(t, t));
            if (length > 0) best = std::max(best, length - across / length);
            return std::max(0.0, best * (1 - 0x1p-36) - margin_);
        }

    private:
        FrameMap map_;
        double margin_ = 0;
        bool similar_ = true;
    };

    static constexpr bool has_unite = false;
    static Volume fit(std::span<const Vector3> corners, double error) {
        if (corners.size() == 3) return fit_to_triangle(corners, error);
        detail::AreaMoments moments;
        for (std::size_t i = 0; i < corners.size(); i += 3)
            moments.add(corners[i], corners[i + 1], corners[i + 2]);
        return fit_along(detail::principal_frame(moments), corners, error);
    }
    static double size(const Box& b) { return b.half[0] + b.half[1] + b.half[2]; }
    static VolumeOutline outline(const Box& b) {
        VolumeOutline out;
        for (std::size_t i = 0; i < 3; ++i) {
            const double middle = dot(b.axis[i], b.center);
            out.slabs.push_back({b.axis[i], middle - b.half[i], middle + b.half[i]});
        }
        return out;
    }

protected:
    static Volume fit_to_triangle(std::span<const Vector3> corners, double error) {
        return fit_along(detail::triangle_frame(corners[0], corners[1], corners[2]), corners,
                         error);
    }
    static Volume fit_along(const detail::AreaFrame& frame, std::span<const Vector3> corners,
                            double error) {
        Box box;
        box.axis = frame.axis;
        Vector3 middle{};
        for (std::size_t i = 0; i < 3; ++i) {
            double lo = dot(box.axis[i], corners[0]);
            double hi = lo;
            for (const Vector3& c : corners) {
                const double v = dot(box.axis[i], c);
                lo = std::min(lo, v);
                hi = std::max(hi, v);
            }
            middle[i] = 0.5 * (lo + hi);
        }
        for (std::size_t k = 0; k < 3; ++k)
            box.center[k] = box.axis[0][k] * middle[0] + box.axis[1][k] * middle[1] +
                            box.axis[2][k] * middle[2];
        // About the centre as it came out.
        for (std::size_t i = 0; i < 3; ++i) {
            double half = 0;
            for (const Vector3& c : corners)
                half = std::max(half, std::abs(dot(box.axis[i], detail::minus(c, box.center))));
            box.half[i] = half + 1.8 * error + 0x1p-45;
        }
        return box;
    }
};

// Along the principal axes of the hull's surface, as the paper has it: what is within the hull does
// not turn the box, however much surface there is.
struct HullBoxKind : BoxKind {
    static Volume fit(std::span<const Vector3> corners, double error) {
        if (corners.size() == 3) return fit_to_triangle(corners, error);
        const detail::AreaMoments moments = surface_moments(frame_hull(corners));
        return fit_along(detail::principal_frame(moments), corners, error);
    }
};

}  // namespace

std::unique_ptr<PairStructure> make_obb_tree(const InterferenceModel& a, const InterferenceModel& b,
                                             const TreeOptions& options) {
    return std::make_unique<VolumeHierarchy<BoxKind>>(a, b, options,
                                                      options.arity == 2 ? "obb" : "obb-wide");
}
std::unique_ptr<PairStructure> make_obb_tree(const InterferenceModel& a,
                                             const InterferenceModel& b) {
    return make_obb_tree(a, b, TreeOptions{});
}
std::unique_ptr<PairStructure> make_hull_obb_tree(const InterferenceModel& a,
                                                  const InterferenceModel& b) {
    return std::make_unique<VolumeHierarchy<HullBoxKind>>(a, b, TreeOptions{}, "obb-hull");
}
std::unique_ptr<PairStructure> make_wide_obb_tree(const InterferenceModel& a,
                                                  const InterferenceModel& b) {
    TreeOptions options;
    options.arity = 4;
    return make_obb_tree(a, b, options);
}

}  // namespace trisect::hierarchies
