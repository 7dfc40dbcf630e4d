// SPDX-License-Identifier: Apache-2.0
//
// Pulling a plane back, not moving points: for corners of b bits and a pose of m bits the side of a
// corner takes 3 b + m bits or so, where moving the corner and the three corners that span the
// plane would take three times the pose. And a pose is a rational map, so rounded moved corners
// would destroy nearly all coplanarities that there were.
//
// Widths. P bounds the bits of the relative pose (895). Planes have |n| < 2^328, |d| < 2^383,
// homogeneous points |x| < 2^1044, w < 2^988 (plane.h, predicates.h); in the second column what
// whole coordinates give: |n| < 2^109, |d| < 2^163, |x| < 2^384, w < 2^330.
//   direction        w_p q - w_q p                     < 2^2033       2^715
//   n' = M^T n       three products                    < 2^(P+330)    2^(P+111)
//   d' = S d + n·t                                     < 2^(P+385)    2^(P+164)
//   n'·x + d' w                                        < 2^(P+1377)   2^(P+498)
//   n'·v                                               < 2^(P+2365)   2^(P+828)
//   M x + t w                                          < 2^(P+1046)   2^(P+386)
//   w_r (M s) - w_s (M r)                              < 2^(P+2035)   2^(P+717)
//   w_p (M r) - S w_r p                                < 2^(P+2035)   2^(P+717)
//   det(q - p, s' - r', r' - p)   six products         < 2^(2P+6106)  2^(2P+2152)
// With P = 895 the last is below 2^7896, and 2^3942 of whole coordinates; BoundedInt holds 8192. On
// lattices of b bits and a pose of m bits the numbers are 3 b + m + 5 for sides and 3 b + 2 m + 8
// for two edges.

#include <trisect/kernel/pose/moved_predicates.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/int128.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

double mag(double v) { return v < 0 ? -v : v; }

IntVector to_ints(const VectorOf<std::int64_t>& x) {
    return {BoundedInt(x[0]), BoundedInt(x[1]), BoundedInt(x[2])};
}

int counted(int sign, bool narrow) {
    auto& counters = detail::counters_of_thread<PredicateCounters>;
    ++(narrow ? counters.exact_narrow : counters.exact_wide);
    return sign;
}

constexpr int narrow_bits = 255;

// A lattice point without fractions.
bool is_whole(const Point& p) { return p.is_lattice() && p.lattice().is_whole(); }

// 128 bits ------------------------------------------------------------------------------------
//
// Lengths are added up before anything is multiplied: |v| < 2^bits(v), a product of lengths a and b
// is below 2^(a + b), a sum of two below twice the larger one. 126 bits and a sign fit.
constexpr int short_bits = 126;

using ShortVector = std::array<Int128, 3>;

int bits(Int128 v) {
    const Uint128 u = v < 0 ? -static_cast<Uint128>(v) : static_cast<Uint128>(v);
    const auto high = static_cast<std::uint64_t>(u >> 64U);
    return high != 0 ? 128 - std::countl_zero(high)
                     : 64 - std::countl_zero(static_cast<std::uint64_t>(u));
}
int bits(const ShortVector& v) { return std::max({bits(v[0]), bits(v[1]), bits(v[2])}); }

ShortVector to_short(const VectorOf<std::int64_t>& v) { return {v[0], v[1], v[2]}; }
// The way from p to the moved point r, times the pose's denominator; below 2^88.
ShortVector way(const LatticePoint& p, const MovedPoint& r) {
    ShortVector v = r.short_numbers();
    const std::int64_t s = r.pose().short_numbers()->s;
    const auto x = to_integers(p);
    for (std::size_t k = 0; k < 3; ++k) v[k] -= Int128{s} * x[k];
    return v;
}
int counted_short(Int128 v) {
    ++detail::counters_of_thread<PredicateCounters>.exact_short;
    return v > 0 ? 1 : (v < 0 ? -1 : 0);
}

std::optional<int> short_orientation(const LatticePoint& p, const LatticePoint& q,
                                     const MovedPoint& r, const MovedPoint& s) {
    const ShortVector u = to_short(difference(q, p));
    const ShortVector v = minus(s.short_numbers(), r.short_numbers());
    const ShortVector w = way(p, r);
    if (bits(u) + bits(v) + bits(w) + 3 > short_bits) return std::nullopt;
    return counted_short(dot(u, cross(v, w)));
}

