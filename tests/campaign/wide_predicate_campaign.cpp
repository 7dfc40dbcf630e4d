// SPDX-License-Identifier: Apache-2.0
//
// Signs of lattice points and of constructed points on raw doubles, against CGAL.
//
// Coordinates are doubles that span up to 126 bits: decimals k / 10^d of several magnitudes, binary
// ones with exponents from a range of 73, and such of one exponent. The library gets them in
// lattice units, with bits behind the point; the oracles get the doubles. An input is four
// triangles and two points. Compared are the sides of points of the input and the common points of
// three planes, and on which side of the fourth they are.
//
// Oracles: the predicates of CGAL's Exact_predicates_inexact_constructions_kernel for points of the
// input. For constructed points determinants in CGAL's intervals, and in Gmpz where these do not
// decide; in one input of 16 also planes, points and sides of CGAL's kernel with exact
// constructions.
//
//     wide_predicate_campaign [--seed S] [--random N] [--degenerate M]
//
// Inputs are drawn until N answers on random and M on nearly degenerate input have been compared.
// The latter are built around a common point, line or plane, parallel planes, triangles or points
// that nearly coincide, and planes through the rounded common point of three others; then each
// corner is moved by one ulp or left where it is. Exits with 1 when an answer differs.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

namespace {

using trisect::Approximation;
using trisect::Coordinate;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::Point3d;

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

// All coordinates of an input are multiples of 2^(top - span + 1) below 2^(top + 1).
constexpr int span = 126;

using Triangle = std::array<Point3d, 3>;

struct Input {
    int top = 0;
    std::array<Triangle, 4> triangles;
    std::array<Point3d, 2> points;
};

// Inputs -----------------------------------------------------------------------------------------

class Generator {
public:
    explicit Generator(std::uint64_t seed) : engine_(seed) {}

    Input random() {
        start();
        return all_points();
    }

    Input degenerate() {
        start();
        Input in = all_points();
        switch (below(7)) {
            case 0:
                common_point(in);
                break;
            case 1:
                common_line(in);
                break;
            case 2:
                nearly_parallel(in);
                break;
            case 3:
                same_plane(in);
                break;
            case 4:
                nearly_coincident(in);
                break;
            case 5:
                nearly_concurrent(in);
                break;
            default:
                flush(in);
                break;
        }
        return in;
    }

private:
    std::uint64_t below(std::uint64_t n) { return engine_() % n; }
    bool chance(std::uint64_t of) { return below(of) == 0; }

