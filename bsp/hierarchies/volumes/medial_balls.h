// SPDX-License-Identifier: Apache-2.0
//
// Approximate centres on the medial axis of a solid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/tree_frame.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

/// A ball inside of the solid that touches the boundary at a vertex, and somewhere else.
struct MedialBall {
    std::uint32_t vertex = 0;
    std::array<double, 3> center{};  ///< in units of the frame
    double radius = 0;
};

/// One for each of at most `most` vertices, spread over their numbers, by shrinking balls (Ma, Bae
/// and Choi 2012): a large ball under the vertex shrinks until none of the sampled vertices is in
/// it. In doubles, without promise; users of the centres make their own radii. Cost: O(most²),
/// below a second for 2,000.
[[nodiscard]] std::vector<MedialBall> medial_balls(const detail::InterferenceModelData& model,
                                                   const TreeFrame& frame, std::size_t most);

}  // namespace trisect::hierarchies
