// SPDX-License-Identifier: Apache-2.0
//
// Laws of set algebra and of volumes, exact, on random families of solids on a small grid, where
// faces, edges and corners coincide all the time:
//
//     identities_campaign [--seed S] [--identities N] [--minutes M]
//
// Seeds S, S + 1, ... until N identities have been checked or M minutes are over (0: no limit). The
// first line that differs is printed with its seed, and the exit code is 1. The last line says
// where the next run goes on: "seeds A to B, N identities, 0 differ". P1 to P14 of the list that
// the tests of tests/algebra follow; leaf sizes and positions of walls vary with the seed.

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>

#include "algebra/algebra.h"

namespace {

using trisect::evaluate;
using trisect::ExactRational;
using trisect::Expression;
using trisect::Solid;

struct Options {
    std::uint64_t seed = 1;
    std::uint64_t identities = 10'000;
    double minutes = 0;
};

bool parse(int argc, char** argv, Options& o) {
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        if (name == "--seed")
            o.seed = std::strtoull(argv[i + 1], nullptr, 10);
        else if (name == "--identities")
            o.identities = std::strtoull(argv[i + 1], nullptr, 10);
        else if (name == "--minutes")
            o.minutes = std::strtod(argv[i + 1], nullptr);
        else
            return false;
    }
    return argc % 2 == 1;
}

// Checks the laws for one family.
class Laws {
public:
    explicit Laws(std::uint64_t seed)
        : seed_(seed), family_(seed, 3), options_(algebra::options_of(seed)) {}

    void check() {
        sets();
        volumes();
        points();
    }
    [[nodiscard]] std::uint64_t checked() const { return checked_; }
    [[nodiscard]] std::uint64_t failed() const { return failed_; }

private:
    void note(bool holds, const char* law) {
        ++checked_;
        if (holds) return;
        ++failed_;
        std::printf("seed %llu: %s does not hold\n", static_cast<unsigned long long>(seed_), law);
    }
    [[nodiscard]] Solid of(const Expression& e) const { return evaluate(e, options_); }
    // Both sides are evaluated, so that the comparison is not a formula's tautology.
    void equal(const char* law, const Expression& x, const Expression& y) {
        note(algebra::same_set(of(x), of(y), options_), law);
    }

    void sets() {
        const Solid& a = family_.solids[0];
        const Solid& b = family_.solids[1];
        const Solid& c = family_.solids[2];
        const Solid none;
        const Solid all = Solid::whole_space();
        equal("P4 a - b = a & ~b", a - b, a & ~b);
        equal("P4 ~(a | b) = ~a & ~b", ~(a | b), ~a & ~b);
        equal("P4 ~~a = a", ~~a, a);
        equal("P5 a | a = a", a | a, a);
        equal("P5 a & b = b & a", a & b, b & a);
        equal("P5 a ^ b = b ^ a", a ^ b, b ^ a);
        equal("P5 (a | b) | c = a | (b | c)", (a | b) | c, a | (b | c));
        equal("P5 (a ^ b) ^ c = a ^ (b ^ c)", (a ^ b) ^ c, a ^ (b ^ c));
        equal("P5 a & (b | c) = (a & b) | (a & c)", a & (b | c), (a & b) | (a & c));
        equal("P5 a | (b & c) = (a | b) & (a | c)", a | (b & c), (a | b) & (a | c));
        equal("P5 a | (a & b) = a", a | (a & b), a);
        equal("P6 a | 0 = a", a | none, a);
        equal("P6 a & 1 = a", a & all, a);
        equal("P6 a ^ 1 = ~a", a ^ all, ~a);
        // On results of steps: every one works on the tree of the one before.
        const Solid left = of(a - b);
        const Solid common = of(a & b);
        const Solid either = of(a | b);
        equal("P7 (a - b) | (a & b) = a", left | common, a);
        equal("P7 (a | b) - b = a - b", either - b, left);
        equal("P7 (a ^ b) ^ b = a", of(a ^ b) ^ b, a);
        const Expression terms[]{a, b, c};
        equal("P8 any_of(a, b, c) = c | (b | a)", Expression::any_of(terms), c | (b | a));
        note(of(a - either).to_brep().is_empty(), "P12 a - (a | b) = 0");
        note(of(common - a).to_brep().is_empty(), "P12 (a & b) - a = 0");
    }

