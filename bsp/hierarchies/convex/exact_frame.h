// SPDX-License-Identifier: Apache-2.0
//
// Integers behind a CommonFrame.
#pragma once

#include <gmpxx.h>

#include <array>

#include <trisect/bsp/hierarchies/convex/common_frame.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::hierarchies {

/// Places of both bodies are integers here: x -> M x + t. A distance in this space is `scale` times
/// the requested one.
struct CommonFrame::Exact {
    struct Map {
        std::array<std::array<mpz_class, 3>, 3> m;
        std::array<mpz_class, 3> t;
    };
    Map a;
    Map b;
    mpq_class scale;

    [[nodiscard]] detail::VectorOf<mpz_class> place(Body body, const LatticePoint& p) const {
        static_assert(sizeof(long) == sizeof(std::int64_t), "GMP takes long");
        const auto x = detail::to_integers(p);
        const Map& map = body == Body::A ? a : b;
        detail::VectorOf<mpz_class> r;
        for (std::size_t i = 0; i < 3; ++i) {
            r[i] = map.t[i];
            r[i] += map.m[i][0] * static_cast<long>(x[0]);
            r[i] += map.m[i][1] * static_cast<long>(x[1]);
            r[i] += map.m[i][2] * static_cast<long>(x[2]);
        }
        return r;
    }
};

}  // namespace trisect::hierarchies
