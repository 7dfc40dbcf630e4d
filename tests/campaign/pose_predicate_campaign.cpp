// SPDX-License-Identifier: Apache-2.0
//
// Compares the predicates of posed solids with CGAL's exact rational arithmetic: points are moved
// by affine transformations of that kernel, made from the same quaternions and doubles as the
// poses.
//
//     pose_predicate_campaign [--seed S] [--random N] [--degenerate M]
//
// Inputs are drawn until N signs on random and M signs on nearly degenerate input have been
// compared. Prints one row a predicate with the stages that decided it; exits with 1 when a sign
// differs. The same seed gives the same inputs on every machine.
//
// Nearly degenerate: corners of one solid are those of the other one brought over, rounded to the
// lattice or, under rotations by small quaternions and matrices of small integers, exactly; some of
// them are then moved by a unit.

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/pose.h>
#include <trisect/kernel/pose/moved_predicates.h>

#include "support/lattice_arithmetic.h"

namespace {

using trisect::Coordinate;
using trisect::Lattice;
using trisect::LatticePoint;
using trisect::Plane;
using trisect::Point;
using trisect::Pose;
using trisect::PredicateCounters;
using trisect::detail::Direction;
using trisect::detail::MovedPoint;
using trisect::detail::PosedPair;
using trisect::detail::PulledPlane;

using Rational = CGAL::Gmpq;
using Exact = CGAL::Simple_cartesian<Rational>;
using ExactPoint = Exact::Point_3;
using ExactVector = Exact::Vector_3;
using Transformation = CGAL::Aff_transformation_3<Exact>;

int sign(const Rational& v) { return static_cast<int>(CGAL::sign(v)); }

Rational rational(std::int64_t v) { return Rational(static_cast<long>(v)); }

ExactPoint exact(const LatticePoint& p) {
    return {rational(p.x.to_integer()), rational(p.y.to_integer()), rational(p.z.to_integer())};
}

Rational determinant(const ExactVector& u, const ExactVector& v, const ExactVector& w) {
    return CGAL::determinant(u, v, w);
}

enum class Input { Random, Degenerate };

class Source {
public:
    explicit Source(std::uint64_t seed) : engine_(seed) {}

    std::uint64_t below(std::uint64_t n) { return engine_() % n; }
    bool coin() { return below(2) == 0; }
    std::int64_t coordinate(int bits) {
        const auto v = static_cast<std::int64_t>(engine_() >> (64 - bits));
        return coin() ? v : -v;
    }
    std::int64_t between(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low + 1)));
    }
    double real() { return static_cast<double>(engine_() >> 11U) * 0x1p-52 - 1; }
    LatticePoint point(int bits) { return {coordinate(bits), coordinate(bits), coordinate(bits)}; }

private:
    std::mt19937_64 engine_;
};

// A pose and the same map in CGAL's kernel, from lattice units to the world.
struct Placed {
    Pose pose;
    Lattice lattice;
    Transformation map;
    bool mirror = false;
};

Transformation scaled(const Transformation& t, Lattice lattice) {
    const Rational unit = Rational(std::ldexp(1.0, lattice.exponent));
    return t * Transformation(CGAL::SCALING, unit);
}

Placed by_quaternion(Source& random, int bits, double size, Lattice lattice,
                     bool whole_shift = false) {
    for (;;) {
        const auto part = [&] {
            return bits < 4 ? random.between(-4, 4) : random.coordinate(bits);
        };
        const std::array<std::int64_t, 4> q{part(), part(), part(), part()};
        if (q == std::array<std::int64_t, 4>{}) continue;
        const auto shift = [&] {
            const double v = size * random.real();
            return whole_shift || random.coin() ? std::floor(v) : v;
        };
        const std::array<double, 3> t{shift(), shift(), shift()};
        const Rational a = rational(q[0]);
        const Rational b = rational(q[1]);
        const Rational c = rational(q[2]);
        const Rational d = rational(q[3]);
        const Rational n = a * a + b * b + c * c + d * d;
        const Rational two = 2;
        const Transformation map(a * a + b * b - c * c - d * d, two * (b * c - a * d),
                                 two * (b * d + a * c), n * Rational(t[0]), two * (b * c + a * d),
                                 a * a - b * b + c * c - d * d, two * (c * d - a * b),
                                 n * Rational(t[1]), two * (b * d - a * c), two * (c * d + a * b),
                                 a * a - b * b - c * c + d * d, n * Rational(t[2]), n);
        return {Pose::from_quaternion(q, t), lattice, scaled(map, lattice), false};
    }
}

