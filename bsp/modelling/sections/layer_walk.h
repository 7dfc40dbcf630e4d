// SPDX-License-Identifier: Apache-2.0
//
// LayerWalk: the slice of a plane, by a walk from triangle to triangle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/bsp/flat/loop_sweep.h>
#include <trisect/bsp/modelling/sections/corner_rows.h>
#include <trisect/bsp/modelling/sections/mesh_section.h>
#include <trisect/bsp/modelling/sections/section_edges.h>
#include <trisect/bsp/modelling/sections/section_numbers.h>
#include <trisect/bsp/modelling/slices.h>

namespace trisect::detail {

/// What came of a walk. Only loops that are proved to be the slice count as such.
enum class LayerOutcome : std::uint8_t {
    Found,
    Faces,      ///< a face in the plane, which takes the sections on both sides of it
    Touching,   ///< a corner with several sides that come and go
    Collapsed,  ///< corners or loops that are none after rounding
    Crossing    ///< sides that are not shown apart, or loops around loops of their own direction
};

/// Finds what section_prism() finds, corner by corner, where the loops of a layer, with rounded
/// corners, are simple and do not touch each other. For one thread; keeps its memory.
class LayerWalk {
public:
    /// Refers to both. O(n)
    LayerWalk(const MeshSection& mesh, const SectionEdges& edges);

    /// The slice, where the outcome is Found. O(k log k) for k triangles of the plane.
    LayerOutcome run(const SectionPlane& plane, SliceRule rule, EvaluateOptions::Winding winding,
                     Slice& out);

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    enum class Exactness : std::uint8_t { Exact, Rounded, Unknown };
    /// Where the walk goes on: nodes are edges, and then corners of the mesh in the plane.
    struct Link {
        std::uint32_t layer = 0;  // the last one that came here
        std::uint32_t to = 0;
        std::uint32_t side = 0;  // by order of triangles
    };
    struct Corner {
        std::uint32_t node = 0;
        std::uint32_t side = 0;  // that leaves it
        Exactness exactness = Exactness::Unknown;
    };

    [[nodiscard]] LayerOutcome link_sides(const SectionPlane& plane, SliceRule rule);
    [[nodiscard]] bool link(std::uint32_t from, std::uint32_t to);
    [[nodiscard]] LayerOutcome find_loops();
    [[nodiscard]] bool is_straight(std::uint32_t node) const;
    void find_points(double height);
    void find_rows(double height);
    [[nodiscard]] bool is_in_rows(std::uint32_t node) const;
    [[nodiscard]] bool leave_out_straight(const SectionNumbers& numbers);
    [[nodiscard]] bool goes_straight(std::size_t before, std::size_t i, std::size_t after,
                                     const SectionNumbers& numbers) const;
    [[nodiscard]] bool has_equal_neighbours() const;
    void put_in_order();
    [[nodiscard]] bool are_exact(const SectionNumbers& numbers) const;
    [[nodiscard]] bool find_regions(EvaluateOptions::Winding winding, Slice& out);
    void write(Slice& out) const;

    [[nodiscard]] bool is_edge(std::uint32_t node) const { return node < edges_.count(); }
    [[nodiscard]] SectionNumbers::Name name(std::uint32_t node) const;
    [[nodiscard]] std::size_t loop_count() const { return begin_.size() - 1; }

    const MeshSection& mesh_;
    const SectionEdges& edges_;
    bool takes_rows_ = false;  // the frame is an axis's, and no corner is too large
    bool are_all_doubles_ = true;
    std::uint32_t layer_ = 0;
    std::vector<Link> links_;
    std::vector<std::uint32_t> from_;  // by side: the node
    std::vector<Corner> corners_;      // loop by loop
    std::vector<Point2d> points_;
    std::vector<std::uint32_t> begin_;  // by loop, and the end
    CornerRows rows_;
    LoopSweep sweep_;
    // Loops from the corner after that whose side is the first one, in the order of these sides.
    struct Start {
        std::uint32_t side = 0;
        std::uint32_t loop = 0;
        std::uint32_t corner = 0;
    };
    std::vector<Start> starts_;
    std::vector<Point2d> ordered_;
    std::vector<std::uint32_t> ordered_begin_;
    std::vector<int> left_;  // winding numbers by loop
    std::vector<std::uint32_t> region_;
};

}  // namespace trisect::detail
