// SPDX-License-Identifier: Apache-2.0
//
// FacetSides: positions of a mesh's facets relative to another mesh.
// No tree is needed for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/two_meshes/conforming/conforming_meshes.h>
#include <trisect/bsp/two_meshes/cube_grid.h>
#include <trisect/bsp/two_meshes/equal_facets.h>

namespace trisect::detail {

class PointSide;

/// A mesh beside another one that it crosses, both embedded. All pairs of facets that cross are
/// known, and nothing else of them touches.
class FacetSides {
public:
    /// `cubes` are those of the mesh, `other` the occupied ones of the other mesh, `near` the
    /// facets whose boxes meet these, in order. `fates`: of these, where some have an equal; their
    /// crossings are not known, and they are listed by their fates. `threads`: 1, or 0 for as many
    /// as there are here.
    FacetSides(const CubeGrid& grid, const LatticeMesh& mesh, const OccupiedCubes& cubes,
               const CubeSet& other, std::span<const std::uint32_t> near,
               std::span<const EqualFacets::Fate> fates, std::uint32_t threads);

    /// How near facets lie to the other mesh, where nothing crosses: `fates` are by that, and of
    /// the unknown ones their own. To be called before all else; the mesh outlives this.
    void set_conforming(const ConformingMeshes::Mesh& mesh) { conforming_ = &mesh; }

    /// The facets that nothing crosses and that lie below the other mesh's facets, where `below`,
    /// or above them; in order. `operand` has been numbered by `crossings`; `outer_below`: far out
    /// one is below the other mesh's facets. Nothing when the side of a facet is not known: where
    /// there are many parts that nothing pierces.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> uncrossed(const Crossings& crossings,
                                                                      std::size_t operand,
                                                                      bool outer_below, bool below,
                                                                      const LatticeMesh& other);
    /// The same for other operations on the meshes with these crossings, where that had a value.
    /// `fates`: as at first, of the same facets.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> uncrossed_again(
        std::span<const EqualFacets::Fate> fates, bool below) {
        fates_ = fates;
        return list_uncrossed(below);
    }
    /// Of the facets that are crossed and have no equal, in order: whether their first corners lie
    /// below the other mesh's facets, where `below`, or above them. \pre uncrossed()
    [[nodiscard]] std::vector<Crossings::Corner> first_corners(bool below);

private:
    enum class Side : std::uint8_t { Unknown, Above, Below };
    /// Cubes in a row of which none is occupied, none before it, none behind it.
    struct Run {
        std::uint64_t bits;
        std::size_t row;
    };

    void list_runs();
    void join_runs(std::size_t row, std::size_t other_row);
    [[nodiscard]] std::uint32_t node_of(std::uint32_t point);
    [[nodiscard]] std::uint32_t root(std::uint32_t node);
    void join(std::uint32_t a, std::uint32_t b);
    void flatten();
    [[nodiscard]] Side side_of_joined(std::uint32_t point) const;
    [[nodiscard]] bool set_side(std::uint32_t node, Side side);
    [[nodiscard]] bool has_equal(std::size_t near) const {
        return !fates_.empty() && fates_[near] != EqualFacets::Fate::Own;
    }
    // Whether the other mesh has a corner there, too; no side is known by that.
    [[nodiscard]] bool is_common(std::uint32_t point) const {
        return conforming_ != nullptr && conforming_->is_common[point];
    }
    // A point on the side that a near facet is on, if it has no equal.
    [[nodiscard]] std::uint32_t point_of(std::size_t near) const {
        return conforming_ != nullptr && !conforming_->corners.empty()
                   ? conforming_->corners[near]
                   : mesh_.triangles[near_[near]][0];
    }
    [[nodiscard]] bool take_known_sides();
    [[nodiscard]] bool are_pierces_known(std::uint32_t facet) const;
    void mark_crossed(const Crossings& crossings, std::size_t operand);
    void join_uncrossed();
    [[nodiscard]] bool look_at_outer_runs(Side side);
    [[nodiscard]] bool look_at_pierced_edges(const Crossings& crossings, std::size_t operand);
    [[nodiscard]] bool look_at_often_pierced_edges(const Crossings& crossings, std::size_t operand,
                                                   const LatticeMesh& other);
    [[nodiscard]] bool look_along_lines(const PointSide& side_of, std::size_t most);
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> list_uncrossed(bool below);

    const CubeGrid& grid_;
    const LatticeMesh& mesh_;
    const OccupiedCubes& cubes_;
    const CubeSet& other_;
    std::span<const std::uint32_t> near_;
    std::span<const EqualFacets::Fate> fates_;
    const ConformingMeshes::Mesh* conforming_ = nullptr;
    std::uint32_t threads_;
    std::vector<std::uint8_t> is_crossed_;  // of the near facets
    std::vector<Run> runs_;
    std::vector<std::uint32_t> first_run_;  // by row
    // Nodes are the runs, then points of near facets in occupied cubes.
    std::vector<std::uint32_t> parents_;
    std::vector<Side> sides_;           // of roots
    std::vector<std::uint32_t> nodes_;  // by point: its node and 1, or 0
};

}  // namespace trisect::detail
