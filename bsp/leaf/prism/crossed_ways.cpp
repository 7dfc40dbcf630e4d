// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/prism/crossed_ways.h>

#include <algorithm>

#include <trisect/bsp/cells/cell.h>
#include <trisect/kernel/number/dyadic.h>

namespace trisect::detail {

namespace {

// In units of 2^-fraction_limit / 192: positions are below 2^61, coordinates below 2^126 in units
// of 2^-fraction_limit, so both are below 2^134.
using Fine = WideInt<3>;

Fine fine(Coordinate c) {
    return multiply<3>(WideInt<2>(scaled_integer(c, fraction_limit)), WideInt<1>(splitting_scale));
}

Fine fine(std::int64_t position) { return Fine(position).shifted_left(fraction_limit); }

// Differences are below 2^135, products below 2^270.
bool crosses_way_exactly(const PrismSideFace& w, const FlatFinePoint& p) {
    const Fine from_v = fine(w.from.v);
    const Fine to_v = fine(w.to.v);
    const Fine v = fine(p[1]);
    if ((from_v > v) == (to_v > v)) return false;
    const Fine from_u = fine(w.from.u);
    const auto left = multiply<5>(fine(w.to.u) - from_u, v - from_v);
    const auto right = multiply<5>(to_v - from_v, fine(p[0]) - from_u);
    return (left > right) == (to_v > from_v);
}

}  // namespace

bool crosses_way(const PrismSideFace& w, const FlatFinePoint& p) {
    const std::array<double, 2> rounded{rounded_position(p[0]), rounded_position(p[1])};
    const double error =
        error_slack * last_place * std::max(std::fabs(rounded[0]), std::fabs(rounded[1]));
    const auto certain = crosses_way(w, rounded, error);
    return certain ? *certain : crosses_way_exactly(w, p);
}

int compare(Coordinate c, std::int64_t position) { return (fine(c) - fine(position)).sign(); }

}  // namespace trisect::detail