    void volumes() {
        const Solid& a = family_.solids[0];
        const Solid& b = family_.solids[1];
        const Solid& c = family_.solids[2];
        const auto v = [this](const Expression& e) { return algebra::volume(e, options_); };
        const ExactRational va = v(a);
        const ExactRational vb = v(b);
        const ExactRational vab = v(a & b);
        const ExactRational vu = v(a | b);
        note(vu + vab == va + vb, "P1 V(a | b) + V(a & b) = V(a) + V(b)");
        note(v(a - b) + vab == va, "P2 V(a - b) + V(a & b) = V(a)");
        note(v(a ^ b) + vab == vu, "P2 V(a ^ b) = V(a | b) - V(a & b)");
        note(v(Expression(a) | b | c) + vab + v(a & c) + v(b & c) ==
                 va + vb + v(c) + v(Expression(a) & b & c),
             "P3 inclusion and exclusion of three");
        note(v(~a) + va == v(a & ~Expression(a)), "P14 V(~a) = -V(a)");
    }

    // P13: memberships of lattice points, in open and closed sets.
    void points() {
        const Solid& a = family_.solids[0];
        const Solid& b = family_.solids[1];
        const Solid results[]{a, b, of(a | b), of(a & b), of(a - b)};
        std::vector<trisect::BrepIndex> indices;
        for (const Solid& s : results) indices.emplace_back(s);
        for (int k = 0; k < 12; ++k) {
            // Halves and thirds of the grid's unit, not all of them on it.
            const auto c = [&](std::uint64_t n) {
                return 0.5 * static_cast<double>((seed_ * 31 + static_cast<std::uint64_t>(k) * 17 +
                                                  n * 7 + seed_ % 13 * n) %
                                                 33);
            };
            const std::array<double, 3> p{c(1), c(2), c(3)};
            std::array<trisect::Location, 5> at{};
            for (std::size_t i = 0; i < 5; ++i) at[i] = indices[i].locate(p).location;
            const auto inside = [&](std::size_t i) { return at[i] == trisect::Location::Inside; };
            const auto outside = [&](std::size_t i) { return at[i] == trisect::Location::Outside; };
            const bool on = !(inside(0) || outside(0)) || !(inside(1) || outside(1));
            if (on) continue;  // regularised: boundaries of operands may vanish
            note(inside(2) == (inside(0) || inside(1)), "P13 membership of a | b");
            note(inside(3) == (inside(0) && inside(1)), "P13 membership of a & b");
            note(inside(4) == (inside(0) && outside(1)), "P13 membership of a - b");
        }
    }

    std::uint64_t seed_;
    algebra::Family family_;
    trisect::EvaluateOptions options_;
    std::uint64_t checked_ = 0;
    std::uint64_t failed_ = 0;
};

int run(const Options& o) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto minutes = [&] {
        return std::chrono::duration<double>(Clock::now() - start).count() / 60;
    };
    std::uint64_t checked = 0;
    std::uint64_t failed = 0;
    std::uint64_t seed = o.seed;
    for (; checked < o.identities && (o.minutes == 0 || minutes() < o.minutes); ++seed) {
        Laws laws(seed);
        try {
            laws.check();
        } catch (const std::exception& e) {
            std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), e.what());
            ++failed;
        }
        checked += laws.checked();
        failed += laws.failed();
    }
    std::printf("seeds %llu to %llu, %llu identities, %llu differ\n",
                static_cast<unsigned long long>(o.seed), static_cast<unsigned long long>(seed - 1),
                static_cast<unsigned long long>(checked), static_cast<unsigned long long>(failed));
    return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    if (!parse(argc, argv, o)) {
        std::fprintf(stderr,
                     "usage: identities_campaign [--seed S] [--identities N] [--minutes M]\n");
        return 2;
    }
    return run(o);
}
