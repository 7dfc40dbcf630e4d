// SPDX-License-Identifier: Apache-2.0
//
// GlbVertices: a part's vertices as glTF has them.
// There is one for each combination of place and properties.
#pragma once

#include <trisect/brep/io/model.h>

#include <cstdint>
#include <string>
#include <vector>

namespace trisect::detail {

struct GlbVertices {
    static constexpr std::uint8_t has_uv = 1;
    static constexpr std::uint8_t has_normal = 2;
    static constexpr std::uint8_t has_color = 4;

    std::vector<std::uint32_t> corner;  ///< by corner of the mesh: a vertex
    std::vector<std::uint32_t> place;   ///< by vertex: a vertex of the mesh
    std::vector<std::uint32_t> first;   ///< by vertex: the first one in the same place
    std::vector<float> uv;              ///< two of each vertex, v downward; empty: none has any
    std::vector<float> normal;          ///< three, of length 1
    std::vector<float> color;           ///< four, amounts of light
    std::vector<std::uint8_t> kinds;    ///< by face: what all its corners have
};

/// Without properties these are the vertices of the mesh. Numbers that a corner does not have are
/// 0. \throw LimitError for a number beyond the range of floats
[[nodiscard]] GlbVertices glb_vertices(const ModelPart& part, const std::string& name);

}  // namespace trisect::detail
