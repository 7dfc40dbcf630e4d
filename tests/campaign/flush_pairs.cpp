// SPDX-License-Identifier: Apache-2.0
//
// Flush pairs: boxes and prisms with decimal coordinates that share a plane, an edge or a corner.
//
// Coordinates are decimal texts of some digits, read as doubles like those of a file. Sizes go from
// 10^-6 to 10^6, each solid is imported by itself, and what two solids share they share as doubles.
// So they touch, and have no volume in common: under poses that do not move them, in a boolean, and
// by the volume of their union, which is the sum of theirs as fractions. A second pair overlaps
// there by one ulp, which must show.
//
//     flush_pairs [--seed S] [--pairs N]
//
// Exits with 1 when a pair does not touch, or one with an overlap of an ulp does not overlap.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <random>
#include <string>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/interference_overlap.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>

namespace {

using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

struct Extent {
    Point3d lo{};
    Point3d hi{};
};

class Pairs {
public:
    explicit Pairs(std::uint64_t seed) : random_(seed) {}

    /// What the pair has in common: a plane, an edge or a corner.
    [[nodiscard]] int shared_axes() { return 1 + static_cast<int>(random_() % 3); }
    [[nodiscard]] bool chance(unsigned of) { return random_() % of == 0; }
    [[nodiscard]] std::array<int, 3> axes() {
        std::array<int, 3> order{0, 1, 2};
        std::ranges::shuffle(order, random_);
        return order;
    }

    [[nodiscard]] Extent first() {
        const double size = magnitude();
        Extent e;
        for (std::size_t k = 0; k < 3; ++k) {
            e.lo[k] = decimal(size * real(-1, 1), size);
            do e.hi[k] = decimal(e.lo[k] + size * real(0.1, 1), size);
            while (!(e.hi[k] > e.lo[k]));
        }
        return e;
    }

    /// Beyond the upper ends of the first one along the shared axes, across it along the others.
    [[nodiscard]] Extent second(const Extent& first, const std::array<int, 3>& order, int shared) {
        const double size = magnitude();
        Extent e;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(order[static_cast<std::size_t>(i)]);
            if (i < shared) {
                e.lo[k] = first.hi[k];
            } else {
                const double at = first.lo[k] + (first.hi[k] - first.lo[k]) * real(0.1, 0.9);
                do e.lo[k] = decimal(at - size * real(0, 0.5), size);
                while (!(e.lo[k] < first.hi[k]));
            }
            double way = size * real(0.6, 1.6);
            do {
                e.hi[k] = decimal(e.lo[k] + way, size);
                way *= 2;
            } while (!(e.hi[k] > e.lo[k]) || (i >= shared && !(e.hi[k] > first.lo[k])));
        }
        return e;
    }

    /// A box, or a prism along z over a triangle with two sides of the box.
    [[nodiscard]] PolygonMesh mesh(const Extent& e, bool prism, bool at_upper_corner) const {
        if (!prism) return trisect::make_box(e.lo, e.hi);
        const auto& [lo, hi] = e;
        const trisect::Outline outline =
            at_upper_corner ? trisect::Outline{{hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}}
                            : trisect::Outline{{lo[0], lo[1]}, {hi[0], lo[1]}, {lo[0], hi[1]}};
        return trisect::make_extrusion(outline, {}, lo[2], hi[2]);
    }

private:
    double real(double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random_);
    }
    double magnitude() { return std::pow(10.0, real(-6, 6)); }
    // The double of a decimal text with two to six digits of what a solid of that size is made of.
    double decimal(double v, double size) {
        const int digits = 2 + static_cast<int>(random_() % 5);
        const int places = std::max(0, digits - static_cast<int>(std::ceil(std::log10(size))));
        std::array<char, 400> text{};
        std::snprintf(text.data(), text.size(), "%.*f", places, v);
        return std::strtod(text.data(), nullptr);
    }

    std::mt19937_64 random_;
};

