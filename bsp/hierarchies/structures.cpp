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

struct StructureEntry {
    StructureInfo info;
    Make make;
};

// One line for each kind, in the order of the enumeration.
constexpr std::array structure_entries{
    StructureEntry{{StructureKind::AllPairs, "all-pairs", "no structure"}, make_all_pairs},
    StructureEntry{{StructureKind::Aabb, "aabb", "axis-parallel boxes, refitted to each pose"},
                   make_aabb_tree},
    StructureEntry{{StructureKind::Kdop6, "kdop6", "axis-parallel boxes, turned when met"},
                   make_kdop6_tree},
    StructureEntry{{StructureKind::Kdop14, "kdop14", "slabs of 7 directions"}, make_kdop14_tree},
    StructureEntry{{StructureKind::Kdop18, "kdop18", "slabs of 9 directions"}, make_kdop18_tree},
    StructureEntry{{StructureKind::Kdop26, "kdop26", "slabs of 13 directions"}, make_kdop26_tree},
    StructureEntry{{StructureKind::Kdop18Refit, "kdop18-refit", "the same, refitted to each pose"},
                   make_refitted_kdop18_tree},
    StructureEntry{{StructureKind::Kdop18Climb, "kdop18-climb", "the same, climbed along hulls"},
                   make_climbed_kdop18_tree},
    StructureEntry{{StructureKind::Sphere, "sphere", "spheres"}, make_sphere_tree},
    StructureEntry{
        {StructureKind::SphereOctree, "sphere-octree", "spheres around the cubes of an octree"},
        make_octree_spheres},
    StructureEntry{
        {StructureKind::SphereMedial, "sphere-medial", "spheres about the medial axis, annealed"},
        make_medial_spheres},
    StructureEntry{{StructureKind::SphereVertices, "sphere-vertices", "spheres about vertices"},
                   make_vertex_spheres},
    StructureEntry{{StructureKind::Obb, "obb", "oriented boxes"}, make_obb_tree},
    StructureEntry{{StructureKind::ObbHull, "obb-hull", "oriented boxes along the axes of hulls"},
                   make_hull_obb_tree},
    StructureEntry{{StructureKind::ObbWide, "obb-wide", "oriented boxes, four to a node"},
                   make_wide_obb_tree},
    StructureEntry{
        {StructureKind::ObbPacked, "obb-packed", "oriented boxes, four at a time in floats"},
        make_packed_obb_tree},
    StructureEntry{{StructureKind::Hull, "hull", "convex hulls of few corners"}, make_hull_volumes},
    StructureEntry{{StructureKind::Octree, "octree", "cubes in eight"}, make_octree_partition},
    StructureEntry{{StructureKind::KdTree, "kd-tree", "cuts by the surface-area heuristic"},
                   make_kd_tree_partition},
    StructureEntry{{StructureKind::RTree, "r-tree", "packed nodes of eight boxes"},
                   make_r_tree_partition},
    StructureEntry{{StructureKind::HashGrid, "hash-grid", "one grid in a hash table"},
                   make_hash_grid_partition},
    StructureEntry{{StructureKind::HierarchicalGrid, "hierarchical-grid", "a grid for each size"},
                   make_hierarchical_grid_partition},
    StructureEntry{{StructureKind::ConvexParts, "convex-parts", "hulls of parts, features tracked"},
                   make_convex_parts},
    StructureEntry{{StructureKind::Bsp, "bsp", "the classic tree of face planes"},
                   make_bsp_partition},
    StructureEntry{{StructureKind::Msp, "msp", "the same with trees in the planes"},
                   make_msp_partition},
    StructureEntry{{StructureKind::FreeSpace, "free-space", "tetrahedra, walked through"},
                   make_free_space_partition},
};

constexpr auto infos = [] {
    std::array<StructureInfo, structure_entries.size()> r{};
    for (std::size_t i = 0; i < structure_entries.size(); ++i) r[i] = structure_entries[i].info;
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
    const auto found = std::ranges::find(structure_entries, kind,
                                         [](const StructureEntry& e) { return e.info.kind; });
    TRISECT_EXPECTS(found != structure_entries.end(), "a kind of structure has no entry");
    return found->make(a, b);
}

}  // namespace trisect::hierarchies
