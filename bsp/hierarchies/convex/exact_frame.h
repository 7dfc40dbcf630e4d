// SPDX-License-Identifier: Apache-2.0
//
// Integers behind a CommonFrame.
#pragma once

#include <array>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/hierarchies/convex/common_frame.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

/// Places of both bodies are integers here: x -> (M x + t) 2^bits, of points with at most so many
/// bits behind the point. A distance in this space is `scale` times the requested one.
struct CommonFrame::Exact {
    struct Map {
        std::array<std::array<mpz_class, 3>, 3> m;
        std::array<mpz_class, 3> t;
    };
    Map a;
    Map b;
    int bits = 0;
    mpq_class scale;

    [[nodiscard]] detail::VectorOf<mpz_class> place(Body body, const LatticePoint& p) const {
        const Map& map = body == Body::A ? a : b;
        return bits == 0 ? place_of_whole(map, p) : place_of_fractions(map, p);
    }

private:
    [[nodiscard]] static detail::VectorOf<mpz_class> place_of_whole(const Map& map,
                                                                    const LatticePoint& p) {
        static_assert(sizeof(long) == sizeof(std::int64_t), "GMP takes long");
        const auto x = detail::to_integers(p);
        detail::VectorOf<mpz_class> r;
        for (std::size_t i = 0; i < 3; ++i) {
            r[i] = map.t[i];
            r[i] += map.m[i][0] * static_cast<long>(x[0]);
            r[i] += map.m[i][1] * static_cast<long>(x[1]);
            r[i] += map.m[i][2] * static_cast<long>(x[2]);
        }
        return r;
    }
    [[nodiscard]] detail::VectorOf<mpz_class> place_of_fractions(const Map& map,
                                                                 const LatticePoint& p) const {
        detail::VectorOf<mpz_class> x;
        for (std::size_t k = 0; k < 3; ++k)
            x[k] =
                detail::to_gmp(WideInt<2>(detail::scaled_integer(detail::coordinate(p, k), bits)));
        detail::VectorOf<mpz_class> r;
        for (std::size_t i = 0; i < 3; ++i) {
            r[i] = map.t[i] << static_cast<mp_bitcnt_t>(bits);
            for (std::size_t k = 0; k < 3; ++k) r[i] += map.m[i][k] * x[k];
        }
        return r;
    }
};

}  // namespace trisect::hierarchies