std::optional<int> short_planar_orientation(const LatticePoint& p, const LatticePoint& q,
                                            const MovedPoint& r, std::size_t i, std::size_t j) {
    const ShortVector u = to_short(difference(q, p));
    const ShortVector w = way(p, r);
    if (bits(u) + bits(w) + 1 > short_bits) return std::nullopt;
    return counted_short(u[i] * w[j] - u[j] * w[i]);
}

// w_p q - w_q p with positive weights.
IntVector difference(const IntPoint& from, const IntPoint& to) {
    IntVector v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = from.w * to.x[i] - to.w * from.x[i];
    return v;
}

// Largest entry and largest error of a difference of two approximations.
struct SizedVector {
    std::array<double, 3> c{};
    double size = 0;   // of the largest component, error included
    double error = 0;  // of each component
};

SizedVector difference(const Approximation& from, const Approximation& to) {
    SizedVector v;
    for (std::size_t i = 0; i < 3; ++i) {
        v.c[i] = to.c[i] - from.c[i];
        if (mag(v.c[i]) > v.size) v.size = mag(v.c[i]);
    }
    // One rounding of the subtraction, relative to the result.
    v.error = (from.error + to.error) * error_slack + v.size * unit_roundoff;
    v.size += v.error;
    return v;
}

// A sign that doubles prove, or 0.
int filtered_orientation(const SizedVector& u, const SizedVector& v, const SizedVector& w) {
    const auto minor = [](const SizedVector& a, const SizedVector& b, std::size_t i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        return a.c[j] * b.c[k] - a.c[k] * b.c[j];
    };
    const double det = u.c[0] * minor(v, w, 0) + u.c[1] * minor(v, w, 1) + u.c[2] * minor(v, w, 2);
    // Six products of three entries. Replacing an entry by one within `error` changes a product by
    // at most error times the two other sizes; five roundings of 2^-53 a product and the sums,
    // below 8 · 2^-53 of six products of sizes. 6.1 and 2^-47 pay for second-order terms and for
    // the bound's own rounding, 2^-900 for underflow.
    const double vw = v.size * w.size;
    const double bound = 6.1 * (u.error * vw + u.size * (v.error * w.size + v.size * w.error)) +
                         0x1p-47 * (u.size * vw) + 0x1p-900;
    return det > bound ? 1 : (det < -bound ? -1 : 0);
}

}  // namespace

IntPoint exact_point(const Point& p) {
    if (is_whole(p)) return {to_ints(to_integers(p.lattice())), BoundedInt(1)};
    const HomogeneousPoint h = p.homogeneous();
    return {{BoundedInt(h.xyz[0]), BoundedInt(h.xyz[1]), BoundedInt(h.xyz[2])}, BoundedInt(h.w)};
}

// Directions ---------------------------------------------------------------------------------

Direction::Direction(const Point& from, const Point& to) {
    if (is_whole(from) && is_whole(to)) {
        v_ = to_ints(difference(to.lattice(), from.lattice()));
    } else {
        v_ = difference(exact_point(from), exact_point(to));
    }
    make_doubles();
}

void Direction::make_doubles() {
    int top = 0;
    for (const BoundedInt& v : v_)
        if (v.bit_length() > top) top = v.bit_length();
    const int down = top > 64 ? top - 64 : 0;  // a common positive factor does not matter
    for (std::size_t i = 0; i < 3; ++i) {
        const BoundedInt::Scaled s = v_[i].scaled();
        // Of whole coordinates at most 651 places down. Farther down a double might underflow;
        // then there are none, and nothing is decided by them.
        if (s.mantissa != 0 && s.exponent - down < -900) {
            f_ = {};
            return;
        }
        f_[i] = s.mantissa == 0 ? 0.0 : std::ldexp(s.mantissa, s.exponent - down);
    }
}

Direction Direction::operator-() const {
    Direction r(*this);
    for (BoundedInt& v : r.v_) v = -v;
    for (double& v : r.f_) v = -v;
    return r;
}

