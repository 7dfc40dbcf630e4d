// SPDX-License-Identifier: Apache-2.0
//
// Bounding volume hierarchies of all kinds.
#pragma once

#include <memory>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>
#include <trisect/bsp/interference/boxes/tree_builder.h>

namespace trisect::hierarchies {

/// Axis-parallel boxes in A's frame. A pose fits all of B's again to the moved triangles, which is
/// what it costs; the boxes are as tight as they can be.
[[nodiscard]] std::unique_ptr<PairStructure> make_aabb_tree(const InterferenceModel& a,
                                                            const InterferenceModel& b);

/// k-DOPs. B's are turned when a walk comes to them; they are looser than fitted ones.
[[nodiscard]] std::unique_ptr<PairStructure> make_kdop6_tree(const InterferenceModel& a,
                                                             const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_kdop14_tree(const InterferenceModel& a,
                                                              const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_kdop18_tree(const InterferenceModel& a,
                                                              const InterferenceModel& b,
                                                              const TreeOptions& options);
[[nodiscard]] std::unique_ptr<PairStructure> make_kdop18_tree(const InterferenceModel& a,
                                                              const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_kdop26_tree(const InterferenceModel& a,
                                                              const InterferenceModel& b);

/// The same with B's fitted again to each pose, like make_aabb_tree's; and with B's slabs found by
/// climbing along the hulls of what is below, where a walk comes to them. Both as tight as can be.
[[nodiscard]] std::unique_ptr<PairStructure> make_refitted_kdop18_tree(const InterferenceModel& a,
                                                                       const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_climbed_kdop18_tree(const InterferenceModel& a,
                                                                      const InterferenceModel& b);

/// Convex hulls of at most 24 corners and a radius around them.
[[nodiscard]] std::unique_ptr<PairStructure> make_hull_volumes(const InterferenceModel& a,
                                                               const InterferenceModel& b);

/// Spheres around the triangles below.
[[nodiscard]] std::unique_ptr<PairStructure> make_sphere_tree(const InterferenceModel& a,
                                                              const InterferenceModel& b);

/// Oriented boxes in doubles: a binary tree, one of four children, and the tree that models have
/// anyway, in floats and four at a time.
[[nodiscard]] std::unique_ptr<PairStructure> make_obb_tree(const InterferenceModel& a,
                                                           const InterferenceModel& b,
                                                           const TreeOptions& options);
[[nodiscard]] std::unique_ptr<PairStructure> make_obb_tree(const InterferenceModel& a,
                                                           const InterferenceModel& b);
/// Along the principal axes of the hull of what is below, not of the surface.
[[nodiscard]] std::unique_ptr<PairStructure> make_hull_obb_tree(const InterferenceModel& a,
                                                                const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_wide_obb_tree(const InterferenceModel& a,
                                                                const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_packed_obb_tree(const InterferenceModel& a,
                                                                  const InterferenceModel& b);

}  // namespace trisect::hierarchies
