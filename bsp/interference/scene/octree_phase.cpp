// SPDX-License-Identifier: Apache-2.0
//
// In an octree whose boxes must lie within their cells, a small box that straddles the middle stays
// at the root and is compared with everything. A loose octree lets a box reach out of its cell by
// half the length of the cell on each side: it is in the cell of its centre, on the level whose
// cells are as long as it is, and only size decides how deep it is.
//
// Each box is then taken down from the root again, into those loose cells that it meets. A pair is
// kept at the box of the smaller number.
#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/packed_phase.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {
namespace {

using detail::BodyBox;
using detail::Vector3;
constexpr unsigned most_octree_levels = 21;

class OctreePhase final : public PackedPhase {
    struct Cell {
        Vector3 middle{};
        double half = 0;                       // of the cell; it reaches twice as far
        std::array<std::uint32_t, 8> child{};  // 0 where there is none
        std::uint32_t first = 0;               // boxes in it: a list through next_
    };
    static constexpr std::uint32_t end = 0;  // of lists: numbers are stored plus one

    void pack() override {
        cells_.clear();
        next_.assign(boxes().size(), end);
        cells_.push_back(root());
        for (std::uint32_t i = 0; i < boxes().size(); ++i) {
            Cell& cell = cells_[cell_for(boxes()[i])];
            next_[i] = cell.first;
            cell.first = i + 1;
        }
        counts_.cells = boxes().size();
    }

    [[nodiscard]] std::size_t cell_bytes() const override {
        return cells_.size() * sizeof(Cell) + next_.size() * sizeof(next_[0]);
    }

    [[nodiscard]] Cell root() const {
        BodyBox all{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
        for (const BodyBox& b : boxes()) {
            for (std::size_t k = 0; k < 3; ++k) {
                all.lo[k] = std::min(all.lo[k], b.lo[k]);
                all.hi[k] = std::max(all.hi[k], b.hi[k]);
            }
        }
        Cell r;
        if (boxes().empty()) return r;
        for (std::size_t k = 0; k < 3; ++k) {
            r.middle[k] = 0.5 * all.lo[k] + 0.5 * all.hi[k];
            r.half = std::max(r.half, all.hi[k] - all.lo[k]);
        }
        return r;
    }

    static Vector3 centre_of(const BodyBox& b) {
        return {0.5 * b.lo[0] + 0.5 * b.hi[0], 0.5 * b.lo[1] + 0.5 * b.hi[1],
                0.5 * b.lo[2] + 0.5 * b.hi[2]};
    }

    std::size_t cell_for(const BodyBox& box) {
        const Vector3 centre = centre_of(box);
        const double size = extent(box);
        std::uint32_t at = 0;
        for (unsigned level = 1; level < most_octree_levels; ++level) {
            // A child's cells are `half` long; a box that long reaches out by half of that. The
            // strict comparison leaves room for rounding, see `reach`.
            if (!(size < cells_[at].half * (1 - 0x1p-20))) break;
            std::size_t octant = 0;
            for (std::size_t k = 0; k < 3; ++k)
                octant |= static_cast<std::size_t>(centre[k] >= cells_[at].middle[k] ? 1 : 0) << k;
            if (cells_[at].child[octant] == 0) add_child(at, octant);
            at = cells_[at].child[octant];
        }
        return at;
    }

    void add_child(std::uint32_t parent, std::size_t octant) {
        Cell c;
        c.half = cells_[parent].half / 2;
        for (std::size_t k = 0; k < 3; ++k)
            c.middle[k] = cells_[parent].middle[k] + ((octant >> k & 1U) != 0 ? c.half : -c.half);
        cells_[parent].child[octant] = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back(c);
    }

    // Middles are sums of up to 21 rounded numbers; what they are off by is far below 2^-40 of the
    // largest coordinate or of the root's size.
    [[nodiscard]] bool may_reach(const Cell& c, const BodyBox& b) {
        ++counts_.lookups;
        bool meets = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const double reach = 2 * c.half + 0x1p-40 * (std::abs(c.middle[k]) + cells_[0].half);
            meets = meets && b.lo[k] <= c.middle[k] + reach && b.hi[k] >= c.middle[k] - reach;
        }
        return meets;
    }

    void find_pairs() override {
        for (std::uint32_t i = 0; i < boxes().size(); ++i) {
            stack_.assign(1, 0);
            while (!stack_.empty()) {
                const Cell& c = cells_[stack_.back()];
                stack_.pop_back();
                for (std::uint32_t j = c.first; j != end; j = next_[j - 1])
                    if (j - 1 > i) compare(i, j - 1);
                for (const std::uint32_t child : c.child)
                    if (child != 0 && may_reach(cells_[child], boxes()[i])) stack_.push_back(child);
            }
        }
    }

    std::vector<Cell> cells_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> stack_;
};

}  // namespace

std::unique_ptr<detail::BroadPhase> make_octree_phase() { return std::make_unique<OctreePhase>(); }

}  // namespace trisect::hierarchies
