// SPDX-License-Identifier: Apache-2.0
#include "slabs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect::app {

namespace {

constexpr std::uint64_t sample_size = 200'000;
constexpr std::size_t most_slabs = 4096;
// Of the largest coordinate.
constexpr int quantum_bits = 30;

double volume_of(const Point3d& a, const Point3d& b, const Point3d& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Point3d difference_of(const Point3d& a, const Point3d& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Survey::Reach reach_of_corners(const Corners& c) {
    Survey::Reach r{c[0], c[0]};
    for (const Point3d& p : c)
        for (std::size_t k = 0; k < 3; ++k) {
            r.low[k] = std::min(r.low[k], p[k]);
            r.high[k] = std::max(r.high[k], p[k]);
        }
    return r;
}

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

Survey survey_of(const TriangleStream& stream, const std::string& name) {
    Survey out;
    out.triangles = stream.size();
    out.step = 1 + out.triangles / sample_size;
    Point3d origin{};
    stream.read(0, out.triangles, [&](std::uint64_t i, const Corners& c) {
        const Survey::Reach r = reach_of_corners(c);
        for (std::size_t k = 0; k < 3; ++k)
            if (!std::isfinite(r.low[k]) || !std::isfinite(r.high[k]) ||
                !std::isfinite(c[0][k] + c[1][k] + c[2][k]))
                throw Error(ErrorCode::InvalidSolid, name + ": triangle " + std::to_string(i) +
                                                         " has a coordinate that is not finite");
        if (i == 0) {
            origin = c[0];
            out.low = r.low;
            out.high = r.high;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            out.low[k] = std::min(out.low[k], r.low[k]);
            out.high[k] = std::max(out.high[k], r.high[k]);
        }
        out.volume += volume_of(difference_of(c[0], origin), difference_of(c[1], origin),
                                difference_of(c[2], origin));
        if (i % out.step == 0) out.sample.push_back(r);
    });
    return out;
}

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