    void start() {
        top_ = static_cast<int>(below(81)) - 40;
        style_ = static_cast<int>(below(3));
        digits_ = 1 + static_cast<int>(below(15));
        spread_ = static_cast<int>(below(21));
        bits_ = 1 + static_cast<int>(below(53));
    }
    [[nodiscard]] double finest() const { return std::ldexp(1.0, top_ - span + 1); }
    // A multiple of the finest unit within the range.
    [[nodiscard]] double fit(double v) const {
        const double limit = std::ldexp(1.0, top_ + 1);
        if (!(std::fabs(v) < limit)) v = std::copysign(std::nextafter(limit, 0), v);
        return std::ldexp(std::nearbyint(std::ldexp(v, span - 1 - top_)), top_ - span + 1);
    }
    double coordinate() {
        const std::uint64_t r = engine_();
        const double sign = (r & 1U) != 0 ? 1 : -1;
        if (style_ == 0) {
            // k / 10^d, rounded once like a decimal text.
            static constexpr std::array<double, 23> powers{
                1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
            const auto k = static_cast<double>(
                (r >> 1) % static_cast<std::uint64_t>(powers[static_cast<std::size_t>(digits_)]));
            // The largest are about 2^top.
            const int magnitude = static_cast<int>(std::floor(0.30103 * top_)) -
                                  static_cast<int>(below(static_cast<unsigned>(spread_) + 1));
            const int d = digits_ - magnitude;
            const double v =
                d < 0    ? k * powers[static_cast<std::size_t>(std::min(22, -d))]
                : d < 23 ? k / powers[static_cast<std::size_t>(d)]
                         : k / 1e22 / powers[static_cast<std::size_t>(std::min(22, d - 22))];
            return fit(sign * v);
        }
        const int e = style_ == 1 ? top_ - static_cast<int>(below(74)) : top_;
        const auto m = static_cast<double>((r >> 11) | (std::uint64_t{1} << 52));
        const double cut = std::ldexp(std::floor(std::ldexp(m, bits_ - 53)), 53 - bits_);
        return fit(std::ldexp(sign * cut, e - 52));
    }
    Point3d point() { return {coordinate(), coordinate(), coordinate()}; }
    Triangle triangle() { return {point(), point(), point()}; }
    Input all_points() {
        Input in;
        in.top = top_;
        for (Triangle& t : in.triangles) t = triangle();
        for (Point3d& p : in.points) p = point();
        return in;
    }
    // By an ulp, or by the finest unit where that is more.
    double moved(double v, bool up) const {
        const double to = up ? HUGE_VAL : -HUGE_VAL;
        const double next = std::nextafter(v, to);
        const double out = fit(next);
        return out == next ? out : fit(v + (up ? finest() : -finest()));
    }
    // Each coordinate by one ulp up or down, or left where it is; half of all points stay.
    Point3d maybe_moved(Point3d p) {
        if (chance(2)) return p;
        for (double& c : p)
            if (const std::uint64_t way = below(3); way != 0) c = moved(c, way == 1);
        return p;
    }
    Point3d combination(const Point3d& o, double s, const Point3d& a, double t,
                        const Point3d& b) const {
        Point3d out{};
        for (std::size_t k = 0; k < 3; ++k)
            out[k] = fit(o[k] + s * (a[k] - o[k]) + t * (b[k] - o[k]));
        return out;
    }

    void common_point(Input& in) {
        const Point3d o = point();
        for (Triangle& t : in.triangles) t[0] = maybe_moved(o);
        in.points = {o, maybe_moved(o)};
    }
    void common_line(Input& in) {
        const Point3d a = point();
        const Point3d b = point();
        for (Triangle& t : in.triangles) {
            t[0] = maybe_moved(a);
            t[1] = maybe_moved(b);
        }
        if (chance(2)) in.triangles[2] = triangle();
        in.points = {maybe_moved(a), combination(a, 0.5, b, 0, b)};
    }
    void nearly_parallel(Input& in) {
        const Triangle base = triangle();
        const Point3d shift = point();
        const bool small = chance(2);
        for (Triangle& t : in.triangles) {
            const bool shifted = chance(2);
            for (std::size_t i = 0; i < 3; ++i) {
                t[i] = base[i];
                for (std::size_t k = 0; shifted && k < 3; ++k)
                    t[i][k] = fit(0.5 * base[i][k] + (small ? 0x1p-40 : 0.25) * shift[k]);
                t[i] = maybe_moved(t[i]);
            }
            if (chance(2)) std::swap(t[0], t[1]);
        }
        if (chance(2)) in.triangles[2] = triangle();
        in.points = {maybe_moved(base[0]), combination(base[0], 0.5, base[1], 0.5, base[2])};
    }
    // Corners of one plane as far as doubles are on it.
    void same_plane(Input& in) {
        const Triangle base = triangle();
        const auto any = [&] {
            const double s = 0.25 * static_cast<double>(below(9)) - 1;
            const double t = 0.25 * static_cast<double>(below(9)) - 1;
            return maybe_moved(combination(base[0], s, base[1], t, base[2]));
        };
        for (Triangle& t : in.triangles)
            for (Point3d& p : t) p = any();
        if (chance(2)) in.triangles[1] = triangle();
        if (chance(2)) in.triangles[2] = triangle();
        in.points = {any(), any()};
    }
    void nearly_coincident(Input& in) {
        in.triangles[3] = in.triangles[2];
        for (Point3d& p : in.triangles[3]) p = maybe_moved(p);
        std::swap(in.triangles[3][0], in.triangles[3][below(3)]);
        in.points = {maybe_moved(in.triangles[2][0]), maybe_moved(in.triangles[0][0])};
    }
    // The fourth plane passes through what doubles make of the common point of the others.
    void nearly_concurrent(Input& in) {
        const auto x = rounded_common_point(in);
        if (!x) return common_point(in);
        in.triangles[3][0] = maybe_moved(*x);
        in.points = {*x, maybe_moved(*x)};
    }
    // Planes perpendicular to axes, decimals that coincide.
    void flush(Input& in) {
        const Point3d o = point();
        for (Triangle& t : in.triangles) {
            const std::size_t axis = below(3);
            for (Point3d& p : t) {
                p[axis] = o[axis];
                if (chance(3)) p = maybe_moved(p);
            }
        }
        in.points = {o, maybe_moved(o)};
    }

    std::optional<Point3d> rounded_common_point(const Input& in);

    std::mt19937_64 engine_;
    int top_ = 0, style_ = 0, digits_ = 0, spread_ = 0, bits_ = 0;
};

// Oracle -----------------------------------------------------------------------------------------

template <class N>
using Rows = std::array<std::array<N, 4>, 4>;

// Normal and offset of the plane through three points.
template <class N>
std::array<N, 4> plane_of(const std::array<std::array<N, 3>, 3>& t) {
    std::array<N, 3> u;
    std::array<N, 3> v;
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = t[1][k] - t[0][k];
        v[k] = t[2][k] - t[0][k];
    }
    std::array<N, 4> out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    out[3] = -(out[0] * t[0][0] + out[1] * t[0][1] + out[2] * t[0][2]);
    return out;
}

// det3[s]: of the normals of all planes but s, in order. det4: of all rows.
template <class N>
struct Determinants {
    std::array<N, 4> det3;
    N det4;
};

template <class N>
Determinants<N> determinants_of(const Rows<N>& r) {
    const auto minor = [&](std::size_t i, std::size_t j, std::size_t a, std::size_t b) {
        return r[i][a] * r[j][b] - r[i][b] * r[j][a];
    };
    // Columns 0 and 1 of two rows, with columns 2 and 3 of the two others.
    const N a01 = minor(0, 1, 0, 1), a02 = minor(0, 2, 0, 1), a03 = minor(0, 3, 0, 1),
            a12 = minor(1, 2, 0, 1), a13 = minor(1, 3, 0, 1), a23 = minor(2, 3, 0, 1);
    const N b01 = minor(0, 1, 2, 3), b02 = minor(0, 2, 2, 3), b03 = minor(0, 3, 2, 3),
            b12 = minor(1, 2, 2, 3), b13 = minor(1, 3, 2, 3), b23 = minor(2, 3, 2, 3);
    Determinants<N> out;
    out.det3[3] = a01 * r[2][2] - a02 * r[1][2] + a12 * r[0][2];
    out.det3[2] = a01 * r[3][2] - a03 * r[1][2] + a13 * r[0][2];
    out.det3[1] = a02 * r[3][2] - a03 * r[2][2] + a23 * r[0][2];
    out.det3[0] = a12 * r[3][2] - a13 * r[2][2] + a23 * r[1][2];
    out.det4 = a01 * b23 - a02 * b13 + a03 * b12 + a12 * b03 - a13 * b02 + a23 * b01;
    return out;
}

// Signs of det3[s], and of det4 with row s moved to the end.
struct Signs {
    std::array<int, 4> det3{};
    std::array<int, 4> det4{};
};

using Interval = CGAL::Interval_nt_advanced;

std::optional<int> certain_sign(const Interval& v) {
    if (v.inf() > 0) return 1;
    if (v.sup() < 0) return -1;
    return std::nullopt;
}

// The interval's determinants, where all of them have a sign.
std::optional<Signs> interval_signs(const Input& in) {
    const CGAL::Protect_FPU_rounding<true> upwards;
    Rows<Interval> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<std::array<Interval, 3>, 3> t;
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) t[j][k] = Interval(in.triangles[i][j][k]);
        rows[i] = plane_of(t);
    }
    const Determinants<Interval> d = determinants_of(rows);
    Signs out;
    const auto det4 = certain_sign(d.det4);
    if (!det4) return std::nullopt;
    for (std::size_t s = 0; s < 4; ++s) {
        const auto det3 = certain_sign(d.det3[s]);
        if (!det3) return std::nullopt;
        out.det3[s] = *det3;
        out.det4[s] = s % 2 == 1 ? *det4 : -*det4;
    }
    return out;
}

