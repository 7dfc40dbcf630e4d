// SPDX-License-Identifier: Apache-2.0
//
// Compares every predicate of the kernel with CGAL's exact rational arithmetic.
//
//     predicate_campaign [--seed S] [--random N] [--degenerate M] [--timing]
//
// Inputs are drawn until N answers on random and M answers on nearly degenerate input have been
// compared. Prints one row a predicate with the stages that decided it; exits with 1 when an answer
// differs. The same seed gives the same inputs on every machine.
//
// Random planes hardly ever come close to a wrong sign, so the second kind of input is built around
// a coincidence (a common point, a common line, a common plane, a parallel pair), exact or missed
// by one lattice unit.

#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

#include "support/lattice_arithmetic.h"

namespace {

using trisect::Approximation;
using trisect::HomogeneousPoint;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::PredicateCounters;
using trisect::Side;
using trisect::WideInt;

using Rational = CGAL::Gmpq;
using Exact = CGAL::Simple_cartesian<Rational>;
using ExactPoint = Exact::Point_3;
using ExactPlane = Exact::Plane_3;

// ---------------------------------------------------------------- conversion

template <int N>
CGAL::Gmpz integer(const WideInt<N>& v) {
    const WideInt<N> a = v.abs();
    CGAL::Gmpz out;
    std::array<std::uint64_t, static_cast<std::size_t>(N)> limbs{};
    for (int i = 0; i < N; ++i) limbs[static_cast<std::size_t>(i)] = a.limb(i);
    mpz_import(out.mpz(), limbs.size(), -1, sizeof(std::uint64_t), 0, 0, limbs.data());
    return v.is_negative() ? -out : out;
}

Rational rational(std::int64_t v) { return Rational(integer(WideInt<1>(v))); }
Rational rational(double v) { return Rational(v); }

ExactPoint exact(const LatticePoint& p) {
    return {rational(p.x.to_integer()), rational(p.y.to_integer()), rational(p.z.to_integer())};
}

ExactPlane exact(const Plane& p) {
    return {Rational(integer(WideInt<2>(p.normal(0)))), Rational(integer(WideInt<2>(p.normal(1)))),
            Rational(integer(WideInt<2>(p.normal(2)))), Rational(integer(p.offset()))};
}

ExactPoint exact(const HomogeneousPoint& p) {
    const CGAL::Gmpz w = integer(p.w);
    return {Rational(integer(p.xyz[0]), w), Rational(integer(p.xyz[1]), w),
            Rational(integer(p.xyz[2]), w)};
}

int sign(std::strong_ordering o) { return o < 0 ? -1 : (o > 0 ? 1 : 0); }
int sign(Side s) { return trisect::sign_of(s); }

// ---------------------------------------------------------------- bookkeeping

enum class Kind { Random, Degenerate };

struct Row {
    std::array<std::uint64_t, 2> checks{};
    std::uint64_t mismatches = 0;
    PredicateCounters stages;
};

class Ledger {
public:
    // Calls the predicate, books its stages, and compares its answer with the expected one.
    template <class F, class E>
    auto check(const char* name, F&& predicate, const E& expected) {
        const trisect::Diagnostics<PredicateCounters> diagnostics;
        const auto answer = predicate();
        Row& row = rows_[name];
        book(row, diagnostics.counters());
        if (answer != expected) {
            ++row.mismatches;
            std::fprintf(stderr, "MISMATCH %s in input %llu\n", name,
                         static_cast<unsigned long long>(inputs_));
        }
        return answer;
    }
    void start_input(Kind kind) {
        kind_ = kind;
        ++inputs_;
    }
    [[nodiscard]] std::uint64_t checks(Kind kind) const {
        return total_[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] std::uint64_t mismatches() const {
        std::uint64_t n = 0;
        for (const auto& [name, row] : rows_) n += row.mismatches;
        return n;
    }
    void print() const;

private:
    void book(Row& row, const PredicateCounters& made) {
        ++row.checks[static_cast<std::size_t>(kind_)];
        ++total_[static_cast<std::size_t>(kind_)];
        row.stages.symbolic += made.symbolic;
        row.stages.filtered += made.filtered;
        row.stages.exact_narrow += made.exact_narrow;
        row.stages.exact_wide += made.exact_wide;
    }

    std::map<std::string, Row> rows_;
    std::array<std::uint64_t, 2> total_{};
    std::uint64_t inputs_ = 0;
    Kind kind_ = Kind::Random;
};

void Ledger::print() const {
    std::printf(
        "| predicate | random | near-degenerate | mismatches | symbolic | filtered | 256 bits "
        "| 512 bits |\n|---|---:|---:|---:|---:|---:|---:|---:|\n");
    Row sum;
    const auto line = [](const char* name, const Row& r) {
        const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
        std::printf("| %s | %llu | %llu | %llu | %llu | %llu | %llu | %llu |\n", name,
                    n(r.checks[0]), n(r.checks[1]), n(r.mismatches), n(r.stages.symbolic),
                    n(r.stages.filtered), n(r.stages.exact_narrow), n(r.stages.exact_wide));
    };
    for (const auto& [name, row] : rows_) {
        line(name.c_str(), row);
        for (std::size_t k = 0; k < 2; ++k) sum.checks[k] += row.checks[k];
        sum.mismatches += row.mismatches;
        sum.stages += row.stages;
    }
    line("all", sum);
}

// ---------------------------------------------------------------- inputs

using Triangle = std::array<LatticePoint, 3>;

struct Input {
    std::array<Triangle, 4> triangles;
    std::array<int, 4> axis{-1, -1, -1, -1};  // 0..2: the plane along this axis through two corners
    std::array<LatticePoint, 2> points;
};

class Generator {
public:
    explicit Generator(std::uint64_t seed) : engine_(seed) {}

