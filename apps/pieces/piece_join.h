// SPDX-License-Identifier: Apache-2.0
//
// PieceJoin: one mesh of pieces that lie side by side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace trisect::app {

struct JoinedMesh {
    std::uint64_t points = 0;
    std::uint64_t triangles = 0;
    std::uint64_t wall_points = 0;  ///< that two pieces have
};

struct JoinFiles {
    std::vector<std::string> pieces;  ///< in their order
    std::vector<std::string> links;   ///< of each piece, to be made
    std::string output;
    std::string unfinished;  ///< the output until it is complete, on the same file system
};

/// Points of walls are identified by their exact names, and every edge in a wall must be passed
/// once each way. The result is binary PLY with doubles, or binary STL, by the ending of its name.
/// For one process or many that see the same files; each step begins when the one before is done:
///
///   1. link() every piece, in any order: the points that it has in common with the piece below.
///   2. begin() once.
///   3. write() every share.
///   4. finish() once.
class PieceJoin {
public:
    /// \throw UsageError for another ending
    explicit PieceJoin(JoinFiles files);

    /// \throw Error (Internal) where two pieces do not fit
    void link(std::size_t piece) const;
    /// \throw LimitError for more than the format can have
    JoinedMesh begin() const;
    void write(std::size_t share, std::size_t shares) const;
    void finish() const;

private:
    JoinFiles files_;
};

/// Whether pieces are joined into a file of this name.
[[nodiscard]] bool can_join_into(const std::string& output);

}  // namespace trisect::app
