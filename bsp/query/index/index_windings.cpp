// SPDX-License-Identifier: Apache-2.0
//
// With M the largest coordinate of a triangle or line in the block's units, a corner is within
// 2^-50 M of its place. The turn (b' - b)(C - c) - (c' - c)(B - b) of a line's point (B, C) about
// an edge has factors of at most 2 M with errors of at most 2^-48 M, so it errs by less than
// 2^-45 M^2. Where all three turns are larger, the place of the crossing is their mean of the
// corners' coordinates, weighted by turns: it errs by 2^-42 M^3 / sum at most.

#include <trisect/bsp/query/index/index_windings.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/query/index/index_signs.h>

namespace trisect::detail {

namespace {

struct IntegerRange {
    int lo = 0;
    int hi = -1;
};

// The integers from lo to hi below n, n < 2^20. No call of floor, which is one of a library.
IntegerRange integers(double lo, double hi, std::uint32_t n) {
    const double last = static_cast<double>(n) - 1;
    if (!(hi >= 0) || lo > last) return {};
    return {lo > 0 ? static_cast<int>(lo + 1) : 0, static_cast<int>(std::min(hi, last))};
}

}  // namespace

std::int64_t fine_position(double v) {
    return 3 * static_cast<std::int64_t>(v * static_cast<double>(dyadic_scale));
}

void IndexWindings::reset(const Vector& origin, const Vector& step,
                          const std::array<std::uint32_t, 3>& n) {
    origin_ = origin;
    step_ = step;
    n_ = n;
    winding_.assign(std::size_t{n[0]} * n[1] * n[2], 0);
}

FinePoint IndexWindings::corner(const std::array<std::uint32_t, 3>& at) const {
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k)
        p.c[k] = fine_position(origin_[k] + step_[k] * static_cast<double>(at[k]));
    return p;
}

bool IndexWindings::add(const BlockItem& item) {
    double largest = 8;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max(largest,
                           std::max(std::max(-item.lo[k], item.hi[k]), static_cast<double>(n_[k])));
    const double margin = std::max(0x1p-30, largest * 0x1p-46);
    if (!add_along<0>(item, margin, largest)) return false;
    // The others are lines of the block's lower sides.
    if (item.lo[0] > margin) return true;
    if (!add_along<1>(item, margin, largest)) return false;
    return item.lo[1] > margin || add_along<2>(item, margin, largest);
}

template <std::size_t Axis>
bool IndexWindings::add_along(const BlockItem& item, double margin, double largest) {
    constexpr std::size_t b = (Axis + 1) % 3;
    constexpr std::size_t c = (Axis + 2) % 3;
    // How many lines there are: along x everywhere, and so on.
    const IntegerRange rows =
        integers(item.lo[b] - margin, item.hi[b] + margin, b < Axis ? 1 : n_[b]);
    if (rows.lo > rows.hi) return true;
    const IntegerRange columns =
        integers(item.lo[c] - margin, item.hi[c] + margin, c < Axis ? 1 : n_[c]);
    if (columns.lo > columns.hi) return true;
    if (item.hi[Axis] < -margin || item.lo[Axis] > static_cast<double>(n_[Axis])) return true;
    for (int row = rows.lo; row <= rows.hi; ++row)
        for (int column = columns.lo; column <= columns.hi; ++column) {
            std::array<std::uint32_t, 3> line{};
            line[b] = static_cast<std::uint32_t>(row);
            line[c] = static_cast<std::uint32_t>(column);
            if (item.is_triangle && add_quickly<Axis>(item, line, largest)) continue;
            if (!add_exactly(item, Axis, line)) return false;
        }
    return true;
}

// A triangle and a line in doubles; false when they cannot decide.
template <std::size_t Axis>
bool IndexWindings::add_quickly(const BlockItem& item, std::array<std::uint32_t, 3> line,
                                double largest) {
    constexpr std::size_t b = (Axis + 1) % 3;
    constexpr std::size_t c = (Axis + 2) % 3;
    const double bound = 0x1p-45 * largest * largest;
    const auto& p = item.corner;
    const auto row = static_cast<double>(line[b]);
    const auto column = static_cast<double>(line[c]);
    const auto turn = [&](std::size_t s, std::size_t e) {
        return (p[e][b] - p[s][b]) * (column - p[s][c]) - (p[e][c] - p[s][c]) * (row - p[s][b]);
    };
    // About the edge opposite to a corner.
    const double t0 = turn(1, 2);
    const double t1 = turn(2, 0);
    const double t2 = turn(0, 1);
    const double lo = std::min(std::min(t0, t1), t2);
    const double hi = std::max(std::max(t0, t1), t2);
    if (hi > bound && lo < -bound) return true;
    if (!(lo > bound || hi < -bound)) return false;
    const double sum = t0 + t1 + t2;
    const double at = (t0 * p[0][Axis] + t1 * p[1][Axis] + t2 * p[2][Axis]) / sum;
    const double error = std::max(0x1p-20, 0x1p-42 * largest * largest * largest / std::fabs(sum));
    if (at < -error || at > static_cast<double>(n_[Axis] - 1) + error) return true;
    const auto i = static_cast<std::uint32_t>(std::max(at, 0.0));
    const double part = at - static_cast<double>(i);
    if (!(part > error && part < 1 - error)) return false;
    line[Axis] = i + 1;
    // Upwards through a facet whose normal points up: from inside to outside.
    winding_[number(line)] += (sum > 0) != polygons_->is_flipped(item.id) ? -1 : 1;
    return true;
}

bool IndexWindings::add_exactly(const BlockItem& item, std::size_t axis,
                                std::array<std::uint32_t, 3> line) {
    if (n_[axis] < 2) return true;
    const IntegerRange steps = integers(item.lo[axis] - 1.001, item.hi[axis] + 0.001, n_[axis] - 1);
    for (int i = steps.lo; i <= steps.hi; ++i) {
        line[axis] = static_cast<std::uint32_t>(i);
        const Reference from(corner(line));
        line[axis] = static_cast<std::uint32_t>(i) + 1;
        const Passing passed = passing(*polygons_, item.id, IndexPoint(corner(line)), from);
        if (passed == Passing::On) return false;
        const int change = static_cast<int>(passed);
        winding_[number(line)] += polygons_->is_flipped(item.id) ? -change : change;
    }
    return true;
}

void IndexWindings::finish(std::int32_t start) {
    winding_[0] = start;
    for (std::uint32_t z = 1; z < n_[2]; ++z)
        winding_[number({0, 0, z})] += winding_[number({0, 0, z - 1})];
    for (std::uint32_t z = 0; z < n_[2]; ++z) {
        for (std::uint32_t y = 1; y < n_[1]; ++y)
            winding_[number({0, y, z})] += winding_[number({0, y - 1, z})];
        for (std::uint32_t y = 0; y < n_[1]; ++y) {
            std::int32_t* row = &winding_[number({0, y, z})];
            for (std::uint32_t x = 1; x < n_[0]; ++x) row[x] += row[x - 1];
        }
    }
}

}  // namespace trisect::detail
