// SPDX-License-Identifier: Apache-2.0
//
// Every vertex against every edge would be quadratic. Few candidates are sorted along one axis, and
// an edge looks at those between its ends; many are in a grid, and for long edges in columns along
// an axis or in a tree of boxes. Doubles with bounds leave those that may lie on the edge to the
// exact predicates: on both planes of its line, and between its ends along an axis.

#include <trisect/bsp/assembly/parts/edge_splitter.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/cells/point_order.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

// The axis along which the ends of an edge are farthest apart.
std::size_t longest_axis(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(a[k] - b[k]) > std::fabs(a[best] - b[best])) best = k;
    return best;
}

// The certified doubles of an edge's ends, to reject points that are clearly not on it.
class EdgeFilter {
public:
    /// `error`: of the ends and of a point together.
    EdgeFilter(const std::array<double, 3>& a, const std::array<double, 3>& b, double error)
        : a_(a), b_(b), error_(error_slack * error) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = std::min(a[k], b[k]) - error_;
            hi_[k] = std::max(a[k], b[k]) + error_;
        }
    }
    // The box of points that it may contain.
    [[nodiscard]] const std::array<double, 3>& low() const { return lo_; }
    [[nodiscard]] const std::array<double, 3>& high() const { return hi_; }
    [[nodiscard]] bool may_contain(const std::array<double, 3>& p) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] < lo_[k] || p[k] > hi_[k]) return false;
        return may_be_on_line(p);
    }

private:
    // A component of (p - a) × (b - a) is two products, their factors below m and off by at most
    // `error` each; the last term pays for all roundings.
    [[nodiscard]] bool may_be_on_line(const std::array<double, 3>& p) const {
        const std::size_t axis = longest_axis(a_, b_);
        const double m = std::fabs(b_[axis] - a_[axis]) + 2 * error_;
        const double bound = 2 * (2 * m * error_ + error_ * error_ + 0x1p-50 * m * m);
        const double along = p[axis] - a_[axis];
        for (std::size_t k = 0; k < 3; ++k) {
            const double cross = (p[k] - a_[k]) * (b_[axis] - a_[axis]) - along * (b_[k] - a_[k]);
            if (k != axis && std::fabs(cross) > bound) return false;
        }
        return true;
    }

    const std::array<double, 3>& a_;
    const std::array<double, 3>& b_;
    double error_;
    std::array<double, 3> lo_{}, hi_{};
};

// An axis along which the ends of an edge differ. Ends that are nearer to each other than doubles
// can decide may be equal along the axis that looks longest: then an edge would never be split.
int separating_axis(const Workbench& bench, PointId from, PointId to) {
    const auto axis =
        static_cast<int>(longest_axis(bench.approximation(from).c, bench.approximation(to).c));
    for (int k = 0; k < 2; ++k)
        if (const int candidate = (axis + k) % 3; compare_along(bench, from, to, candidate) != 0)
            return candidate;
    return (axis + 2) % 3;
}

// Does p lie strictly inside the edge? All three points are distinct.
bool lies_inside(const Workbench& bench, PointId p, const BoundaryEdge& e, PlaneId support) {
    if (bench.side(p, support) != 0 || bench.side(p, e.line.plane) != 0) return false;
    const int along = separating_axis(bench, e.from, e.to);
    const int from = compare_along(bench, e.from, p, along);
    const int to = compare_along(bench, p, e.to, along);
    return from == to && from != 0;
}

}  // namespace

void EdgeSplitter::clear() {
    for (const Candidate& c : candidates_) is_listed_[as_index(c.point)] = false;
    candidates_.clear();
    are_many_ = false;
    for (VertexColumns& c : columns_) c.clear();
    for (BuiltOnce& c : has_columns_) c.clear();
    boxes_.clear();
    has_boxes_.clear();
    looked_.clear();
}

void EdgeSplitter::add_candidate(PointId p) {
    if (is_listed_.size() <= as_index(p)) is_listed_.resize(bench_.point_count(), false);
    if (is_listed_[as_index(p)]) return;
    is_listed_[as_index(p)] = true;
    candidates_.push_back({bench_.approximation(p).c, p});
}

// Along the longest axis; of a fifth of the edges that or less. Looks at some, at irregular
// distances: facets of a prism have their short edges at regular ones.
double EdgeSplitter::short_length(std::span<const BoundaryEdge> edges) const {
    std::vector<double> lengths;
    constexpr std::size_t most = 512;
    const std::size_t step = 1 + edges.size() / most;
    for (std::size_t begin = 0; begin < edges.size(); begin += step) {
        const std::size_t i = begin + mix64(begin) % std::min(step, edges.size() - begin);
        const std::array<double, 3>& a = bench_.approximation(edges[i].from).c;
        const std::array<double, 3>& b = bench_.approximation(edges[i].to).c;
        const std::size_t axis = longest_axis(a, b);
        lengths.push_back(std::fabs(a[axis] - b[axis]));
    }
    if (lengths.empty()) return 0;
    const auto fifth = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 5);
    std::ranges::nth_element(lengths, fifth);
    return *fifth;
}

