// SPDX-License-Identifier: Apache-2.0
//
// Contacts of a boundary with itself, and crossings that decide nevertheless.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::detail {

/// The triangles that meet one of the same boundary anywhere but in common corners and sides; none
/// when it is clear. Some microseconds.
[[nodiscard]] std::vector<std::uint32_t> touching_triangles(const InterferenceModelData& model,
                                                            std::uint32_t triangle);

/// Whether triangles that cross show that the solids overlap. They do unless other triangles of
/// either boundary lie where they cross: if the triangles that touch the one are certainly apart
/// from the other, both boundaries are nothing but these two triangles along the crossing. For one
/// question; models must outlive it.
class TellingCrossings {
public:
    TellingCrossings(const InterferenceModelData& a, const InterferenceModelData& b,
                     const ApproximateMap& to_a);

    /// \pre doubles saw triangle i of A and triangle j of B cross
    [[nodiscard]] bool tells(std::uint32_t i, std::uint32_t j);

private:
    // So many triangles that are not clear are looked at in one question; mostly it is one large
    // one.
    static constexpr std::size_t patience = 4;
    using Touching = std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>>;
    [[nodiscard]] static const std::vector<std::uint32_t>* touching(
        const InterferenceModelData& model, std::uint32_t triangle, Touching& known);

    const InterferenceModelData& a_;
    const InterferenceModelData& b_;
    const ApproximateMap& to_a_;
    double error_;
    Touching known_a_;
    Touching known_b_;
};

}  // namespace trisect::detail
