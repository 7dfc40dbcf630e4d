// SPDX-License-Identifier: Apache-2.0
//
// Sphere trees by three constructions, their tightness, and anytime queries.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>
#include <trisect/bsp/hierarchies/volumes/sphere_kind.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchy.h>

namespace trisect::hierarchies {

/// How the spheres of a tree come about. In every tree a sphere contains all triangles below it.
enum class SphereConstruction : std::uint8_t {
    Octree,      ///< a sphere around what each cube of an octree has (Hubbard 1995)
    MedialAxis,  ///< about centres on the medial axis, chosen by simulated annealing (Hubbard 1996)
    Vertices     ///< about vertices that are far from each other (O'Rourke and Badler 1979)
};

using SphereTree = VolumeTree<SphereKind>;

/// Up to eight children a node, up to four triangles a leaf. Deterministic. Cost: O(n log n); the
/// medial axis takes samples of a bounded size, some hundred times as long as the others.
/// \pre the model has triangles
[[nodiscard]] SphereTree build_sphere_tree(const detail::InterferenceModelData& model,
                                           SphereConstruction construction);

/// How the spheres of one level stand out of the solid. The spheres of a level are its nodes and
/// the leaves above it: they contain the boundary.
struct SphereLevel {
    std::size_t spheres = 0;
    double volume = 0;  ///< the sum of theirs, in the user's units
    /// No point of any of them is farther outside of the solid, in the user's units: a bound of the
    /// Hausdorff distance between the solid and the solid with the spheres. Certified.
    double largest_protrusion = 0;
    double mean_protrusion = 0;
};

/// Level by level from the root, until there are more than `most` spheres. Cost: a signed distance
/// for each sphere.
[[nodiscard]] std::vector<SphereLevel> tightness(const InterferenceModel& model,
                                                 const SphereTree& tree, std::size_t most = 4096);

/// What is known after some tests. Lengths are in lattice units of A.
struct AnytimeAnswer {
    bool apart = false;       ///< proved
    double at_least = 0;      ///< the boundaries' distance is not less,
    double at_most = 0;       ///< and not more: both spheres of a pair contain points of them
    std::uint64_t tests = 0;  ///< pairs of spheres compared
};

/// A way out: B moved this far in this direction, of length 1, or any farther, does not meet A.
struct AnytimeDepth {
    double at_most = 0;  ///< in lattice units of A; the depth of penetration is not more
    std::array<double, 3> direction{};
    std::uint64_t tests = 0;
};

/// Sphere trees as a structure like the others, which can be interrupted.
class SphereTrees : public VolumeHierarchy<SphereKind> {
public:
    SphereTrees(const InterferenceModel& a, const InterferenceModel& b,
                SphereConstruction construction);

    /// The answer that a number of tests affords, better with every test; no triangle is looked at
    /// (Hubbard's interruptible detection). It ends before when nothing is left to open.
    /// \pre has_doubles()
    [[nodiscard]] AnytimeAnswer answer_within(std::uint64_t tests, CostCounters& counters);

    /// Likewise a bound on the depth of penetration, the least translation that separates the
    /// solids, better with every test: of 26 directions the one that looks best is pursued, in it
    /// the pair of spheres that is left last. 0 proves solids apart. \pre has_doubles()
    [[nodiscard]] AnytimeDepth depth_within(std::uint64_t tests, CostCounters& counters);

private:
    // take(i, j) for the children of the larger of two spheres that can be opened.
    template <class Take>
    void open_larger(std::uint32_t i, std::uint32_t j, Take&& take) const;
};

[[nodiscard]] std::unique_ptr<PairStructure> make_octree_spheres(const InterferenceModel& a,
                                                                 const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_medial_spheres(const InterferenceModel& a,
                                                                 const InterferenceModel& b);
[[nodiscard]] std::unique_ptr<PairStructure> make_vertex_spheres(const InterferenceModel& a,
                                                                 const InterferenceModel& b);

}  // namespace trisect::hierarchies
