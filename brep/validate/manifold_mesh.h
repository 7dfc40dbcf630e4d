// SPDX-License-Identifier: Apache-2.0
//
// ManifoldMesh: a closed triangle mesh with adjacency.
// Some checks follow from the adjacency alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/validate/twins.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Refers to the points and triangles. Answers are nothing where the general checks of validation
/// have to decide.
class ManifoldMesh {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// Nothing if the mesh is empty or not plainly manifold (twins.h). O(n).
    [[nodiscard]] static std::optional<ManifoldMesh> of(std::span<const LatticePoint> points,
                                                        std::span<const Triangle> triangles);

    /// Whether winding numbers change between 0 and 1 across every shell. Exact. O(n), and
    /// O(n log n) for several shells.
    [[nodiscard]] std::optional<bool> are_shells_nested() const;

    /// Whether no two triangles meet beyond the corners and edges that they share. Exact; false as
    /// well when more pairs than some hundred a triangle would have to be compared. O(n log n) for
    /// ordinary meshes. \throw CancelledError, LimitError by the StopScope
    [[nodiscard]] std::optional<bool> has_no_contact() const;
    /// The same for pairs of which one is among these triangles.
    [[nodiscard]] std::optional<bool> has_no_contact(
        std::span<const std::uint32_t> triangles) const;

    /// Whether each direction from a point within plainly meets one triangle: then it bounds a
    /// solid, seen from outside, and no two triangles meet beyond the corners and edges that they
    /// share. False as well where doubles do not decide. O(n).
    [[nodiscard]] bool is_starlike() const;

    /// Whether it is plainly a surface over a flat bottom across z, which has one rim around a
    /// point, and nowhere turns down: then it bounds a solid, seen from outside, and no two
    /// triangles meet beyond the corners and edges that they share. False as well where doubles do
    /// not decide. O(n).
    [[nodiscard]] bool is_height_field() const;

    /// Whether it is plainly the boundary of a convex solid, seen from outside: then no two
    /// triangles meet beyond the corners and edges that they share. Exact; false as well where a
    /// corner lies within a face, or those of a triangle are in a row. Ends at the first edge that
    /// is not convex. O(n) where few edges meet in a corner.
    [[nodiscard]] bool is_convex() const;

private:
    ManifoldMesh(std::span<const LatticePoint> points, std::span<const Triangle> triangles,
                 Twins twins)
        : points_(points), triangles_(triangles), twins_(std::move(twins)) {}

    [[nodiscard]] bool has_equal_corners(const Triangle& a, const Triangle& b) const;
    // By triangle: one of a pair is marked. All pairs where there are no marks.
    [[nodiscard]] std::optional<bool> has_no_contact_of(std::span<const std::uint8_t> marks) const;

    [[nodiscard]] std::optional<bool> have_few_no_contact(
        std::span<const std::uint32_t> triangles) const;

    std::span<const LatticePoint> points_;
    std::span<const Triangle> triangles_;
    Twins twins_;
};

/// As many pairs as a check of so many triangles compares: meshes of needles may have a quadratic
/// number of them.
[[nodiscard]] std::uint64_t pair_limit_of(std::size_t triangles);

}  // namespace trisect::detail
