// SPDX-License-Identifier: Apache-2.0
//
// Orders of facets along an edge, at its ends.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/bsp/cells/shift/corner_derivatives.h>
#include <trisect/bsp/cells/shift/corner_moves.h>
#include <trisect/bsp/cells/shift/near_numbers.h>
#include <trisect/bsp/cells/shift/shift_numbers.h>

namespace trisect::detail::shifted {

/// What order_along_shifted() says, in doubles, where corners move; nothing where doubles leave a
/// sign open, or both facets are met between the ends of the edge.
///
/// An edge from p to q goes through a plane of value v at v(p) / (v(p) - v(q)) of its length. Where
/// p is a corner of the facet, v(p) is 0 but for what the moves make of it, v', and that is
/// -v' / v(q), next to 0; where q is one, it is 1 + v' / v(p). Where both are, it is between them.
class OrderAtCorner {
public:
    OrderAtCorner(const LatticePoint& from, const LatticePoint& to, bool is_second,
                  const InfinitesimalShift& shift)
        : ends_{&from, &to}, is_second_(is_second), moves_(*shift.moves) {}

    [[nodiscard]] std::optional<int> of(const std::array<FacetCorners, 2>& corners) const {
        const NearNumbers numbers;
        const std::array<Place, 2> places{place_in(numbers, corners[0]),
                                          place_in(numbers, corners[1])};
        if (numbers.is_open()) return std::nullopt;
        if (places[0].end != places[1].end) return places[0].end < places[1].end ? -1 : 1;
        if (places[0].end == 0) return std::nullopt;
        const auto ahead = [&](std::size_t i) {
            return NearNumbers::product(places[i].gain, places[1 - i].other);
        };
        const int sign = numbers.sign(NearNumbers::difference(ahead(0), ahead(1)));
        if (numbers.is_open() || sign == 0) return std::nullopt;
        return sign * places[0].side * places[1].side * places[0].end;
    }

private:
    using Value = NearNumbers::Value;
    struct Place {
        int end = 0;   // -1: where the edge begins; 1: where it ends; 0: between
        int side = 0;  // of the plane on which the other end is
        Value gain;    // of the value at that end
        Value other;   // the value at the other one
    };

    [[nodiscard]] Place place_in(const NearNumbers& numbers, const FacetCorners& corners) const {
        const Facet<NearNumbers> facet(corners);
        const std::array<int, 2> at{corner_at(0, corners), corner_at(1, corners)};
        const auto value = [&](std::size_t i) {
            return at[i] >= 0 ? gain_of(facet, i, corners, static_cast<std::size_t>(at[i]))
                              : facet.value(lengths<NearNumbers>(*ends_[i]));
        };
        const std::array<Value, 2> values{value(0), value(1)};
        const std::array<int, 2> sides{numbers.sign(values[0]), numbers.sign(values[1])};
        if (sides[0] * sides[1] == 0) numbers.leave_open();
        if ((at[0] >= 0) == (at[1] >= 0)) return {};
        const std::size_t end = at[0] >= 0 ? 0 : 1;
        return {end == 0 ? -1 : 1, sides[1 - end], values[end], values[1 - end]};
    }
    [[nodiscard]] int corner_at(std::size_t end, const FacetCorners& facet) const {
        for (int i = 0; i < 3; ++i)
            if (*facet[static_cast<std::size_t>(i)] == *ends_[end]) return i;
        return -1;
    }
    // Moved with its mesh a point gains what its move has along the normal; a plane that is moved
    // with its own corner there loses that.
    [[nodiscard]] Value gain_of(const Facet<NearNumbers>& facet, std::size_t end,
                                const FacetCorners& corners, std::size_t corner) const {
        const LatticePoint& moved = is_second_ ? *ends_[end] : *corners[corner];
        const Value v = dot<NearNumbers>(facet.normal, lengths<NearNumbers>(moves_.of(moved)));
        return is_second_ ? v : Value{-v.value, v.error};
    }

    std::array<const LatticePoint*, 2> ends_;
    bool is_second_;
    const CornerMoves& moves_;
};

}  // namespace trisect::detail::shifted
