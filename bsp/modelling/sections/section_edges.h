// SPDX-License-Identifier: Apache-2.0
//
// SectionEdges: the edges of a mesh that is cut, by number.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <trisect/bsp/modelling/sections/mesh_section.h>

namespace trisect::detail {

/// Two corners with a side of some triangle between them are an edge, however many triangles have
/// it. For any thread.
class SectionEdges {
public:
    /// Refers to the mesh. O(n log n)
    explicit SectionEdges(const MeshSection& mesh);

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(ends_.size()); }
    /// Of the side from corner k of the triangle to the next one.
    [[nodiscard]] std::uint32_t edge(std::uint32_t triangle, std::size_t k) const {
        return edge_of_[3 * std::size_t{triangle} + k];
    }
    /// The lower one first, as doubles show it.
    [[nodiscard]] const std::array<std::uint32_t, 2>& ends(std::uint32_t e) const {
        return ends_[e];
    }

    /// What a plane finds that passes through an edge between its ends.
    enum class Bend : std::uint8_t {
        Unknown,   ///< not found out yet
        Straight,  ///< two triangles in one plane, on either side: no corner
        Turns,     ///< two triangles that are not so: a corner
        Open       ///< what doubles of the section show
    };
    /// Found out when it is first needed. Exact.
    [[nodiscard]] Bend bend(std::uint32_t e) const {
        const Bend known = bends_[e].load(std::memory_order_relaxed);
        return known != Bend::Unknown ? known : find_bend(e);
    }

private:
    void number_edges();
    Bend find_bend(std::uint32_t e) const;
    [[nodiscard]] Bend bend_of(std::uint32_t e) const;
    [[nodiscard]] std::uint32_t apex(std::uint32_t side) const {
        return mesh_.triangle(side / 3)[(side + 2) % 3];
    }

    const MeshSection& mesh_;
    std::vector<std::uint32_t> edge_of_;  // by side: three times the triangle, and k
    std::vector<std::array<std::uint32_t, 2>> ends_;
    // The two sides that an edge has, running opposite ways; else none.
    std::vector<std::array<std::uint32_t, 2>> sides_;
    std::unique_ptr<std::atomic<Bend>[]> bends_;
};

}  // namespace trisect::detail
