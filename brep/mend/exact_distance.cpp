// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/exact_distance.h>

#include <cmath>
#include <limits>

#include <trisect/kernel/number/dyadic.h>

namespace trisect::detail {

namespace {

using Difference = std::array<WideInt<2>, 3>;

Difference fine_difference(const LatticePoint& a, const LatticePoint& b) {
    Difference out;
    for (int k = 0; k < 3; ++k)
        out[static_cast<std::size_t>(k)] =
            WideInt<2>(scaled_integer(a[k], fraction_limit) - scaled_integer(b[k], fraction_limit));
    return out;
}

WideInt<5> scalar_product(const Difference& a, const Difference& b) {
    WideInt<5> sum;
    for (std::size_t k = 0; k < 3; ++k) sum += multiply<5>(a[k], b[k]);
    return sum;
}

}  // namespace

double SquaredDistance::root() const {
    return std::ldexp(std::sqrt(numerator.to_double() / denominator.to_double()), -fraction_limit);
}

SquaredDistance squared_distance(const LatticePoint& a, const LatticePoint& b) {
    const Difference d = fine_difference(a, b);
    return {WideInt<9>(scalar_product(d, d)), 1};
}

// With the edge d and the way w to the point, |w|² |d|² - (w·d)² is |d|² times the squared
// distance.
FootOnEdge foot_on_edge(const LatticePoint& from, const LatticePoint& to,
                        const LatticePoint& point) {
    const Difference edge = fine_difference(to, from);
    const Difference way = fine_difference(point, from);
    const WideInt<5> length = scalar_product(edge, edge);
    FootOnEdge out;
    out.place = scalar_product(way, edge);
    out.is_inside = out.place.sign() > 0 && out.place < length;
    if (!out.is_inside) return out;
    out.distance.numerator =
        multiply<9>(scalar_product(way, way), length) - multiply<9>(out.place, out.place);
    out.distance.denominator = length;
    return out;
}

DistanceBound::DistanceBound(double bound, Lattice lattice) {
    const Dyadic d = dyadic(bound);
    square_ = multiply<2>(WideInt<1>(d.mantissa), WideInt<1>(d.mantissa));
    shift_ = 2 * (d.exponent - lattice.exponent + fraction_limit);
    above_ = std::nextafter(std::ldexp(bound, -lattice.exponent),
                            std::numeric_limits<double>::infinity());
}

// n / d <= s 2^shift, n <= s d 2^shift. s d has at most 362 bits, n at most 513.
bool DistanceBound::covers(const SquaredDistance& d) const {
    if (d.numerator.is_zero()) return true;
    if (square_.is_zero()) return false;
    const auto right = multiply<9>(d.denominator, square_);
    const int bits = d.numerator.bit_length();
    const int right_bits = right.bit_length() + shift_;
    if (bits != right_bits) return bits < right_bits;
    return shift_ >= 0 ? d.numerator <= right.shifted_left(shift_)
                       : d.numerator.shifted_left(-shift_) <= right;
}

}  // namespace trisect::detail
