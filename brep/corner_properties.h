// SPDX-License-Identifier: Apache-2.0
//
// CornerProperties: numbers at the corners of the faces of a mesh.
// Texture coordinates, colours, normals, or whatever varies over faces.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace trisect {

/// Each corner of each face has its own numbers, so that neighbouring faces may differ where they
/// meet. Invariant: `values` has `width` numbers for each entry of PolygonMesh::corners.
struct CornerProperties {
    std::size_t width = 0;
    std::vector<double> values;

    [[nodiscard]] std::span<const double> at(std::size_t corner) const {
        return std::span(values).subspan(corner * width, width);
    }
    friend bool operator==(const CornerProperties&, const CornerProperties&) = default;
};

}  // namespace trisect