Placed by_doubles(Source& random, double size, Lattice lattice) {
    for (;;) {
        std::array<double, 12> m{};
        const bool rotation = random.coin();
        for (std::size_t i = 0; i < 12; ++i)
            m[i] = i % 4 == 3 ? std::floor(size * random.real()) : random.real();
        if (rotation) {
            const double angle = 3 * random.real();
            m = {std::cos(angle),
                 -std::sin(angle),
                 0,
                 m[3],
                 std::sin(angle),
                 std::cos(angle),
                 0,
                 m[7],
                 0,
                 0,
                 1,
                 m[11]};
        } else if (random.below(4) == 0) {
            for (double& v : m)
                v = random.below(3) == 0 ? 0 : std::ldexp(v, -static_cast<int>(random.below(30)));
        }
        std::array<Rational, 12> r;
        for (std::size_t i = 0; i < 12; ++i) r[i] = Rational(m[i]);
        const Transformation map(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9], r[10],
                                 r[11]);
        try {
            return {Pose::from_doubles(m), lattice, scaled(map, lattice), map.is_odd()};
        } catch (const trisect::UsageError&) {  // singular
        }
    }
}

// Twelve doubles that are small integers: images of lattice points are lattice points.
Placed by_integers(Source& random, double size) {
    for (;;) {
        std::array<double, 12> m{};
        std::array<Rational, 12> r;
        for (std::size_t i = 0; i < 12; ++i) {
            m[i] = i % 4 == 3 ? std::floor(size * random.real())
                              : static_cast<double>(random.between(-2, 2));
            r[i] = Rational(m[i]);
        }
        const Transformation map(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9], r[10],
                                 r[11]);
        try {
            return {Pose::from_doubles(m), Lattice{}, map, map.is_odd()};
        } catch (const trisect::UsageError&) {  // singular
        }
    }
}

Placed random_placed(Source& random, int bits) {
    const Lattice lattice{random.below(4) == 0 ? -8 : 0};
    const double size = std::ldexp(1.0, bits);
    switch (random.below(4)) {
        case 0:
            return by_quaternion(random, 2, size, lattice);
        case 1:
            return by_quaternion(random, random.coin() ? 10 : 26, size, lattice);
        default:
            return by_doubles(random, size, lattice);
    }
}

struct Row {
    std::array<std::uint64_t, 2> checks{};
    std::uint64_t zeros = 0;
    std::uint64_t mismatches = 0;
    PredicateCounters stages;
};

class Ledger {
public:
    template <class Predicate>
    void check(const char* name, Input kind, Predicate&& predicate, int expected) {
        const trisect::Diagnostics<PredicateCounters> diagnostics;
        const int answer = predicate();
        const PredicateCounters made = diagnostics.counters();
        Row& row = rows_[name];
        ++row.checks[static_cast<std::size_t>(kind)];
        ++total_[static_cast<std::size_t>(kind)];
        row.zeros += expected == 0 ? 1 : 0;
        row.stages.filtered += made.filtered;
        row.stages.exact_narrow += made.exact_narrow;
        row.stages.exact_wide += made.exact_wide;
        if (answer == expected) return;
        ++row.mismatches;
        std::fprintf(stderr, "MISMATCH %s: %d, expected %d\n", name, answer, expected);
    }
    [[nodiscard]] std::uint64_t checks(Input kind) const {
        return total_[static_cast<std::size_t>(kind)];
    }
    // Prints the table; the number of mismatches.
    std::uint64_t print() const {
        std::printf(
            "| predicate | random | near-degenerate | of these 0 | mismatches | filtered | "
            "to 256 bits | wider |\n|---|---:|---:|---:|---:|---:|---:|---:|\n");
        Row all;
        const auto line = [](const std::string& name, const Row& r) {
            const auto u = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
            std::printf("| %s | %llu | %llu | %llu | %llu | %llu | %llu | %llu |\n", name.c_str(),
                        u(r.checks[0]), u(r.checks[1]), u(r.zeros), u(r.mismatches),
                        u(r.stages.filtered), u(r.stages.exact_narrow), u(r.stages.exact_wide));
        };
        for (const auto& [name, r] : rows_) {
            line(name, r);
            for (std::size_t i = 0; i < 2; ++i) all.checks[i] += r.checks[i];
            all.zeros += r.zeros;
            all.mismatches += r.mismatches;
            all.stages.filtered += r.stages.filtered;
            all.stages.exact_narrow += r.stages.exact_narrow;
            all.stages.exact_wide += r.stages.exact_wide;
        }
        line("all", all);
        return all.mismatches;
    }

private:
    std::map<std::string, Row> rows_;
    std::array<std::uint64_t, 2> total_{};
};