    Input random() {
        const int bits = between(4, 53);
        Input in;
        for (auto& t : in.triangles) t = triangle(bits);
        for (auto& a : in.axis) a = between(0, 3) == 0 ? between(0, 2) : -1;
        for (auto& p : in.points) p = point(bits);
        return in;
    }

    Input degenerate() {
        switch (between(0, 6)) {
            case 0:
                return small_grid();
            case 1:
                return common_point();
            case 2:
                return common_line();
            case 3:
                return nearly_parallel();
            case 4:
                return same_plane();
            case 5:
                return nearly_coincident_points();
            default:
                return mixed_magnitudes();
        }
    }

private:
    int between(int low, int high) {
        return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
    }
    std::int64_t coordinate(int bits) {
        const std::uint64_t v = engine_();
        const auto m = static_cast<std::int64_t>(v >> (64 - bits));
        return (v & 1U) != 0 ? m : -m;
    }
    LatticePoint point(int bits) { return {coordinate(bits), coordinate(bits), coordinate(bits)}; }
    Triangle triangle(int bits) { return {point(bits), point(bits), point(bits)}; }
    LatticePoint nudge() {  // one unit in a direction, or nothing
        return {between(-1, 1), between(-1, 1), between(-1, 1)};
    }
    // Within the range of coordinates.
    static LatticePoint sum(const LatticePoint& p, const LatticePoint& q) {
        const auto clamped = [](std::int64_t v) {
            constexpr std::int64_t most = trisect::coordinate_limit - 1;
            return std::clamp(v, -most, most);
        };
        return {clamped(p.x + q.x), clamped(p.y + q.y), clamped(p.z + q.z)};
    }
    LatticePoint maybe_nudged(LatticePoint p) { return between(0, 1) == 0 ? p : sum(p, nudge()); }

