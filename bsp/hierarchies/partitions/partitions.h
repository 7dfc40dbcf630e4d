// SPDX-License-Identifier: Apache-2.0
//
// Partitions of space as pair structures (pair_structure.h).
// docs/hierarchies.md has a paragraph on each.
#pragma once

#include <memory>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>

namespace trisect::hierarchies {

/// Cubes divided into eight.
[[nodiscard]] std::unique_ptr<PairStructure> make_octree_partition(const InterferenceModel& a,
                                                                   const InterferenceModel& b);
/// Boxes cut by the surface-area heuristic.
[[nodiscard]] std::unique_ptr<PairStructure> make_kd_tree_partition(const InterferenceModel& a,
                                                                    const InterferenceModel& b);
/// Boost.Geometry's R-tree, packed. It does not decide how many boxes of inner nodes it compares;
/// counted are the boxes of triangles in the leaves that it opens.
[[nodiscard]] std::unique_ptr<PairStructure> make_r_tree_partition(const InterferenceModel& a,
                                                                   const InterferenceModel& b);
/// One grid in a hash table, its cells as long as the median triangle.
[[nodiscard]] std::unique_ptr<PairStructure> make_hash_grid_partition(const InterferenceModel& a,
                                                                      const InterferenceModel& b);
/// A grid for every power of two; a triangle is in one cell of one of them.
[[nodiscard]] std::unique_ptr<PairStructure> make_hierarchical_grid_partition(
    const InterferenceModel& a, const InterferenceModel& b);
/// A is a field of obstacles in a mesh of tetrahedra, B a small body that walks through it.
[[nodiscard]] std::unique_ptr<PairStructure> make_free_space_partition(const InterferenceModel& a,
                                                                       const InterferenceModel& b);
/// The planes of A's faces as a tree, triangles on their planes (BspTree).
[[nodiscard]] std::unique_ptr<PairStructure> make_bsp_partition(const InterferenceModel& a,
                                                                const InterferenceModel& b);
/// The same with trees in the planes that name faces (MspTree).
[[nodiscard]] std::unique_ptr<PairStructure> make_msp_partition(const InterferenceModel& a,
                                                                const InterferenceModel& b);

}  // namespace trisect::hierarchies
