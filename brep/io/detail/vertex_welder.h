// SPDX-License-Identifier: Apache-2.0
//
// VertexWelder: gives equal points equal numbers, in order of first appearance. Equality is that of
// the coordinates' values, so -0.0 equals 0.0, and nothing else is near enough.
//
// Open addressing with linear probing over 32-bit numbers into the vector of points: one cache line
// for a probe, no node allocations. The hash is salted at random once a process, so that a file
// cannot be made whose points all collide; the numbers given out do not depend on it.
//
// Cost: O(1) expected a point; at most 16 bytes a point beside the points themselves.
#pragma once

#include <trisect/brep/polygon_mesh.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace trisect::detail {

class VertexWelder {
public:
    /// `points` must outlive the welder and be changed by it alone; `expected` is a bounded hint.
    VertexWelder(std::vector<Point3d>& points, std::uint64_t expected)
        : points_(points), salt_(process_salt()) {
        slots_.assign(std::bit_ceil(static_cast<std::size_t>(2 * expected + 16)), none);
    }

    /// The number of the vertex at `p`. All coordinates must be finite.
    [[nodiscard]] std::uint32_t vertex(const Point3d& p) {
        if (2 * points_.size() >= slots_.size()) grow();
        std::uint32_t& slot = find(p);
        if (slot == none) {
            slot = static_cast<std::uint32_t>(points_.size());
            points_.push_back(p);
        }
        return slot;
    }

private:
    static constexpr std::uint32_t none = 0xFFFF'FFFFU;

    static std::uint64_t process_salt() {
        static const std::uint64_t salt = [] {
            std::random_device device;
            return (std::uint64_t{device()} << 32) ^ device();
        }();
        return salt;
    }

    /// A bijection of 64 bits in which every bit depends on every other (Stafford's variant 13).
    static std::uint64_t mixed(std::uint64_t h) noexcept {
        h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9U;
        h = (h ^ (h >> 27)) * 0x94D049BB133111EBU;
        return h ^ (h >> 31);
    }

    [[nodiscard]] std::uint64_t hash(const Point3d& p) const noexcept {
        std::uint64_t h = salt_;
        // Adding 0.0 turns -0.0 into 0.0 and changes nothing else.
        for (const double c : p) h = mixed(h ^ std::bit_cast<std::uint64_t>(c + 0.0));
        return h;
    }

    /// The slot that holds `p`, or the free slot where it belongs.
    std::uint32_t& find(const Point3d& p) noexcept {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = static_cast<std::size_t>(hash(p)) & mask;
        while (slots_[i] != none && points_[slots_[i]] != p) i = (i + 1) & mask;
        return slots_[i];
    }

    void grow() {
        slots_.assign(slots_.size() * 2, none);
        for (std::size_t v = 0; v < points_.size(); ++v) {
            find(points_[v]) = static_cast<std::uint32_t>(v);
        }
    }

    std::vector<Point3d>& points_;
    std::uint64_t salt_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace trisect::detail
