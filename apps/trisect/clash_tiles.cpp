// SPDX-License-Identifier: Apache-2.0
#include "clash_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace trisect::app {
namespace {

// A tile is small beside what a rank does, so that ranks that take the next one end at the same
// time, and large beside what is listed twice on its walls.
constexpr std::size_t boxes_of_a_tile = 128;
constexpr std::size_t most_samples = std::size_t{1} << 15;  // or an eighth of all, if that is more
// What a candidate costs beside a box: an exact answer, against some comparisons.
constexpr double cost_of_a_pair = 16;
constexpr std::size_t samples_of_a_neighbourhood = 64;

struct SampledBox {
    std::array<double, 3> middle{};
    const ClashBox* box = nullptr;
    double load = 1;
};

using SampledBoxes = std::span<SampledBox>;

std::size_t widest_axis(SampledBoxes samples) {
    std::array<double, 3> lo = samples.front().middle;
    std::array<double, 3> hi = lo;
    for (const SampledBox& s : samples)
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
std::size_t halved(SampledBoxes samples, std::size_t axis) {
    std::ranges::sort(samples, [axis](const SampledBox& a, const SampledBox& b) {
        if (a.middle[axis] != b.middle[axis]) return a.middle[axis] < b.middle[axis];
        return a.box->part < b.box->part;
    });
    const double all =
        std::accumulate(samples.begin(), samples.end(), 0.0,
                        [](double sum, const SampledBox& s) { return sum + s.load; });
    const auto differ = [&](std::size_t i) {
        return samples[i - 1].middle[axis] < samples[i].middle[axis];
    };
    std::size_t at = 0;
    for (double sum = 0; at < samples.size() && sum < all / 2; ++at) sum += samples[at].load;
    // The nearest place between two that differ.
    for (std::size_t step = 0; step < samples.size(); ++step) {
        if (at >= 1 + step && at - step < samples.size() && differ(at - step)) return at - step;
        if (at + step >= 1 && at + step < samples.size() && differ(at + step)) return at + step;
    }
    return 0;
}

std::vector<SampledBox> sample_of(std::span<const ClashBox> boxes) {
    const std::size_t most = std::max(most_samples, boxes.size() / 8);
    const std::size_t stride = (boxes.size() + most - 1) / most;
    std::vector<SampledBox> out;
    for (std::size_t i = 0; i < boxes.size(); i += stride) {
        SampledBox s;
        s.box = &boxes[i];
        for (std::size_t k = 0; k < 3; ++k)
            s.middle[k] = boxes[i].box.lo[k] / 2 + boxes[i].box.hi[k] / 2;
        out.push_back(s);
    }
    return out;
}

// Counts candidates among neighbours; those of different neighbourhoods are not seen, which makes
// the estimate smaller by about as much everywhere.
void estimate(SampledBoxes samples, const ClashLimits& limits, double boxes_of_a_sample) {
    if (samples.size() > samples_of_a_neighbourhood) {
        const std::size_t lower = halved(samples, widest_axis(samples));
        if (lower != 0) {
            estimate(samples.first(lower), limits, boxes_of_a_sample);
            return estimate(samples.subspan(lower), limits, boxes_of_a_sample);
        }
    }
    const std::size_t n = std::min(samples.size(), 8 * samples_of_a_neighbourhood);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (is_candidate(limits, *samples[i].box, *samples[j].box)) {
                samples[i].load += cost_of_a_pair / 2 * boxes_of_a_sample;
                samples[j].load += cost_of_a_pair / 2 * boxes_of_a_sample;
            }
    // Many in one place, where some stand for all.
    for (std::size_t i = n; i < samples.size(); ++i)
        samples[i].load =
            samples[i % n].load * static_cast<double>(samples.size()) / static_cast<double>(n);
}

}  // namespace

class ClashTiles::Builder {
public:
    Builder(ClashTiles& tiles, double least) : tiles_(tiles), least_(least) {}

    // A cell whose load is no more than `least` is a tile, and one whose boxes are in one place.
    std::uint32_t build(SampledBoxes samples, const Bounds& cell) {
        const auto number = static_cast<std::uint32_t>(tiles_.nodes_.size());
        tiles_.nodes_.emplace_back();
        const double load =
            std::accumulate(samples.begin(), samples.end(), 0.0,
                            [](double sum, const SampledBox& s) { return sum + s.load; });
        const std::size_t axis = samples.empty() ? 0 : widest_axis(samples);
        const std::size_t lower = load > least_ && samples.size() > 1 ? halved(samples, axis) : 0;
        if (lower == 0) {
            tiles_.nodes_[number].below = static_cast<std::uint32_t>(tiles_.cells_.size());
            tiles_.cells_.push_back(cell);
            return number;
        }
        Node node;
        node.axis = static_cast<std::uint32_t>(axis);
        // Not at the middle of a box: many have theirs in one plane.
        node.value = samples[lower - 1].middle[axis] / 2 + samples[lower].middle[axis] / 2;
        Bounds half = cell;
        half.hi[axis] = node.value;
        node.below = build(samples.first(lower), half);
        half = cell;
        half.lo[axis] = node.value;
        node.above = build(samples.subspan(lower), half);
        tiles_.nodes_[number] = node;
        return number;
    }

private:
    ClashTiles& tiles_;
    double least_;
};

ClashTiles::ClashTiles(std::span<const ClashBox> boxes, const ClashLimits& limits) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    std::vector<SampledBox> samples = sample_of(boxes);
    const double each =
        samples.empty() ? 1
                        : static_cast<double>(boxes.size()) / static_cast<double>(samples.size());
    if (!samples.empty()) estimate(samples, limits, each);
    const double all =
        std::accumulate(samples.begin(), samples.end(), 0.0,
                        [](double sum, const SampledBox& s) { return sum + s.load; });
    const auto wanted = static_cast<double>((boxes.size() + boxes_of_a_tile - 1) / boxes_of_a_tile);
    Builder builder(*this, all / std::max(wanted, 1.0) * std::sqrt(2.0));
    builder.build(samples,
                  {{-unbounded, -unbounded, -unbounded}, {unbounded, unbounded, unbounded}});
    list(boxes, limits.most());
}

template <class Visit>
void ClashTiles::visit(std::uint32_t from, const Bounds& grown, const Visit& found) const {
    while (nodes_[from].axis < 3) {
        const Node& node = nodes_[from];
        if (!(grown.lo[node.axis] < node.value)) {
            from = node.above;
            continue;
        }
        if (!(grown.hi[node.axis] < node.value)) visit(node.above, grown, found);
        from = node.below;
    }
    found(nodes_[from].below);
}

// Counted, then filled: no list of a tile grows.
void ClashTiles::list(std::span<const ClashBox> boxes, double most) {
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    const auto grown = [&](const ClashBox& b) {
        Bounds out = b.box;
        for (double& hi : out.hi) hi = std::nextafter(hi + most, unbounded);
        return out;
    };
    begins_.assign(cells_.size() + 1, 0);
    for (const ClashBox& b : boxes)
        visit(0, grown(b), [&](std::uint32_t tile) { ++begins_[tile + 1]; });
    std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
    listed_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        visit(0, grown(boxes[i]), [&](std::uint32_t tile) { listed_[next[tile]++] = i; });
}

}  // namespace trisect::app
