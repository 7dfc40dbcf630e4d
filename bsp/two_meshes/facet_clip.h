// SPDX-License-Identifier: Apache-2.0
//
// FacetClip: boxes of the parts of facets that lie in a box.
#pragma once

#include <array>
#include <cstdint>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/cells/packed_box.h>

namespace trisect::detail {

/// The facets of a mesh in a frame. The box of a long facet that runs across all axes says little
/// about where the facet is; those of its parts in small cells do.
class FacetClip {
public:
    FacetClip(const Frame& frame, const LatticeMesh& mesh);

    /// A box around all of a facet that lies in cells that `within` covers, not larger than
    /// `within`; an empty one only where nothing of it does. Its id is the facet. \pre the facet
    /// lies within the limits of the frame
    [[nodiscard]] PackedBox clipped(std::uint32_t facet, const PackedBox& within) const;

private:
    const LatticeMesh& mesh_;
    std::array<double, 3> origin_{};
    double scale_ = 1;
    float margin_ = 1;
};

}  // namespace trisect::detail
