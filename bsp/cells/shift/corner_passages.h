// SPDX-License-Identifier: Apache-2.0
//
// Edges and lines through facets of two meshes, as corners move.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <trisect/bsp/cells/shift/corner_derivatives.h>

namespace trisect::detail::shifted {

template <class N>
using Cubic = std::array<typename N::Value, 4>;

/// What edges and facets are, as polynomials of d.
template <class N>
class MovingValues {
public:
    /// Those of one mesh move.
    MovingValues(const InfinitesimalShift& shift, bool points_move)
        : shift_(shift), points_move_(points_move) {}

    /// Where points move, by `move`, facets do not.
    [[nodiscard]] Cubic<N> value(const FacetCorners& corners, const Facet<N>& facet,
                                 const Lengths<N>& point, const Lengths<N>& move) const {
        Cubic<N> out{facet.value(point)};
        if (points_move_) {
            out[1] = dot<N>(facet.normal, move);
        } else {
            const std::array<Lengths<N>, 3> moves = moves_of(corners);
            const auto rest =
                MovingNormal<N>(facet, moves).value(point, facet.corners[0], moves[0]);
            for (std::size_t i = 0; i < 3; ++i) out[i + 1] = rest[i];
        }
        return out;
    }
    [[nodiscard]] std::array<Normal<N>, 3> normal(const FacetCorners& corners,
                                                  const Facet<N>& facet) const {
        if (points_move_) return {facet.normal};
        return MovingNormal<N>(facet, moves_of(corners)).by;
    }
    [[nodiscard]] Lengths<N> move_of(const LatticePoint& point) const {
        return points_move_ ? lengths<N>(shift_.moves->of(point)) : Lengths<N>{};
    }
    [[nodiscard]] std::array<Lengths<N>, 3> moves_of(const FacetCorners& corners) const {
        std::array<Lengths<N>, 3> out{};
        for (std::size_t i = 0; !points_move_ && i < 3; ++i)
            out[i] = lengths<N>(shift_.moves->of(*corners[i]));
        return out;
    }

private:
    const InfinitesimalShift& shift_;
    bool points_move_;
};

/// The sign of a0 b1 - a1 b0.
template <class N, class Number, std::size_t D>
int sign_of_products(const std::array<std::array<Number, D>, 2>& a,
                     const std::array<Cubic<N>, 2>& b) {
    for (std::size_t k = 0; k < D + 3; ++k) {
        decltype(N::product(a[0][0], b[0][0])) sum;
        for (std::size_t i = 0; i < D; ++i) {
            if (i > k || k - i > 3) continue;
            sum += N::product(a[0][i], b[1][k - i]) - N::product(a[1][i], b[0][k - i]);
        }
        if (const int sign = sum.sign(); sign != 0) return sign;
    }
    return 0;
}

/// See order_along_shifted().
template <class N>
int order_along_moved(const LatticePoint& from, const LatticePoint& to, bool is_second,
                      const std::array<FacetCorners, 2>& corners, const InfinitesimalShift& shift) {
    const N numbers;
    const MovingValues<N> moving(shift, is_second);
    std::array<Cubic<N>, 2> start;
    std::array<Cubic<N>, 2> drop;
    std::array<std::array<Normal<N>, 3>, 2> normals;
    int drops = 1;
    for (std::size_t i = 0; i < 2; ++i) {
        const Facet<N> facet(corners[i]);
        start[i] = moving.value(corners[i], facet, lengths<N>(from), moving.move_of(from));
        const Cubic<N> end = moving.value(corners[i], facet, lengths<N>(to), moving.move_of(to));
        for (std::size_t k = 0; k < 4; ++k) drop[i][k] = start[i][k] - end[k];
        drops *= first_sign(numbers, drop[i]);
        normals[i] = moving.normal(corners[i], facet);
    }
    if (const int sign = sign_of_products<N>(start, drop); sign != 0) return sign * drops;
    std::array<int, 3> signs{};
    for (std::size_t k = 0; k < 3; ++k) {
        std::array<std::array<typename N::Area, 3>, 2> along;
        for (std::size_t i = 0; i < 2; ++i)
            along[i] = {normals[i][0][k], normals[i][1][k], normals[i][2][k]};
        signs[k] = sign_of_products<N>(along, drop);
    }
    const int moved = shift.along(signs);
    return (is_second ? moved : -moved) * drops;
}

/// See passage_shifted().
template <class N>
std::optional<int> passage_moved(const LatticePoint& from, const LatticePoint& to, bool is_second,
                                 const FacetCorners& corners, const InfinitesimalShift& shift) {
    const N numbers;
    const Facet<N> facet(corners);
    const MovingValues<N> moving(shift, is_second);
    const Lengths<N> p = lengths<N>(from);
    const Lengths<N> q = lengths<N>(to);
    const Lengths<N> move = moving.move_of(from);
    const std::array<Normal<N>, 3> normal = moving.normal(corners, facet);
    const auto along = [&](const std::array<Normal<N>, 3>& n) {
        std::array<int, 3> signs{};
        for (std::size_t k = 0; k < 3; ++k)
            signs[k] = first_sign(numbers, std::array{n[0][k], n[1][k], n[2][k]});
        return is_second ? shift.along(signs) : -shift.along(signs);
    };
    const auto side = [&](const Lengths<N>& at) {
        const int sign = first_sign(numbers, moving.value(corners, facet, at, move));
        return sign != 0 ? sign : along(normal);
    };
    const int start = side(p);
    if (start == side(q)) return 0;
    const Lengths<N> d = minus(q, p);
    const std::array<Lengths<N>, 3> moves = moving.moves_of(corners);
    for (std::size_t e = 0; e < 3; ++e) {
        const std::size_t f = (e + 1) % 3;
        const Lengths<N> way = minus(facet.corners[e], p);
        const Lengths<N> turn = minus(moves[e], move);
        const Normal<N> n = cross<N>(d, minus(facet.corners[f], facet.corners[e]));
        const Normal<N> later = cross<N>(d, minus(moves[f], moves[e]));
        int sign = first_sign(
            numbers,
            std::array{dot<N>(n, way), dot<N>(later, way) + dot<N>(n, turn), dot<N>(later, turn)});
        if (sign == 0) sign = -along({n, later});
        if (sign == 0) return std::nullopt;
        if (sign != start) return 0;
    }
    return -start;
}

}  // namespace trisect::detail::shifted
