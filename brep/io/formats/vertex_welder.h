// SPDX-License-Identifier: Apache-2.0
//
// VertexWelder: equal numbers for equal points, in order of first appearance.
// Equality is that of the coordinates' values: -0.0 equals 0.0, and there is no tolerance.
//
// Open addressing with linear probing over 32-bit numbers into the vector of points: one cache line
// for a probe, no node allocations. The lines are spread over the whole table, so points that come
// in blocks are hashed first and their lines prefetched before the first is needed. The hash is
// salted at random once a process, so that a file cannot be made whose points all collide; the
// numbers given out do not depend on it.
//
// Cost: O(1) expected a point; at most 32 bytes a point beside the points themselves.
#pragma once

#include <trisect/brep/polygon_mesh.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace trisect::detail {

class VertexWelder {
public:
    /// The most points that come at a time.
    static constexpr std::size_t block = 96;

    /// `points` must outlive the welder and be changed by it alone; `expected` is a bounded hint.
    /// When it is right, the table ends a quarter full: two points in one place cost more than a
    /// larger table.
    VertexWelder(std::vector<Point3d>& points, std::uint64_t expected)
        : points_(points), salt_(process_salt()) {
        slots_.assign(std::bit_ceil(static_cast<std::size_t>(4 * expected + 16)), none);
    }

    /// The number of the vertex at `p`. All coordinates must be finite.
    [[nodiscard]] std::uint32_t vertex(const Point3d& p) {
        make_room(1);
        return find_or_add(p, hash(p));
    }

    /// The numbers of the vertices at `p`, at most `block` of them.
    void vertices(std::span<const Point3d> p, std::uint32_t* numbers) {
        make_room(p.size());
        std::array<std::uint64_t, block> hashes;
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t i = 0; i < p.size(); ++i) {
            hashes[i] = hash(p[i]);
            __builtin_prefetch(&slots_[hashes[i] & mask]);
        }
        for (std::size_t i = 0; i < p.size(); ++i) {
            const std::uint32_t v = slots_[hashes[i] & mask];
            __builtin_prefetch(points_.data() + (v == none ? 0 : v));
        }
        for (std::size_t i = 0; i < p.size(); ++i) numbers[i] = find_or_add(p[i], hashes[i]);
    }

private:
    static constexpr std::uint32_t none = 0xFFFF'FFFFU;
    using Salt = std::array<std::uint64_t, 4>;

    static const Salt& process_salt() {
        static const Salt salt = [] {
            std::random_device device;
            Salt s{};
            for (std::uint64_t& word : s) word = (std::uint64_t{device()} << 32) ^ device();
            return s;
        }();
        return salt;
    }

    /// Both halves of the product, so that every bit of the result depends on both factors.
    static std::uint64_t folded_product(std::uint64_t a, std::uint64_t b) noexcept {
        __extension__ using Wide = unsigned __int128;
        const Wide product = Wide{a} * b;
        return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
    }

    [[nodiscard]] std::uint64_t hash(const Point3d& p) const noexcept {
        // Adding 0.0 turns -0.0 into 0.0 and changes nothing else.
        const auto bits = [&](std::size_t k) {
            return std::bit_cast<std::uint64_t>(p[k] + 0.0) ^ salt_[k];
        };
        return folded_product(folded_product(bits(0), bits(1)) ^ salt_[3], bits(2));
    }

    std::uint32_t find_or_add(const Point3d& p, std::uint64_t h) {
        std::uint32_t& slot = find(p, h);
        if (slot == none) {
            slot = static_cast<std::uint32_t>(points_.size());
            points_.push_back(p);
        }
        return slot;
    }

    /// The slot that holds `p`, or the free slot where it belongs.
    std::uint32_t& find(const Point3d& p, std::uint64_t h) noexcept {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = static_cast<std::size_t>(h) & mask;
        while (slots_[i] != none && points_[slots_[i]] != p) i = (i + 1) & mask;
        return slots_[i];
    }

    void make_room(std::size_t more) {
        if (2 * (points_.size() + more) <= slots_.size()) return;
        slots_.assign(std::max(slots_.size() * 2, std::bit_ceil(2 * (points_.size() + more))),
                      none);
        for (std::size_t v = 0; v < points_.size(); ++v)
            find(points_[v], hash(points_[v])) = static_cast<std::uint32_t>(v);
    }

    std::vector<Point3d>& points_;
    Salt salt_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace trisect::detail
