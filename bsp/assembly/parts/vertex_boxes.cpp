// SPDX-License-Identifier: Apache-2.0
//
// A segment and a box are apart where an axis, or the product of one and the segment, parts them.

#include <trisect/bsp/assembly/parts/vertex_boxes.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/wide_clones.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t few = 8;  // vertices that are not parted

// Fewer are not worth a thread. An eighth of them at least is on each side of a cut.
constexpr std::uint32_t many = 16384;
static_assert(many / 512 > few);

struct VertexExtent {
    std::array<double, 3> lo;
    std::array<double, 3> hi;
};

// \pre there are any
VertexExtent box_of_vertices(std::span<const VertexBoxes::Vertex> vertices) {
    VertexExtent out{vertices[0].c, vertices[0].c};
    for (const VertexBoxes::Vertex& v : vertices.subspan(1))
        for (std::size_t k = 0; k < 3; ++k) {
            out.lo[k] = std::min(out.lo[k], v.c[k]);
            out.hi[k] = std::max(out.hi[k], v.c[k]);
        }
    return out;
}

}  // namespace

void VertexBoxes::build(std::span<Vertex> vertices, std::uint32_t threads) {
    vertices_ = vertices;
    nodes_.clear();
    if (vertices.empty()) return;
    const auto [lo, hi] = box_of_vertices(vertices);
    double largest = 0;
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        origin_[k] = lo[k] + (hi[k] - lo[k]) / 2;
        largest = std::max({largest, std::fabs(lo[k]), std::fabs(hi[k])});
        extent = std::max(extent, hi[k] - lo[k]);
    }
    // A float is off by 2^-24 of itself, the difference in doubles by 2^-53 of the coordinates.
    rounding_ = 0x1p-23 * extent + 0x1p-51 * largest;
    scale_ = extent > 0 ? std::ldexp(1.0, -std::ilogb(extent)) : 1;
    const auto count = static_cast<std::uint32_t>(vertices.size());
    nodes_.reserve(2 + count / few);
    if (threads == 1 || count < many) {
        static_cast<void>(add(0, count, nodes_));
    } else {
        on_threads(threads, [&](std::uint32_t n) { add_all(count, n); });
    }
}

// The first node by several threads, then what is below each of its children by one.
void VertexBoxes::add_all(std::uint32_t count, std::uint32_t threads) {
    std::array<std::uint32_t, width + 1> bounds{};
    bounds.back() = count;
    part_on_threads(bounds);
    Node root;
    root.begin = bounds;
    root.count = width;
    std::array<Nodes, width> below;
    ParallelParts(width, threads, 1).for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            set_box(root, static_cast<std::uint32_t>(i), bounds[i], bounds[i + 1]);
            static_cast<void>(add(bounds[i], bounds[i + 1], below[i]));
        }
    });
    nodes_.push_back(root);
    for (std::size_t i = 0; i < width; ++i) {
        const auto first = static_cast<std::uint32_t>(nodes_.size());
        nodes_[0].child[i] = first;
        for (Node& n : below[i]) {
            for (std::uint32_t& child : n.child) child += child != 0 ? first : 0;
            nodes_.push_back(n);
        }
    }
}

// Fills in the bounds between the first one and the last one; of many vertices all parts have more
// than a few.
void VertexBoxes::part_on_threads(std::span<std::uint32_t> bounds) {
    if (bounds.size() < 3) return;
    const std::size_t middle = bounds.size() / 2;
    bounds[middle] = parted_at(bounds.front(), bounds.back());
    both_at_once([&] { part_on_threads(bounds.first(middle + 1)); },
                 [&] { part_on_threads(bounds.subspan(middle)); });
}

// In the middle of their box: those of one plane across the axis stay together. Where that leaves
// less than an eighth on one side, in two halves of a size; so the depth is some bits of a number.
std::uint32_t VertexBoxes::parted_at(std::uint32_t begin, std::uint32_t end) {
    const auto [lo, hi] = box_of_vertices(vertices_.subspan(begin, end - begin));
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
    const std::span<Vertex> all = vertices_.subspan(begin, end - begin);
    const double middle = lo[axis] + (hi[axis] - lo[axis]) / 2;
    const auto above =
        std::partition(all.begin(), all.end(), [&](const Vertex& v) { return v.c[axis] < middle; });
    const auto part = static_cast<std::uint32_t>(above - all.begin());
    const std::uint32_t least = (end - begin) / 8;
    if (part > least && end - begin - part > least) return begin + part;
    const std::uint32_t half = (end - begin) / 2;
    std::ranges::nth_element(all, all.begin() + half, [axis](const Vertex& a, const Vertex& b) {
        return a.c[axis] < b.c[axis];
    });
    return begin + half;
}