// A point of B's lattice near where a point of A is, if it is in range.
std::optional<LatticePoint> brought_over(const Transformation& a_to_b, const LatticePoint& p,
                                         Source& random) {
    const ExactPoint x = a_to_b.transform(exact(p));
    LatticePoint r;
    const std::array<Coordinate*, 3> to{&r.x, &r.y, &r.z};
    for (int i = 0; i < 3; ++i) {
        const double c = CGAL::to_double(x[i]);
        if (!(std::fabs(c) < 0x1p52)) return std::nullopt;
        *to[static_cast<std::size_t>(i)] = Coordinate(std::nearbyint(c));
    }
    if (random.below(3) == 0) {
        Coordinate& c = *to[random.below(3)];
        c = c + (random.coin() ? 1 : -1);
    }
    return r;
}

class Comparison {
public:
    Comparison(Ledger& ledger, Source& random, Input kind)
        : ledger_(ledger), random_(random), kind_(kind) {}

    void run() {
        const std::array<int, 5> sizes{2, 4, 10, 26, 52};
        const int bits = sizes[random_.below(sizes.size())];
        if (kind_ == Input::Degenerate && random_.coin()) {
            run_exactly_placed(std::min(bits, 26));
            return;
        }
        const Placed pa = random_.coin() ? standing() : random_placed(random_, bits);
        const Placed pb = random_placed(random_, bits);
        std::array<LatticePoint, 3> a{random_.point(bits), random_.point(bits),
                                      random_.point(bits)};
        std::array<LatticePoint, 3> b{random_.point(bits), random_.point(bits),
                                      random_.point(bits)};
        if (kind_ == Input::Degenerate) {
            const Transformation a_to_b = pb.map.inverse() * pa.map;
            for (std::size_t i = 0; i < 3; ++i)
                if (const auto p = brought_over(a_to_b, a[i], random_)) b[i] = *p;
        }
        compare(pa, pb, a, b);
    }

private:
    static Placed standing() { return {Pose(), Lattice{}, Transformation(CGAL::IDENTITY), false}; }

    // A's corners are images of B's, or off by a unit.
    void run_exactly_placed(int bits) {
        const double size = std::ldexp(1.0, bits);
        const Placed pb = random_.coin() ? by_quaternion(random_, 2, size, Lattice{}, true)
                                         : by_integers(random_, size);
        std::array<LatticePoint, 3> a;
        std::array<LatticePoint, 3> b;
        for (std::size_t i = 0; i < 3; ++i) {
            b[i] = random_.point(bits);
            for (int k = 0; k < 3; ++k) {
                const ExactPoint x = pb.map.transform(exact(b[i]));
                const auto n = static_cast<std::int64_t>(CGAL::to_double(x[k].denominator()));
                b[i] = {b[i].x * n, b[i].y * n, b[i].z * n};
            }
            const ExactPoint x = pb.map.transform(exact(b[i]));
            a[i] = {static_cast<std::int64_t>(CGAL::to_double(x[0])),
                    static_cast<std::int64_t>(CGAL::to_double(x[1])),
                    static_cast<std::int64_t>(CGAL::to_double(x[2]))};
            if (random_.below(4) == 0) a[i].x = a[i].x + (random_.coin() ? 1 : -1);
        }
        if (random_.below(4) == 0) std::swap(b[0], b[1]);
        if (random_.coin())
            compare(standing(), pb, a, b);
        else
            compare(pb, standing(), b, a);
    }

