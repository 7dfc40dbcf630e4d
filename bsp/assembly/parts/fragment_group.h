// SPDX-License-Identifier: Apache-2.0
//
// FragmentGroup: fragments of one facet in one cell, joined along named lines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// The boundary of what a leaf lists of one facet: what two of its fragments have in common runs
/// both ways along one line and cancels. A vertex is known by the two lines that meet there, so all
/// of this is about small numbers, and only what is left has to be looked up. Where doubles cannot
/// decide the order of vertices on a line its edges stay as they are. Keeps its memory.
class FragmentGroup {
public:
    static constexpr std::size_t max_parts = 64;
    static constexpr std::size_t max_lines = 32;
    static constexpr std::size_t max_vertices = 128;

    /// From a vertex to the next one along a line, counter-clockwise seen from above the support.
    struct Edge {
        std::uint8_t from = 0;
        std::uint8_t to = 0;
        std::uint8_t line = 0;
        bool above = false;
    };

    /// False when there are too many lines or vertices. \pre fragments of one facet.
    [[nodiscard]] bool join(std::span<const PolygonRef> group);

    [[nodiscard]] std::span<const PlaneName> lines() const { return {lines_.data(), line_count_}; }
    /// What is left, in no order.
    [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
    /// The lines that meet in a vertex.
    [[nodiscard]] const std::array<std::uint8_t, 2>& lines_of(std::uint8_t vertex) const {
        return vertices_[vertex].lines;
    }
    [[nodiscard]] const Approximation& approximation(std::uint8_t vertex) const {
        return *vertices_[vertex].at;
    }
    /// One of the edges that begin at a vertex of edges().
    [[nodiscard]] std::size_t first_edge(std::uint8_t vertex) const {
        return vertices_[vertex].first_edge;
    }

private:
    static constexpr std::uint8_t none = 255;
    struct Vertex {
        std::array<std::uint8_t, 2> lines{};
        std::uint8_t first_edge = none;
        const Approximation* at = nullptr;
    };
    [[nodiscard]] std::uint8_t line(const PlaneName& name);
    [[nodiscard]] std::uint8_t vertex(std::uint8_t p, std::uint8_t q, const Approximation& at);
    void cancel_on(std::uint8_t line);
    [[nodiscard]] bool sort_vertices_on(std::uint8_t line);

    std::array<PlaneName, max_lines> lines_;
    std::size_t line_count_ = 0;
    std::array<Vertex, max_vertices> vertices_;
    std::size_t vertex_count_ = 0;
    std::vector<Edge> all_;  // of all fragments
    std::vector<Edge> edges_;
    std::vector<std::uint8_t> on_line_;  // vertices in their order
    std::vector<int> cover_;             // edges up less edges down, from each to the next
};

}  // namespace trisect::detail
