// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/structures.h>

#include <algorithm>
#include <array>

#include <trisect/bsp/hierarchies/convex/convex_parts_structure.h>
#include <trisect/bsp/hierarchies/pairs/all_pairs.h>
#include <trisect/bsp/hierarchies/partitions/partitions.h>
#include <trisect/bsp/hierarchies/volumes/sphere_trees.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>
#include <trisect/kernel/contract.h>

namespace trisect::hierarchies {

namespace {

using Make = std::unique_ptr<PairStructure> (*)(const InterferenceModel&, const InterferenceModel&);

struct Entry {
    StructureInfo info;
    Make make;
};

// One line for each kind, in the order of the enumeration.
constexpr std::array entries{
    Entry{{StructureKind::AllPairs, "all-pairs", "no structure"}, make_all_pairs},
    Entry{{StructureKind::Aabb, "aabb", "axis-parallel boxes, refitted to each pose"},
          make_aabb_tree},
    Entry{{StructureKind::Kdop6, "kdop6", "axis-parallel boxes, turned when met"}, make_kdop6_tree},
    Entry{{StructureKind::Kdop14, "kdop14", "slabs of 7 directions"}, make_kdop14_tree},
    Entry{{StructureKind::Kdop18, "kdop18", "slabs of 9 directions"}, make_kdop18_tree},
    Entry{{StructureKind::Kdop26, "kdop26", "slabs of 13 directions"}, make_kdop26_tree},
    Entry{{StructureKind::Kdop18Refit, "kdop18-refit", "the same, refitted to each pose"},
          make_refitted_kdop18_tree},
    Entry{{StructureKind::Kdop18Climb, "kdop18-climb", "the same, climbed along hulls"},
          make_climbed_kdop18_tree},
    Entry{{StructureKind::Sphere, "sphere", "spheres"}, make_sphere_tree},
    Entry{{StructureKind::SphereOctree, "sphere-octree", "spheres around the cubes of an octree"},
          make_octree_spheres},
    Entry{{StructureKind::SphereMedial, "sphere-medial", "spheres about the medial axis, annealed"},
          make_medial_spheres},
    Entry{{StructureKind::SphereVertices, "sphere-vertices", "spheres about vertices"},
          make_vertex_spheres},
    Entry{{StructureKind::Obb, "obb", "oriented boxes"}, make_obb_tree},
    Entry{{StructureKind::ObbHull, "obb-hull", "oriented boxes along the axes of hulls"},
          make_hull_obb_tree},
    Entry{{StructureKind::ObbWide, "obb-wide", "oriented boxes, four to a node"},
          make_wide_obb_tree},
    Entry{{StructureKind::ObbPacked, "obb-packed", "oriented boxes, four at a time in floats"},
          make_packed_obb_tree},
    Entry{{StructureKind::Hull, "hull", "convex hulls of few corners"}, make_hull_volumes},
    Entry{{StructureKind::Octree, "octree", "cubes in eight"}, make_octree_partition},
    Entry{{StructureKind::KdTree, "kd-tree", "cuts by the surface-area heuristic"},
          make_kd_tree_partition},
    Entry{{StructureKind::RTree, "r-tree", "packed nodes of eight boxes"}, make_r_tree_partition},
    Entry{{StructureKind::HashGrid, "hash-grid", "one grid in a hash table"},
          make_hash_grid_partition},
    Entry{{StructureKind::HierarchicalGrid, "hierarchical-grid", "a grid for each size"},
          make_hierarchical_grid_partition},
    Entry{{StructureKind::ConvexParts, "convex-parts", "hulls of parts, features tracked"},
          make_convex_parts},
    Entry{{StructureKind::Bsp, "bsp", "the classic tree of face planes"}, make_bsp_partition},
    Entry{{StructureKind::Msp, "msp", "the same with trees in the planes"}, make_msp_partition},
    Entry{{StructureKind::FreeSpace, "free-space", "tetrahedra, walked through"},
          make_free_space_partition},
};

constexpr auto infos = [] {
    std::array<StructureInfo, entries.size()> r{};
    for (std::size_t i = 0; i < entries.size(); ++i) r[i] = entries[i].info;
    return r;
}();

}  // namespace

std::span<const StructureInfo> all_structures() { return infos; }

std::string_view to_string(StructureKind kind) {
    return infos[static_cast<std::size_t>(kind)].name;
}

std::optional<StructureKind> structure_kind(std::string_view name) {
    const auto found = std::ranges::find(infos, name, &StructureInfo::name);
    if (found == infos.end()) return std::nullopt;
    return found->kind;
}

std::unique_ptr<PairStructure> make_structure(StructureKind kind, const InterferenceModel& a,
                                              const InterferenceModel& b) {
    const auto found = std::ranges::find(entries, kind, [](const Entry& e) { return e.info.kind; });
    TRISECT_EXPECTS(found != entries.end(), "a kind of structure has no entry");
    return found->make(a, b);
}

}  // namespace trisect::hierarchies