    Input small_grid() {
        const int bits = between(1, 3);
        Input in;
        for (auto& t : in.triangles) t = triangle(bits);
        for (auto& a : in.axis) a = between(0, 2) == 0 ? between(0, 2) : -1;
        for (auto& p : in.points) p = point(bits);
        return in;
    }
    // Four planes through one lattice point, up to a nudge.
    Input common_point() {
        const int bits = between(4, 53);
        const LatticePoint o = point(bits);
        Input in;
        for (auto& t : in.triangles) t = {maybe_nudged(o), point(bits), point(bits)};
        in.points = {o, maybe_nudged(o)};
        return in;
    }
    // Planes around one line, up to a nudge.
    Input common_line() {
        const int bits = between(4, 53);
        const LatticePoint a = point(bits);
        const LatticePoint b = point(bits);
        Input in;
        for (auto& t : in.triangles) t = {maybe_nudged(a), maybe_nudged(b), point(bits)};
        if (between(0, 1) == 0) in.triangles[2] = triangle(bits);
        if (between(0, 1) == 0) in.axis[3] = between(0, 2);
        in.points = {a, maybe_nudged(b)};
        return in;
    }
    Input nearly_parallel() {
        const int bits = between(4, 53);
        const Triangle base = triangle(bits);
        const LatticePoint shift = point(between(1, bits));
        Input in;
        for (auto& t : in.triangles) {
            const bool moved = between(0, 1) == 0;
            for (std::size_t i = 0; i < 3; ++i)
                t[i] = maybe_nudged(moved ? sum(base[i], shift) : base[i]);
            if (between(0, 1) == 0) std::swap(t[0], t[1]);
        }
        if (between(0, 1) == 0) in.triangles[2] = triangle(bits);
        in.points = {maybe_nudged(base[0]), maybe_nudged(base[1])};
        return in;
    }
    // Triangles of one plane with different coefficients: corners a + i u + j v, up to a nudge.
    Input same_plane() {
        const int bits = between(2, 48);
        const Triangle base = triangle(bits);
        const LatticePoint u = base[1] - base[0];
        const LatticePoint v = base[2] - base[0];
        const auto combination = [&] {
            LatticePoint p = base[0];
            const std::int64_t i = between(-3, 3);
            const std::int64_t j = between(-3, 3);
            p = sum(p, {i * u.x, i * u.y, i * u.z});
            return sum(p, {j * v.x, j * v.y, j * v.z});
        };
        Input in;
        for (auto& t : in.triangles)
            for (auto& p : t) p = between(0, 7) == 0 ? sum(combination(), nudge()) : combination();
        if (between(0, 1) == 0) in.triangles[1] = triangle(bits);
        if (between(0, 1) == 0) in.triangles[2] = triangle(bits);
        in.points = {combination(), maybe_nudged(combination())};
        return in;
    }
    // Two of the planes, and the fourth beside the third: two names of nearly the same point.
    Input nearly_coincident_points() {
        const int bits = between(4, 53);
        Input in;
        for (auto& t : in.triangles) t = triangle(bits);
        in.triangles[3] = in.triangles[2];
        in.triangles[3][0] = maybe_nudged(in.triangles[2][0]);
        std::swap(in.triangles[3][0], in.triangles[3][between(0, 1) == 0 ? 0 : 2]);
        in.points = {in.triangles[2][0], in.triangles[3][2]};
        return in;
    }
    Input mixed_magnitudes() {
        Input in;
        const auto any = [this] {
            return LatticePoint{coordinate(between(1, 53)), coordinate(between(1, 53)),
                                coordinate(between(1, 53))};
        };
        for (auto& t : in.triangles) t = {any(), any(), any()};
        in.triangles[1][0] = maybe_nudged(in.triangles[0][0]);
        in.triangles[3][1] = maybe_nudged(in.triangles[0][0]);
        for (auto& a : in.axis) a = between(0, 5) == 0 ? between(0, 2) : -1;
        in.points = {in.triangles[0][0], any()};
        return in;
    }

