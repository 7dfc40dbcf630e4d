// SPDX-License-Identifier: Apache-2.0
//
// CornerNames: corners of some facets of two meshes, by value.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// Whether some corners of either mesh are equal, by a sample of those of the first one: all of few
/// facets. Of many facets it may miss some. O(n), a fraction of what names take.
[[nodiscard]] bool may_have_common_corners(
    const std::array<const LatticeMesh*, 2>& meshes,
    const std::array<std::span<const std::uint32_t>, 2>& facets);

/// Equal corners have one name, of whichever mesh they are. Names count up from 0 in the order of
/// first use. Facets are *items*: those of the first list, then those of the second one.
class CornerNames {
public:
    using Triple = std::array<std::uint32_t, 3>;

    /// Memory is the arena's. O(n)
    CornerNames(const std::array<const LatticeMesh*, 2>& meshes,
                const std::array<std::span<const std::uint32_t>, 2>& facets, StackArena& arena);

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t common_count() const { return common_count_; }
    /// Whether a corner of either mesh has the name.
    [[nodiscard]] bool is_common(std::uint32_t name) const { return is_common_[name] != 0; }
    [[nodiscard]] const LatticePoint& point(std::uint32_t name) const {
        const std::uint32_t at = at_[name];
        return at < first_points_ ? meshes_[0]->points[at] : meshes_[1]->points[at - first_points_];
    }

    [[nodiscard]] std::uint32_t item_count() const { return items_[1]; }
    [[nodiscard]] std::size_t mesh_of(std::uint32_t item) const { return item < items_[0] ? 0 : 1; }
    /// The first item of a mesh; of 2 the number of items.
    [[nodiscard]] std::uint32_t first_item(std::size_t mesh) const {
        return mesh == 0 ? 0 : items_[mesh - 1];
    }
    [[nodiscard]] const Triple& corners(std::uint32_t item) const { return triples_[item]; }
    [[nodiscard]] std::uint32_t facet(std::uint32_t item) const {
        return item < items_[0] ? facets_[0][item] : facets_[1][item - items_[0]];
    }
    /// The corner of the first mesh that has a common name.
    [[nodiscard]] std::uint32_t first_corner(std::uint32_t name) const { return at_[name]; }

private:
    struct Slot {
        std::uint32_t name;
        std::uint32_t at;
    };
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    void name_corners(std::size_t mesh);
    [[nodiscard]] std::uint32_t name_of(std::uint32_t at, const LatticePoint& p, bool is_second);
    void rehash(std::size_t slots);
    [[nodiscard]] std::uint32_t most_names() const { return 3 * items_[1]; }
    [[nodiscard]] const LatticePoint& point_at(std::uint32_t at) const {
        return at < first_points_ ? meshes_[0]->points[at] : meshes_[1]->points[at - first_points_];
    }

    std::array<const LatticeMesh*, 2> meshes_;
    std::array<std::span<const std::uint32_t>, 2> facets_;
    std::array<std::uint32_t, 2> items_{};  // where they end
    std::uint32_t first_points_;
    StackArena& arena_;
    Triple* triples_;
    std::uint32_t* at_;  // by name: a corner of the first mesh, or after these
    std::uint8_t* is_common_;
    std::span<Slot> slots_;  // by value, open addressing
    std::size_t count_ = 0;
    std::size_t common_count_ = 0;
};

}  // namespace trisect::detail
