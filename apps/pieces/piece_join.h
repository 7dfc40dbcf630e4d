// SPDX-License-Identifier: Apache-2.0
//
// JoinedMesh: one mesh of pieces that lie side by side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trisect::app {

struct JoinedMesh {
    std::uint64_t points = 0;
    std::uint64_t triangles = 0;
    std::uint64_t wall_points = 0;  ///< that two pieces have
};

/// Points of walls are identified by their exact names, and every edge in a wall must be passed
/// once each way. Reads one piece after the other, twice; writes binary PLY with doubles, or binary
/// STL, by the ending of the name, complete or not at all.
/// \throw Error (Internal) where pieces do not fit; UsageError for another ending
JoinedMesh join_pieces(const std::vector<std::string>& pieces, const std::string& output);

/// Whether join_pieces() writes a file of this name.
[[nodiscard]] bool can_join_into(const std::string& output);

}  // namespace trisect::app
