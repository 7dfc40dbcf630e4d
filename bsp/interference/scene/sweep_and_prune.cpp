// SPDX-License-Identifier: Apache-2.0
//
// Sweep and prune (Cohen, Lin, Manocha and Ponamgi, I-COLLIDE, 1995; Baraff 1992). All pairs of n
// boxes are n²/2 tests. But boxes that meet also meet along any axis, and in the order of their
// lower ends those that meet one box along the axis follow it without a gap. Between two frames the
// order hardly changes, so the order of the last frame is sorted by insertion, which costs as many
// steps as there are neighbours that changed places.
//
// I-COLLIDE keeps all three axes in order and counts along how many of them two boxes meet. We keep
// one, along which the centres are spread most, and compare the other two coordinates on the spot:
// there is no table of pairs to keep right, the answer cannot depend on history, and a frame in
// which everything jumps costs no more than a sort. Where the scene turns, the axis changes; that
// costs one sort too.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include <trisect/bsp/interference/boxes/broad_phase.h>

namespace trisect::detail {
namespace {

/// How much wider the spread along another axis must be for the order to be made anew.
constexpr double worth_a_sort = 1.5;

class SweepAndPrune final : public BroadPhase {
public:
    void insert(std::uint32_t slot, const BodyBox& box) override {
        if (slot >= entry_of_.size()) entry_of_.resize(std::size_t{slot} + 1, none);
        entry_of_[slot] = static_cast<std::uint32_t>(entries_.size());
        entries_.push_back({box, slot});
        ++inserted_;
    }

    void update(std::uint32_t slot, const BodyBox& box) override {
        entries_[entry_of_[slot]].box = box;
    }

    void remove(std::uint32_t slot) override {
        // Its entry is taken out at the next sort, with all others that left.
        entries_[entry_of_[slot]].slot = none;
        entry_of_[slot] = none;
    }

    void pairs(std::vector<BodyPair>& out) override {
        counts_ = {};
        out.clear();
        std::erase_if(entries_, [](const Entry& e) { return e.slot == none; });
        sort_entries();
        sweep(out);
        std::sort(out.begin(), out.end());
    }

    [[nodiscard]] std::size_t bytes() const override {
        return entries_.size() * sizeof(Entry) + entry_of_.size() * sizeof(entry_of_[0]);
    }

private:
    struct Entry {
        BodyBox box;
        std::uint32_t slot = 0;
    };

    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// Ties by slot, so that there is one order.
    [[nodiscard]] bool comes_before(const Entry& a, const Entry& b) const {
        return a.box.lo[axis_] != b.box.lo[axis_] ? a.box.lo[axis_] < b.box.lo[axis_]
                                                  : a.slot < b.slot;
    }

    [[nodiscard]] std::array<double, 3> spread() const {
        std::array<double, 3> mean{};
        std::array<double, 3> variance{};
        const auto n = static_cast<double>(std::max<std::size_t>(1, entries_.size()));
        for (const Entry& e : entries_)
            for (std::size_t k = 0; k < 3; ++k) mean[k] += (e.box.lo[k] + e.box.hi[k]) / n;
        for (const Entry& e : entries_) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double d = e.box.lo[k] + e.box.hi[k] - mean[k];
                variance[k] += d * d / n;
            }
        }
        return variance;
    }

    void sort_entries() {
        const auto before = [this](const Entry& a, const Entry& b) { return comes_before(a, b); };
        const std::array<double, 3> variance = spread();
        const auto widest = static_cast<std::size_t>(
            std::max_element(variance.begin(), variance.end()) - variance.begin());
        const bool turns = variance[widest] > worth_a_sort * worth_a_sort * variance[axis_];
        if (turns) axis_ = widest;
        // Many new ones at the end would each be carried through half of the list.
        if (turns || inserted_ > entries_.size() / 16 || !sort_by_insertion()) {
            std::sort(entries_.begin(), entries_.end(), before);
            counts_.moves = entries_.size();
        }
        inserted_ = 0;
        for (std::size_t i = 0; i < entries_.size(); ++i)
            entry_of_[entries_[i].slot] = static_cast<std::uint32_t>(i);
    }

    /// False, with the list in any order, when that takes longer than a sort would.
    [[nodiscard]] bool sort_by_insertion() {
        const std::size_t budget = 32 * entries_.size();
        std::size_t moves = 0;
        for (std::size_t i = 1; i < entries_.size(); ++i) {
            if (!comes_before(entries_[i], entries_[i - 1])) continue;
            const Entry e = entries_[i];
            std::size_t j = i;
            for (; j > 0 && comes_before(e, entries_[j - 1]); --j) entries_[j] = entries_[j - 1];
            entries_[j] = e;
            moves += i - j;
            if (moves > budget) return false;
        }
        counts_.moves = moves;
        return true;
    }

    void sweep(std::vector<BodyPair>& out) {
        const std::size_t u = (axis_ + 1) % 3;
        const std::size_t v = (axis_ + 2) % 3;
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            const Entry& a = entries_[i];
            std::size_t j = i + 1;
            for (; j < entries_.size() && entries_[j].box.lo[axis_] <= a.box.hi[axis_]; ++j) {
                const Entry& b = entries_[j];
                // Not short-circuited: which of them fails is random.
                const int meet = int{a.box.lo[u] <= b.box.hi[u]} & int{b.box.lo[u] <= a.box.hi[u]} &
                                 int{a.box.lo[v] <= b.box.hi[v]} & int{b.box.lo[v] <= a.box.hi[v]};
                if (meet != 0) out.push_back({std::min(a.slot, b.slot), std::max(a.slot, b.slot)});
            }
            counts_.box_tests += j - i - 1;
        }
    }

    std::vector<Entry> entries_;           // nearly in order
    std::vector<std::uint32_t> entry_of_;  // by slot
    std::size_t axis_ = 0;
    std::size_t inserted_ = 0;  // since the last sort
};

}  // namespace

std::unique_ptr<BroadPhase> make_sweep_and_prune() { return std::make_unique<SweepAndPrune>(); }

}  // namespace trisect::detail
