// SPDX-License-Identifier: Apache-2.0
//
// Six times the volume is a sum of determinants det(a, b, c) of corners relative to one of them.
//
// Filter: differences are rounded once (relative u = 2^-53), a product of three with two
// subtractions and additions more is within 8u of the sum M of the magnitudes of its six products,
// and adding n of them costs n·u of the sum of all M. Exact: entries below 2^54, a determinant
// below 6·2^162 < 2^165, so 2^32 triangles fit into 256 bits.

#include <trisect/brep/import/volume_sign.h>

#include <cmath>

#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

int filtered_sign(std::span<const LatticePoint> points,
                  std::span<const std::array<std::uint32_t, 3>> triangles,
                  const LatticePoint& origin) {
    double sum = 0;
    double magnitude = 0;
    for (const auto& t : triangles) {
        std::array<std::array<double, 3>, 3> m{};
        for (std::size_t i = 0; i < 3; ++i) {
            m[i] = minus(points[t[i]].doubles(), origin.doubles());
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const double p = m[1][(i + 1) % 3] * m[2][(i + 2) % 3];
            const double q = m[1][(i + 2) % 3] * m[2][(i + 1) % 3];
            sum += m[0][i] * (p - q);
            magnitude += std::fabs(m[0][i]) * (std::fabs(p) + std::fabs(q));
        }
    }
    const double bound = (3 * static_cast<double>(triangles.size()) + 16) * 0x1p-52 * magnitude;
    return sum > bound ? 1 : (sum < -bound ? -1 : 0);
}

// In units of 2^(-3 fraction_limit): differences below 2^127, minors below 2^255, terms below
// 2^382, so 2^32 triangles fit into 448 bits.
int sign_of_fractions(std::span<const LatticePoint> points,
                      std::span<const std::array<std::uint32_t, 3>> triangles,
                      const LatticePoint& origin) {
    WideInt<7> sum;
    const auto scaled = [](const LatticePoint& p, std::size_t k) {
        return scaled_integer(coordinate(p, k), fraction_limit);
    };
    for (const auto& t : triangles) {
        const auto fine = [&](std::size_t i, std::size_t k) {
            return WideInt<2>(scaled(points[t[i]], k) - scaled(origin, k));
        };
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            const auto minor =
                multiply<4>(fine(1, j), fine(2, k)) - multiply<4>(fine(1, k), fine(2, j));
            sum += multiply<7>(minor, fine(0, i));
        }
    }
    return sum.sign();
}

}  // namespace

int volume_sign(std::span<const LatticePoint> points,
                std::span<const std::array<std::uint32_t, 3>> triangles) {
    if (triangles.empty()) return 0;
    const LatticePoint origin = points[triangles[0][0]];
    if (const int s = filtered_sign(points, triangles, origin); s != 0) return s;
    const auto is_whole = [](const LatticePoint& p) { return p.is_whole(); };
    if (!std::ranges::all_of(points, is_whole)) return sign_of_fractions(points, triangles, origin);
    WideInt<4> sum;
    for (const auto& t : triangles) {
        const auto a = difference(points[t[0]], origin);
        const auto b = difference(points[t[1]], origin);
        const auto c = difference(points[t[2]], origin);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            const Int128 minor = Int128{b[j]} * c[k] - Int128{b[k]} * c[j];
            sum += multiply<4>(WideInt<2>(minor), WideInt<1>(a[i]));
        }
    }
    return sum.sign();
}

}  // namespace trisect::detail