// In multiples of the finest unit.
CGAL::Gmpz integer(double v, int top) {
    CGAL::Gmpz out;
    mpz_set_d(out.mpz(), std::ldexp(v, span - 1 - top));
    return out;
}

int sign_of(const CGAL::Gmpz& v) { return static_cast<int>(CGAL::sign(v)); }

Signs exact_signs(const Input& in) {
    Rows<CGAL::Gmpz> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<std::array<CGAL::Gmpz, 3>, 3> t;
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) t[j][k] = integer(in.triangles[i][j][k], in.top);
        rows[i] = plane_of(t);
    }
    const Determinants<CGAL::Gmpz> d = determinants_of(rows);
    Signs out;
    for (std::size_t s = 0; s < 4; ++s) {
        out.det3[s] = sign_of(d.det3[s]);
        out.det4[s] = s % 2 == 1 ? sign_of(d.det4) : -sign_of(d.det4);
    }
    return out;
}

template <class K>
typename K::Point_3 cgal_point(const Point3d& p) {
    return {p[0], p[1], p[2]};
}

// Of the point of three planes to the fourth, constructed by CGAL; nothing where there is no point.
std::optional<int> constructed_side(const std::array<Exact::Plane_3, 4>& planes, std::size_t s) {
    std::array<std::size_t, 3> others{};
    for (std::size_t i = 0, n = 0; i < 4; ++i)
        if (i != s) others[n++] = i;
    const auto found = CGAL::intersection(planes[others[0]], planes[others[1]], planes[others[2]]);
    const Exact::Point_3* point = found ? boost::get<Exact::Point_3>(&*found) : nullptr;
    if (point == nullptr) return std::nullopt;
    return static_cast<int>(planes[s].oriented_side(*point));
}

