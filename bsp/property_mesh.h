// SPDX-License-Identifier: Apache-2.0
//
// Meshes of results with the properties of their operands' faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/corner_properties.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// A mesh that became a solid, with its properties. Both must outlive the call.
struct PropertyOperand {
    std::uint32_t source_id = 0;  ///< Solid::source_id() of the solid of that mesh
    const PolygonMesh* mesh = nullptr;
    const CornerProperties* properties = nullptr;  ///< null: none
};

struct PropertyMesh {
    PolygonMesh mesh;  ///< triangles, if not made of other faces
    CornerProperties properties;
    std::vector<FaceSource> source;  ///< by face: operand (the source_id) and face of its mesh
    /// By face: whether it looks the other way than that face does, as walls of a hole do.
    /// Channels of normals are turned over there; numbers without names are as they are.
    std::vector<bool> is_turned_over;
};

/// The boundary in triangles, each within one face of one operand. Properties are interpolated
/// linearly in that face, once, from the rounded corner; they never leave the range of the values
/// at the face's corners, and are exactly these at corners of the face. A face of more than three
/// corners counts as a fan of triangles from its first corner: it should be convex, or linear.
/// The channels are those of all operands; what an operand does not have is absent. Normals are
/// not brought to a length. Without channels the width is that of the widest operand, and what an
/// operand does not have is 0. Costs to_brep() and O(1) for each corner.
///
/// Where faces of two operands lie in one plane and look the same way, the face that the result
/// names is one of both.
/// \throw UsageError for an operand whose properties do not fit its mesh or that is named twice,
/// and for channels of one name that differ; UnsupportedError when the boundary is unbounded
[[nodiscard]] PropertyMesh to_property_mesh(const Solid& solid,
                                            std::span<const PropertyOperand> operands);

/// The same for faces that are there already, of which `source` names the faces of operands. Each
/// lies within that face, but for rounding. What the source of a face names is not there: absent.
[[nodiscard]] PropertyMesh with_properties(PolygonMesh faces, std::vector<FaceSource> source,
                                           std::span<const PropertyOperand> operands);

}  // namespace trisect
