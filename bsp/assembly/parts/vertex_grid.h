// SPDX-License-Identifier: Apache-2.0
//
// VertexGrid: a grid over vertices, to find those near short edges.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/vertex_boxes.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Cubes that have vertices are in a hash table. Most edges of a result are about as short as the
/// others and lie in one cube or two, where a tree takes several steps from its root.
class VertexGrid {
public:
    using Vertex = VertexBoxes::Vertex;

    /// Cubes of about that size. Copies the vertices. O(n)
    void build(std::span<const Vertex> vertices, double size);
    void clear() { cells_.clear(); }
    /// Cube by cube; they stay where they are.
    [[nodiscard]] std::span<const Vertex> vertices() const { return vertices_; }

    /// Calls `look_at` with spans that have all vertices of a box, and few others. False where it
    /// has too many cubes; then nothing is called.
    template <class LookAt>
    [[nodiscard]] bool for_each_near(const std::array<double, 3>& lo,
                                     const std::array<double, 3>& hi, const LookAt& look_at) const {
        const Place first = place_of(lo);
        const Place last = place_of(hi);
        if (cube_count(first, last) > most_cubes) return false;
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                for (std::int64_t z = first[2]; z <= last[2]; ++z) {
                    const Cell& cell = cells_[slot_of(key_of({x, y, z}))];
                    if (cell.count != 0)
                        look_at(std::span(vertices_).subspan(cell.first, cell.count));
                }
        return true;
    }

    /// Whether for_each_near() returns true.
    [[nodiscard]] bool takes(const std::array<double, 3>& lo,
                             const std::array<double, 3>& hi) const {
        return cube_count(place_of(lo), place_of(hi)) <= most_cubes;
    }

private:
    static constexpr std::int64_t most_cubes = 27;
    static constexpr std::int64_t most_along = std::int64_t{1} << 20;  // an axis

    using Place = std::array<std::int64_t, 3>;
    struct Cell {
        std::uint64_t key = 0;
        std::uint32_t first = 0;
        std::uint32_t count = 0;  // 0: none
    };
    // Rounded steps keep the order of coordinates, so a box has all cubes of its points. What is
    // beyond all vertices is in the cubes next to them. Zero is the first of two, as no number is
    // no larger.
    [[nodiscard]] Place place_of(const std::array<double, 3>& c) const {
        Place out{};
        for (std::size_t k = 0; k < 3; ++k)
            out[k] = static_cast<std::int64_t>(std::min(
                static_cast<double>(most_along), std::max(0.0, (c[k] - origin_[k]) * per_unit_)));
        return out;
    }
    [[nodiscard]] static std::int64_t cube_count(const Place& first, const Place& last) {
        const auto count = [&](std::size_t k) { return last[k] - first[k] + 1; };
        return count(0) * count(1) * count(2);
    }
    [[nodiscard]] static std::uint64_t key_of(const Place& p) {
        return static_cast<std::uint64_t>(p[0]) << 42 | static_cast<std::uint64_t>(p[1]) << 21 |
               static_cast<std::uint64_t>(p[2]);
    }
    // Of the cell with that key, or where it would be.
    [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
        std::size_t at = static_cast<std::size_t>(key * 0x9e3779b97f4a7c15U >> shift_);
        while (cells_[at].count != 0 && cells_[at].key != key) at = (at + 1) & (cells_.size() - 1);
        return at;
    }

    PoolVector<Vertex> vertices_;  // cell after cell
    PoolVector<Cell> cells_;       // a power of two of them, at most half full
    int shift_ = 0;
    std::array<double, 3> origin_{};
    double per_unit_ = 0;  // cubes
};

// \pre there are any
inline void VertexGrid::build(std::span<const Vertex> vertices, double size) {
    std::array<double, 3> hi = vertices[0].c;
    origin_ = hi;
    for (const Vertex& v : vertices)
        for (std::size_t k = 0; k < 3; ++k) {
            origin_[k] = std::min(origin_[k], v.c[k]);
            hi[k] = std::max(hi[k], v.c[k]);
        }
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, hi[k] - origin_[k]);
    const double least = extent / static_cast<double>(most_along);
    size = std::max(size, least);
    per_unit_ = size > 0 ? 1 / size : 0;
    const std::size_t places = std::bit_ceil(2 * vertices.size());
    shift_ = 64 - std::countr_zero(places);
    cells_.assign(places, {});
    PoolVector<std::uint32_t> slots;
    slots.reserve(vertices.size());
    for (const Vertex& v : vertices) {
        const std::uint64_t key = key_of(place_of(v.c));
        Cell& cell = cells_[slot_of(key)];
        cell.key = key;
        ++cell.count;
        slots.push_back(static_cast<std::uint32_t>(&cell - cells_.data()));
    }
    std::uint32_t first = 0;
    for (Cell& cell : cells_) {
        cell.first = first;
        first += cell.count;
    }
    vertices_.resize(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
        vertices_[cells_[slots[i]].first++] = vertices[i];
    for (Cell& cell : cells_) cell.first -= cell.count;
}

}  // namespace trisect::detail