// Along the axis on which the candidates extend farthest; on another one all may be equal, and
// every edge would look at all of them.
void EdgeSplitter::sort_candidates(std::span<const BoundaryEdge> edges) {
    std::array<double, 3> lo;
    std::array<double, 3> hi;
    lo.fill(HUGE_VAL);
    hi.fill(-HUGE_VAL);
    widest_ = 0;
    for (const BoundaryEdge& e : edges)
        widest_ = std::max(
            {widest_, bench_.approximation(e.from).error, bench_.approximation(e.to).error});
    constexpr std::size_t few = 128;
    for (const Candidate& c : candidates_) {
        widest_ = std::max(widest_, bench_.approximation(c.point).error);
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], c.c[k]);
            hi[k] = std::max(hi[k], c.c[k]);
        }
    }
    are_many_ = candidates_.size() > few;
    if (are_many_) return grid_.build(candidates_, 3 * short_length(edges));
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
    axis_ = axis;
    std::sort(candidates_.begin(), candidates_.end(), [axis](const auto& a, const auto& b) {
        return a.c[axis] != b.c[axis] ? a.c[axis] < b.c[axis] : a.point < b.point;
    });
}

void EdgeSplitter::find_inside(const BoundaryEdge& e, PoolVector<PointId>& inside) {
    const std::size_t first = inside.size();
    if (are_many_) {
        find_inside_near(e, inside);
    } else {
        find_inside_sorted(e, inside);
    }
    if (inside.size() > first + 1)
        sort_inside(e, separating_axis(bench_, e.from, e.to), std::span(inside).subspan(first));
}

void EdgeSplitter::look_at(const BoundaryEdge& e, const Candidate& candidate,
                           PoolVector<PointId>& inside) const {
    if (lies_inside(bench_, candidate.point, e, facets_[as_index(e.facet)].support))
        inside.push_back(candidate.point);
}

// What is between the ends along axis_, and farther out by no more than the errors allow.
void EdgeSplitter::find_inside_sorted(const BoundaryEdge& e, PoolVector<PointId>& inside) {
    const std::array<double, 3>& from = bench_.approximation(e.from).c;
    const std::array<double, 3>& to = bench_.approximation(e.to).c;
    const double reach = error_slack * (3 * widest_);
    const auto [low, high] = std::minmax(from[axis_], to[axis_]);
    const double end = high + reach;
    auto it = std::ranges::lower_bound(candidates_, low - reach, {},
                                       [&](const Candidate& c) { return c.c[axis_]; });
    if (it == candidates_.end() || it->c[axis_] > end) return;
    const EdgeFilter filter(from, to, 3 * widest_);
    for (; it != candidates_.end() && it->c[axis_] <= end; ++it)
        if (it->point != e.from && it->point != e.to && filter.may_contain(it->c))
            look_at(e, *it, inside);
}

// That of an edge along an axis: there its ends have the same place across it, as far as doubles
// know.
std::optional<std::size_t> EdgeSplitter::axis_of_columns(const BoundaryEdge& e) const {
    const std::array<double, 3>& from = bench_.approximation(e.from).c;
    const std::array<double, 3>& to = bench_.approximation(e.to).c;
    const std::size_t axis = longest_axis(from, to);
    double farthest = 0;
    for (const std::size_t k : {(axis + 1) % 3, (axis + 2) % 3})
        farthest = std::max(farthest, std::fabs(from[k] - to[k]));
    if (farthest > 3 * widest_) return std::nullopt;
    return axis;
}

void EdgeSplitter::find_inside_near(const BoundaryEdge& e, PoolVector<PointId>& inside) {
    const std::array<double, 3>& from = bench_.approximation(e.from).c;
    const std::array<double, 3>& to = bench_.approximation(e.to).c;
    const EdgeFilter filter(from, to, 3 * widest_);
    const auto look_at_all = [&](std::span<const Candidate> candidates) {
        for (const Candidate& c : candidates)
            if (filter.may_contain(c.c) && c.point != e.from && c.point != e.to)
                look_at(e, c, inside);
    };
    if (grid_.for_each_near(filter.low(), filter.high(), look_at_all)) return;
    if (const auto axis = axis_of_columns(e)) {
        if (!has_columns_[*axis].is_worth_building()) return look_at_all(grid_.vertices());
        VertexColumns& columns = columns_[*axis];
        // Some dozens of times wider than what is looked for, so that this is mostly in one column.
        has_columns_[*axis].by(
            [&] { columns.build(grid_.vertices(), *axis, widest_ > 0 ? 256 * widest_ : 1); });
        if (columns.for_each_near(filter.low(), filter.high(), look_at_all)) return;
    }
    if (!has_boxes_.is_worth_building()) return look_at_all(grid_.vertices());
    has_boxes_.by([&] { boxes_.build(candidates_); });
    boxes_.for_each_near(from, to, error_slack * (3 * widest_), look_at_all);
}

