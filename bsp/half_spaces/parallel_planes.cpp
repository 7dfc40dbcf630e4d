// SPDX-License-Identifier: Apache-2.0
//
// Planes n x + d = 0 and m x + e = 0 with n and m parallel are compared by n_k e and m_k d, k being
// an axis along which neither normal is 0: where m = c n, the second value is e - c d on the first
// plane.

#include <trisect/bsp/half_spaces/parallel_planes.h>

#include <trisect/kernel/side.h>

namespace trisect::detail {

namespace {

using Product = WideInt<12>;

bool are_parallel(const Plane& p, const Plane& q) {
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1;
        if (multiply<12>(p.normal(i), q.normal(j)) != multiply<12>(p.normal(j), q.normal(i)))
            return false;
    }
    return true;
}

// Of the first plane with respect to the second one: -1 below, 0 on it, 1 above. \pre parallel
int side_of_plane(const Plane& of, const Plane& plane) {
    const int k = of.dominant_axis();
    const Product value =
        multiply<12>(of.normal(k), plane.offset()) - multiply<12>(plane.normal(k), of.offset());
    const int sign = value.is_zero() ? 0 : (value.is_negative() ? -1 : 1);
    return of.normal(k).is_negative() ? -sign : sign;
}

// Whether the sides of two parallel planes look the same way.
bool look_alike(const PlaneSide& a, const PlaneSide& b) {
    const int k = a.plane.dominant_axis();
    const bool same_way = a.plane.normal(k).is_negative() == b.plane.normal(k).is_negative();
    return same_way == (a.below == b.below);
}

}  // namespace

std::optional<std::vector<std::size_t>> tight_sides(std::span<const PlaneSide> sides) {
    std::vector<std::size_t> tight;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        bool is_tight = true;
        for (std::size_t j = 0; j < sides.size(); ++j) {
            if (i == j) continue;
            if (!are_parallel(sides[i].plane, sides[j].plane)) return std::nullopt;
            const int side = side_of_plane(sides[i].plane, sides[j].plane);
            if (side == 0) return std::nullopt;
            const bool is_inside = (side < 0) == sides[j].below;
            // A plane within the side of one that looks the same way is the tighter one; of two
            // that face each other either is within the side of the other.
            if (look_alike(sides[i], sides[j])) {
                is_tight = is_tight && is_inside;
            } else if (!is_inside) {
                return std::nullopt;
            }
        }
        if (is_tight) tight.push_back(i);
    }
    return tight;
}

bool are_ascending(std::span<const Plane> planes) {
    for (std::size_t i = 1; i < planes.size(); ++i) {
        const Plane& before = planes[i - 1];
        if (!are_parallel(before, planes[i]) || !look_alike({before, true}, {planes[i], true}) ||
            side_of_plane(planes[i], before) <= 0)
            return false;
    }
    return true;
}

}  // namespace trisect::detail
