// SPDX-License-Identifier: Apache-2.0
//
// Around a vertex each half-edge is crossed in turn, and after all of them the walk is where it
// began. Left of a half-edge it is where it would be at its other end, to the right of the
// half-edge back. So a walk goes over all of a component, crosses each edge once at either end, and
// never undoes anything. What is around a component is counted below its leftmost vertex.

#include <trisect/bsp/flat/flat_walk.h>

#include <algorithm>
#include <numeric>

#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

FlatWalk::FlatWalk(const FlatArrangement& arrangement, LeafFormula& formula)
    : arrangement_(arrangement),
      formula_(formula),
      row_(formula.row_size(), 0),
      winding_(arrangement.operand_count(), 0) {
    list_around();
    formula_.fill(row_);
}

void FlatWalk::list_around() {
    const std::size_t vertices = arrangement_.figure().vertices.size();
    const std::size_t halves = 2 * arrangement_.edges().size();
    first_.assign(vertices + 1, 0);
    for (std::size_t h = 0; h < halves; ++h) ++first_[origin(static_cast<Index>(h)) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    around_.resize(halves);
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for (std::size_t h = 0; h < halves; ++h)
        around_[next[origin(static_cast<Index>(h))]++] = static_cast<Index>(h);
    place_.resize(halves);
    for (std::size_t v = 0; v < vertices; ++v) {
        sort_around(static_cast<Index>(v));
        for (Index i = first_[v]; i < first_[v + 1]; ++i) place_[around_[i]] = i - first_[v];
    }
    is_known_.assign(vertices, false);
}

// Directions from that of u on, to the opposite one, which is not among them.
bool FlatWalk::is_upper(Index half) const {
    const auto& line = arrangement_.figure().lines[arrangement_.edges()[half / 2].line];
    const bool along = runs_along(half);
    if (line.a.v != line.b.v) return (line.a.v < line.b.v) == along;
    return (line.a.u < line.b.u) == along;
}

void FlatWalk::sort_around(Index vertex) {
    const auto begin = around_.begin() + first_[vertex];
    const auto end = around_.begin() + first_[vertex + 1];
    if (end - begin < 2) return;
    const auto is_before = [&](Index g, Index h) {
        const bool upper = is_upper(g);
        if (upper != is_upper(h)) return upper;
        const int turn = arrangement_.figure().cross(arrangement_.edges()[g / 2].line,
                                                     arrangement_.edges()[h / 2].line);
        return (runs_along(g) == runs_along(h) ? turn : -turn) > 0;
    };
    std::sort(begin, end, is_before);
}

void FlatWalk::change(Index operand, int by) {
    int& w = winding_[operand];
    const bool odd = arrangement_.rule(operand) == FlatRegion::Rule::Odd;
    const bool before = odd ? w % 2 != 0 : w > 0;
    w += by;
    const bool after = odd ? w % 2 != 0 : w > 0;
    if (before != after) formula_.set(row_, operand, after ? 1 : 0);
}

// Counter-clockwise about its origin.
void FlatWalk::cross(Index half) {
    const auto& edge = arrangement_.edges()[half / 2];
    const int direction = half % 2 == 0 ? 1 : -1;
    for (const auto& c : arrangement_.changes(edge)) change(c.operand, direction * c.by);
}

void FlatWalk::start_at(Index vertex) {
    base_.clear();
    arrangement_.for_each_below(vertex, [&](Index operand, int by) {
        base_.push_back(operand);
        change(operand, by);
    });
}

void FlatWalk::end_component() {
    for (const Index operand : base_) change(operand, -winding_[operand]);
}

void FlatWalk::walk_from(Index vertex, std::span<std::uint8_t> sides) {
    // The leftmost vertex has no edge between down and the opposite of u.
    const auto halves = around(vertex);
    const auto lower =
        std::find_if(halves.begin(), halves.end(), [&](Index h) { return !is_upper(h); });
    const Index start = lower == halves.end() ? 0 : static_cast<Index>(lower - halves.begin());
    is_known_[vertex] = true;
    steps_.push_back({vertex, start, 0});
    while (!steps_.empty()) {
        Step& step = steps_.back();
        const auto here = around(step.vertex);
        if (step.count == here.size()) {
            steps_.pop_back();
            continue;
        }
        const Index half = here[(step.start + step.count++) % here.size()];
        const bool right = is_inside();
        cross(half);
        const bool left = is_inside();
        const bool forward = half % 2 == 0;
        sides[half / 2] = static_cast<std::uint8_t>(((forward ? left : right) ? 1 : 0) +
                                                    ((forward ? right : left) ? 2 : 0));
        const Index to = target(half);
        if (is_known_[to]) continue;
        is_known_[to] = true;
        steps_.push_back({to, place_[half ^ 1U], 0});
    }
}

// The leftmost vertex of each component.
std::vector<FlatWalk::Index> FlatWalk::component_starts() const {
    std::vector<Index> root(first_.size() - 1);
    std::iota(root.begin(), root.end(), Index{0});
    const auto root_of = [&](Index v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (const auto& e : arrangement_.edges()) {
        const Index p = root_of(e.from);
        const Index q = root_of(e.to);
        if (p != q) root[std::max(p, q)] = std::min(p, q);
    }
    std::vector<Index> leftmost(root.size(), FlatArrangement::none);
    for (std::size_t i = 0; i < root.size(); ++i) {
        if (first_[i] == first_[i + 1]) continue;
        const auto v = static_cast<Index>(i);
        Index& known = leftmost[root_of(v)];
        if (known == FlatArrangement::none || arrangement_.figure().compare(v, known) < 0)
            known = v;
    }
    std::erase(leftmost, FlatArrangement::none);
    return leftmost;
}

void FlatWalk::find_sides(std::span<std::uint8_t> sides) {
    for (const Index v : component_starts()) {
        check_stop();
        start_at(v);
        walk_from(v, sides);
        end_component();
    }
}

}  // namespace trisect::detail