// In doubles; for making inputs.
std::optional<Point3d> Generator::rounded_common_point(const Input& in) {
    const std::array<double, 4> p = plane_of(in.triangles[0]);
    const std::array<double, 4> q = plane_of(in.triangles[1]);
    const std::array<double, 4> r = plane_of(in.triangles[2]);
    const auto det = [](const std::array<double, 3>& a, const std::array<double, 3>& b,
                        const std::array<double, 3>& c) {
        return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    };
    const auto column = [&](std::size_t k) { return std::array<double, 3>{p[k], q[k], r[k]}; };
    const double w = det(column(0), column(1), column(2));
    const Point3d x{-det(column(3), column(1), column(2)) / w,
                    -det(column(0), column(3), column(2)) / w,
                    -det(column(0), column(1), column(3)) / w};
    for (const double c : x)
        if (!(std::fabs(c) < std::ldexp(1.0, top_))) return std::nullopt;
    return Point3d{fit(x[0]), fit(x[1]), fit(x[2])};
}

// Comparison -------------------------------------------------------------------------------------

enum class Kind { Random, Degenerate };

struct Row {
    std::array<std::uint64_t, 2> answers{};
    std::uint64_t zeros = 0;
    std::uint64_t mismatches = 0;
};

class Ledger {
public:
    void start_input(Kind kind) {
        kind_ = kind;
        ++inputs_;
    }
    void check(const char* name, int answer, int expected) {
        Row& row = rows_[name];
        ++row.answers[static_cast<std::size_t>(kind_)];
        ++total_[static_cast<std::size_t>(kind_)];
        row.zeros += expected == 0 ? 1U : 0U;
        if (answer == expected) return;
        ++row.mismatches;
        std::printf("MISMATCH %s in input %llu: %d, not %d\n", name,
                    static_cast<unsigned long long>(inputs_), answer, expected);
    }
    [[nodiscard]] std::uint64_t answers(Kind kind) const {
        return total_[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] std::uint64_t mismatches() const {
        std::uint64_t n = 0;
        for (const auto& [name, row] : rows_) n += row.mismatches;
        return n;
    }
    [[nodiscard]] std::uint64_t inputs() const { return inputs_; }
    void print() const {
        std::printf("| | random | nearly degenerate | of these 0 | different |\n");
        std::printf("|---|---:|---:|---:|---:|\n");
        Row sum;
        for (const auto& [name, r] : rows_) {
            print(name, r);
            for (std::size_t k = 0; k < 2; ++k) sum.answers[k] += r.answers[k];
            sum.zeros += r.zeros;
            sum.mismatches += r.mismatches;
        }
        print("all", sum);
    }

private:
    static void print(std::string_view name, const Row& r) {
        const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
        std::printf("| %s | %llu | %llu | %llu | %llu |\n", std::string(name).c_str(),
                    n(r.answers[0]), n(r.answers[1]), n(r.zeros), n(r.mismatches));
    }

    std::map<std::string_view, Row> rows_;
    std::array<std::uint64_t, 2> total_{};
    std::uint64_t inputs_ = 0;
    Kind kind_ = Kind::Random;
};

class Comparison {
public:
    Comparison(Ledger& ledger, const Input& in) : ledger_(ledger), in_(in) {}

