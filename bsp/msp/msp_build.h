// SPDX-License-Identifier: Apache-2.0
//
// MspTreeBuilder: construction of an MspTree from polygons.
#pragma once

#include <span>

#include <trisect/bsp/msp/msp_soup.h>
#include <trisect/bsp/msp_tree.h>

namespace trisect {

class MspTreeBuilder {
public:
    [[nodiscard]] static MspTree run(detail::msp::MspSoup&& soup, std::span<const Plane> walls,
                                     MspTree::Leaf empty, const MspOptions& options,
                                     Lattice lattice);
};

}  // namespace trisect
