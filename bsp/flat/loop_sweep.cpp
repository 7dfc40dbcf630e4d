// SPDX-License-Identifier: Apache-2.0
//
// Why no loop is touched. Let the order of all chains be right up to an event, the beginning or the
// end of two chains. Up to the next event, neighbours stay the same, and each pair of them passes
// stay_apart() for all of that stretch: at a corner of either it compares strictly, and both are
// straight between such corners. A stretch begins at an event whose point is strictly between its
// neighbours, or which is the common beginning of both; it ends so too. Hence neighbours are apart
// in all of the stretch, but for common ends, and so are all chains, being in order. Where a pair
// is compared does not matter, so that is put off until the pair parts: a corner is looked at once
// from above and once from below. What was found before is right if all comparisons succeed.

#include <trisect/bsp/flat/loop_sweep.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/lattice.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/number/power_of_two.h>

namespace trisect::detail {

// The lattice that choose_lattice() takes where there is room above the largest coordinate, heights
// of 1 included. Products of differences neither underflow nor overflow then in the users' units.
bool LoopSweep::find_unit(std::span<const Point> points) {
    double largest = 1;
    for (const Point& p : points) largest = std::max({largest, std::fabs(p[0]), std::fabs(p[1])});
    if (!(largest < 0x1p400)) return false;
    const int least = std::ilogb(largest) + 1 - (coordinate_bits - growth_bits);
    const int exponent = 8 * ((least + 8 * 8 + 7) / 8 - 8);  // a multiple of 8; least >= -44
    const double power = power_of_two(exponent - fraction_limit + 52);
    for (const Point& p : points)
        for (const double c : p) {
            const double size = std::fabs(c);
            if (size < power && size + power - power != size) return false;
        }
    unit_ = power_of_two(-exponent);
    return true;
}

int LoopSweep::exact_turn_of(const Point& a, const Point& b, const Point& c) const {
    const auto corner = [&](const Point& p) {
        return FlatCorner{Coordinate(p[0] * unit_), Coordinate(p[1] * unit_)};
    };
    return exact_turn(corner(a), corner(b), corner(c));
}

LoopSweep::Index LoopSweep::add_chain(Index first, Index last, int step, Index loop) {
    const Index next = moved(first, step);
    chains_.push_back({last, step, loop, next, next, next});
    return static_cast<Index>(chains_.size() - 1);
}

bool LoopSweep::add_loop(std::span<const Point> loop, Index number) {
    if (loop.size() < 3) return false;
    std::size_t least = 0;
    for (std::size_t i = 1; i < loop.size(); ++i)
        if (is_before(loop[i], loop[least])) least = i;
    const auto first = static_cast<Index>(corners_.size());
    corners_.insert(corners_.end(), loop.begin() + static_cast<std::ptrdiff_t>(least), loop.end());
    corners_.insert(corners_.end(), loop.begin(),
                    loop.begin() + static_cast<std::ptrdiff_t>(least) + 1);
    const auto end = static_cast<Index>(corners_.size() - 1);
    const std::size_t begins = events_.size();
    events_.push_back({corners_[first], first, {none, none}, true});
    bool rises = true;
    Index from = first;
    for (Index i = first; i < end; ++i) {
        const bool on = is_before(corners_[i], corners_[i + 1]);
        if (on == rises) {
            if (!on && corners_[i] == corners_[i + 1]) return false;
            continue;
        }
        // A corner to the right of both neighbours, or to the left.
        if (corners_[i] == corners_[i + 1]) return false;
        if (rises) {
            events_.back().chains[0] = add_chain(from, i, 1, number);
            events_.push_back({corners_[i], i, {events_.back().chains[0], none}, false});
        } else {
            const Index falling = add_chain(i, from, -1, number);
            events_.back().chains[1] = falling;
            events_.push_back({corners_[i], i, {none, falling}, true});
        }
        rises = on;
        from = i;
    }
    const Index falling = add_chain(end, from, -1, number);
    events_.back().chains[1] = falling;
    events_[begins].chains[1] = falling;
    return !rises;
}

// Moves on to the first corner that is not before p.
int LoopSweep::side_of_chain(Chain& c, const Point& p) const {
    while (c.seen != c.last && is_before(corners_[c.seen], p)) c.seen = moved(c.seen, c.step);
    return turn(corners_[moved(c.seen, -c.step)], corners_[c.seen], p);
}

void LoopSweep::skip(Index& next, const Chain& c, const Point& until) const {
    const Index end = moved(c.last, c.step);
    while (next != end && !is_before(until, corners_[next])) next = moved(next, c.step);
}

bool LoopSweep::stay_apart(Chain& low, Chain& high, const Point& until) const {
    const Index low_end = moved(low.last, low.step);
    const Index high_end = moved(high.last, high.step);
    Index i = low.high;
    Index j = high.low;
    while (true) {
        const bool has_i = i != low_end && !is_before(until, corners_[i]);
        const bool has_j = j != high_end && !is_before(until, corners_[j]);
        if (!has_i && !has_j) break;
        if (has_i && has_j && corners_[i] == corners_[j]) {
            if (i != j) return false;
            i = low_end;  // the common end
            j = high_end;
        } else if (has_i && (!has_j || is_before(corners_[i], corners_[j]))) {
            if (j == high_end ||
                turn(corners_[moved(j, -high.step)], corners_[j], corners_[i]) >= 0)
                return false;
            i = moved(i, low.step);
        } else {
            if (i == low_end || turn(corners_[moved(i, -low.step)], corners_[i], corners_[j]) <= 0)
                return false;
            j = moved(j, high.step);
        }
    }
    low.high = i;
    high.low = j;
    return true;
}

void LoopSweep::note_place(const Event& e, Index below, bool is_outline) {
    Place& place = places_[chains_[e.chains[0]].loop];
    place.is_outline = is_outline;
    if (below == none) return;
    place.below = chains_[below].loop;
    place.is_on_left = chains_[below].step > 0;
}

bool LoopSweep::begin_chains(const Event& e) {
    if (active_.size() + 2 > most_chains) return false;
    const auto [rising, falling] = e.chains;
    const int o = turn(e.at, corners_[chains_[rising].seen], corners_[chains_[falling].seen]);
    if (o == 0) return false;
    std::size_t at = 0;
    for (std::size_t end = active_.size(); at < end;) {
        const std::size_t middle = (at + end) / 2;
        const int side = side_of_chain(chains_[active_[middle]], e.at);
        if (side == 0) return false;
        if (side > 0) {
            at = middle + 1;
        } else {
            end = middle;
        }
    }
    const bool has_low = at > 0;
    const bool has_high = at < active_.size();
    if (has_low && has_high) {
        if (!stay_apart(chains_[active_[at - 1]], chains_[active_[at]], e.at)) return false;
    } else if (has_low) {
        skip(chains_[active_[at - 1]].high, chains_[active_[at - 1]], e.at);
    } else if (has_high) {
        skip(chains_[active_[at]].low, chains_[active_[at]], e.at);
    }
    const Index loop = chains_[rising].loop;
    if (places_[loop].below == none && !is_placed_[loop]) {
        is_placed_[loop] = true;
        order_.push_back(loop);
        note_place(e, has_low ? active_[at - 1] : none, o > 0);
    }
    const std::array<Index, 2> upwards =
        o > 0 ? std::array{rising, falling} : std::array{falling, rising};
    active_.insert(active_.begin() + static_cast<std::ptrdiff_t>(at), upwards.begin(),
                   upwards.end());
    return true;
}

bool LoopSweep::end_chains(const Event& e) {
    const auto found = std::ranges::find_if(
        active_, [&](Index c) { return c == e.chains[0] || c == e.chains[1]; });
    const auto at = static_cast<std::size_t>(found - active_.begin());
    if (at + 1 >= active_.size()) return false;
    Chain& low = chains_[active_[at]];
    Chain& high = chains_[active_[at + 1]];
    if (active_[at + 1] != (active_[at] == e.chains[0] ? e.chains[1] : e.chains[0])) return false;
    if (!stay_apart(low, high, e.at)) return false;
    if (at > 0 && !stay_apart(chains_[active_[at - 1]], low, e.at)) return false;
    if (at + 2 < active_.size() && !stay_apart(high, chains_[active_[at + 2]], e.at)) return false;
    active_.erase(found, found + 2);
    return true;
}

bool LoopSweep::run(std::span<const Point> points, std::span<const Index> begin) {
    const std::size_t loops = begin.empty() ? 0 : begin.size() - 1;
    corners_.clear();
    chains_.clear();
    events_.clear();
    active_.clear();
    order_.clear();
    places_.assign(loops, {});
    is_placed_.assign(loops, false);
    if (!find_unit(points)) return false;
    for (std::size_t l = 0; l < loops; ++l)
        if (!add_loop(points.subspan(begin[l], begin[l + 1] - begin[l]), static_cast<Index>(l)))
            return false;
    std::ranges::sort(events_, [](const Event& e, const Event& f) {
        return is_before(e.at, f.at) || (e.at == f.at && e.corner < f.corner);
    });
    const auto are_equal = [](const Event& e, const Event& f) { return e.at == f.at; };
    if (std::ranges::adjacent_find(events_, are_equal) != events_.end()) return false;
    return std::ranges::all_of(
        events_, [&](const Event& e) { return e.begins ? begin_chains(e) : end_chains(e); });
}

}  // namespace trisect::detail
