// SPDX-License-Identifier: Apache-2.0
//
// VertexColumns: vertices by lines along an axis.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/assembly/parts/vertex_boxes.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A grid of narrow columns along an axis; those that have vertices are in a hash table. Most long
/// edges of machine-made solids go along an axis, and a column has few vertices, where a tree has
/// many boxes that such an edge runs through.
class VertexColumns {
public:
    using Vertex = VertexBoxes::Vertex;

    /// `width` is about what vertices on one line are apart across it. The vertices must stay where
    /// they are. O(n), and O(m log m) for each column of m
    void build(std::span<const Vertex> vertices, std::size_t axis, double width);
    void clear() { columns_.clear(); }
    [[nodiscard]] bool is_empty() const { return columns_.empty(); }

    /// Calls `look_at` with spans that have all vertices of a box, and few others. False where it
    /// meets more than four columns; then nothing is called.
    template <class LookAt>
    [[nodiscard]] bool for_each_near(const std::array<double, 3>& lo,
                                     const std::array<double, 3>& hi, const LookAt& look_at) const {
        const Place first = place_of(lo);
        const Place last = place_of(hi);
        if (last[0] - first[0] > 1 || last[1] - first[1] > 1) return false;
        std::array<std::size_t, 4> seen{};  // columns of equal keys are one
        std::size_t count = 0;
        const auto along = [&](std::uint32_t v) { return vertices_[v].c[axis_]; };
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y) {
                const std::size_t slot = slot_of(key_of({x, y}));
                const Column& column = columns_[slot];
                const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
                if (column.count == 0 || std::find(seen.begin(), end, slot) != end) continue;
                seen[count++] = slot;
                const auto all = std::span(order_).subspan(column.first, column.count);
                const auto begin = std::ranges::lower_bound(all, lo[axis_], {}, along);
                for (auto v = begin; v != all.end() && along(*v) <= hi[axis_]; ++v)
                    look_at(vertices_.subspan(*v, 1));
            }
        return true;
    }

private:
    using Place = std::array<std::int64_t, 2>;
    struct Column {
        std::uint32_t key = 0;
        std::uint32_t first = 0;
        std::uint32_t count = 0;  // 0: none
    };
    // Rounded steps keep the order of coordinates, so a box has all columns of its points. What is
    // far beyond all vertices is in the columns at the end.
    [[nodiscard]] Place place_of(const std::array<double, 3>& c) const {
        constexpr double most = 0x1p50;
        const auto number = [&](std::size_t k) {
            return static_cast<std::int64_t>(
                std::min(most, std::max(-most, (c[k] - origin_[k]) * per_unit_)));
        };
        return {number((axis_ + 1) % 3), number((axis_ + 2) % 3)};
    }
    // Columns of equal keys count as one.
    [[nodiscard]] static std::uint32_t key_of(const Place& p) {
        return static_cast<std::uint32_t>(
            mix64(mix64(static_cast<std::uint64_t>(p[0])) + static_cast<std::uint64_t>(p[1])));
    }
    // Of the column with that key, or where it would be.
    [[nodiscard]] std::size_t slot_of(std::uint32_t key) const {
        std::size_t at = key & (columns_.size() - 1);
        while (columns_[at].count != 0 && columns_[at].key != key)
            at = (at + 1) & (columns_.size() - 1);
        return at;
    }

    std::size_t axis_ = 0;
    std::span<const Vertex> vertices_;
    PoolVector<std::uint32_t> order_;  // column after column, each along the axis
    PoolVector<Column> columns_;       // a power of two of them, at most half full
    std::array<double, 3> origin_{};
    double per_unit_ = 0;  // columns
};

// \pre there are any
inline void VertexColumns::build(std::span<const Vertex> vertices, std::size_t axis, double width) {
    axis_ = axis;
    origin_ = vertices[0].c;
    per_unit_ = 1 / width;
    const std::size_t places = std::bit_ceil(2 * vertices.size());
    vertices_ = vertices;
    columns_.assign(places, {});
    PoolVector<std::uint32_t> slots;
    slots.reserve(vertices.size());
    for (const Vertex& v : vertices) {
        const std::uint32_t key = key_of(place_of(v.c));
        Column& column = columns_[slot_of(key)];
        column.key = key;
        ++column.count;
        slots.push_back(static_cast<std::uint32_t>(&column - columns_.data()));
    }
    std::uint32_t first = 0;
    for (Column& column : columns_) {
        column.first = first;
        first += column.count;
    }
    order_.resize(vertices.size());
    for (std::uint32_t i = 0; i < vertices.size(); ++i) order_[columns_[slots[i]].first++] = i;
    for (Column& column : columns_) {
        column.first -= column.count;
        if (column.count < 2) continue;
        const auto all = std::span(order_).subspan(column.first, column.count);
        std::sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) {
            return vertices[a].c[axis] < vertices[b].c[axis];
        });
    }
}

}  // namespace trisect::detail
