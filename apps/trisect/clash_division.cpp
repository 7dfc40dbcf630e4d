// SPDX-License-Identifier: Apache-2.0
#include "clash_division.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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

double highest(LoadItems items, std::size_t axis) {
    double out = items.front().middle[axis];
    for (const ClashLoads::Item& item : items) out = std::max(out, item.middle[axis]);
    return out;
}

double lowest(LoadItems items, std::size_t axis) {
    double out = items.front().middle[axis];
    for (const ClashLoads::Item& item : items) out = std::min(out, item.middle[axis]);
    return out;
}

bool are_in_order(const ClashLoads::Item& a, const ClashLoads::Item& b, std::size_t axis) {
    if (a.middle[axis] != b.middle[axis]) return a.middle[axis] < b.middle[axis];
    return a.number < b.number;
}

// How many of the lowest along an axis have half the load; the next one, if there is one, comes to
// its place in the order.
std::size_t half_of_load(LoadItems items, std::size_t axis) {
    const double half = load_of(items) / 2;
    const auto in_order = [axis](const ClashLoads::Item& a, const ClashLoads::Item& b) {
        return are_in_order(a, b, axis);
    };
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    double before = 0;  // of those below `lo`, which is less than half
    std::size_t lo = 0;
    std::size_t hi = items.size();
    while (hi - lo > 1) {
        const std::size_t mid = lo + (hi - lo) / 2;
        std::nth_element(at(lo), at(mid), at(hi), in_order);
        const double with = before + load_of(items.subspan(lo, mid - lo));
        // Most loads are the same, and then the one in the middle is it.
        if (with == half) return mid;
        if (with > half) {
            hi = mid;
            continue;
        }
        if (with + items[mid].load >= half) {
            if (mid + 1 < hi)
                std::iter_swap(at(mid + 1), std::min_element(at(mid + 1), at(hi), in_order));
            return mid + 1;
        }
        before = with;
        lo = mid;
    }
    return hi;
}

// Puts the lower half of the load along an axis first and returns how many that are; none where
// all are in one place, and then they are in order. Those in one plane across it stay together.
std::size_t halved(LoadItems items, std::size_t axis) {
    const std::size_t at = half_of_load(items, axis);
    const double value = items[std::min(at, items.size() - 1)].middle[axis];
    const auto below = [&](const ClashLoads::Item& item) { return item.middle[axis] < value; };
    const auto not_above = [&](const ClashLoads::Item& item) { return item.middle[axis] <= value; };
    const auto count = [&](const auto& is_in) {
        return static_cast<std::size_t>(std::ranges::count_if(items, is_in));
    };
    const std::size_t fewer = count(below);
    const std::size_t more = count(not_above);
    if (fewer == 0 && more == items.size()) {
        std::ranges::sort(items, {}, &ClashLoads::Item::number);
        return 0;
    }
    // The nearer one of the two places between two that differ.
    const bool is_fewer = more == items.size() || (fewer != 0 && at - fewer <= more - at);
    if (is_fewer)
        std::partition(items.begin(), items.end(), below);
    else
        std::partition(items.begin(), items.end(), not_above);
    return is_fewer ? fewer : more;
}

constexpr std::size_t most_neighbours = 8 * samples_of_a_neighbourhood;

// Boxes of a neighbourhood in numbers of half the size, rounded outwards and grown by what
// clearances need: those that are apart so are no candidates.
class NearBoxes {
public:
    void add(const Bounds& box, double most) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k][size_] = -above(-box.lo[k]);
            hi_[k][size_] = above(next_above(box.hi[k] + most));
        }
        ++size_;
    }
    void clear() { size_ = 0; }
    /// Calls visit(i, j) for those that are not apart, j < i.
    template <class Visit>
    void for_each_pair(const Visit& visit) {
        for (std::size_t i = 1; i < size_; ++i) {
            look_at(i);
            for (std::size_t j = 0; j < i; ++j)
                if (is_near_[j] != 0) visit(i, j);
        }
    }

private:
    using Numbers = std::array<float, most_neighbours>;

    // Not less, in the nearest ones.
    [[nodiscard]] static float above(double v) {
        const auto near = static_cast<float>(v);
        return static_cast<double>(near) < v
                   ? std::nextafter(near, std::numeric_limits<float>::infinity())
                   : near;
    }
    // No branch: several at a time.
    void look_at(std::size_t i) {
        const std::array<float, 3> lo{lo_[0][i], lo_[1][i], lo_[2][i]};
        const std::array<float, 3> hi{hi_[0][i], hi_[1][i], hi_[2][i]};
        for (std::size_t j = 0; j < i; ++j)
            is_near_[j] = static_cast<std::int32_t>(lo_[0][j] <= hi[0]) &
                          static_cast<std::int32_t>(lo[0] <= hi_[0][j]) &
                          static_cast<std::int32_t>(lo_[1][j] <= hi[1]) &
                          static_cast<std::int32_t>(lo[1] <= hi_[1][j]) &
                          static_cast<std::int32_t>(lo_[2][j] <= hi[2]) &
                          static_cast<std::int32_t>(lo[2] <= hi_[2][j]);
    }

    std::array<Numbers, 3> lo_{};
    std::array<Numbers, 3> hi_{};
    std::array<std::int32_t, most_neighbours> is_near_{};
    std::size_t size_ = 0;
};

// Counts candidates among neighbours; those of different neighbourhoods are not seen, which makes
// the estimate smaller by about as much everywhere.
class LoadEstimate {
public:
    LoadEstimate(std::span<const ClashBox> sample, double each, const ClashLimits& limits)
        : sample_(sample), each_(each), limits_(limits) {}

    void add(LoadItems items) {
        if (items.size() > samples_of_a_neighbourhood) {
            const std::size_t lower = halved(items, widest_axis(items));
            if (lower != 0) {
                add(items.first(lower));
                return add(items.subspan(lower));
            }
        }
        const std::size_t n = std::min(items.size(), most_neighbours);
        near_.clear();
        for (const ClashLoads::Item& item : items.first(n))
            near_.add(sample_[item.number].box, limits_.most());
        near_.for_each_pair([&](std::size_t i, std::size_t j) {
            if (!is_candidate(limits_, sample_[items[i].number], sample_[items[j].number])) return;
            items[i].load += cost_of_a_pair / 2 * each_;
            items[j].load += cost_of_a_pair / 2 * each_;
        });
        // Many in one place, where some stand for all.
        for (std::size_t i = n; i < items.size(); ++i)
            items[i].load =
                items[i % n].load * static_cast<double>(items.size()) / static_cast<double>(n);
    }

private:
    std::span<const ClashBox> sample_;
    double each_;
    const ClashLimits& limits_;
    NearBoxes near_;
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
        node.value = highest(items.first(lower), axis) / 2 + lowest(items.subspan(lower), axis) / 2;
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
