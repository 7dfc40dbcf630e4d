// SPDX-License-Identifier: Apache-2.0
//
// A k-d tree over boxes has to say where a box is that a plane cuts. Here it is in the lists of
// both sides, and so in every leaf that it reaches into. That could go on without end for boxes
// larger than what separates them; so what cuts add to the lists is taken from a budget of three
// entries a box, the longest list is cut first, and where the budget ends leaves stay long. A giant
// that lies about everything costs an entry a leaf.
//
// A pair that shares several leaves is kept in the one that has the lower corner of what they
// share.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/packed_phase.h>

namespace trisect::hierarchies {
namespace {

using detail::BodyBox;

constexpr std::size_t leaf_size = 8;
constexpr unsigned most_kd_levels = 48;

class KdTreePhase final : public PackedPhase {
    struct Leaf {
        std::vector<std::uint32_t> list;
        // Half open: a point is in one leaf.
        std::array<double, 3> lo{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        std::array<double, 3> hi{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        unsigned level = 1;
    };
    struct Shorter {
        bool operator()(const Leaf& a, const Leaf& b) const {
            return a.list.size() < b.list.size();
        }
    };

    void pack() override {
        leaves_.clear();
        Leaf root;
        for (std::uint32_t i = 0; i < boxes().size(); ++i) root.list.push_back(i);
        std::vector<Leaf> open;
        open.push_back(std::move(root));
        std::size_t budget = 3 * boxes().size() + 64;
        while (!open.empty()) {
            std::pop_heap(open.begin(), open.end(), Shorter{});
            Leaf leaf = std::move(open.back());
            open.pop_back();
            Leaf low;
            Leaf high;
            if (leaf.list.size() <= leaf_size || leaf.level == most_kd_levels ||
                !cut(leaf, low, high, budget)) {
                counts_.cells += leaf.list.size();
                leaves_.push_back(std::move(leaf));
                continue;
            }
            for (Leaf* part : {&low, &high}) {
                open.push_back(std::move(*part));
                std::push_heap(open.begin(), open.end(), Shorter{});
            }
        }
    }

    [[nodiscard]] std::size_t cell_bytes() const override {
        std::size_t sum = leaves_.size() * sizeof(Leaf);
        for (const Leaf& leaf : leaves_) sum += leaf.list.size() * sizeof(leaf.list[0]);
        return sum;
    }

    /// At the median of centres along the axis where that separates most.
    bool cut(const Leaf& leaf, Leaf& low, Leaf& high, std::size_t& budget) const {
        const std::size_t n = leaf.list.size();
        std::vector<double> centres(n);
        std::size_t best = n;  // the longer of both lists
        std::size_t best_axis = 0;
        double best_at = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < n; ++i) {
                const BodyBox& b = boxes()[leaf.list[i]];
                centres[i] = 0.5 * b.lo[k] + 0.5 * b.hi[k];
            }
            const auto middle = centres.begin() + static_cast<std::ptrdiff_t>(n / 2);
            std::nth_element(centres.begin(), middle, centres.end());
            const double at = *middle;
            if (!(leaf.lo[k] < at && at < leaf.hi[k])) continue;
            std::size_t below = 0;
            std::size_t above = 0;
            for (const std::uint32_t i : leaf.list) {
                below += boxes()[i].lo[k] < at ? 1 : 0;
                above += boxes()[i].hi[k] >= at ? 1 : 0;
            }
            if (std::max(below, above) >= best || below + above - n > budget) continue;
            best = std::max(below, above);
            best_axis = k;
            best_at = at;
        }
        if (best == n) return false;
        for (Leaf* part : {&low, &high}) {
            part->lo = leaf.lo;
            part->hi = leaf.hi;
            part->level = leaf.level + 1;
        }
        low.hi[best_axis] = best_at;
        high.lo[best_axis] = best_at;
        for (const std::uint32_t i : leaf.list) {
            if (boxes()[i].lo[best_axis] < best_at) low.list.push_back(i);
            if (boxes()[i].hi[best_axis] >= best_at) high.list.push_back(i);
        }
        budget -= low.list.size() + high.list.size() - n;
        return true;
    }

    void find_pairs() override {
        for (const Leaf& leaf : leaves_) {
            const auto is_here = [&leaf](const std::array<double, 3>& p) {
                bool r = true;
                for (std::size_t k = 0; k < 3; ++k)
                    r = r && leaf.lo[k] <= p[k] && p[k] < leaf.hi[k];
                return r;
            };
            for (std::size_t i = 0; i < leaf.list.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    compare_in_cell(leaf.list[i], leaf.list[j], is_here);
        }
    }

    std::vector<Leaf> leaves_;
};

}  // namespace

std::unique_ptr<detail::BroadPhase> make_kd_tree_phase() { return std::make_unique<KdTreePhase>(); }

}  // namespace trisect::hierarchies