    std::mt19937_64 engine_;
};

// ---------------------------------------------------------------- comparisons

// The common point by Cramer's rule on CGAL's determinants: CGAL::intersection of three planes goes
// by way of a line and is kept for one input in sixteen, where both must agree.
std::optional<ExactPoint> common_point(const ExactPlane& p, const ExactPlane& q,
                                       const ExactPlane& r) {
    const Rational w =
        CGAL::determinant(p.a(), p.b(), p.c(), q.a(), q.b(), q.c(), r.a(), r.b(), r.c());
    if (w == 0) return std::nullopt;
    const Rational x =
        CGAL::determinant(p.d(), p.b(), p.c(), q.d(), q.b(), q.c(), r.d(), r.b(), r.c());
    const Rational y =
        CGAL::determinant(p.a(), p.d(), p.c(), q.a(), q.d(), q.c(), r.a(), r.d(), r.c());
    const Rational z =
        CGAL::determinant(p.a(), p.b(), p.d(), q.a(), q.b(), q.d(), r.a(), r.b(), r.d());
    return ExactPoint(-x / w, -y / w, -z / w);
}

bool is_intersection(const std::optional<ExactPoint>& point, const ExactPlane& p,
                     const ExactPlane& q, const ExactPlane& r) {
    const auto found = CGAL::intersection(p, q, r);
    const ExactPoint* other = found ? boost::get<ExactPoint>(&*found) : nullptr;
    if (!point || other == nullptr) return !point && other == nullptr;
    return *point == *other;
}

bool is_nearest(double d, const Rational& x) {
    const auto middle = [d](double towards) {
        return (rational(d) + rational(std::nextafter(d, towards))) / Rational(2);
    };
    const Rational low = middle(-std::numeric_limits<double>::infinity());
    const Rational high = middle(std::numeric_limits<double>::infinity());
    if (x == 0) return d == 0;
    if (x > low && x < high) return true;
    int e = 0;
    const auto m = static_cast<std::int64_t>(std::ldexp(std::frexp(d, &e), 53));
    return (x == low || x == high) && m % 2 == 0;
}

bool encloses(const Approximation& a, const ExactPoint& x) {
    for (int i = 0; i < 3; ++i) {
        const Rational move = x[i] - rational(a.c[static_cast<std::size_t>(i)]);
        if (move > rational(a.error) || -move > rational(a.error)) return false;
    }
    return true;
}

bool is_lattice(const ExactPoint& x) {
    for (int i = 0; i < 3; ++i) {
        if (x[i].denominator() != 1) return false;
        if (CGAL::abs(x[i]) >= rational(trisect::coordinate_limit)) return false;
    }
    return true;
}

class Comparison {
public:
    Comparison(Ledger& ledger, const Input& in, bool with_intersection)
        : ledger_(ledger), in_(in), with_intersection_(with_intersection) {}

    void run() {
        if (!make_planes()) return;
        lattice_points();
        pairs_of_planes();
        points();
    }

private:
    bool make_planes();
    void lattice_points();
    void pairs_of_planes();
    void points();
    void named_point(const ExactPoint& x);
    void two_points(const ExactPoint& x, const ExactPoint& y);

