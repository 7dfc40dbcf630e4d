// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/pairs/deformation.h>

#include <algorithm>
#include <compare>

#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

namespace {

struct Named {
    FaceSource source;
    std::uint32_t triangle = 0;  ///< its number in the model
    friend auto operator<=>(const Named&, const Named&) = default;
};

std::vector<Named> named(const detail::InterferenceModelData& m) {
    std::vector<Named> r;
    r.reserve(m.triangles.size());
    for (std::uint32_t t = 0; t < m.triangles.size(); ++t)
        r.push_back({m.brep.source(m.triangles[t].face), t});
    std::ranges::sort(r);
    // Every solid has a number of its own; here the first one is 0, and so on.
    std::uint32_t rank = 0;
    for (std::size_t i = 0; i < r.size();) {
        const std::uint32_t operand = r[i].source.operand;
        for (; i < r.size() && r[i].source.operand == operand; ++i) r[i].source.operand = rank;
        ++rank;
    }
    return r;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> same_triangles(const InterferenceModel& before,
                                                         const InterferenceModel& after) {
    const std::vector<Named> from = named(detail::data_of(before));
    const std::vector<Named> to = named(detail::data_of(after));
    if (!std::ranges::equal(from, to, {}, &Named::source, &Named::source)) return std::nullopt;
    std::vector<std::uint32_t> r(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) r[from[i].triangle] = to[i].triangle;
    return r;
}

}  // namespace trisect::hierarchies
