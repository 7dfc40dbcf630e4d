// SPDX-License-Identifier: Apache-2.0
//
// Soon after the event, at a rational time, there is a point inside both solids. What met at the
// event is near it: a tetrahedron from a feature near it, a corner, a side or a whole triangle, to
// a neighbourhood of that point is mostly inside the solid; and those from the features that met
// overlap all the time since then, if the time is short enough to look like the event.

#include <trisect/bsp/interference/certificate/find/overlap_witness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/boxes/triangle_distance.h>
#include <trisect/bsp/interference/certificate/certified_tetrahedron.h>
#include <trisect/bsp/interference/certificate/certified_time.h>
#include <trisect/bsp/interference/certificate/find/from_world.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

using namespace proof;

namespace {

using certified::Boundary;
using certified::Polynomial;
using certified::RootTime;
using certified::Tetrahedron;

constexpr std::size_t largest_part = 8;

// In multiples of a power of two near 2^-30 of a length: short numbers.
ExactPoint rounded(const Approximate& x, double size) {
    const double unit = std::ldexp(1., std::ilogb(size) - 30);
    Approximate r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = std::round(x[k] / unit) * unit;
    return exact(r);
}

// x + s u + t v
Approximate sum(const Approximate& x, double s, const Approximate& u, double t,
                const Approximate& v) {
    return {x[0] + s * u[0] + t * v[0], x[1] + s * u[1] + t * v[1], x[2] + s * u[2] + t * v[2]};
}

Approximate some_normal_to(const Approximate& d) {
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(d[i]) < std::abs(d[k])) k = i;
    Approximate axis{};
    axis[k] = 1;
    const Approximate n = cross(d, axis);
    const double size = length(n);
    return {n[0] / size, n[1] / size, n[2] / size};
}

// The way to a point from the nearest one in the span of a corner, of two or of three.
Approximate way_from(std::span<const ExactPoint> feature, const Approximate& x) {
    const Approximate p = approximate(feature[0]);
    Approximate way = minus(x, p);
    if (feature.size() == 1) return way;
    const Approximate u = minus(approximate(feature[1]), p);
    if (feature.size() == 2) return sum(way, -dot(way, u) / dot(u, u), u, 0, u);
    const Approximate n = cross(u, minus(approximate(feature[2]), p));
    return sum({}, dot(way, n) / dot(n, n), n, 0, n);
}

// From one to three corners to a neighbourhood of a point; `width` is its size, as a part of the
// distance.
std::optional<Tetrahedron> around(const ExactPoint& p, std::span<const ExactPoint> feature,
                                  double width) {
    const Approximate x = approximate(p);
    const Approximate way = way_from(feature, x);
    const double size = length(way);
    if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
    const double w = width * size;
    const auto place = [&](double s, const Approximate& u, double t, const Approximate& v) {
        return rounded(sum(sum(x, width, way, 0, way), s, u, t, v), w);
    };
    if (feature.size() == 3)
        return Tetrahedron{feature[0], feature[1], feature[2], place(0, way, 0, way)};
    if (feature.size() == 2) {
        const Approximate n = cross(way, minus(approximate(feature[1]), approximate(feature[0])));
        const double l = length(n);
        if (!(l > 0)) return std::nullopt;
        const Approximate across{n[0] / l, n[1] / l, n[2] / l};
        return Tetrahedron{feature[0], feature[1], place(w, across, 0, way),
                           place(-w, across, 0, way)};
    }
    const Approximate u = some_normal_to(way);
    Approximate v = cross(way, u);
    for (double& c : v) c /= size;
    return Tetrahedron{feature[0], place(w, u, 0, v), place(-w / 2, u, w, v),
                       place(-w / 2, u, -w, v)};
}

// One solid at a time after the event.
class Side {
public:
    Side(const InterferenceModel& model, const std::vector<CertifiedTriangle>& triangles,
         const Pose& pose, const ExactPoint& inside)
        : model_(model),
          triangles_(triangles),
          boundary_(model.brep()),
          point_(FromWorld(detail::data_of(model), pose).moved_back(inside)) {}