    Ledger& ledger_;
    const Input& in_;
    bool with_intersection_;
    std::array<Plane, 4> planes_;
    std::array<ExactPlane, 4> exact_;
};

bool Comparison::make_planes() {
    for (std::size_t i = 0; i < 4; ++i) {
        const Triangle& t = in_.triangles[i];
        const int axis = in_.axis[i];
        const auto [a, b, c] = std::array{exact(t[0]), exact(t[1]), exact(t[2])};
        if (axis >= 0) {
            const Exact::Vector_3 e(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
            if (CGAL::collinear(a, b, a + e)) return false;
            planes_[i] = Plane::along_axis(t[0], t[1], axis);
            exact_[i] = exact(planes_[i]);
            ledger_.check(
                "Plane::along_axis", [&] { return exact_[i]; }, ExactPlane(a, b, a + e));
            continue;
        }
        const bool collinear = CGAL::collinear(a, b, c);
        ledger_.check(
            "are_collinear", [&] { return are_collinear(t[0], t[1], t[2]); }, collinear);
        if (collinear) return false;
        planes_[i] = Plane::through(t[0], t[1], t[2]);
        exact_[i] = exact(planes_[i]);
        ledger_.check(
            "Plane::through", [&] { return exact_[i]; }, ExactPlane(a, b, c));
    }
    return true;
}

void Comparison::lattice_points() {
    for (const LatticePoint& p : in_.points) {
        for (std::size_t i = 0; i < 2; ++i) {
            const int expected = exact_[i].oriented_side(exact(p));
            ledger_.check(
                "side_of(LatticePoint)", [&] { return sign(side_of(p, planes_[i])); }, expected);
        }
    }
}

void Comparison::pairs_of_planes() {
    const Plane& p = planes_[0];
    for (std::size_t i = 1; i < 4; i += 2) {
        const Plane& q = planes_[i];
        const Exact::Vector_3 n = exact_[0].orthogonal_vector();
        const Exact::Vector_3 m = exact_[i].orthogonal_vector();
        const Exact::Vector_3 cross = CGAL::cross_product(n, m);
        for (int k = 0; k < 3; ++k)
            ledger_.check(
                "sign_of_cross", [&] { return sign_of_cross(p, q, k); },
                static_cast<int>(CGAL::sign(cross[k])));
        ledger_.check(
            "sign_of_dot", [&] { return sign_of_dot(p, q); }, static_cast<int>(CGAL::sign(n * m)));
        const bool same = exact_[0] == exact_[i];
        const bool opposite = exact_[0] == exact_[i].opposite();
        ledger_.check(
            "is_same_plane", [&] { return is_same_plane(p, q); }, same || opposite);
        if (same || opposite)
            ledger_.check(
                "same_orientation", [&] { return same_orientation(p, q); }, same);
    }
    ledger_.check(
        "is_same_plane(flipped)", [&] { return is_same_plane(p, p.flipped()); }, true);
    ledger_.check(
        "same_orientation", [&] { return same_orientation(p, p.flipped()); }, false);
}

void Comparison::points() {
    const auto& [p, q, r, s] = planes_;
    const auto& [ep, eq, er, es] = exact_;
    const auto x = common_point(ep, eq, er);
    const auto y = common_point(ep, es, eq);
    if (with_intersection_)
        ledger_.check(
            "(oracle) CGAL::intersection", [&] { return is_intersection(x, ep, eq, er); }, true);
    const Rational det =
        CGAL::determinant(ep.a(), ep.b(), ep.c(), eq.a(), eq.b(), eq.c(), er.a(), er.b(), er.c());
    ledger_.check(
        "sign_of_det", [&, &p = p, &q = q, &r = r] { return sign_of_det(p, q, r); },
        static_cast<int>(CGAL::sign(det)));
    ledger_.check(
        "meet_in_a_point", [&, &p = p, &q = q, &r = r] { return meet_in_a_point(p, q, r); },
        x.has_value());
    const auto h = intersect(p, q, r);
    ledger_.check(
        "intersect", [&] { return h.has_value(); }, x.has_value());
    if (!x) return;
    named_point(*x);
    if (y) two_points(*x, *y);
}

void Comparison::named_point(const ExactPoint& x) {
    const Plane& p = planes_[0];
    const Plane& q = planes_[1];
    const Plane& r = planes_[2];
    const HomogeneousPoint h = *intersect(p, q, r);
    ledger_.check(
        "intersect", [&] { return h.w.sign() == 1 && exact(h) == x; }, true);
    const Approximation rough = approximate(p, q, r);
    ledger_.check(
        "approximate(planes)", [&] { return encloses(rough, x); }, true);
    const Approximation fine = approximate(h);
    ledger_.check(
        "approximate(HomogeneousPoint)", [&] { return encloses(fine, x); }, true);
    const auto d = nearest_doubles(h);
    for (int i = 0; i < 3; ++i)
        ledger_.check(
            "nearest_double", [&] { return is_nearest(d[static_cast<std::size_t>(i)], x[i]); },
            true);
    const Point point(p, q, r);
    ledger_.check(
        "Point::is_lattice", [&] { return point.is_lattice(); }, is_lattice(x));
    ledger_.check(
        "Point::homogeneous", [&] { return exact(point.homogeneous()) == x; }, true);
    for (const Plane& s : {planes_[3], r.flipped(), p}) {
        const int expected = exact(s).oriented_side(x);
        if (const auto f = filtered_side(rough, s))
            ledger_.check(
                "filtered_side", [&] { return sign(*f); }, expected);
        ledger_.check(
            "side_of(Approximation, planes)", [&] { return sign(side_of(rough, p, q, r, s)); },
            expected);
        // No information in the approximation: the exact stage alone.
        const Approximation vague{{0, 0, 0}, 1e300};
        ledger_.check(
            "side_of(planes), unfiltered", [&] { return sign(side_of(vague, p, q, r, s)); },
            expected);
        ledger_.check(
            "side_of(HomogeneousPoint)", [&] { return sign(side_of(h, s)); }, expected);
        ledger_.check(
            "side_of(Point)", [&] { return sign(side_of(point, s)); }, expected);
    }
}

void Comparison::two_points(const ExactPoint& x, const ExactPoint& y) {
    const Point a(planes_[0], planes_[1], planes_[2]);
    const Point b(planes_[0], planes_[3], planes_[1]);
    ledger_.check(
        "Point ==", [&] { return a == b; }, x == y);
    ledger_.check(
        "compare_lexicographic", [&] { return sign(compare_lexicographic(a, b)); },
        static_cast<int>(CGAL::compare_lexicographically(x, y)));
    const HomogeneousPoint h = a.homogeneous();
    const HomogeneousPoint g = b.homogeneous();
    for (int i = 0; i < 3; ++i) {
        const int expected = CGAL::compare(x[i], y[i]);
        ledger_.check(
            "compare_coordinate(Point)", [&] { return sign(compare_coordinate(a, b, i)); },
            expected);
        ledger_.check(
            "compare_coordinate(HomogeneousPoint)",
            [&] { return sign(compare_coordinate(h, g, i)); }, expected);
    }
}

// ---------------------------------------------------------------- timing

template <class F>
void time_of(const char* name, std::size_t n, F&& call) {
    double best = std::numeric_limits<double>::max();
    double sum = 0;
    for (int round = 0; round < 15; ++round) {
        const auto start = std::chrono::steady_clock::now();
        for (int repeat = 0; repeat < 10; ++repeat)
            for (std::size_t i = 0; i < n; ++i) sum += call(i);
        const std::chrono::duration<double, std::nano> t = std::chrono::steady_clock::now() - start;
        best = std::min(best, t.count() / static_cast<double>(10 * n));
    }
    // The sum keeps the calls from being optimised away.
    std::printf("| %s | %.1f |%s\n", name, best, std::isnan(sum) ? " " : "");
}

// Nanoseconds a call, the best of fifteen rounds over 1,000 inputs that stay in the cache.
void timing(int bits, std::uint64_t seed) {
    constexpr std::size_t n = 1000;
    std::mt19937_64 engine(seed);
    const auto coordinate = [&] {
        const std::uint64_t v = engine();
        const auto m = static_cast<std::int64_t>(v >> (64 - bits));
        return (v & 1U) != 0 ? m : -m;
    };
    std::vector<LatticePoint> corners(n + 6);
    for (auto& p : corners) p = {coordinate(), coordinate(), coordinate()};
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < n + 4; ++i)
        planes.push_back(Plane::through(corners[i], corners[i + 1], corners[i + 2]));
    // Stride 1 would make neighbours share corners: take planes far apart.
    const auto at = [&](std::size_t i, std::size_t k) -> const Plane& {
        return planes[(i + 251 * k) % n];
    };
    std::vector<Approximation> near;
    std::vector<HomogeneousPoint> exact_points;
    for (std::size_t i = 0; i < n; ++i) {
        near.push_back(approximate(at(i, 0), at(i, 1), at(i, 2)));
        exact_points.push_back(*intersect(at(i, 0), at(i, 1), at(i, 2)));
    }
    const Approximation vague{{0, 0, 0}, 1e300};
    std::printf("\n| %d-bit coordinates (%s planes) | ns |\n|---|---:|\n", bits,
                planes[0].is_narrow() ? "narrow" : "wide");
    time_of("Plane::through", n, [&](std::size_t i) {
        return Plane::through(corners[i], corners[i + 1], corners[i + 2]).approx_offset();
    });
    time_of("side_of(LatticePoint), filtered", n,
            [&](std::size_t i) { return sign(side_of(corners[i], at(i, 3))); });
    time_of("side_of(LatticePoint), exact", n,
            [&](std::size_t i) { return sign(side_of(corners[i], planes[i])); });
    time_of("side_of(planes), filtered", n, [&](std::size_t i) {
        return sign(side_of(near[i], at(i, 0), at(i, 1), at(i, 2), at(i, 3)));
    });
    time_of("side_of(planes), exact", n, [&](std::size_t i) {
        return sign(side_of(vague, at(i, 0), at(i, 1), at(i, 2), at(i, 3)));
    });
    time_of("side_of(HomogeneousPoint)", n,
            [&](std::size_t i) { return sign(side_of(exact_points[i], at(i, 3))); });
    time_of("intersect", n, [&](std::size_t i) {
        return static_cast<double>(intersect(at(i, 0), at(i, 1), at(i, 2))->w.limb(0));
    });
    time_of("approximate(planes)", n,
            [&](std::size_t i) { return approximate(at(i, 0), at(i, 1), at(i, 2)).error; });
    time_of("nearest_doubles", n,
            [&](std::size_t i) { return nearest_doubles(exact_points[i])[0]; });
    time_of("Point(planes)", n, [&](std::size_t i) {
        return Point(at(i, 0), at(i, 1), at(i, 2)).approximation().error;
    });
    time_of("compare_coordinate(HomogeneousPoint)", n, [&](std::size_t i) {
        return sign(compare_coordinate(exact_points[i], exact_points[(i + 1) % n], 0));
    });
}

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t random = 90000;
    std::uint64_t degenerate = 10000;
    bool timing = false;
};

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; ++i) {
        const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0; };
        if (is("--timing")) {
            out.timing = true;
            continue;
        }
        std::uint64_t* target = is("--seed")         ? &out.seed
                                : is("--random")     ? &out.random
                                : is("--degenerate") ? &out.degenerate
                                                     : nullptr;
        if (target == nullptr || i + 1 == argc) return std::nullopt;
        char* end = nullptr;
        *target = std::strtoull(argv[++i], &end, 10);
        if (end == argv[i] || *end != '\0') return std::nullopt;
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr, "usage: %s [--seed S] [--random N] [--degenerate M] [--timing]\n",
                     argv[0]);
        return 2;
    }
    Ledger ledger;
    Generator generator(options->seed);
    std::uint64_t inputs = 0;
    for (const Kind kind : {Kind::Random, Kind::Degenerate}) {
        const std::uint64_t wanted = kind == Kind::Random ? options->random : options->degenerate;
        while (ledger.checks(kind) < wanted) {
            ledger.start_input(kind);
            const Input in = kind == Kind::Random ? generator.random() : generator.degenerate();
            Comparison(ledger, in, inputs++ % 16 == 0).run();
        }
    }
    ledger.print();
    std::printf("\n%llu inputs, seed %llu, %llu mismatches\n",
                static_cast<unsigned long long>(inputs),
                static_cast<unsigned long long>(options->seed),
                static_cast<unsigned long long>(ledger.mismatches()));
    if (options->timing)
        for (const int bits : {25, 26, 53}) timing(bits, options->seed);
    return ledger.mismatches() == 0 ? 0 : 1;
}
