// SPDX-License-Identifier: Apache-2.0
//
// Differences of coordinates are integers below 2^56, exact; as doubles they have one rounding.
//
// In doubles: a product of three differences has a relative error below 6 · 2^-53, a determinant of
// three rows, six such products and five sums, below 12 · 2^-53 of the sum of the magnitudes, and
// the one of the sphere, whose terms have one factor more, a sum of squares, below 24 · 2^-53 of
// that. The bounds used are 2^-49 and 2^-48.
//
// Exactly: a determinant of three rows is below 6 · 2^168, which 192 bits hold; times a sum of
// squares below 3 · 2^112, four of these, it is below 2^287, for which there are 320.

#include <trisect/bsp/hierarchies/partitions/sphere_signs.h>

#include <cmath>
#include <cstddef>

#include <trisect/kernel/wide_int.h>

namespace trisect::hierarchies {

namespace {

using Row = std::array<std::int64_t, 3>;
using Minor = WideInt<3>;

Row minus(const IntegerPoint& a, const IntegerPoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct Filtered {
    double value = 0;
    double size = 0;  // sum of magnitudes of all terms
};

Filtered filtered_determinant(const Row& x, const Row& y, const Row& z) {
    Filtered r;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto f = static_cast<double>(x[i]);
        const double p = static_cast<double>(y[(i + 1) % 3]) * static_cast<double>(z[(i + 2) % 3]);
        const double q = static_cast<double>(y[(i + 2) % 3]) * static_cast<double>(z[(i + 1) % 3]);
        r.value += f * (p - q);
        r.size += std::abs(f) * (std::abs(p) + std::abs(q));
    }
    return r;
}

Minor exact_determinant(const Row& x, const Row& y, const Row& z) {
    Minor r;
    for (std::size_t i = 0; i < 3; ++i) {
        const Int128 minor = static_cast<Int128>(y[(i + 1) % 3]) * z[(i + 2) % 3] -
                             static_cast<Int128>(y[(i + 2) % 3]) * z[(i + 1) % 3];
        r += multiply<3>(WideInt<2>(minor), WideInt<1>(x[i]));
    }
    return r;
}

}  // namespace

int orientation(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c,
                const IntegerPoint& d) {
    const Row x = minus(b, a);
    const Row y = minus(c, a);
    const Row z = minus(d, a);
    const Filtered f = filtered_determinant(x, y, z);
    const double bound = 0x1p-49 * f.size;
    if (f.value > bound) return 1;
    if (f.value < -bound) return -1;
    return exact_determinant(x, y, z).sign();
}

int side_of_sphere(const std::array<IntegerPoint, 4>& t, const IntegerPoint& p) {
    // With rows relative to p and squares q: the determinant of (row, q), developed along q. Its
    // sign is that of the case where p is the centre, where all q are equal.
    std::array<Row, 4> row;
    for (std::size_t i = 0; i < 4; ++i) row[i] = minus(t[i], p);
    double value = 0;
    double size = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        double square = 0;
        for (const std::int64_t c : row[i])
            square += static_cast<double>(c) * static_cast<double>(c);
        const Filtered f =
            filtered_determinant(row[(i + 1) % 4], row[(i + 2) % 4], row[(i + 3) % 4]);
        value += (i % 2 == 0 ? square : -square) * f.value;
        size += square * f.size;
    }
    const double bound = 0x1p-48 * size;
    if (value > bound) return 1;
    if (value < -bound) return -1;
    WideInt<5> sum;
    for (std::size_t i = 0; i < 4; ++i) {
        Int128 square = 0;
        for (const std::int64_t c : row[i]) square += static_cast<Int128>(c) * c;
        const WideInt<5> term =
            multiply<5>(WideInt<2>(square),
                        exact_determinant(row[(i + 1) % 4], row[(i + 2) % 4], row[(i + 3) % 4]));
        i % 2 == 0 ? sum += term : sum -= term;
    }
    return sum.sign();
}

}  // namespace trisect::hierarchies
