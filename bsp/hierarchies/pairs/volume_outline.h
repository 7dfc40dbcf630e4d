// SPDX-License-Identifier: Apache-2.0
//
// VolumeOutline: a bounding volume of a structure, for pictures.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/tree_frame.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/point3d.h>

namespace trisect::hierarchies {

/// The points between two parallel planes: lower <= direction · x <= upper.
struct Slab {
    Point3d direction{};
    double lower = 0;
    double upper = 0;
};

/// The common part of slabs, or, where there are none, a ball. Numbers are rounded.
struct VolumeOutline {
    unsigned level = 0;  ///< 0: around everything
    bool is_leaf = false;
    std::vector<Slab> slabs;
    Point3d center{};
    double radius = 0;

    /// From a tree's numbers to the user's units.
    void to_user(const TreeFrame& frame, Lattice lattice);
};

}  // namespace trisect::hierarchies
