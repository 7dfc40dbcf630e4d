// SPDX-License-Identifier: Apache-2.0
//
// Fast path for a face of OFF or ASCII PLY.
// The face fills its line: the count and the indices from 0.
#pragma once

#include <trisect/brep/io/formats/mesh_builder.h>
#include <trisect/brep/io/formats/quick_text.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace trisect::detail {

/// Adds the face of the line at which `text` begins; false, and nothing added, for other lines and
/// for faces of many corners.
inline bool quick_loop(QuickText& text, MeshBuilder& mesh) {
    struct Corner {
        const char* at;
        std::uint32_t index;
    };
    std::array<Corner, 8> corners;
    const char* line = text.here();
    std::uint32_t n = 0;
    if (!text.integer(n) || n > corners.size()) return false;
    for (std::size_t i = 0; i < n; ++i) {
        if (!text.blanks()) return false;
        corners[i].at = text.here();
        if (!text.integer(corners[i].index)) return false;
    }
    if (!text.blanks_or_line_end() || !text.line_end()) return false;
    for (std::size_t i = 0; i < n; ++i) mesh.add_corner(corners[i].index, corners[i].at);
    mesh.end_face(line);
    return true;
}

}  // namespace trisect::detail
