// SPDX-License-Identifier: Apache-2.0
//
// Boxes are sorted along the axis on which they are shortest beside the whole, and each is compared
// with those that begin before it ends. One long part costs a pass over what lies beside it.
#include "clash_pairs.h"

#include <trisect/kernel/support/parallel_parts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trisect::app {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double below(double v) { return std::nextafter(v, -infinity); }
double above(double v) { return std::nextafter(v, infinity); }

// One coordinate of a box, a part of it, as the sweep needs them side by side.
struct SweptBox {
    double lo = 0;
    double hi = 0;
    std::uint32_t part = 0;
};

std::size_t sweep_axis(std::span<const std::optional<Bounds>> boxes) {
    std::array<double, 3> lo{infinity, infinity, infinity};
    std::array<double, 3> hi{-infinity, -infinity, -infinity};
    std::array<double, 3> sum{};
    for (const auto& box : boxes) {
        if (!box) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], box->lo[k]);
            hi[k] = std::max(hi[k], box->hi[k]);
            sum[k] += box->hi[k] - box->lo[k];
        }
    }
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (sum[k] * (hi[best] - lo[best]) < sum[best] * (hi[k] - lo[k])) best = k;
    return best;
}

// How near parts of a pair may be for a set to say something of them; nothing for pairs of no set.
class PairLimits {
public:
    explicit PairLimits(const ClashManifest& manifest)
        : groups_(manifest.groups.size()), limits_(groups_ * groups_, -1) {
        for (std::uint32_t g = 0; g < groups_; ++g)
            for (std::uint32_t h = 0; h < groups_; ++h)
                for (const ClashSet& set : manifest.sets)
                    if (set.has(g, h))
                        limits_[g * groups_ + h] =
                            std::max(limits_[g * groups_ + h], set.clearance);
        for (const double limit : limits_) most_ = std::max(most_, limit);
    }
    /// Below 0: no set has them.
    [[nodiscard]] double of(std::uint32_t g, std::uint32_t h) const {
        return limits_[g * groups_ + h];
    }
    [[nodiscard]] double most() const { return most_; }

private:
    std::size_t groups_;
    std::vector<double> limits_;
    double most_ = 0;
};

bool meet(const Bounds& a, const Bounds& b, double within) {
    for (std::size_t k = 0; k < 3; ++k)
        if (above(a.hi[k] + within) < b.lo[k] || above(b.hi[k] + within) < a.lo[k]) return false;
    return true;
}

}  // namespace

// Each product and sum is rounded by at most 2^-53 of its size.
Bounds posed_box(const Bounds& box, const std::array<double, 12>& pose) {
    Bounds out;
    for (std::size_t i = 0; i < 3; ++i) {
        double lo = pose[4 * i + 3];
        double hi = lo;
        double size = std::fabs(lo);
        for (std::size_t j = 0; j < 3; ++j) {
            const double p = pose[4 * i + j] * below(box.lo[j]);
            const double q = pose[4 * i + j] * above(box.hi[j]);
            lo += std::min(p, q);
            hi += std::max(p, q);
            size += std::max(std::fabs(p), std::fabs(q));
        }
        const double error = size * 0x1p-49;
        out.lo[i] = below(lo - error);
        out.hi[i] = above(hi + error);
    }
    return out;
}

std::vector<ClashCandidate> clash_candidates(const ClashManifest& manifest,
                                             std::span<const std::optional<Bounds>> boxes) {
    const PairLimits limits(manifest);
    const std::size_t axis = sweep_axis(boxes);
    std::vector<SweptBox> swept;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (boxes[i])
            swept.push_back({boxes[i]->lo[axis], above(boxes[i]->hi[axis] + limits.most()), i});
    std::ranges::sort(swept, [](const SweptBox& a, const SweptBox& b) {
        return a.lo != b.lo ? a.lo < b.lo : a.part < b.part;
    });
    const detail::ParallelParts parts(swept.size(), 0);
    std::vector<std::vector<ClashCandidate>> found(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t j = i + 1; j < swept.size() && swept[j].lo <= swept[i].hi; ++j) {
                const auto [a, b] = std::minmax(swept[i].part, swept[j].part);
                const double limit = limits.of(manifest.parts[a].group, manifest.parts[b].group);
                if (limit >= 0 && meet(*boxes[a], *boxes[b], limit)) found[part].push_back({a, b});
            }
    });
    std::vector<ClashCandidate> out;
    for (const auto& some : found) out.insert(out.end(), some.begin(), some.end());
    std::ranges::sort(out);
    return out;
}

}  // namespace trisect::app