// Empty where two solids touch and have no volume in common.
std::string why_not_flush(const Solid& a, const Solid& b) {
    const trisect::InterferenceModel model_a(a);
    const trisect::InterferenceModel model_b(b);
    const Relation r = interfere(model_a, Pose(), model_b, Pose()).relation;
    if (r != Relation::Touching) return trisect::to_string(r);
    if (overlap(model_a, Pose(), model_b, Pose()).volume.sign() != 0) return "an overlap";
    if (!evaluate(a & b).is_empty()) return "an intersection";
    if (exact_volume(evaluate(a | b)) != exact_volume(a) + exact_volume(b))
        return "a union of another volume";
    return {};
}

// The second one reaches into the first one by one ulp along all shared axes.
std::string why_not_overlapping(const Solid& a, const Solid& b) {
    const Relation r =
        interfere(trisect::InterferenceModel(a), Pose(), trisect::InterferenceModel(b), Pose())
            .relation;
    if (!interiors_meet(r)) return std::string("by one ulp: ") + trisect::to_string(r);
    if (evaluate(a & b).is_empty()) return "by one ulp: no intersection";
    return {};
}

struct Counts {
    std::size_t pairs = 0, prisms = 0, lattices = 0, wrong = 0;
    std::array<std::size_t, 3> shared{};
    std::size_t ulps = 0;
};

void compare(Pairs& pairs, std::uint64_t index, Counts& counts) {
    const int shared = pairs.shared_axes();
    const bool prisms = pairs.chance(3);
    // Prisms have their right angles where they meet, so along x and y.
    const std::array<int, 3> order = prisms ? std::array{0, 1, 2} : pairs.axes();
    const Extent one = pairs.first();
    Extent two = pairs.second(one, order, prisms ? std::max(shared, 2) : shared);
    const Solid a = Solid::from_mesh(pairs.mesh(one, prisms, true));
    const auto solid_of_two = [&] { return Solid::from_mesh(pairs.mesh(two, prisms, false)); };
    const Solid b = solid_of_two();
    ++counts.pairs;
    counts.prisms += prisms ? 1U : 0U;
    ++counts.shared[static_cast<std::size_t>(prisms ? std::max(shared, 2) : shared) - 1];
    counts.lattices += a.lattice() != b.lattice() ? 1U : 0U;
    std::string why = why_not_flush(a, b);
    // An ulp of zero is more than 126 bits below everything else.
    const auto shared_lo = [&](int i) -> double& {
        return two.lo[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
    };
    bool has_zero = false;
    for (int i = 0; i < shared; ++i) has_zero = has_zero || shared_lo(i) == 0;
    if (why.empty() && !prisms && !has_zero) {
        for (int i = 0; i < shared; ++i) {
            double& lo = shared_lo(i);
            lo = std::nextafter(lo, -std::numeric_limits<double>::infinity());
        }
        why = why_not_overlapping(a, solid_of_two());
        ++counts.ulps;
    }
    if (why.empty()) return;
    ++counts.wrong;
    std::printf("WRONG pair %llu: %s\n", static_cast<unsigned long long>(index), why.c_str());
    for (const Extent& e : {one, two})
        std::printf("  %.17g %.17g %.17g  %.17g %.17g %.17g\n", e.lo[0], e.lo[1], e.lo[2], e.hi[0],
                    e.hi[1], e.hi[2]);
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t seed = 1;
    std::uint64_t count = 1000;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        (name == "--seed" ? seed : count) = std::strtoull(argv[i + 1], nullptr, 10);
    }
    Counts counts;
    for (std::uint64_t i = 0; i < count; ++i) {
        Pairs pairs(seed * 1'000'003 + i);
        try {
            compare(pairs, i, counts);
        } catch (const std::exception& e) {
            ++counts.wrong;
            std::printf("WRONG pair %llu: %s\n", static_cast<unsigned long long>(i), e.what());
        }
    }
    std::printf("| | |\n|---|---:|\n");
    std::printf("| pairs | %zu |\n", counts.pairs);
    std::printf("| of them prisms | %zu |\n", counts.prisms);
    std::printf("| that share a plane, an edge, a corner | %zu, %zu, %zu |\n", counts.shared[0],
                counts.shared[1], counts.shared[2]);
    std::printf("| with lattices of their own | %zu |\n", counts.lattices);
    std::printf("| pairs that overlap by one ulp | %zu |\n", counts.ulps);
    std::printf("| wrong | %zu |\n", counts.wrong);
    return counts.wrong == 0 ? 0 : 1;
}
