// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/lattice.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect {

namespace {

// Exponent of the lowest set bit of a finite non-zero double.
int lowest_bit(double v) {
    int e = 0;
    const double m = std::frexp(v, &e);  // |m| in [1/2, 1)
    const auto i = static_cast<std::uint64_t>(std::fabs(std::ldexp(m, 53)));
    return e - 53 + std::countr_zero(i);
}

// v · 2^e. A product with a power of two rounds like ldexp and is many times faster.
double scaled(double v, int e) {
    if (e < -1022 || e > 1023) return std::ldexp(v, e);
    return v * std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52);
}

int floor_to_multiple_of_8(int e) { return (e >= 0 ? e / 8 : -((-e + 7) / 8)) * 8; }
int ceil_to_multiple_of_8(int e) { return -floor_to_multiple_of_8(-e); }

}  // namespace

double Lattice::to_double(double lattice_units) const { return scaled(lattice_units, exponent); }

Lattice choose_lattice(std::span<const std::array<double, 3>> points) {
    int lowest = std::numeric_limits<int>::max();
    double largest = 0;
    for (const auto& p : points) {
        for (const double c : p) {
            if (c == 0 || !std::isfinite(c)) continue;
            largest = std::max(largest, std::fabs(c));
            lowest = std::min(lowest, lowest_bit(c));
        }
    }
    if (largest == 0) return {0};
    int top = 0;
    std::frexp(largest, &top);  // largest < 2^top
    const int coarsest_lossless = floor_to_multiple_of_8(lowest);
    const int finest_with_room = ceil_to_multiple_of_8(top - (coordinate_bits - growth_bits));
    return {std::max(coarsest_lossless, finest_with_room)};
}

std::vector<LatticePoint> to_lattice(std::span<const std::array<double, 3>> points, Lattice lattice,
                                     LatticeReport& report) {
    report.lattice = lattice;
    std::vector<LatticePoint> out(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::array<std::int64_t, 3> c{};
        bool moved = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const double units = scaled(points[i][k], -lattice.exponent);
            if (!(std::fabs(units) < static_cast<double>(coordinate_limit)))
                throw LimitError("vertex " + std::to_string(i) + ": coordinate " +
                                 std::to_string(points[i][k]) +
                                 " is not finite or outside the lattice of unit 2^" +
                                 std::to_string(lattice.exponent));
            const double r = std::nearbyint(units);
            c[k] = static_cast<std::int64_t>(r);
            // Scaling a tiny coordinate may underflow to the zero that it is rounded to.
            if (r != units || (r == 0 && points[i][k] != 0)) {
                moved = true;
                const double move = r == 0 ? std::fabs(points[i][k])
                                           : std::ldexp(std::fabs(r - units), lattice.exponent);
                report.max_move = std::max(report.max_move, move);
            }
        }
        if (moved) ++report.moved;
        out[i] = {c[0], c[1], c[2]};
    }
    report.lossless = report.lossless && report.moved == 0;
    return out;
}

}  // namespace trisect
