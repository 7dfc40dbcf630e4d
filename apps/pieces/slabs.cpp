// SPDX-License-Identifier: Apache-2.0
#include "slabs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect::app {

namespace {

constexpr std::size_t most_slabs = 4096;
// Of the largest coordinate.
constexpr int quantum_bits = 30;

/// All samples along one axis, each with the triangles that it stands for.
struct AxisSample {
    struct Item {
        double low;
        double high;
        std::uint64_t weight;
    };
    std::vector<Item> items;  // by their middles
    std::uint64_t total = 0;

    AxisSample(const std::vector<Survey>& operands, std::size_t axis) {
        for (const Survey& s : operands)
            for (const Survey::Reach& r : s.sample) {
                items.push_back({r.low[axis], r.high[axis], s.step});
                total += items.back().weight;
            }
        std::ranges::sort(items, {}, [](const Item& i) { return i.low / 2 + i.high / 2; });
    }
    /// Of all slabs.
    [[nodiscard]] std::vector<std::uint64_t> loads(const Slabs& slabs) const {
        std::vector<std::uint64_t> out(slabs.count());
        for (const Item& i : items) {
            const auto range = slabs.slabs_at(i.low, i.high);
            for (std::size_t s = range[0]; s < range[1]; ++s) out[s] += i.weight;
        }
        return out;
    }
    /// Walls that give slabs of about one load, by the middles of triangles.
    [[nodiscard]] std::vector<double> walls(std::size_t slabs, double quantum) const {
        std::vector<double> out;
        std::uint64_t sum = 0;
        for (const Item& i : items) {
            if (out.size() + 1 >= slabs) break;
            sum += i.weight;
            if (sum * slabs < total * (out.size() + 1)) continue;
            const double at = i.low / 2 + i.high / 2;
            const double wall = (2 * std::floor(at / (2 * quantum)) + 1) * quantum;
            if (out.empty() || wall - out.back() > 64 * quantum) out.push_back(wall);
        }
        return out;
    }
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
