// SPDX-License-Identifier: Apache-2.0
//
// Ears are kept in a heap by the length of their diagonals. An ear is a corner that turns left and
// whose closed triangle holds no other corner but such at its own corners; it suffices to look at
// corners that do not turn left, since of the corners inside such a triangle one at least is of
// that kind. Those lie in a grid, and an ear is compared with the cells that its triangle meets,
// row by row.
//
// A corner that is no ear now becomes one only when a neighbour is cut: its diagonal does not lie
// in the polygon, so it lies in no part of the polygon either. Hence each corner is queued again
// only then, two for each ear, and a triangle is looked at once (O'Rourke 1998, sec. 1.4, with a
// heap in place of the outline's order).

#include <trisect/brep/face/short_ears.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trisect::detail {

namespace {

double as_double(Coordinate c) { return c.to_double(); }

// The cell of a coordinate, which may lie a rounding error beside the grid.
std::size_t cell_of(double at, double low, double per_unit, std::size_t count) {
    const double cell = (at - low) * per_unit;
    if (!(cell > 0)) return 0;
    return std::min(static_cast<std::size_t>(std::min(cell, 1e9)), count - 1);
}

struct Span {
    double low, high;
};

// The part of an edge between two values of v, in u; adds it to `span`.
void add_part(const FlatCorner& a, const FlatCorner& b, double bottom, double top, Span& span) {
    const double au = as_double(a.u);
    const double av = as_double(a.v);
    const double bu = as_double(b.u);
    const double bv = as_double(b.v);
    if (std::max(av, bv) < bottom || std::min(av, bv) > top) return;
    for (const double v : {std::clamp(av, bottom, top), std::clamp(bv, bottom, top)}) {
        const double u = av == bv ? au : au + (bu - au) * ((v - av) / (bv - av));
        span.low = std::min(span.low, u);
        span.high = std::max(span.high, u);
    }
    if (av == bv) {
        span.low = std::min(span.low, bu);
        span.high = std::max(span.high, bu);
    }
}

}  // namespace

std::size_t ShortEars::Grid::column_of(double at) const { return cell_of(at, u, per_u, columns); }
std::size_t ShortEars::Grid::row_of(double at) const { return cell_of(at, v, per_v, rows); }

void ShortEars::make_grid() {
    FlatCorner low = corners_[0];
    FlatCorner high = low;
    for (const FlatCorner& c : corners_) {
        low = {std::min(low.u, c.u), std::min(low.v, c.v)};
        high = {std::max(high.u, c.u), std::max(high.v, c.v)};
    }
    std::vector<Index> blocking;
    for (Index i = 0; i < corners_.size(); ++i)
        if (turn(corners_[prev_[i]], corners_[i], corners_[next_[i]]) <= 0) blocking.push_back(i);
    // About one of them in a cell.
    const double width = as_double(high.u) - as_double(low.u);
    const double height = as_double(high.v) - as_double(low.v);
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(blocking.size()))) + 1;
    grid_.u = as_double(low.u);
    grid_.v = as_double(low.v);
    grid_.columns = grid_.rows = side;
    grid_.per_u = width > 0 ? static_cast<double>(side) / width : 0;
    grid_.per_v = height > 0 ? static_cast<double>(side) / height : 0;
    const auto cell_at = [&](Index i) {
        return grid_.row_of(as_double(corners_[i].v)) * side +
               grid_.column_of(as_double(corners_[i].u));
    };
    grid_.begin.assign(side * side + 1, 0);
    for (const Index i : blocking) ++grid_.begin[cell_at(i) + 1];
    for (std::size_t c = 0; c < side * side; ++c) grid_.begin[c + 1] += grid_.begin[c];
    grid_.corners.resize(blocking.size());
    std::vector<std::uint32_t> next(grid_.begin.begin(), grid_.begin.end() - 1);
    for (const Index i : blocking) grid_.corners[next[cell_at(i)]++] = i;
}

