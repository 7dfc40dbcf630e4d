// SPDX-License-Identifier: Apache-2.0
//
// LoopTriangulator: exact triangulation of one polygon with lattice corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/face/short_ears.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// What kind of loop it was.
struct LoopShape {
    bool degenerate = false;  ///< all corners on one line: no triangles
    bool planar = true;
    bool simple = true;  ///< false: the triangles fold over each other in the projection
};

/// Most corners a loop may have: sums of that many products of differences fit into 128 bits.
inline constexpr std::size_t loop_corner_limit = std::size_t{1} << 17;

/// Holds scratch memory; use one per thread. The corners of a loop are indices into `points`.
class LoopTriangulator {
public:
    explicit LoopTriangulator(std::span<const LatticePoint> points) : points_(points) {}

    /// Appends the non-degenerate triangles to `out`, oriented like the loop.
    ///
    /// The triangles' boundaries add up to the loop's (degenerate triangles, whose boundary is
    /// nothing, left out). A simple planar loop gives triangles without overlap that use all its
    /// corners, also those in the middle of a side; a loop that touches itself (a hole joined by
    /// a bridge) as well. Cost: O(n) for a convex loop (halved, convex_cut.h) and where a
    /// fan does; O(n log n), typically, for other loops with many corners (short_ears.h), unless
    /// they cross themselves: then O(n r) for r reflex corners.
    /// \throw LimitError for too many corners or too much work.
    LoopShape triangulate(std::span<const std::uint32_t> loop,
                          std::vector<std::array<std::uint32_t, 3>>& out);

    /// Degenerate and planar as above, without cutting.
    [[nodiscard]] LoopShape shape(std::span<const std::uint32_t> loop) const;

private:
    void project(std::span<const std::uint32_t> loop);
    [[nodiscard]] bool is_strictly_convex() const;
    bool fan(std::span<const std::uint32_t> loop, std::size_t apex,
             std::vector<std::array<std::uint32_t, 3>>& out) const;
    bool cut_short_ears(std::span<const std::uint32_t> loop,
                        std::vector<std::array<std::uint32_t, 3>>& out);
    bool clip_ears(std::span<const std::uint32_t> loop,
                   std::vector<std::array<std::uint32_t, 3>>& out);
    bool is_clear(std::uint32_t ear, bool boundary_too);
    void clip(std::uint32_t ear, std::span<const std::uint32_t> loop,
              std::vector<std::array<std::uint32_t, 3>>& out);

    std::span<const LatticePoint> points_;
    std::vector<FlatCorner> flat_;
    ShortEars short_ears_;
    std::vector<std::uint32_t> prev_, next_;
    std::vector<std::uint32_t> reflex_;
    std::vector<bool> clipped_;
    std::uint64_t work_ = 0;
};

}  // namespace trisect::detail
