// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/tree/leaf_tree.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/spares.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

namespace {

struct Division {
    ObbParts parts;
    std::vector<std::uint32_t> order;

    [[nodiscard]] std::size_t bytes() const {
        return parts.bytes() + order.capacity() * sizeof(order[0]);
    }
};

}  // namespace

LeafTree::LeafTree(const LeafTriangles& triangles, std::uint32_t count, const Bounds& bounds)
    : triangles_(triangles), order_(count) {
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    if (count == 0) return;
    double extent = 0;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double e = bounds.hi[k] - bounds.lo[k];
        origin_[k] = bounds.lo[k] + 0.5 * e;
        extent = std::max(extent, e);
        square += 0.25 * e * e;
    }
    unit_ = extent > 0 ? std::ldexp(1.0, std::ilogb(extent)) : 1.0;
    slack_ = ObbParts::slack_of(bounds.error, unit_);
    radius_ = bound_slack * std::sqrt(square) / unit_ + slack_;
}

template <class Put>
void LeafTree::put_parts(std::size_t triangles, ObbParts& parts, const Put& put) const {
    const auto put_in_units = [&](std::span<Vector3> corners) {
        put(corners);
        const double per_unit = 1 / unit_;  // a power of two
        for (Vector3& c : corners)
            for (std::size_t k = 0; k < 3; ++k) c[k] = (c[k] - origin_[k]) * per_unit;
    };
    parts.assign(static_cast<std::uint32_t>(triangles), slack_, put_in_units);
}

const LeafTree::Node& LeafTree::divide(std::uint32_t begin, std::uint32_t size,
                                       const AreaFrame* frame) const {
    check_stop(size);
    const std::span<std::uint32_t> range = std::span(order_).subspan(begin, size);
    Spare<Division> division;
    ObbParts& all = division->parts;
    put_parts(size, all,
              [&](std::span<Vector3> corners) { triangles_.put_corners(range, corners); });
    std::array<ObbParts::Part, 4> parts;
    const std::size_t count =
        all.divide(frame != nullptr ? ObbParts::Part{0, size, *frame} : all.whole(), 1, parts);
    auto node = std::make_unique<Node>();
    close_lanes(node->boxes_, count);
    for (std::uint32_t i = 0; i < count; ++i) {
        all.put(parts[i], node->boxes_, i);
        node->begin_[i] = begin + parts[i].begin;
        node->size_[i] = parts[i].size();
    }
    std::vector<std::uint32_t>& order = division->order;
    order.resize(size);
    for (std::uint32_t i = 0; i < size; ++i) order[i] = range[all.triangle(i)];
    std::ranges::copy(order, range.begin());
    nodes_.push_back(std::move(node));
    return *nodes_.back();
}

const LeafTree::Node& LeafTree::root() const {
    if (const Node* const known = root_.load(std::memory_order_acquire)) return *known;
    const WorkLock lock(dividing_);
    if (const Node* const known = root_.load(std::memory_order_relaxed)) return *known;
    const Node& made = divide(0, size(), nullptr);
    root_.store(&made, std::memory_order_release);
    return made;
}

// The frame is that of the box, whose floats are all that division looks at.
const LeafTree::Node& LeafTree::make_below(const Node& node, std::uint32_t lane) const {
    const WorkLock lock(dividing_);
    if (const Node* const known = node.below_[lane].load(std::memory_order_relaxed)) return *known;
    AreaFrame frame;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            frame.axis[i][k] = static_cast<double>(node.boxes_.axis[i][k][lane]);
    const Node& made = divide(node.begin_[lane], node.size_[lane], &frame);
    node.below_[lane].store(&made, std::memory_order_release);
    return made;
}

ObbNode LeafTree::boxes_of(std::span<const TriangleCorners> triangles,
                           std::span<const std::uint32_t> ends) const {
    Spare<Division> division;
    ObbParts& all = division->parts;
    put_parts(triangles.size(), all, [&](std::span<Vector3> corners) {
        for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = triangles[i / 3][i % 3];
    });
    ObbNode node;
    close_lanes(node, ends.size());
    std::uint32_t begin = 0;
    for (std::uint32_t i = 0; i < ends.size(); ++i) {
        all.put(all.part(begin, ends[i]), node, i);
        begin = ends[i];
    }
    return node;
}

std::size_t LeafTree::bytes() const {
    const WorkLock lock(dividing_);
    return order_.capacity() * sizeof(order_[0]) + nodes_.size() * (sizeof(Node) + sizeof(void*));
}

}  // namespace trisect::detail
