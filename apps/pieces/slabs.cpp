// SPDX-License-Identifier: Apache-2.0
#include "slabs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect::app {

namespace {

constexpr std::size_t most_slabs = 4096;
// Of the largest coordinate.
constexpr int quantum_bits = 30;

/// All samples along one axis, each with the triangles that it stands for.
class AxisSample {
public:
    AxisSample(const std::vector<Survey>& operands, std::size_t axis) {
        for (const Survey& s : operands)
            for (const Survey::Reach& r : s.sample) {
                items_.push_back({r.low[axis], r.high[axis], s.step});
                total_ += s.step;
            }
        sort_roughly();
    }
    /// Of all slabs.
    [[nodiscard]] std::vector<std::uint64_t> loads(const Slabs& slabs) const {
        std::vector<std::uint64_t> out(slabs.count());
        for (const Item& i : items_) {
            const auto range = slabs.slabs_at(i.low, i.high);
            for (std::size_t s = range[0]; s < range[1]; ++s) out[s] += i.weight;
        }
        return out;
    }
    /// Walls that give slabs of about one load, by the middles of triangles.
    [[nodiscard]] std::vector<double> walls(std::size_t slabs, double quantum) {
        std::vector<double> out;
        std::uint64_t sum = 0;
        for (Part& part : parts_) {
            if (out.size() + 1 >= slabs) break;
            // No wall would be in it.
            if ((sum + part.weight) * slabs < total_ * (out.size() + 1)) {
                sum += part.weight;
                continue;
            }
            sort(part);
            for (std::size_t k = part.begin; k < part.end && out.size() + 1 < slabs; ++k) {
                sum += items_[k].weight;
                if (sum * slabs < total_ * (out.size() + 1)) continue;
                const double wall =
                    (2 * std::floor(items_[k].middle() / (2 * quantum)) + 1) * quantum;
                if (out.empty() || wall - out.back() > 64 * quantum) out.push_back(wall);
            }
        }
        return out;
    }

private:
    struct Item {
        double low;
        double high;
        std::uint64_t weight;
        [[nodiscard]] double middle() const { return low / 2 + high / 2; }
    };
    /// Items that lie together in the order of their middles.
    struct Part {
        std::size_t begin = 0;
        std::size_t end = 0;
        std::uint64_t weight = 0;
        bool is_sorted = false;
    };

    // Into equal parts of the axis: walls are in few of them, and only these are sorted.
    void sort_roughly() {
        if (items_.empty()) return;
        const auto [low, high] = std::ranges::minmax(items_, {}, &Item::middle);
        const double from = low.middle();
        const double size = high.middle() - from;
        const std::size_t count = 1 + items_.size() / items_of_a_part;
        // Never decreases with the middle, whatever is rounded.
        const auto part_of = [&](const Item& i) {
            const double place = (i.middle() - from) / size * static_cast<double>(count);
            return place > 0 ? std::min(static_cast<std::size_t>(place), count - 1) : 0;
        };
        parts_.resize(count);
        for (const Item& i : items_) {
            Part& part = parts_[part_of(i)];
            ++part.end;
            part.weight += i.weight;
        }
        std::size_t begin = 0;
        for (Part& part : parts_) {
            part.begin = begin;
            begin += std::exchange(part.end, begin);
        }
        std::vector<Item> sorted(items_.size());
        for (const Item& i : items_) sorted[parts_[part_of(i)].end++] = i;
        items_ = std::move(sorted);
    }
    void sort(Part& part) {
        if (std::exchange(part.is_sorted, true)) return;
        const auto at = [&](std::size_t k) {
            return items_.begin() + static_cast<std::ptrdiff_t>(k);
        };
        std::ranges::sort(at(part.begin), at(part.end), {}, &Item::middle);
    }

    static constexpr std::size_t items_of_a_part = 64;
    std::vector<Item> items_;
    std::vector<Part> parts_;
    std::uint64_t total_ = 0;
};

}  // namespace

Slabs Slabs::of(const std::vector<Survey>& operands, std::uint64_t most, std::uint64_t least) {
    Slabs best;
    Slabs chosen;
    double largest = 0;
    std::uint64_t triangles = 0;
    for (const Survey& s : operands) {
        triangles += s.triangles;
        for (std::size_t k = 0; k < 3; ++k)
            largest = std::max({largest, std::fabs(s.low[k]), std::fabs(s.high[k])});
    }
    const int magnitude = largest > 0 ? std::ilogb(largest) : 0;
    best.bound_ = std::ldexp(1.0, magnitude + 2);
    best.quantum_ = std::ldexp(1.0, magnitude - quantum_bits);
    std::vector<AxisSample> samples;
    for (std::size_t k = 0; k < 3; ++k) samples.emplace_back(operands, k);
    const std::uint64_t first = std::max(least, triangles / most + 1);
    for (std::size_t n = first; n <= most_slabs; n += 1 + n / 8) {
        std::uint64_t smallest = std::numeric_limits<std::uint64_t>::max();
        for (std::size_t k = 0; k < 3; ++k) {
            Slabs tried = best;
            tried.axis_ = k;
            tried.walls_ = samples[k].walls(n, best.quantum_);
            tried.loads_ = samples[k].loads(tried);
            const std::uint64_t load = *std::ranges::max_element(tried.loads_);
            if (load >= smallest) continue;
            smallest = load;
            chosen = std::move(tried);
        }
        if (smallest <= most) return chosen;
    }
    throw LimitError("no " + std::to_string(most_slabs) + " slabs of space have at most " +
                     std::to_string(most) +
                     " triangles each: triangles are too long; allow more memory");
}

std::array<std::size_t, 2> Slabs::slabs_at(double low, double high) const {
    const auto first = std::ranges::lower_bound(walls_, low - margin());
    const auto last = std::ranges::upper_bound(walls_, high + margin());
    return {static_cast<std::size_t>(first - walls_.begin()),
            static_cast<std::size_t>(last - walls_.begin()) + 1};
}

bool Slabs::has_wall_at(double x) const { return std::ranges::binary_search(walls_, x); }

void Slabs::move_walls() {
    for (double& w : walls_) w += 2 * quantum_;
}

}  // namespace trisect::app
