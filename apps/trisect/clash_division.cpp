// SPDX-License-Identifier: Apache-2.0
#include "clash_division.h"

#include <algorithm>
#include <numeric>

namespace trisect::app {
namespace {

// What a candidate costs beside a box: an exact answer, against some comparisons.
constexpr double cost_of_a_pair = 16;
constexpr std::size_t samples_of_a_neighbourhood = 64;

using LoadItems = std::span<ClashLoads::Item>;

double load_of(LoadItems items) {
    return std::accumulate(
        items.begin(), items.end(), 0.0,
        [](double sum, const ClashLoads::Item& item) { return sum + item.load; });
}

std::size_t widest_axis(LoadItems items) {
    std::array<double, 3> lo = items.front().middle;
    std::array<double, 3> hi = lo;
    for (const ClashLoads::Item& s : items)
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], s.middle[k]);
            hi[k] = std::max(hi[k], s.middle[k]);
        }
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (hi[k] - lo[k] > hi[best] - lo[best]) best = k;
    return best;
}

// Sorts them along an axis and returns how many are in the lower half of the load; none where all
// are in one place.
std::size_t halved(LoadItems items, std::size_t axis) {
    std::ranges::sort(items, [axis](const ClashLoads::Item& a, const ClashLoads::Item& b) {
        if (a.middle[axis] != b.middle[axis]) return a.middle[axis] < b.middle[axis];
        return a.number < b.number;
    });
    const double all = load_of(items);
    const auto differ = [&](std::size_t i) {
        return items[i - 1].middle[axis] < items[i].middle[axis];
    };
    std::size_t at = 0;
    for (double sum = 0; at < items.size() && sum < all / 2; ++at) sum += items[at].load;
    // The nearest place between two that differ.
    for (std::size_t step = 0; step < items.size(); ++step) {
        if (at >= 1 + step && at - step < items.size() && differ(at - step)) return at - step;
        if (at + step >= 1 && at + step < items.size() && differ(at + step)) return at + step;
    }
    return 0;
}

// Counts candidates among neighbours; those of different neighbourhoods are not seen, which makes
// the estimate smaller by about as much everywhere.
class LoadEstimate {
public:
    LoadEstimate(std::span<const ClashBox> sample, double each, const ClashLimits& limits)
        : sample_(sample), each_(each), limits_(limits) {}

    void add(LoadItems items) const {
        if (items.size() > samples_of_a_neighbourhood) {
            const std::size_t lower = halved(items, widest_axis(items));
            if (lower != 0) {
                add(items.first(lower));
                return add(items.subspan(lower));
            }
        }
        const std::size_t n = std::min(items.size(), 8 * samples_of_a_neighbourhood);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (is_candidate(limits_, sample_[items[i].number], sample_[items[j].number])) {
                    items[i].load += cost_of_a_pair / 2 * each_;
                    items[j].load += cost_of_a_pair / 2 * each_;
                }
        // Many in one place, where some stand for all.
        for (std::size_t i = n; i < items.size(); ++i)
            items[i].load =
                items[i % n].load * static_cast<double>(items.size()) / static_cast<double>(n);
    }

private:
    std::span<const ClashBox> sample_;
    double each_;
    const ClashLimits& limits_;
};

}  // namespace

Bounds unbounded_space() {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    return {{-unbounded, -unbounded, -unbounded}, {unbounded, unbounded, unbounded}};
}

ClashLoads::ClashLoads(std::span<const ClashBox> sample, double each, const ClashLimits& limits)
    : items_(sample.size()), each_(each) {
    for (std::uint32_t i = 0; i < sample.size(); ++i) {
        items_[i].number = i;
        for (std::size_t k = 0; k < 3; ++k)
            items_[i].middle[k] = sample[i].box.lo[k] / 2 + sample[i].box.hi[k] / 2;
    }
    if (!items_.empty()) LoadEstimate(sample, each, limits).add(items_);
    all_ = each_ * load_of(items_);
}

class ClashDivision::Builder {
public:
    Builder(ClashDivision& division, double most) : division_(division), most_(most) {}

    std::uint32_t build(LoadItems items, const Bounds& cell) {
        const auto number = static_cast<std::uint32_t>(division_.nodes_.size());
        division_.nodes_.emplace_back();
        const std::size_t axis = items.empty() ? 0 : widest_axis(items);
        const bool is_large = items.size() > 1 && load_of(items) > most_;
        const std::size_t lower = is_large ? halved(items, axis) : 0;
        if (lower == 0) {
            division_.nodes_[number].below = static_cast<std::uint32_t>(division_.cells_.size());
            division_.cells_.push_back(cell);
            return number;
        }
        Node node;
        node.axis = static_cast<std::uint32_t>(axis);
        // Not at the middle of a box: many have theirs in one plane.
        node.value = items[lower - 1].middle[axis] / 2 + items[lower].middle[axis] / 2;
        Bounds half = cell;
        half.hi[axis] = node.value;
        node.below = build(items.first(lower), half);
        half = cell;
        half.lo[axis] = node.value;
        node.above = build(items.subspan(lower), half);
        division_.nodes_[number] = node;
        return number;
    }

private:
    ClashDivision& division_;
    double most_;
};

ClashDivision::ClashDivision(ClashLoads loads, const Bounds& space, double most) {
    Builder(*this, most / loads.each()).build(loads.items(), space);
}

}  // namespace trisect::app
