// SPDX-License-Identifier: Apache-2.0
//
// Space partitions as broad phases: intersecting boxes by cells.
// The other broad phases (bsp/interference/boxes/broad_phase.h) use an order along an axis.
#pragma once

#include <memory>

#include <trisect/bsp/interference/boxes/broad_phase.h>

namespace trisect::hierarchies {

/// A uniform grid whose occupied cells are in a hash table. Cells are twice as long as the box of
/// median size, so boxes of similar size take a few cells each: storage and time are O(n) and the
/// pairs. A box that would take more than 64 cells is kept apart and compared with all others; so a
/// few giants among many dwarfs cost n comparisons each, many giants n² of them.
///
/// Source: M. Overmars, Point location in fat subdivisions (1992), for similar sizes.
[[nodiscard]] std::unique_ptr<detail::BroadPhase> make_hash_grid();

/// Grids of all sizes that are powers of two, in one hash table. A box is in one cell of the grid
/// just as coarse as the box is long; it looks for partners in at most 27 cells of its own grid and
/// each coarser one in use. So storage is O(n) whatever the sizes are, an update is O(1), and
/// dwarfs find a giant while the giant never looks for dwarfs.
///
/// Source: B. Mirtich, Efficient algorithms for two-phase collision detection (MERL TR-97-23,
/// 1997); M. Overmars as above.
[[nodiscard]] std::unique_ptr<detail::BroadPhase> make_hierarchical_grid();

/// A loose octree: a box is in the cell of its centre, on the level whose cells are just as long as
/// the box. Empty parts of space are passed over with one test, otherwise as the hierarchical grid.
/// Packed anew when something moved: O(n) levels of at most 21.
///
/// Source: T. Ulrich, Loose octrees (Game Programming Gems 1, 2000).
[[nodiscard]] std::unique_ptr<detail::BroadPhase> make_octree_phase();

/// A k-d tree whose leaves list the boxes that reach into them; cut at medians of centres, while
/// the lists of all leaves together stay below four entries a box. Packed anew when something
/// moved: O(n log n).
///
/// Source: J. Bentley, Multidimensional binary search trees (CACM 18(9), 1975).
[[nodiscard]] std::unique_ptr<detail::BroadPhase> make_kd_tree_phase();

}  // namespace trisect::hierarchies