void VertexBoxes::part(Node& node, std::uint32_t begin, std::uint32_t end, int levels) {
    if (levels == 0 || end - begin <= few) {
        set_box(node, node.count, begin, end);
        node.begin[node.count++] = begin;
        node.begin[node.count] = end;
        return;
    }
    const std::uint32_t at = parted_at(begin, end);
    part(node, begin, at, levels - 1);
    part(node, at, end, levels - 1);
}

void VertexBoxes::set_box(Node& node, std::uint32_t child, std::uint32_t begin,
                          std::uint32_t end) const {
    const auto [lo, hi] = box_of_vertices(vertices_.subspan(begin, end - begin));
    for (std::size_t k = 0; k < 3; ++k) {
        const auto middle =
            static_cast<float>(((lo[k] + (hi[k] - lo[k]) / 2) - origin_[k]) * scale_);
        const double at = origin_[k] + static_cast<double>(middle) / scale_;
        node.middle[k][child] = middle;
        node.half[k][child] =
            static_cast<float>((std::max(hi[k] - at, at - lo[k]) + rounding_) * scale_ * 1.000001);
    }
}

std::uint32_t VertexBoxes::add(std::uint32_t begin, std::uint32_t end, Nodes& nodes) {
    const auto place = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    Node node;
    constexpr int levels = 3;
    part(node, begin, end, levels);
    for (std::uint32_t i = 0; i < node.count; ++i)
        if (node.begin[i + 1] - node.begin[i] > few)
            node.child[i] = add(node.begin[i], node.begin[i + 1], nodes);
    nodes[place] = node;
    return place;
}

VertexBoxes::Edge VertexBoxes::single_precision(const std::array<double, 3>& from,
                                                const std::array<double, 3>& to,
                                                double within) const {
    Edge out;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = to[k] - from[k];
        out.along[k] = static_cast<float>(along * scale_);
        out.middle[k] = static_cast<float>(((from[k] + along / 2) - origin_[k]) * scale_);
        out.half[k] =
            static_cast<float>((std::fabs(along) / 2 + within + 2 * rounding_) * scale_ * 1.000001);
        longest = std::max(longest, std::fabs(along));
    }
    out.reach =
        static_cast<float>(2 * (longest * scale_) * ((within + 2 * rounding_) * scale_) * 1.000001);
    return out;
}

// By the axes first. Products of lengths are off by less than 2^-20 of the largest ones.
TRISECT_WIDE_CLONES
void VertexBoxes::Edge::compare(const Node& node, std::array<std::uint8_t, width>& is_near) const {
    std::array<Row, 3> apart;
    std::array<std::int32_t, width> near;
    near.fill(1);
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < width; ++i) {
            apart[k][i] = node.middle[k][i] - middle[k];
            near[i] &= std::fabs(apart[k][i]) <= (node.half[k][i] + half[k]) * 1.00001F ? 1 : 0;
        }
    std::int32_t left_over = 0;
    for (std::size_t i = 0; i < width; ++i) {
        left_over += near[i];
        is_near[i] = static_cast<std::uint8_t>(near[i]);
    }
    // The ends of an edge are in boxes themselves.
    if (left_over <= 2) return;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        const float along_u = std::fabs(along[u]);
        const float along_v = std::fabs(along[v]);
        for (std::size_t i = 0; i < width; ++i) {
            const float left = apart[u][i] * along[v];
            const float right = apart[v][i] * along[u];
            const float sum = node.half[u][i] * along_v + node.half[v][i] * along_u;
            const float rounding = 0x1p-20F * (std::fabs(left) + std::fabs(right) + sum);
            near[i] &= std::fabs(left - right) <= sum + reach + rounding ? 1 : 0;
        }
    }
    for (std::size_t i = 0; i < width; ++i) is_near[i] = static_cast<std::uint8_t>(near[i]);
}

}  // namespace trisect::detail