void EdgeSplitter::sort_inside(const BoundaryEdge& e, int axis, std::span<PointId> inside) const {
    const int direction = compare_along(bench_, e.from, e.to, axis);
    std::sort(inside.begin(), inside.end(), [&](PointId p, PointId q) {
        return p != q && compare_along(bench_, p, q, axis) == direction;
    });
}

namespace {

// `inside`: of the edge, or of it the other way round.
void add_parts(const BoundaryEdge& e, std::span<const PointId> inside, bool runs_back,
               BoundaryEdges& out) {
    PointId from = e.from;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const PointId p = inside[runs_back ? inside.size() - 1 - i : i];
        out.push_back({from, p, e.facet, e.line});
        from = p;
    }
    out.push_back({from, e.to, e.facet, e.line});
}

// Fewer edges are not worth a thread of their own.
constexpr std::size_t least_edges_split = 4096;

}  // namespace

void EdgeSplitter::split(std::span<const BoundaryEdge> edges, BoundaryEdges& out,
                         std::uint32_t threads) {
    if (candidates_.empty()) {
        out.insert(out.end(), edges.begin(), edges.end());
        return;
    }
    sort_candidates(edges);
    if (!are_many_) {
        for (const BoundaryEdge& e : edges) {
            inside_.clear();
            find_inside(e, inside_);
            add_parts(e, inside_, false, out);
        }
        return;
    }
    const std::size_t count =
        threads == 1 ? 1 : parts_by_thread(edges.size(), threads, least_edges_split).count();
    if (count > 1) return split_in_parts(edges, out, count, threads);
    looked_.reserve(edges.size() / 2);  // mostly each edge comes twice
    for (const BoundaryEdge& e : edges) {
        const LookedEdges::Inside& found = looked_[looked_.number_of(
            e, [&](const BoundaryEdge& edge, PoolVector<PointId>& in) { find_inside(edge, in); })];
        add_parts(e, looked_.vertices_of(found), found.from != e.from, out);
    }
}

// Before several threads need them: while one of them built the tree, the others would wait.
void EdgeSplitter::build_boxes(std::span<const BoundaryEdge> edges, std::uint32_t threads) {
    constexpr std::size_t worth = 64;
    std::atomic<std::size_t> count{0};
    ParallelParts(edges.size(), threads, least_edges_split)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && count < worth; ++i) {
                const EdgeFilter filter(bench_.approximation(edges[i].from).c,
                                        bench_.approximation(edges[i].to).c, 3 * widest_);
                if (!grid_.takes(filter.low(), filter.high()) && !axis_of_columns(edges[i]))
                    ++count;
            }
        });
    if (count >= worth) has_boxes_.by([&] { boxes_.build(candidates_, threads); });
}

// An edge belongs to the part that its ends say, so that both facets of it find it there.
void EdgeSplitter::split_in_parts(std::span<const BoundaryEdge> edges, BoundaryEdges& out,
                                  std::size_t count, std::uint32_t threads) {
    const auto part_of = [count](const BoundaryEdge& e) {
        return static_cast<std::size_t>((LookedEdges::hash_of(e) >> 32U) % count);
    };
    build_boxes(edges, threads);
    std::vector<LookedEdges> looked(count);
    PoolVector<std::uint32_t> numbers(edges.size());  // of each edge in its part
    ParallelParts(count, threads, 1).for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part) {
            looked[part].reserve(edges.size() / (2 * count));
            for (std::size_t i = 0; i < edges.size(); ++i) {
                if (part_of(edges[i]) != part) continue;
                numbers[i] = looked[part].number_of(
                    edges[i], [&](const BoundaryEdge& e, PoolVector<PointId>& inside) {
                        find_inside(e, inside);
                    });
            }
        }
    });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const LookedEdges& of_part = looked[part_of(edges[i])];
        const LookedEdges::Inside& found = of_part[numbers[i]];
        add_parts(edges[i], of_part.vertices_of(found), found.from != edges[i].from, out);
    }
}

}  // namespace trisect::detail