    // Inside the solid, from features of the nearest triangles, each once.
    [[nodiscard]] std::vector<Tetrahedron> tetrahedra() const {
        std::set<std::vector<std::uint32_t>> seen;
        std::vector<Tetrahedron> r;
        for (const std::uint32_t t : nearest_triangles()) {
            const auto& v = detail::data_of(model_).triangles[t].vertex;
            for (std::size_t i = 0; i < 3; ++i) {
                add({v[i]}, seen, r);
                add({v[i], v[(i + 1) % 3]}, seen, r);
            }
            add({v[0], v[1], v[2]}, seen, r);
        }
        return r;
    }

private:
    [[nodiscard]] std::vector<std::uint32_t> nearest_triangles() const {
        const Approximate p = approximate(point_);
        std::vector<std::pair<double, std::uint32_t>> all;
        for (std::uint32_t t = 0; t < detail::data_of(model_).triangles.size(); ++t) {
            TriangleCorners c;
            for (std::size_t i = 0; i < 3; ++i)
                c[i] = approximate(boundary_.at(detail::data_of(model_).triangles[t].vertex[i]));
            all.emplace_back(closest_points({p, p, p}, c).squared, t);
        }
        std::ranges::sort(all);
        std::vector<std::uint32_t> r;
        for (std::size_t i = 0; i < std::min(all.size(), largest_part); ++i)
            r.push_back(all[i].second);
        return r;
    }
    void add(std::vector<VertexId> feature, std::set<std::vector<std::uint32_t>>& seen,
             std::vector<Tetrahedron>& all) const {
        std::ranges::sort(feature);
        std::vector<std::uint32_t> key;
        std::vector<ExactPoint> corners;
        for (const VertexId v : feature) {
            key.push_back(v.index);
            corners.push_back(boundary_.at(v));
        }
        if (!seen.insert(key).second) return;
        for (const double width : {0x1p-1, 0x1p-3, 0x1p-6})
            if (const auto t = around(point_, corners, width);
                t && is_within(*t, boundary_, triangles_)) {
                all.push_back(*t);
                return;
            }
    }

    const InterferenceModel& model_;
    const std::vector<CertifiedTriangle>& triangles_;
    Boundary boundary_;
    ExactPoint point_;
};

class WitnessSearch {
public:
    WitnessSearch(const OverlapCertificate& c, const InterferenceModel& a, const Motion& motion_a,
                  const InterferenceModel& b, const Motion& motion_b)
        : c_(c), a_(a), motion_a_(motion_a), b_(b), motion_b_(motion_b) {
        if (!c.polynomial.empty()) event_.emplace(c.polynomial, c.lower, c.upper);
        to_a_ = seen_from(certified::piece_of(motion_a, c.piece),
                          certified::piece_of(motion_b, c.piece));
    }

    std::optional<OverlapWitness> at(const ExactRational& until) const {
        const Pose pose_a = pose_of(motion_a_, until);
        const Pose pose_b = pose_of(motion_b_, until);
        const InterferenceCertificate s = certify_relation(a_, pose_a, b_, pose_b);
        if (!s.in_both) return std::nullopt;
        const Side side_a(a_, c_.triangles_a, pose_a, *s.in_both);
        const Side side_b(b_, c_.triangles_b, pose_b, *s.in_both);
        const auto is_positive = [&](const Polynomial& p) {
            return event_ ? event_->is_positive_after(p, until) : is_positive_after_zero(p, until);
        };
        const auto of_b = side_b.tetrahedra();
        for (const Tetrahedron& t_a : side_a.tetrahedra())
            for (const Tetrahedron& t_b : of_b)
                if (keep_overlapping(t_a, t_b, to_a_, is_positive))
                    return OverlapWitness{t_a, t_b, until};
        return std::nullopt;
    }

private:
    [[nodiscard]] Pose pose_of(const Motion& m, const ExactRational& s) const {
        const std::size_t i = std::min(c_.piece, m.piece_count() - 1);
        return m.pose_at(ExactRational(static_cast<std::int64_t>(i)) + s);
    }
    const OverlapCertificate& c_;
    const InterferenceModel& a_;
    const Motion& motion_a_;
    const InterferenceModel& b_;
    const Motion& motion_b_;
    std::optional<RootTime> event_;
    certified::Piece to_a_;
};

}  // namespace

std::optional<OverlapWitness> find_overlap_witness(const OverlapCertificate& c,
                                                   const InterferenceModel& a,
                                                   const Motion& motion_a,
                                                   const InterferenceModel& b,
                                                   const Motion& motion_b) {
    const WitnessSearch search(c, a, motion_a, b, motion_b);
    const double event = c.polynomial.empty() ? 0 : c.upper.to_double();
    for (const int bits : {5, 12, 22}) {
        // A time with few digits.
        const double unit = std::ldexp(1., -bits - 1);
        const double until = std::ceil(event / unit + 1) * unit;
        if (until > 1) continue;
        try {
            if (auto w = search.at(ExactRational::from_double(until))) return w;
        } catch (const LimitError&) {
            // A pose too wide for the static query, or a limit of the caller's.
            check_stop(0);
        }
    }
    return std::nullopt;
}

}  // namespace trisect::detail
