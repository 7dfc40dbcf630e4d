// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/flat/flat_outline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/flat/flat_walk.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

using Index = std::uint32_t;
constexpr Index none = FlatRegion::none;

/// Half-edges with the inside on the left of alone, linked to loops.
class LoopMaker {
public:
    LoopMaker(const FlatArrangement& arrangement, const FlatWalk& walk,
              std::span<const std::uint8_t> sides)
        : arrangement_(arrangement),
          walk_(walk),
          sides_(sides),
          next_(2 * sides.size(), none),
          lines_(arrangement.figure().lines.size(), none),
          vertices_(arrangement.figure().vertices.size(), none) {}

    FlatRegion run() {
        for (std::size_t e = 0; e < sides_.size(); ++e)
            if (is_boundary(static_cast<Index>(e))) link(half_of(static_cast<Index>(e)));
        out_.loop_begin.push_back(0);
        for (std::size_t e = 0; e < sides_.size(); ++e) {
            const Index half = half_of(static_cast<Index>(e));
            if (is_boundary(static_cast<Index>(e)) && next_[half] != none) make_loop(half);
        }
        name_crossings();
        out_.is_resolved = true;
        return std::move(out_);
    }

private:
    [[nodiscard]] bool is_boundary(Index e) const { return sides_[e] == 1 || sides_[e] == 2; }
    [[nodiscard]] Index half_of(Index e) const { return 2 * e + (sides_[e] == 1 ? 0 : 1); }
    [[nodiscard]] Index line_of(Index half) const { return arrangement_.edges()[half / 2].line; }

    // The interior is from the half-edge that leaves to the one that comes, counter-clockwise: the
    // next one is the first to leave clockwise from what comes.
    void link(Index half) {
        const Index back = half ^ 1U;
        const auto around = walk_.around(walk_.target(half));
        std::size_t i = static_cast<std::size_t>(std::find(around.begin(), around.end(), back) -
                                                 around.begin());
        do {
            i = i == 0 ? around.size() - 1 : i - 1;
        } while (!is_boundary(around[i] / 2));
        TRISECT_EXPECTS(half_of(around[i] / 2) == around[i], "an outline goes on at its vertices");
        next_[half] = around[i];
    }

    // Whether nothing else is at the end of a half-edge, and the next one goes straight on.
    [[nodiscard]] bool goes_straight_on(Index half, Index next) const {
        if (arrangement_.figure().cross(line_of(half), line_of(next)) != 0) return false;
        int boundaries = 0;
        for (const Index h : walk_.around(walk_.target(half)))
            boundaries += is_boundary(h / 2) ? 1 : 0;
        return boundaries == 2;
    }

    void make_loop(Index first) {
        loop_.clear();
        for (Index h = first; next_[h] != none;) {
            loop_.push_back(h);
            h = std::exchange(next_[h], none);
        }
        const std::size_t n = loop_.size();
        ends_.assign(n, false);
        std::size_t start = n;
        for (std::size_t i = 0; i < n; ++i) {
            ends_[i] = !goes_straight_on(loop_[i], loop_[(i + 1) % n]);
            if (ends_[i] && start == n) start = i;
        }
        TRISECT_EXPECTS(start < n, "an outline has corners");
        Index from = walk_.target(loop_[start]);
        for (std::size_t k = 1; k <= n; ++k) {
            const std::size_t i = (start + k) % n;
            if (!ends_[i]) continue;
            const Index to = walk_.target(loop_[i]);
            out_.segments.push_back(
                {vertex(from), vertex(to), line(line_of(loop_[i])), walk_.runs_along(loop_[i])});
            from = to;
        }
        out_.loop_begin.push_back(static_cast<Index>(out_.segments.size()));
    }

    Index line(Index l) {
        if (lines_[l] == none) {
            lines_[l] = static_cast<Index>(out_.lines.size());
            out_.lines.push_back(arrangement_.figure().lines[l]);
            used_.push_back(l);
        }
        return lines_[l];
    }
    Index vertex(Index v) {
        if (vertices_[v] == none) {
            vertices_[v] = static_cast<Index>(out_.vertices.size());
            const FlatRegion::Vertex& at = arrangement_.figure().vertices[v];
            out_.vertices.push_back({at.u, at.v, at.error});
            out_.largest = std::max({out_.largest, std::fabs(at.u), std::fabs(at.v)});
        }
        return vertices_[v];
    }

    // Two segments that end there and are on two lines.
    void name_crossings() {
        for (std::size_t s = 0; s < out_.segments.size(); ++s)
            for (const Index v : {out_.segments[s].from, out_.segments[s].to}) {
                const Index line = out_.segments[s].line;
                FlatRegion::Vertex& at = out_.vertices[v];
                if (at.error == 0) continue;
                if (at.lines[0] == none) {
                    at.lines[0] = line;
                } else if (at.lines[1] == none &&
                           arrangement_.figure().cross(used_[at.lines[0]], used_[line]) != 0) {
                    at.lines[1] = line;
                    const Approximation better =
                        flat_approximation(out_.lines[at.lines[0]], out_.lines[line]);
                    if (better.error < at.error) {
                        at.u = better.c[0];
                        at.v = better.c[1];
                        at.error = std::max(better.error, 0x1p-300);
                    }
                }
            }
        for (const FlatRegion::Vertex& v : out_.vertices)
            TRISECT_EXPECTS(v.error == 0 || v.lines[1] != none, "a crossing of two lines");
    }

    const FlatArrangement& arrangement_;
    const FlatWalk& walk_;
    std::span<const std::uint8_t> sides_;
    std::vector<Index> next_;
    std::vector<Index> lines_;     // numbers in the result
    std::vector<Index> vertices_;  // the same
    std::vector<Index> used_;      // lines of the result
    std::vector<Index> loop_;
    std::vector<bool> ends_;
    FlatRegion out_;
};

}  // namespace

FlatRegion flat_outline(const FlatArrangement& arrangement, std::span<const std::int32_t> slots,
                        const Residual& formula, const EvaluateSettings& settings) {
    std::vector<LeafOperand> operands(arrangement.operand_count());
    for (std::size_t i = 0; i < operands.size(); ++i) operands[i].slot = slots[i];
    EvaluateSettings positive = settings;
    positive.winding = EvaluateOptions::Winding::Positive;
    LeafFormula values;
    values.start({Cell{}, FinePoint{}, operands, &formula, &positive, false});
    FlatWalk walk(arrangement, values);
    std::vector<std::uint8_t> sides(arrangement.edges().size(), 0);
    walk.find_sides(sides);
    return LoopMaker(arrangement, walk, sides).run();
}

FlatRegion resolved_region(const FlatRegion& region) {
    FlatArrangement arrangement;
    arrangement.add(region, 0);
    arrangement.divide();
    constexpr std::array<std::int32_t, 1> only{0};
    FlatRegion out = flat_outline(arrangement, only, *Residual::of_slot(0), EvaluateSettings());
    out.lattice = region.lattice;
    out.cap_names = region.cap_names;
    return out;
}

}  // namespace trisect::detail
