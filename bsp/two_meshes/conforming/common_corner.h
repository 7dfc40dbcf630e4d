// SPDX-License-Identifier: Apache-2.0
//
// CommonCorner: the facets of two meshes around a corner that both have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/two_meshes/conforming/corner_fans.h>
#include <trisect/bsp/two_meshes/conforming/corner_names.h>

namespace trisect::detail {

/// Keeps its memory from corner to corner.
class CommonCorner {
public:
    explicit CommonCorner(const CornerNames& names) : names_(names) {}

    /// A facet around the corner, by the spokes of its other two corners.
    struct Sector {
        std::uint32_t item = 0;
        std::uint32_t next = 0;
        std::uint32_t last = 0;
    };
    /// A use of an edge from the corner.
    struct Use {
        std::uint32_t other = 0;   ///< the name of its other end
        std::uint32_t sector = 0;  ///< of its mesh
        bool forward = false;      ///< the facet runs along it away from the corner
    };
    using Pair = std::array<std::uint32_t, 2>;

    void set(std::uint32_t name, const CornerFans& fans);

    [[nodiscard]] std::uint32_t name() const { return name_; }
    /// Of a mesh, by the names of the other ends.
    [[nodiscard]] std::span<const Use> uses(std::size_t mesh) const { return uses_[mesh]; }
    [[nodiscard]] const Sector& sector(std::size_t mesh, std::uint32_t i) const {
        return sectors_[mesh][i];
    }
    /// The name of the corner that is not on the edge.
    [[nodiscard]] std::uint32_t apex(std::size_t mesh, const Use& use) const {
        const Sector& s = sectors_[mesh][use.sector];
        return spokes_[mesh][use.forward ? s.last : s.next];
    }
    [[nodiscard]] std::size_t pair_count() const { return sectors_[0].size() * sectors_[1].size(); }

    /// Appends the pairs of items, one of each mesh, that have just the corner in common and may
    /// meet elsewhere: no line through the corner parts them, seen along an axis. In doubles.
    void add_open_pairs(std::vector<Pair>& out);

private:
    struct Flat {
        double x = 0;
        double y = 0;
    };
    void set_mesh(std::size_t mesh, const CornerFans& fans);
    void project();
    void compare_spokes();

    const CornerNames& names_;
    std::uint32_t name_ = 0;
    std::array<std::vector<Sector>, 2> sectors_;
    std::array<std::vector<Use>, 2> uses_;
    std::array<std::vector<std::uint32_t>, 2> spokes_;  // names of other ends, each once
    std::array<std::vector<Flat>, 2> flat_;             // from the corner, by spoke
    // By spoke of a mesh, a bit for each spoke of the other one: whether that is surely on the
    // left, and on the right.
    std::array<std::size_t, 2> words_{};  // of bits of the other mesh's
    std::array<std::vector<std::uint64_t>, 2> left_;
    std::array<std::vector<std::uint64_t>, 2> right_;
};

}  // namespace trisect::detail
