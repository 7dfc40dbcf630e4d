// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/lattice_move.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

// Most bits of the offset of a plane through lattice points (plane.h).
constexpr int offset_bits = 380;

std::int64_t within(std::int64_t v, std::int64_t limit) {
    if (v >= limit || v <= -limit) throw LimitError("a moved solid leaves the lattice");
    return v;
}

// A sum of doubles that is one. A translation of 2^53 and more leaves no room for a fraction.
Coordinate with_fraction(double c, std::int64_t by) {
    const auto t = static_cast<double>(within(by, coordinate_limit));
    const double sum = c + t;
    if (sum - t != c || sum - c != t)
        throw LimitError("a moved coordinate has more digits than a double");
    if (!(std::fabs(sum) < static_cast<double>(coordinate_limit)))
        throw LimitError("a moved solid leaves the lattice");
    return Coordinate(sum);
}

}  // namespace

bool LatticeMove::is_mirror() const {
    const bool is_cycle = from[1] == (from[0] + 1) % 3;
    return (sign[0] * sign[1] * sign[2] < 0) == is_cycle;
}

int LatticeMove::image_of_axis(int axis) const {
    return static_cast<int>(std::ranges::find(from, axis) - from.begin());
}

LatticePoint LatticeMove::applied(const LatticePoint& p) const {
    const auto c = [&](std::size_t i) {
        const Coordinate from_here = p[from[i]];
        if (from_here.is_whole())
            return Coordinate(within(sign[i] * from_here.to_integer() + by[i], coordinate_limit));
        return with_fraction(sign[i] * from_here.to_double(), by[i]);
    };
    return {c(0), c(1), c(2)};
}

Box LatticeMove::applied(const Box& box) const {
    if (box.is_empty()) return box;
    Box out;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [lo, hi] = std::minmax({sign[i] * box.lo[from[i]], sign[i] * box.hi[from[i]]});
        // Boxes are rounded outwards, beyond the last lattice point.
        out.lo[i] = within(lo + by[i], coordinate_limit + 2);
        out.hi[i] = within(hi + by[i], coordinate_limit + 2);
    }
    return out;
}

std::int64_t LatticeMove::applied_to_wall(int axis, std::int64_t position) const {
    const auto i = static_cast<std::size_t>(image_of_axis(axis));
    return within(sign[i] * position + by[i] * splitting_scale, universe_limit);
}

FinePoint LatticeMove::applied(const FinePoint& p) const {
    FinePoint out;
    for (std::size_t i = 0; i < 3; ++i)
        out.c[i] = within(sign[i] * p.c[from[i]] + by[i] * splitting_scale, universe_limit);
    return out;
}

// n' = P n and n' · x' + d' = n · x + d.
Plane LatticeMove::applied(const Plane& plane) const {
    std::array<Plane::Coefficient, 3> n{};
    Plane::Coefficient d = plane.offset();
    for (std::size_t i = 0; i < 3; ++i) {
        n[i] = sign[i] < 0 ? -plane.normal(from[i]) : plane.normal(from[i]);
        d -= multiply<6>(n[i], WideInt<1>(by[i]));
    }
    if (d.bit_length() > offset_bits) throw LimitError("a moved plane leaves the lattice");
    return {n[0], n[1], n[2], d};
}

Approximation LatticeMove::applied(const Approximation& p) const {
    Approximation out;
    double rounding = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double c = sign[i] * p.c[from[i]];
        const auto t = static_cast<double>(by[i]);
        out.c[i] = c + t;
        if (out.c[i] - t != c || out.c[i] - c != t)
            rounding = std::max(rounding, std::fabs(out.c[i]) * 0x1p-52);
    }
    out.error = rounding == 0 ? p.error : (p.error + rounding) * (1 + 0x1p-50);
    return out;
}

}  // namespace trisect::detail
