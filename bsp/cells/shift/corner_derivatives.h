// SPDX-License-Identifier: Apache-2.0
//
// CornerDerivatives: signs that are 0 without moves of corners, with them.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/bsp/cells/shift/corner_moves.h>
#include <trisect/bsp/cells/shift/near_numbers.h>
#include <trisect/bsp/cells/shift/shift_numbers.h>

namespace trisect::detail::shifted {

template <class N>
Lengths<N> lengths(const CornerMoves::Vector& v) {
    return {N::length(v[0]), N::length(v[1]), N::length(v[2])};
}

template <class N>
Normal<N> sum(const Normal<N>& a, const Normal<N>& b) {
    return {N::sum(a[0], b[0]), N::sum(a[1], b[1]), N::sum(a[2], b[2])};
}

/// The sign, right of 0, of a polynomial by its coefficients, the constant first.
template <class N, class Value, std::size_t D>
int first_sign(const N& numbers, const std::array<Value, D>& coefficients) {
    for (const Value& c : coefficients)
        if (const int sign = numbers.sign(c); sign != 0) return sign;
    return 0;
}

/// The normal of a facet with corners that move, as a polynomial of their d.
template <class N>
struct MovingNormal {
    std::array<Normal<N>, 3> by{};

    MovingNormal(const Facet<N>& facet, const std::array<Lengths<N>, 3>& moves) {
        const std::array<Lengths<N>, 2> sides{minus(facet.corners[1], facet.corners[0]),
                                              minus(facet.corners[2], facet.corners[0])};
        const std::array<Lengths<N>, 2> turns{minus(moves[1], moves[0]), minus(moves[2], moves[0])};
        by[0] = facet.normal;
        by[1] = sum<N>(cross<N>(turns[0], sides[1]), cross<N>(sides[0], turns[1]));
        by[2] = cross<N>(turns[0], turns[1]);
    }
    /// The value of its plane at a point, without the constant part; the plane's first corner is
    /// `from` that moves by `move`.
    [[nodiscard]] std::array<typename N::Value, 3> value(const Lengths<N>& point,
                                                         const Lengths<N>& from,
                                                         const Lengths<N>& move) const {
        const Lengths<N> way = minus(point, from);
        return {N::difference(dot<N>(by[1], way), dot<N>(by[0], move)),
                N::difference(dot<N>(by[2], way), dot<N>(by[1], move)),
                N::difference(typename N::Value{}, dot<N>(by[2], move))};
    }
    /// The sign of its product with the move along the axes.
    [[nodiscard]] int along(const N& numbers, const InfinitesimalShift& shift) const {
        std::array<int, 3> signs{};
        for (std::size_t k = 0; k < 3; ++k)
            signs[k] = first_sign(numbers, std::array{by[0][k], by[1][k], by[2][k]});
        return shift.along(signs);
    }
};

/// Of a pair of facets of which the second one's corners move. In doubles first derivatives alone
/// are looked at; where these leave it open, so do they.
template <class N>
class CornerDerivatives {
public:
    static constexpr bool is_uniform = false;

    CornerDerivatives(const N& numbers, const InfinitesimalShift& shift, const FacetCorners& second)
        : numbers_(numbers), shift_(shift) {
        for (std::size_t i = 0; i < 3; ++i) moves_[i] = lengths<N>(shift.moves->of(*second[i]));
    }
    /// Of the value of the first facet's plane at the second one's corner i.
    [[nodiscard]] int of_corner(const Facet<N>& first, std::size_t i) const {
        const int sign = numbers_.sign(dot<N>(first.normal, moves_[i]));
        return sign != 0 ? sign : sign_along(numbers_, shift_, first.normal);
    }
    /// Of the value of the second facet's plane at a point of the first mesh.
    [[nodiscard]] int of_plane(const Facet<N>& second, const Lengths<N>& point) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (point == second.corners[i])
                if (const int sign = numbers_.sign(dot<N>(second.normal, moves_[i])); sign != 0)
                    return -sign;
        const MovingNormal<N> normal(second, moves_);
        const auto value = normal.value(point, second.corners[0], moves_[0]);
        if constexpr (std::is_same_v<N, NearNumbers>) {
            return sign_in_doubles(value[0]);
        } else {
            const int sign = first_sign(numbers_, value);
            return sign != 0 ? sign : -normal.along(numbers_, shift_);
        }
    }
    /// Of det(p0 - qj, pi - qj, q0 - qj), where the second facet's corners q0 and qj are number
    /// `from` and `to`. It is linear in either.
    [[nodiscard]] int of_edges(const std::array<Lengths<N>, 2>& p,
                               const std::array<Lengths<N>, 2>& q, std::size_t from,
                               std::size_t to) const {
        const Lengths<N>& u0 = moves_[from];
        const Lengths<N>& uj = moves_[to];
        const Lengths<N> turn = minus(u0, uj);
        const Lengths<N> along = minus(p[1], p[0]);
        const Normal<N> n = cross<N>(along, minus(q[1], q[0]));
        const Normal<N> m = cross<N>(minus(p[0], q[1]), minus(p[1], q[1]));
        const typename N::Value first = N::sum(dot<N>(m, turn), dot<N>(n, uj));
        if constexpr (std::is_same_v<N, NearNumbers>) {
            return sign_in_doubles(first);
        } else {
            int sign = numbers_.sign(first);
            if (sign == 0) sign = -numbers_.sign(dot<N>(cross<N>(uj, along), u0));
            if (sign != 0) return sign;
            const Normal<N> later = cross<N>(along, minus(uj, u0));
            std::array<int, 3> signs{};
            for (std::size_t k = 0; k < 3; ++k)
                signs[k] = first_sign(numbers_, std::array{n[k], later[k]});
            return shift_.along(signs);
        }
    }

private:
    [[nodiscard]] int sign_in_doubles(const typename N::Value& v) const {
        const int sign = numbers_.sign(v);
        if (sign == 0) numbers_.leave_open();
        return sign;
    }

    const N& numbers_;
    const InfinitesimalShift& shift_;
    std::array<Lengths<N>, 3> moves_{};
};

}  // namespace trisect::detail::shifted