Direction Direction::between(const Direction& a, const Direction& b, int weight_a, int weight_b) {
    Direction r;
    for (std::size_t i = 0; i < 3; ++i)
        r.v_[i] = BoundedInt(weight_a) * a.v_[i] + BoundedInt(weight_b) * b.v_[i];
    r.make_doubles();
    return r;
}

// Planes -------------------------------------------------------------------------------------

PulledPlane::PulledPlane(const Plane& plane, const RelativePose& pose)
    : plane_(&plane), pose_(&pose) {
    if (!pose.has_doubles()) return;
    // Coefficients of the pose have a relative error of 2^-50, those of the plane 2^-53; products
    // and sums add three roundings: below 1.6 · 2^-50 of the sum of magnitudes.
    const auto& m = pose.approx_rows();
    const auto& t = pose.approx_translation();
    fd_ = plane.approx_offset();
    double d_terms = mag(fd_);
    for (std::size_t i = 0; i < 3; ++i) {
        const double n = plane.approx_normal(static_cast<int>(i));
        for (std::size_t j = 0; j < 3; ++j) {
            const double term = m[i][j] * n;
            fn_[j] += term;
            fn_error_[j] += mag(term);
        }
        const double term = t[i] * n;
        fd_ += term;
        d_terms += mag(term);
    }
    for (double& e : fn_error_) e *= 0x1p-49;
    // The last term is for coordinates of points of planes that nearly underflow.
    fd_error_ = 0x1p-49 * d_terms + 0x1p-900;
}

const PulledPlane::Exact& PulledPlane::exact() const {
    if (known_) return exact_;
    const IntVector n{BoundedInt(plane_->normal(0)), BoundedInt(plane_->normal(1)),
                      BoundedInt(plane_->normal(2))};
    for (std::size_t j = 0; j < 3; ++j)
        exact_.n[j] = pose_->row(0)[j] * n[0] + pose_->row(1)[j] * n[1] + pose_->row(2)[j] * n[2];
    exact_.d = pose_->denominator() * BoundedInt(plane_->offset()) + dot(n, pose_->translation());
    int bits = 0;
    for (const BoundedInt& v : exact_.n)
        if (v.bit_length() > bits) bits = v.bit_length();
    exact_.narrow =
        bits + coordinate_bits + 2 <= narrow_bits && exact_.d.bit_length() + 2 <= narrow_bits;
    known_ = true;
    return exact_;
}

const PulledPlane::Short& PulledPlane::short_numbers() const {
    if (short_known_) return short_;
    short_known_ = true;
    const RelativePose::Short* pose = pose_->short_numbers();
    if (pose == nullptr) return short_;
    if (plane_->tier() > 1) return short_;
    const ShortVector n{to_int128(plane_->normal(0)), to_int128(plane_->normal(1)),
                        to_int128(plane_->normal(2))};
    const BoundedInt offset(plane_->offset());
    // S d and n·t are below 2^125 each.
    if (bits(n) + pose->bits + 3 > short_bits ||
        offset.bit_length() + bits(pose->s) + 1 > short_bits)
        return short_;
    for (std::size_t j = 0; j < 3; ++j)
        short_.n[j] = n[0] * pose->m[0][j] + n[1] * pose->m[1][j] + n[2] * pose->m[2][j];
    short_.d =
        offset.to_int128() * pose->s + dot(n, ShortVector{pose->t[0], pose->t[1], pose->t[2]});
    short_.n_bits = bits(short_.n);
    return short_;
}

int PulledPlane::exact_side_of(const Point& p) const {
    const bool whole = is_whole(p);
    if (whole && pose_->short_numbers() != nullptr) {
        const Short& e = short_numbers();
        const ShortVector x = to_short(to_integers(p.lattice()));
        // n·x is below 2^125, d below 2^126.
        if (e.n_bits + bits(x) + 3 <= short_bits) return counted_short(dot(e.n, x) + e.d);
    }
    const Exact& e = exact();
    if (whole) return counted((dot(e.n, to_ints(to_integers(p.lattice()))) + e.d).sign(), e.narrow);
    const IntPoint x = exact_point(p);
    return counted((dot(e.n, x.x) + e.d * x.w).sign(), false);
}