void ShortEars::queue(Index at) {
    const FlatCorner& a = corners_[prev_[at]];
    const FlatCorner& b = corners_[next_[at]];
    if (turn(a, corners_[at], b) <= 0) return;
    const double u = as_double(b.u) - as_double(a.u);
    const double v = as_double(b.v) - as_double(a.v);
    queue_.push_back({u * u + v * v, at, prev_[at], next_[at]});
    std::push_heap(queue_.begin(), queue_.end(), LaterInQueue());
}

bool ShortEars::is_current(const Ear& ear) const {
    return cut_[ear.at] == 0 && prev_[ear.at] == ear.prev && next_[ear.at] == ear.next;
}

bool ShortEars::is_clear_of_cell(std::size_t cell, const Ear& ear) {
    const FlatCorner& a = corners_[ear.prev];
    const FlatCorner& b = corners_[ear.at];
    const FlatCorner& c = corners_[ear.next];
    comparisons_ += grid_.begin[cell + 1] - grid_.begin[cell];
    for (std::uint32_t n = grid_.begin[cell]; n < grid_.begin[cell + 1]; ++n) {
        const Index i = grid_.corners[n];
        if (cut_[i] != 0 || i == ear.prev || i == ear.at || i == ear.next) continue;
        const FlatCorner& p = corners_[i];
        if (turn(c, a, p) < 0 || turn(a, b, p) < 0 || turn(b, c, p) < 0) continue;
        if (p != a && p != b && p != c) return false;
    }
    return true;
}

bool ShortEars::is_clear(const Ear& ear) {
    const std::array<FlatCorner, 3> t{corners_[ear.prev], corners_[ear.at], corners_[ear.next]};
    const auto [low, high] = std::minmax({t[0].v, t[1].v, t[2].v});
    const std::size_t first_row = grid_.row_of(as_double(low));
    const std::size_t last_row = grid_.row_of(as_double(high));
    for (std::size_t row = first_row; row <= last_row; ++row) {
        // A row more on either side and a column more make up for rounding.
        const double cell = grid_.per_v > 0 ? 1 / grid_.per_v : 0;
        const double bottom = grid_.v + (static_cast<double>(row) - 0.5) * cell;
        const double top = grid_.v + (static_cast<double>(row) + 1.5) * cell;
        Span span{HUGE_VAL, -HUGE_VAL};
        for (std::size_t i = 0; i < 3; ++i) add_part(t[i], t[(i + 1) % 3], bottom, top, span);
        if (span.low > span.high) continue;
        const std::size_t left = grid_.column_of(span.low);
        const std::size_t first = left > 0 ? left - 1 : 0;
        const std::size_t last = std::min(grid_.column_of(span.high) + 1, grid_.columns - 1);
        for (std::size_t column = first; column <= last; ++column)
            if (!is_clear_of_cell(row * grid_.columns + column, ear)) return false;
    }
    return true;
}

bool ShortEars::triangulate(std::span<const FlatCorner> corners,
                            std::vector<std::array<std::uint32_t, 3>>& out) {
    corners_ = corners;
    comparisons_ = 0;
    const auto n = static_cast<Index>(corners.size());
    const std::size_t before = out.size();
    prev_.resize(n);
    next_.resize(n);
    cut_.assign(n, 0);
    queue_.clear();
    for (Index i = 0; i < n; ++i) {
        prev_[i] = i == 0 ? n - 1 : i - 1;
        next_[i] = i + 1 == n ? 0 : i + 1;
    }
    make_grid();
    for (Index i = 0; i < n; ++i) queue(i);
    Index left = n;
    while (left > 2 && !queue_.empty()) {
        std::pop_heap(queue_.begin(), queue_.end(), LaterInQueue());
        const Ear ear = queue_.back();
        queue_.pop_back();
        if (!is_current(ear) || !is_clear(ear)) continue;
        out.push_back({ear.prev, ear.at, ear.next});
        next_[ear.prev] = ear.next;
        prev_[ear.next] = ear.prev;
        cut_[ear.at] = 1;
        --left;
        queue(ear.prev);
        queue(ear.next);
    }
    if (left > 2) out.resize(before);
    return left == 2;
}

}  // namespace trisect::detail
