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

    /// A use of an edge from the corner to another one that both meshes have.
    struct Use {
        std::uint32_t other = 0;  ///< the name of its other end
        std::uint32_t item = 0;
        std::uint32_t apex = 0;  ///< the name of the corner of the item that is not on the edge
        bool forward = false;    ///< the facet runs along it away from the corner
    };
    using Pair = std::array<std::uint32_t, 2>;

    void set(std::uint32_t name, const CornerFans& fans);

    [[nodiscard]] std::uint32_t name() const { return name_; }
    /// Of a mesh, by the names of the other ends, of which those that come before this one are left
    /// out.
    [[nodiscard]] std::span<const Use> uses(std::size_t mesh) const { return uses_[mesh]; }
    [[nodiscard]] std::size_t pair_count() const { return sectors_[0].size() * sectors_[1].size(); }

    /// Appends the pairs of items, one of each mesh, that have just the corner in common and may
    /// meet elsewhere: they do not plainly lie side by side, seen along an axis. In doubles.
    void add_open_pairs(std::vector<Pair>& out);

private:
    // A facet around the corner, by the names of its other corners, and what it takes of the
    // circle, of which a round is 4.
    struct Sector {
        std::uint32_t item;
        std::uint32_t next;
        std::uint32_t last;
        double from;
        double width;
    };
    void set_mesh(std::size_t mesh, const CornerFans& fans);
    void set_angles();
    void add_use(std::size_t mesh, const Use& use);
    [[nodiscard]] std::size_t largest_axis() const;

    const CornerNames& names_;
    std::uint32_t name_ = 0;
    std::array<std::vector<Sector>, 2> sectors_;
    std::array<std::vector<Use>, 2> uses_;
};

}  // namespace trisect::detail