    void compare(const Placed& pa, const Placed& pb, const std::array<LatticePoint, 3>& a,
                 const std::array<LatticePoint, 3>& b) {
        if (are_collinear(a[0], a[1], a[2]) || are_collinear(b[0], b[1], b[2])) return;
        const PosedPair pair(pa.pose, pa.lattice, pb.pose, pb.lattice);
        std::array<ExactPoint, 3> wa;
        std::array<ExactPoint, 3> wb;
        for (std::size_t i = 0; i < 3; ++i) {
            wa[i] = pa.map.transform(exact(a[i]));
            wb[i] = pb.map.transform(exact(b[i]));
        }
        const int turn_a = pa.mirror ? -1 : 1;
        const int turn_b = pb.mirror ? -1 : 1;
        const auto check = [&](const char* name, auto&& predicate, int expected) {
            ledger_.check(name, kind_, predicate, expected);
        };
        const std::array<Point, 3> qa{a[0], a[1], a[2]};
        const std::array<Point, 3> qb{b[0], b[1], b[2]};
        const Plane plane = Plane::through(a[0], a[1], a[2]);
        const Plane other = Plane::through(b[0], b[1], b[2]);
        const PulledPlane pulled(plane, pair.to_a);
        std::array<int, 3> sides{};
        for (std::size_t i = 0; i < 3; ++i) {
            sides[i] = turn_a * static_cast<int>(CGAL::orientation(wa[0], wa[1], wa[2], wb[i]));
            check(
                "PulledPlane::side_of", [&] { return pulled.side_of(qb[i]); }, sides[i]);
            const std::size_t j = (i + 1) % 3;
            check(
                "PulledPlane::along", [&] { return pulled.along(Direction(qb[i], qb[j])); },
                turn_a * sign(determinant(wa[1] - wa[0], wa[2] - wa[0], wb[j] - wb[i])));
        }
        const bool same = sides == std::array<int, 3>{};
        check(
            "PulledPlane::is_same_as", [&] { return pulled.is_same_as(other) ? 1 : 0; },
            same ? 1 : 0);
        if (same) {
            const ExactVector na = CGAL::cross_product(wa[1] - wa[0], wa[2] - wa[0]);
            const ExactVector nb = CGAL::cross_product(wb[1] - wb[0], wb[2] - wb[0]);
            check(
                "PulledPlane::sense_of", [&] { return pulled.sense_of(other); },
                turn_a * turn_b * sign(na * nb));
        }
        const std::array<MovedPoint, 3> mb{MovedPoint(qb[0], pair.to_a),
                                           MovedPoint(qb[1], pair.to_a),
                                           MovedPoint(qb[2], pair.to_a)};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            check(
                "orientation of two edges",
                [&] { return trisect::detail::orientation(qa[0], qa[1], mb[i], mb[j]); },
                turn_a * sign(determinant(wa[1] - wa[0], wb[j] - wb[i], wb[i] - wa[0])));
            check(
                "determinant_sign",
                [&] {
                    return trisect::detail::determinant_sign(Direction(qb[0], qb[1]),
                                                             Direction(qb[0], qb[2]),
                                                             Direction(qa[i], qa[j]), pair.to_b);
                },
                turn_b * sign(determinant(wb[1] - wb[0], wb[2] - wb[0], wa[j] - wa[i])));
        }
        // In A's own coordinates.
        const Transformation to_a = pa.map.inverse();
        for (std::size_t i = 0; i < 2; ++i) {
            const ExactVector u = exact(a[1]) - exact(a[0]);
            const ExactVector v = to_a.transform(wb[i]) - exact(a[0]);
            const ExactVector n = CGAL::cross_product(u, v);
            for (int axis = 0; axis < 3; ++axis)
                check(
                    "planar_orientation",
                    [&] { return trisect::detail::planar_orientation(qa[0], qa[1], mb[i], axis); },
                    sign(n[axis]));
        }
    }

    Ledger& ledger_;
    Source& random_;
    Input kind_;
};

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t random = 20000;
    std::uint64_t degenerate = 20000;
};

std::optional<Options> parse(int argc, char** argv) {
    Options out;
    for (int i = 1; i < argc; i += 2) {
        const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0; };
        std::uint64_t* target = is("--seed")         ? &out.seed
                                : is("--random")     ? &out.random
                                : is("--degenerate") ? &out.degenerate
                                                     : nullptr;
        if (target == nullptr || i + 1 == argc) return std::nullopt;
        char* end = nullptr;
        *target = std::strtoull(argv[i + 1], &end, 10);
        if (end == argv[i + 1] || *end != '\0') return std::nullopt;
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(argc, argv);
    if (!options) {
        std::fprintf(stderr, "usage: %s [--seed S] [--random N] [--degenerate M]\n", argv[0]);
        return 2;
    }
    Ledger ledger;
    Source random(options->seed);
    std::uint64_t inputs = 0;
    for (const Input kind : {Input::Random, Input::Degenerate}) {
        const std::uint64_t wanted = kind == Input::Random ? options->random : options->degenerate;
        for (; ledger.checks(kind) < wanted; ++inputs) Comparison(ledger, random, kind).run();
    }
    const std::uint64_t mismatches = ledger.print();
    std::printf("\n%llu inputs, seed %llu, %llu mismatches\n",
                static_cast<unsigned long long>(inputs),
                static_cast<unsigned long long>(options->seed),
                static_cast<unsigned long long>(mismatches));
    return mismatches == 0 ? 0 : 1;
}
