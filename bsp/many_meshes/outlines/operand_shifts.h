// SPDX-License-Identifier: Apache-2.0
//
// OperandShifts: infinitesimal moves of many meshes that put them in general position.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// Each operand grows about a centre by a factor 1 + d, or shrinks by 1 - d, with a d of its own,
/// or none does. Then it is moved along each axis by an e of its own. Each d is infinitely smaller
/// than the one before it in an order, all e along the first of the axes are smaller than any d,
/// those along the next axis smaller again; along an axis there is an order, too. All e are
/// positive.
class OperandShifts {
public:
    struct Growth {
        std::int8_t sign = 1;  ///< -1: it shrinks
        LatticePoint centre;
        std::int64_t size = 0;  ///< of two that grow the larger one grows more, unless something
                                ///< else is wanted; of two that shrink the smaller one shrinks more
        bool cuts = false;      ///< those that cut others grow more than these
    };
    /// Two operands with facets in one plane, between which nothing must be left: `above` has to be
    /// farther along a direction, by its signs, than `below`. What their growth does for that: 1
    /// what is wanted, -1 the opposite.
    struct Wanted {
        std::uint32_t above = 0;
        std::uint32_t below = 0;
        std::array<int, 3> direction{};
        std::array<int, 2> growth{};  ///< of `above`, of `below`, if they grow
        friend auto operator<=>(const Wanted&, const Wanted&) = default;
    };

    /// All grow by their sizes; all else is in the order of the slots.
    explicit OperandShifts(std::vector<Growth> growths);
    /// Moves that do what is wanted. Some that would grow may shrink, and the other way round.
    /// Nothing where none are found.
    [[nodiscard]] static std::optional<OperandShifts> satisfying(std::vector<Growth> growths,
                                                                 std::span<const Wanted> wanted);

    [[nodiscard]] bool satisfies(const Wanted& wanted) const;
    /// How the second operand moves, seen from the first one.
    [[nodiscard]] InfinitesimalShift of_pair(std::uint32_t first, std::uint32_t second) const;
    /// How it would grow.
    [[nodiscard]] const Growth& growth(std::uint32_t slot) const { return growths_[slot]; }
    [[nodiscard]] bool do_grow() const { return do_grow_; }
    /// Places in the order of the d, the largest one first.
    [[nodiscard]] std::uint32_t growth_rank(std::uint32_t slot) const { return ranks_[3][slot]; }
    /// The same of the e along an axis.
    [[nodiscard]] std::uint32_t rank(std::size_t axis, std::uint32_t slot) const {
        return ranks_[axis][slot];
    }
    [[nodiscard]] const std::array<std::uint8_t, 3>& axes() const { return axes_; }

private:
    using Ranks = std::vector<std::uint32_t>;
    struct Before {
        std::uint32_t slot = 0;
        std::uint32_t other = 0;
    };
    [[nodiscard]] static std::optional<Ranks> ordered(const Ranks& preferred,
                                                      std::span<const Before> all);
    void prefer_by_size();
    [[nodiscard]] bool choose_signs(std::span<const Wanted> wanted);
    [[nodiscard]] bool order_growths(std::span<const Wanted> wanted);
    [[nodiscard]] bool order_moves(std::span<const Wanted> wanted);
    [[nodiscard]] std::array<int, 2> growths_along(const Wanted& wanted) const;
    [[nodiscard]] int along_moves(const Wanted& wanted) const;
    [[nodiscard]] int along_growth(const Wanted& wanted) const;

    std::vector<Growth> growths_;  // by slot
    bool do_grow_ = true;          // all of them, or none
    std::array<std::uint8_t, 3> axes_{0, 1, 2};
    std::array<Ranks, 4> ranks_;      // by axis, and of growths
    std::array<Ranks, 2> preferred_;  // along axes, and of growths
};

}  // namespace trisect::detail
