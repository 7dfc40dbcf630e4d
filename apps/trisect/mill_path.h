// SPDX-License-Identifier: Apache-2.0
//
// ToolPath: straight moves of a tool with their places in a file.
#pragma once

#include <trisect/kernel/point3d.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::app {

/// A straight move of the tool's tip, or of a path whose first place is not known, a placement.
struct ToolMove {
    bool is_rapid = false;
    /// Nothing is swept: the first place of a path, and turns of the tool in the air.
    bool is_placement = false;
    Point3d to{};
    std::uint32_t orientation = 0;  ///< into ToolPath::orientations, all along the move
    double feed = 0;                ///< user's units a minute; 0: rapid
    std::uint64_t line = 0;
};

struct ToolPath {
    std::string file;
    std::vector<std::array<double, 9>> orientations{{1, 0, 0, 0, 1, 0, 0, 0, 1}};
    std::vector<ToolMove> moves;  ///< the first one is a placement
    std::size_t arcs = 0;         ///< that were cut into chords
    std::vector<std::string> notes;
};

struct PathOptions {
    double chord = 0.01;  ///< how far chords may be from their arc
    double feed = 1000;   ///< where the file has none
};

/// A file of poses (the name ends with .poses) or of G-code. "-" is the standard input, G-code.
/// \throw InputError with line and column
[[nodiscard]] ToolPath read_tool_path(const std::string& file, const PathOptions& options);

/// Lines of twelve numbers, row by row, perhaps after the word "rapid".
[[nodiscard]] ToolPath parse_pose_path(std::string_view text, const std::string& name,
                                       const PathOptions& options);
/// G0 to G3 in three planes, G20 and G21, G90 and G91; see docs/mill.md.
[[nodiscard]] ToolPath parse_gcode(std::string_view text, const std::string& name,
                                   const PathOptions& options);

}  // namespace trisect::app
