// SPDX-License-Identifier: Apache-2.0
//
// UserBox: box in units that all lattices have in common.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include <trisect/bsp/cells/solid_state.h>

namespace trisect::detail {

/// Closed, and empty until something is added.
struct UserBox {
    static constexpr double infinite = std::numeric_limits<double>::infinity();
    std::array<double, 3> lo{infinite, infinite, infinite};
    std::array<double, 3> hi{-infinite, -infinite, -infinite};

    static UserBox all() {
        return {{-infinite, -infinite, -infinite}, {infinite, infinite, infinite}};
    }
    [[nodiscard]] UserBox intersected(const UserBox& b) const {
        UserBox out;
        for (std::size_t k = 0; k < 3; ++k) {
            out.lo[k] = std::max(lo[k], b.lo[k]);
            out.hi[k] = std::min(hi[k], b.hi[k]);
        }
        return out;
    }
    void add(const UserBox& b) {
        if (b.is_empty()) return;
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], b.lo[k]);
            hi[k] = std::max(hi[k], b.hi[k]);
        }
    }
    [[nodiscard]] bool is_empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
    /// Whether they have no point in common.
    [[nodiscard]] bool is_beside(const UserBox& b) const { return intersected(b).is_empty(); }
    /// Whether they have no more than a part of their outsides in common.
    [[nodiscard]] bool has_no_inside_in(const UserBox& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (lo[k] >= b.hi[k] || b.lo[k] >= hi[k]) return true;
        return false;
    }
};

/// Box of an imported mesh and a unit of its lattice around it, in constant time. Nothing of other
/// solids, and of lattices whose units are extreme.
[[nodiscard]] std::optional<UserBox> box_around_mesh(const SolidState& state);

/// The least box of an imported mesh. O(n) in its points. \pre box_around_mesh() has one
[[nodiscard]] UserBox least_box_of_mesh(const SolidState& state);

}  // namespace trisect::detail
