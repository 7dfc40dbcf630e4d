// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/axis_plane_pairs.h>

#include <array>
#include <cmath>
#include <cstddef>

#include <trisect/bsp/cells/shift/corner_moves.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

// The axis that all six corners have one coordinate along; else 3.
int common_axis(const FacetCorners& first, const FacetCorners& second) {
    int axis = 0;
    const auto are_across = [&] {
        const Coordinate at = (*first[0])[axis];
        return (*second[0])[axis] == at && (*first[1])[axis] == at && (*second[1])[axis] == at &&
               (*first[2])[axis] == at && (*second[2])[axis] == at;
    };
    while (axis < 3 && !are_across()) ++axis;
    return axis;
}

// Of the only component of a facet's normal; 0 where doubles leave it open. Differences carry one
// rounding each, and minor_rounding is for their products.
int normal_sign(const FacetCorners& facet, int axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<std::array<double, 2>, 3> at;
    for (std::size_t i = 0; i < 3; ++i)
        at[i] = {(*facet[i])[u].to_double(), (*facet[i])[v].to_double()};
    const double a = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]);
    const double b = (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
    return certain_sign(a - b, bound_slack * minor_rounding * (std::fabs(a) + std::fabs(b)));
}

int sign_of_difference(Coordinate a, Coordinate b) { return a < b ? -1 : (b < a ? 1 : 0); }

}  // namespace

std::optional<ShiftedPair> relate_across_axis(const FacetCorners& first, const FacetCorners& second,
                                              const InfinitesimalShift& shift) {
    const int axis = common_axis(first, second);
    if (axis == 3) return std::nullopt;
    const int normal = normal_sign(first, axis);
    const int other = normal_sign(second, axis);
    if (normal == 0 || other == 0) return std::nullopt;
    const auto k = static_cast<std::size_t>(axis);
    std::array<int, 3> along{};
    along[k] = 1;
    const int along_axis = shift.along(along);
    // Where the second one goes along the axis.
    int up = 0;
    if (shift.moves != nullptr) {
        std::array<int, 3> ways{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int32_t move = shift.moves->of(*second[i])[k];
            ways[i] = move != 0 ? (move > 0 ? 1 : -1) : along_axis;
        }
        if (ways[0] != ways[1] || ways[0] != ways[2]) return std::nullopt;
        up = ways[0];
    } else {
        const Coordinate at = (*first[0])[axis];
        if (shift.growth != 0) up = shift.growth * sign_of_difference(at, shift.centre[axis]);
        if (up == 0 && shift.growth != 0 && shift.next_growth != 0)
            up = shift.next_growth * sign_of_difference(at, shift.next_centre[axis]);
        if (up == 0) up = along_axis;
    }
    ShiftedPair out;
    out.kind = ShiftedPair::Kind::Coplanar;
    out.same_side = normal == other;
    out.is_above = up == normal;
    return out;
}

}  // namespace trisect::detail
