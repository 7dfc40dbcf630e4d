// SPDX-License-Identifier: Apache-2.0
#include "operand.h"

#include <algorithm>
#include <map>
#include <utility>

#include "plane.h"

namespace reference {

bool is_balanced(const Operand& operand) {
    std::map<std::pair<LatticePoint, LatticePoint>, int> balances;
    for (const Triangle& triangle : operand) {
        for (std::size_t i = 0; i < 3; ++i) {
            const LatticePoint& from = triangle[i];
            const LatticePoint& to = triangle[(i + 1) % 3];
            balances[std::minmax(from, to)] += from < to ? 1 : from == to ? 0 : -1;
        }
    }
    return std::all_of(balances.begin(), balances.end(),
                       [](const auto& entry) { return entry.second == 0; });
}

Rational signed_volume(const Operand& operand) {
    Integer sum = 0;
    for (const Triangle& t : operand) {
        std::array<std::array<Integer, 3>, 3> c;
        for (std::size_t i = 0; i < 3; ++i) {
            c[i] = {to_integer(t[i][0]), to_integer(t[i][1]), to_integer(t[i][2])};
        }
        sum += c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) +
               c[0][1] * (c[1][2] * c[2][0] - c[1][0] * c[2][2]) +
               c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
    }
    return fraction(sum, 6);
}

std::vector<Polygon> polygons_of(const Operand& triangles) {
    std::vector<Polygon> polygons;
    for (const Triangle& t : triangles) {
        if (const auto plane = plane_through(t[0], t[1], t[2])) {
            polygons.push_back({*plane, {{to_point(t[0]), to_point(t[1]), to_point(t[2])}}});
        }
    }
    return polygons;
}

}  // namespace reference
