// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/pose/reduced_map.h>

#include <algorithm>
#include <limits>
#include <string>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

template <class F>
void for_each_number(MapNumbers& map, F&& f) {
    f(map.s);
    for (IntVector& row : map.m)
        for (BoundedInt& v : row) f(v);
    for (BoundedInt& v : map.t) f(v);
}

}  // namespace

MapNumbers numbers_of(const Pose& pose) {
    MapNumbers r;
    r.s = pose.denominator();
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = pose.matrix(i, j);
        r.t[i] = pose.translation(i);
    }
    return r;
}

MapNumbers negated(const MapNumbers& map) {
    MapNumbers r = map;
    for_each_number(r, [](BoundedInt& v) { v = -v; });
    return r;
}

std::array<IntVector, 3> adjugate(const std::array<IntVector, 3>& rows) {
    std::array<IntVector, 3> r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            r[i][j] = cross(rows[(j + 1) % 3], rows[(j + 2) % 3], i);
    return r;
}

void remove_odd_factor(MapNumbers& map) {
    BoundedInt common = map.s.shifted_right(map.s.trailing_zeros());
    for_each_number(map, [&common](const BoundedInt& v) {
        if (common.bit_length() > 1) common = gcd(common, v);
    });
    common = common.shifted_right(common.trailing_zeros());
    if (common.bit_length() <= 1) return;
    for_each_number(map, [&common](BoundedInt& v) { v = divided_exactly(v, common); });
}

void remove_twos(MapNumbers& map, int m_shift, int t_shift, int limit) {
    const auto for_each = [&map, m_shift, t_shift](auto&& f) {
        f(map.s, 0);
        for (IntVector& row : map.m)
            for (BoundedInt& v : row) f(v, m_shift);
        for (BoundedInt& v : map.t) f(v, t_shift);
    };
    int lowest = std::numeric_limits<int>::max();
    int highest = std::numeric_limits<int>::min();
    for_each([&](const BoundedInt& v, int shift) {
        if (v.is_zero()) return;
        lowest = std::min(lowest, v.trailing_zeros() + shift);
        highest = std::max(highest, v.bit_length() + shift);
    });
    if (highest - lowest > limit)
        throw LimitError("a pose needs integers of " + std::to_string(highest - lowest) +
                         " bits; the limit is " + std::to_string(limit));
    for_each([lowest](BoundedInt& v, int shift) {
        const int by = shift - lowest;
        v = by >= 0 ? v.shifted_left(by) : v.shifted_right(-by);
    });
}

}  // namespace trisect::detail
