// SPDX-License-Identifier: Apache-2.0

#include "algebra.h"

#include <algorithm>
#include <array>

#include <trisect/brep/measure.h>

namespace algebra {

using trisect::Brep;
using trisect::Point;

Family::Family(std::uint64_t seed, std::size_t count) {
    reference::Random random(seed);
    const bool embedded = seed % 3 == 0;
    operands = reference::random_family(random, count, embedded);
    for (const auto& o : operands)
        solids.push_back(
            engines::solid(o, embedded ? trisect::Embedding::Assume : trisect::Embedding::Resolve));
}

Options options_of(std::uint64_t seed) {
    constexpr std::array<std::uint32_t, 4> leaves{25, 4, 12, 1000};
    constexpr std::array<std::uint32_t, 3> offsets{61, 1, 127};
    return Options(leaves[seed % leaves.size()], offsets[seed % offsets.size()]);
}

trisect::ExactRational volume(const trisect::Expression& e,
                              const trisect::EvaluateOptions& options) {
    return trisect::exact_volume(trisect::evaluate(e, options).to_brep());
}

bool same_set(const trisect::Expression& a, const trisect::Expression& b,
              const trisect::EvaluateOptions& options) {
    const trisect::Solid rest = trisect::evaluate(a ^ b, options);
    return rest.is_empty() || (!rest.is_whole_space() && rest.to_brep().is_empty());
}

namespace {

std::vector<Point> sorted_points(const Brep& brep) {
    std::vector<Point> points(brep.points().begin(), brep.points().end());
    std::sort(points.begin(), points.end(), [](const Point& p, const Point& q) {
        return trisect::compare_lexicographic(p, q) < 0;
    });
    return points;
}

}  // namespace

std::string difference(const Brep& a, const Brep& b) {
    const std::string faces =
        reference::explain_difference(reference::canonical_boundary(engines::polygons(a)),
                                      reference::canonical_boundary(engines::polygons(b)));
    if (!faces.empty()) return faces;
    if (a.counts() != b.counts()) return "the same faces with different counts";
    if (a.vertex_contact_count() != b.vertex_contact_count()) return "vertex contacts differ";
    if (a.edge_contact_count() != b.edge_contact_count()) return "edge contacts differ";
    if (!std::ranges::equal(sorted_points(a), sorted_points(b))) return "points differ";
    return {};
}

}  // namespace algebra