int PulledPlane::side_of(const Point& p) const {
    if (!pose_->has_doubles()) return exact_side_of(p);
    const Approximation& a = p.approximation();
    double value = fd_;
    double terms = mag(fd_);
    double error = fd_error_;
    for (std::size_t i = 0; i < 3; ++i) {
        const double term = fn_[i] * a.c[i];
        value += term;
        terms += mag(term);
        error += fn_error_[i] * mag(a.c[i]) + a.error * (mag(fn_[i]) + fn_error_[i]);
    }
    // Beside the errors of coefficients and point, four roundings of the terms; the factors pay for
    // the rounding of the bound itself.
    const double bound = 0x1p-50 * terms + error_slack * error;
    if (value > bound || value < -bound) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return value > 0 ? 1 : -1;
    }
    return exact_side_of(p);
}

int PulledPlane::along(const Direction& v) const {
    if (pose_->has_doubles()) {
        double value = 0;
        double terms = 0;
        double error = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double term = fn_[i] * v.approx()[i];
            value += term;
            terms += mag(term);
            error += fn_error_[i] * mag(v.approx()[i]);
        }
        // The direction's relative error is 2^-51, four roundings of 2^-53; 2^-900 for what
        // underflows.
        const double bound = 0x1p-49 * terms + error_slack * error + 0x1p-900;
        if (value > bound || value < -bound) {
            ++detail::counters_of_thread<PredicateCounters>.filtered;
            return value > 0 ? 1 : -1;
        }
    }
    const IntVector& exact_v = v.exact();
    const int v_bits =
        std::max({exact_v[0].bit_length(), exact_v[1].bit_length(), exact_v[2].bit_length()});
    if (v_bits <= 64 && pose_->short_numbers() != nullptr &&
        short_numbers().n_bits + v_bits + 2 <= short_bits)
        return counted_short(dot(short_numbers().n, {exact_v[0].to_int128(), exact_v[1].to_int128(),
                                                     exact_v[2].to_int128()}));
    const Exact& e = exact();
    const BoundedInt value = dot(e.n, exact_v);
    return counted(value.sign(), value.bit_length() <= narrow_bits);
}

int PulledPlane::sense_of(const Plane& parallel) const {
    const int axis = parallel.dominant_axis();
    const auto k = static_cast<std::size_t>(axis);
    const Short& e = short_numbers();
    const int sign =
        e.n_bits < 128 ? (e.n[k] > 0 ? 1 : 0) - (e.n[k] < 0 ? 1 : 0) : exact().n[k].sign();
    TRISECT_EXPECTS(sign != 0, "the sense of planes that are not parallel");
    return parallel.normal(axis) > 0 ? sign : -sign;
}

bool PulledPlane::is_same_as(const Plane& other) const {
    const Exact& e = exact();
    const IntVector n{BoundedInt(other.normal(0)), BoundedInt(other.normal(1)),
                      BoundedInt(other.normal(2))};
    for (std::size_t i = 0; i < 3; ++i)
        if (!cross(e.n, n, i).is_zero()) return false;
    const auto axis = static_cast<std::size_t>(other.dominant_axis());
    return e.d * n[axis] == BoundedInt(other.offset()) * e.n[axis];
}

// Points and edges ---------------------------------------------------------------------------

const IntPoint& MovedPoint::exact() const {
    if (known_) return exact_;
    IntPoint x = exact_point(*point_);
    for (std::size_t i = 0; i < 3; ++i)
        exact_.x[i] = dot(pose_->row(i), x.x) + pose_->translation()[i] * x.w;
    exact_.w = x.w;
    known_ = true;
    return exact_;
}

std::array<Int128, 3> MovedPoint::short_numbers() const {
    const RelativePose::Short& pose = *pose_->short_numbers();
    const auto p = to_integers(point_->lattice());
    ShortVector x;
    for (std::size_t i = 0; i < 3; ++i)
        x[i] = Int128{pose.m[i][0]} * p[0] + Int128{pose.m[i][1]} * p[1] +
               Int128{pose.m[i][2]} * p[2] + pose.t[i];
    return x;
}

