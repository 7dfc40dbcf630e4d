// SPDX-License-Identifier: Apache-2.0
//
// CornerMoves: an infinitesimal move of its own for each corner of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Each corner is moved by d times its vector, with one positive d below any number. A mesh that is
/// embedded, without contacts of its own, stays so.
struct CornerMoves {
    using Vector = std::array<std::int32_t, 3>;

    const LatticePoint* points = nullptr;  ///< of the mesh
    std::vector<Vector> vectors;           ///< by point

    /// \pre the point is one of the mesh's, at its place there
    [[nodiscard]] const Vector& of(const LatticePoint& point) const {
        return vectors[static_cast<std::size_t>(&point - points)];
    }
};

}  // namespace trisect::detail
