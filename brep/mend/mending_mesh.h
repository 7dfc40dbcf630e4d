// SPDX-License-Identifier: Apache-2.0
//
// MendingMesh: polygons over distinct lattice points, between two kinds of mending.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Corners are names: indices into `points`, which stay while faces change.
struct MendingMesh {
    std::vector<LatticePoint> points;         ///< distinct
    std::vector<std::uint32_t> source_point;  ///< first index in the input of each
    std::vector<std::uint32_t> loop_begin{0};
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> face_source;  ///< index in the input, or no_face

    [[nodiscard]] std::size_t face_count() const { return loop_begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> loop(std::size_t f) const {
        return {corners.data() + loop_begin[f], corners.data() + loop_begin[f + 1]};
    }
    void add_face(std::span<const std::uint32_t> loop, std::uint32_t source) {
        corners.insert(corners.end(), loop.begin(), loop.end());
        loop_begin.push_back(static_cast<std::uint32_t>(corners.size()));
        face_source.push_back(source);
    }
    /// The same points without faces, which `faces` are then moved into.
    void take_faces(MendingMesh&& faces) {
        loop_begin = std::move(faces.loop_begin);
        corners = std::move(faces.corners);
        face_source = std::move(faces.face_source);
    }
};

}  // namespace trisect::detail