bool MovedPoint::is_at(const Point& p) const {
    if (pose_->has_doubles()) {
        const Approximation& a = p.approximation();
        const Approximation& b = approximation();
        const double error = error_slack * (a.error + b.error);
        for (std::size_t i = 0; i < 3; ++i)
            if (mag(a.c[i] - b.c[i]) > error) return false;
    }
    if (is_whole(p) && is_whole(*point_) && pose_->short_numbers() != nullptr) {
        ++detail::counters_of_thread<PredicateCounters>.exact_short;
        return way(p.lattice(), *this) == ShortVector{};
    }
    const IntPoint from = exact_point(p);
    const BoundedInt weight = pose_->denominator() * exact().w;
    bool same = true;
    for (std::size_t i = 0; i < 3; ++i) same = same && from.w * exact().x[i] == weight * from.x[i];
    (void)counted(0, weight.bit_length() <= narrow_bits);
    return same;
}

namespace {

bool are_short(const Point& p, const Point& q, const MovedPoint& r) {
    return is_whole(p) && is_whole(q) && is_whole(r.point()) && r.pose().short_numbers() != nullptr;
}

}  // namespace

int orientation(const Point& p, const Point& q, const MovedPoint& r, const MovedPoint& s) {
    if (r.pose().has_doubles()) {
        const int sign = filtered_orientation(difference(p.approximation(), q.approximation()),
                                              difference(r.approximation(), s.approximation()),
                                              difference(p.approximation(), r.approximation()));
        if (sign != 0) {
            ++detail::counters_of_thread<PredicateCounters>.filtered;
            return sign;
        }
    }
    if (are_short(p, q, r) && is_whole(s.point()))
        if (const auto sign = short_orientation(p.lattice(), q.lattice(), r, s)) return *sign;
    const IntPoint from = exact_point(p);
    const IntVector u = difference(from, exact_point(q));
    const IntVector v = difference(r.exact(), s.exact());
    const BoundedInt weight = r.pose().denominator() * r.exact().w;
    IntVector w;
    for (std::size_t i = 0; i < 3; ++i) w[i] = from.w * r.exact().x[i] - weight * from.x[i];
    const BoundedInt value = determinant(u, v, w);
    return counted(value.sign(), value.bit_length() <= narrow_bits);
}

int planar_orientation(const Point& p, const Point& q, const MovedPoint& r, int axis) {
    const auto i = static_cast<std::size_t>((axis + 1) % 3);
    const auto j = static_cast<std::size_t>((axis + 2) % 3);
    if (r.pose().has_doubles()) {
        const SizedVector u = difference(p.approximation(), q.approximation());
        const SizedVector v = difference(p.approximation(), r.approximation());
        const double value = u.c[i] * v.c[j] - u.c[j] * v.c[i];
        const double bound =
            2.1 * (u.error * v.size + u.size * v.error) + 0x1p-49 * (u.size * v.size) + 0x1p-900;
        if (value > bound || value < -bound) {
            ++detail::counters_of_thread<PredicateCounters>.filtered;
            return value > 0 ? 1 : -1;
        }
    }
    if (are_short(p, q, r))
        if (const auto sign = short_planar_orientation(p.lattice(), q.lattice(), r, i, j))
            return *sign;
    const IntPoint from = exact_point(p);
    const IntPoint to = exact_point(q);
    const BoundedInt weight = r.pose().denominator() * r.exact().w;
    const auto along = [&](std::size_t k) { return from.w * to.x[k] - to.w * from.x[k]; };
    const auto across = [&](std::size_t k) { return from.w * r.exact().x[k] - weight * from.x[k]; };
    const BoundedInt value = along(i) * across(j) - along(j) * across(i);
    return counted(value.sign(), value.bit_length() <= narrow_bits);
}

int determinant_sign(const Direction& a, const Direction& b, const Direction& c,
                     const RelativePose& pose) {
    IntVector moved;
    for (std::size_t i = 0; i < 3; ++i) moved[i] = dot(pose.row(i), c.exact());
    const BoundedInt value = determinant(a.exact(), b.exact(), moved);
    return counted(value.sign(), value.bit_length() <= narrow_bits);
}

}  // namespace trisect::detail