    void run(bool with_constructions) {
        for (std::size_t i = 0; i < 4; ++i)
            if (!make_plane(i)) return;
        sides_of_input();
        const auto quick = interval_signs(in_);
        const Signs signs = quick ? *quick : exact_signs(in_);
        if (with_constructions) check_oracle(signs);
        for (std::size_t s = 0; s < 4; ++s) sides_of_constructed(s, signs.det3[s], signs.det4[s]);
    }

private:
    [[nodiscard]] LatticePoint lattice(const Point3d& p) const {
        const auto c = [&](double v) { return Coordinate(std::ldexp(v, 52 - in_.top)); };
        return {c(p[0]), c(p[1]), c(p[2])};
    }

    bool make_plane(std::size_t i) {
        const Triangle& t = in_.triangles[i];
        const bool collinear = CGAL::collinear(cgal_point<Inexact>(t[0]), cgal_point<Inexact>(t[1]),
                                               cgal_point<Inexact>(t[2]));
        const std::array corners{lattice(t[0]), lattice(t[1]), lattice(t[2])};
        ledger_.check("are_collinear", are_collinear(corners[0], corners[1], corners[2]) ? 1 : 0,
                      collinear ? 1 : 0);
        if (collinear) return false;
        planes_[i] = Plane::through(corners[0], corners[1], corners[2]);
        return true;
    }

    void side_of_point(std::size_t i, const Point3d& p) {
        const Triangle& t = in_.triangles[i];
        const auto expected =
            CGAL::orientation(cgal_point<Inexact>(t[0]), cgal_point<Inexact>(t[1]),
                              cgal_point<Inexact>(t[2]), cgal_point<Inexact>(p));
        ledger_.check("side_of(LatticePoint)", trisect::sign_of(side_of(lattice(p), planes_[i])),
                      static_cast<int>(expected));
    }
    void sides_of_input() {
        for (std::size_t i = 0; i < 4; ++i) {
            for (const Point3d& p : in_.points) side_of_point(i, p);
            for (const Point3d& p : in_.triangles[(i + 1) % 4]) side_of_point(i, p);
            side_of_point(i, in_.triangles[(i + 2) % 4][0]);
        }
    }

