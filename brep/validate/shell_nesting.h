// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers around the shells of a boundary.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// For shells that are closed; others are left out. Refers to what it is made of.
class ShellNesting {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// `shell_of_triangle` is below the size of `is_closed`.
    ShellNesting(std::span<const LatticePoint> points, std::span<const Triangle> triangles,
                 std::span<const std::uint32_t> shell_of_triangle,
                 const std::vector<bool>& is_closed, TriangleTree& tree)
        : points_(points),
          triangles_(triangles),
          shell_of_triangle_(shell_of_triangle),
          is_closed_(is_closed),
          tree_(tree) {
        for (const LatticePoint& p : points) all_.add(p);
    }

    /// Just outside the shell that consists of `own`, the winding number of all other shells.
    /// Nothing if that could not be found: other shells cover many of its facets. O(log n), and the
    /// facets along the shortest way out of the mesh along an axis.
    [[nodiscard]] std::optional<int> winding_outside(std::uint32_t shell,
                                                     std::span<const Triangle> own);
    /// The other shells that wind around it, by number. Nothing as above.
    [[nodiscard]] std::optional<std::vector<std::uint32_t>> shells_around(
        std::uint32_t shell, std::span<const Triangle> own);

private:
    struct Ray;
    [[nodiscard]] Ray shortest_way_out(const std::array<LatticePoint, 3>& own) const;
    struct Winding {
        std::uint32_t shell;
        int number;
    };
    using Windings = std::vector<Winding>;
    // Of all other shells that the ray meets, by number.
    [[nodiscard]] std::optional<Windings> windings_outside(std::uint32_t shell,
                                                           std::span<const Triangle> own);
    [[nodiscard]] std::optional<Windings> windings_along(const Ray& ray, std::uint32_t without);

    std::span<const LatticePoint> points_;
    std::span<const Triangle> triangles_;
    std::span<const std::uint32_t> shell_of_triangle_;
    const std::vector<bool>& is_closed_;
    TriangleTree& tree_;
    LatticeBox all_;
};

}  // namespace trisect::detail
