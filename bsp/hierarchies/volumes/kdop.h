// SPDX-License-Identifier: Apache-2.0
//
// KDop: slabs of fixed directions as a bounding volume, with rotation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/tree_frame.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/float_above.h>

namespace trisect::hierarchies {

/// The directions of k-DOPs, as Klosowski et al. (1998) choose them: axes of the cube (k = 6), with
/// corners (14), with edges (18), with both (26). Of each pair of opposite directions one.
template <std::size_t K>
constexpr std::array<std::array<int, 3>, K / 2> kdop_directions() {
    static_assert(K == 6 || K == 14 || K == 18 || K == 26);
    constexpr std::array<std::array<int, 3>, 13> all{{{1, 0, 0},
                                                      {0, 1, 0},
                                                      {0, 0, 1},
                                                      {1, 1, 1},
                                                      {1, 1, -1},
                                                      {1, -1, 1},
                                                      {-1, 1, 1},
                                                      {1, 1, 0},
                                                      {1, -1, 0},
                                                      {1, 0, 1},
                                                      {1, 0, -1},
                                                      {0, 1, 1},
                                                      {0, 1, -1}}};
    std::array<std::array<int, 3>, K / 2> r{};
    for (std::size_t i = 0; i < K / 2; ++i) r[i] = all[K == 18 && i >= 3 ? i + 4 : i];
    return r;
}

/// How the slabs of one set of directions are turned by a map: which three slabs bound a new
/// direction, and with which weights. In kdop_turn.cpp.
struct KDopTurn {
    struct Bound {
        std::array<std::uint8_t, 3> from{};  ///< of the 2 n directions, those with minus behind
        std::array<double, 3> weight{};      ///< not negative
        double shift = 0;                    ///< what the translation adds, and errors
    };
    std::vector<Bound> bounds;  ///< for all 2 n directions

    KDopTurn(std::span<const std::array<int, 3>> directions, const FrameMap& map);
};

/// What is within all slabs -back_i <= d_i · x <= reach_i, in units of a TreeFrame. Whatever it was
/// made from is inside, exactly.
template <std::size_t K>
struct KDop {
    static constexpr std::size_t n = K / 2;
    static constexpr std::array<std::array<int, 3>, n> directions = kdop_directions<K>();

    /// reach_i in the first half, back_i in the second. Empty at first.
    std::array<float, 2 * n> h;

    KDop() { h.fill(-std::numeric_limits<float>::infinity()); }

    /// Points, known within `error` in each coordinate, and |x_i| <= 2^10. \pre there are some
    ///
    /// Sums of three numbers are rounded by less than 3·2^-53 of the sum of magnitudes.
    void add(std::span<const std::array<double, 3>> points, double error) {
        std::array<double, n> reach;
        std::array<double, n> back;
        reach.fill(-std::numeric_limits<double>::infinity());
        back.fill(-std::numeric_limits<double>::infinity());
        double size = 0;
        for (const std::array<double, 3>& x : points) {
            size = std::max(size, std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
            for (std::size_t i = 0; i < n; ++i) {
                const double v =
                    directions[i][0] * x[0] + directions[i][1] * x[1] + directions[i][2] * x[2];
                reach[i] = std::max(reach[i], v);
                back[i] = std::max(back[i], -v);
            }
        }
        const double off = 3.01 * error + 0x1p-50 * size;
        for (std::size_t i = 0; i < n; ++i) {
            h[i] = std::max(h[i], float_above(reach[i] + off));
            h[n + i] = std::max(h[n + i], float_above(back[i] + off));
        }
    }
    void add(const KDop& o) {
        for (std::size_t i = 0; i < 2 * n; ++i) h[i] = std::max(h[i], o.h[i]);
    }
    /// Whether the slabs of every direction have a common point: not so only if the volumes have
    /// none.
    [[nodiscard]] bool meets(const KDop& o) const {
        // Rounding to nearest keeps the sign of a sum, and apart means that it is negative.
        int apart = 0;
        for (std::size_t i = 0; i < n; ++i)
            apart |= int{h[i] + o.h[n + i] < 0} | int{o.h[i] + h[n + i] < 0};
        return apart == 0;
    }
    /// A lower bound of the distance, in units; 0 when they meet.
    [[nodiscard]] double gap(const KDop& o) const {
        double best = 0;
        double box = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double g = -std::min(static_cast<double>(h[i]) + static_cast<double>(o.h[n + i]),
                                       static_cast<double>(o.h[i]) + static_cast<double>(h[n + i]));
            if (!(g > 0)) continue;
            if (i < 3)
                box += g * g;
            else
                best = std::max(best, g * inverse_length(i));
        }
        return std::max(best, std::sqrt(box)) * detail::surely_less;
    }
    [[nodiscard]] float size() const {
        return (h[0] + h[n]) + (h[1] + h[n + 1]) + (h[2] + h[n + 2]);
    }
    /// The slabs of the image.
    [[nodiscard]] KDop turned(const KDopTurn& turn) const {
        KDop r;
        for (std::size_t i = 0; i < 2 * n; ++i) {
            const KDopTurn::Bound& b = turn.bounds[i];
            r.h[i] = static_cast<float>(((b.weight[0] * static_cast<double>(h[b.from[0]]) +
                                          b.weight[1] * static_cast<double>(h[b.from[1]])) +
                                         b.weight[2] * static_cast<double>(h[b.from[2]])) +
                                        b.shift);
        }
        return r;
    }

private:
    static constexpr double inverse_length(std::size_t i) {
        const auto& d = directions[i];
        const int square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        return square == 1 ? 1 : square == 2 ? 0.70710678118654 : 0.57735026918962;
    }
};

}  // namespace trisect::hierarchies