    // Of the point of all planes but s to the plane s. det4: that of all four, s last.
    void sides_of_constructed(std::size_t s, int det3, int det4) {
        const Plane& p = planes_[s == 0 ? 1 : 0];
        const Plane& q = planes_[s <= 1 ? 2 : 1];
        const Plane& r = planes_[s <= 2 ? 3 : 2];
        const Plane& plane = planes_[s];
        ledger_.check("sign_of_det", sign_of_det(p, q, r), det3);
        if (det3 == 0) return;
        const int expected = det3 * det4;
        const Approximation rough = approximate(p, q, r);
        if (const auto side = filtered_side(rough, plane))
            ledger_.check("filtered_side", trisect::sign_of(*side), expected);
        ledger_.check("side_of(Approximation, planes)",
                      trisect::sign_of(side_of(rough, p, q, r, plane)), expected);
        // No information in the approximation: the exact stage alone.
        const Approximation vague{{0, 0, 0}, 1e300};
        ledger_.check("side_of(planes), unfiltered",
                      trisect::sign_of(side_of(vague, p, q, r, plane)), expected);
        const auto point = intersect(p, q, r);
        ledger_.check("side_of(HomogeneousPoint)",
                      point ? trisect::sign_of(side_of(*point, plane)) : 2, expected);
        ledger_.check("side_of(Point)", trisect::sign_of(side_of(Point(p, q, r), plane)), expected);
    }

    void check_oracle(const Signs& signs) {
        std::array<Exact::Plane_3, 4> planes;
        for (std::size_t i = 0; i < 4; ++i) {
            const Triangle& t = in_.triangles[i];
            planes[i] = Exact::Plane_3(cgal_point<Exact>(t[0]), cgal_point<Exact>(t[1]),
                                       cgal_point<Exact>(t[2]));
        }
        for (std::size_t s = 0; s < 4; ++s) {
            const auto side = constructed_side(planes, s);
            ledger_.check("(oracle) Epeck", side.value_or(2),
                          signs.det3[s] == 0 ? 2 : signs.det3[s] * signs.det4[s]);
        }
    }

    Ledger& ledger_;
    const Input& in_;
    std::array<Plane, 4> planes_;
};

void print_stages(const trisect::PredicateCounters& c) {
    const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
    std::printf(
        "\nsigns: %llu symbolic, %llu filtered, %llu up to 128 bits, %llu up to 256 bits, "
        "%llu wider\n",
        n(c.symbolic), n(c.filtered), n(c.exact_short), n(c.exact_narrow), n(c.exact_wide));
}

void compare(Ledger& ledger, Generator& generator, const std::array<std::uint64_t, 2>& wanted) {
    for (const Kind kind : {Kind::Random, Kind::Degenerate})
        while (ledger.answers(kind) < wanted[static_cast<std::size_t>(kind)]) {
            ledger.start_input(kind);
            const Input in = kind == Kind::Random ? generator.random() : generator.degenerate();
            Comparison(ledger, in).run(ledger.inputs() % 16 == 0);
        }
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t seed = 1;
    std::array<std::uint64_t, 2> wanted{100000, 100000};
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const auto value = std::strtoull(argv[i + 1], nullptr, 10);
        (name == "--seed" ? seed : wanted[name == "--random" ? 0 : 1]) = value;
    }
    Ledger ledger;
    Generator generator(seed);
    const trisect::Diagnostics<trisect::PredicateCounters> diagnostics;
    try {
        compare(ledger, generator, wanted);
    } catch (const std::exception& e) {
        std::printf("input %llu: %s\n", static_cast<unsigned long long>(ledger.inputs()), e.what());
        return 1;
    }
    ledger.print();
    print_stages(diagnostics.counters());
    std::printf("%llu inputs, seed %llu, %llu different\n",
                static_cast<unsigned long long>(ledger.inputs()),
                static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(ledger.mismatches()));
    return ledger.mismatches() == 0 ? 0 : 1;
}
