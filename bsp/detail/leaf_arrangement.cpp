// SPDX-License-Identifier: Apache-2.0
//
// A mixed leaf holds a few dozen polygons of two or more operands. Every polygon that another one
// cuts is clipped to the cell and split along the traces of the others into convex pieces, as in
// the local BSPs of EMBER (Trettner, Nehring-Wirxel, Kobbelt 2022, sec. 5), but with a flat list
// instead of a tree: leaves are small, and a split is made only where the trace runs through the
// piece's interior. A piece is then on one side of everything, so one winding number on each side
// of it says whether it bounds the result: it does iff the formula changes across it.
//
// Winding numbers come from exact segment traces from the cell's reference point. One trace serves
// a whole patch of untouched facets that hang together by edges within the cell.
//
// Coplanar overlaps: the pieces of a facet are split along the edges of every facet that covers it,
// so each piece is covered completely or not at all. Of all facets that cover a piece the first one
// (by slot, source, facet) speaks for all: the others drop theirs, and the step of winding numbers
// across the piece is the sum over all of them.
//
// What goes wrong otherwise: classifying the two halves of one clipped polygon separately by float
// rays (holes), closed coplanar twins emitted twice, and snapping intersection points. Here no
// coordinate is constructed; a piece is a list of planes.

#include <trisect/bsp/detail/leaf_arrangement.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include <trisect/bsp/detail/trace.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

using Index = std::int32_t;

std::size_t u(Index i) { return static_cast<std::size_t>(i); }

// A polygon of the leaf with everything that the arrangement learns about it.
struct Item {
    PolygonRef ref;
    Index operand = 0;
    int orientation = 1;  // -1 when flipped
    WorkPolygon shape;    // unclipped
    Box box;              // within the cell
    std::vector<Index> cutters;
    std::vector<Index> covers;  // coplanar, interiors meet
    bool touched = false;       // something of another surface may touch it
    int side_of_reference = 2;  // of the support; 2 = not computed
};

struct Piece {
    Index item = 0;
    WorkPolygon shape;
    int step = 0;  // index into steps: how winding numbers change across
    bool dropped = false;
};

Box outward_box(const Workbench& bench, const WorkPolygon& polygon) {
    Box b;
    for (const PointId p : polygon.points) {
        const Approximation& a = bench.approximation(p);
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = std::min(b.lo[k], static_cast<std::int64_t>(std::floor(a.c[k] - a.error)));
            b.hi[k] = std::max(b.hi[k], static_cast<std::int64_t>(std::ceil(a.c[k] + a.error)));
        }
    }
    return b;
}

// Box of a segment in lattice units, rounded outwards.
Box box_of_segment(const Approximation& a, const Approximation& b) {
    Box r;
    for (std::size_t k = 0; k < 3; ++k) {
        r.lo[k] =
            static_cast<std::int64_t>(std::floor(std::min(a.c[k] - a.error, b.c[k] - b.error)));
        r.hi[k] =
            static_cast<std::int64_t>(std::ceil(std::max(a.c[k] + a.error, b.c[k] + b.error)));
    }
    return r;
}

// A triangle of three well-separated vertices of a convex polygon.
std::array<PointId, 3> spread_vertices(const WorkPolygon& w) {
    const std::size_t n = w.points.size();
    return {w.points[0], w.points[n / 3], w.points[2 * n / 3]};
}

// Weights of successive attempts: the barycentre first, then points away from it that no simple
// symmetry of the input can hit again.
std::array<std::int64_t, 3> weights_of_attempt(int attempt) {
    if (attempt == 0) return {1, 1, 1};
    const auto a = static_cast<std::int64_t>(mix64(static_cast<std::uint64_t>(attempt)) % 97);
    const auto b =
        static_cast<std::int64_t>(mix64(static_cast<std::uint64_t>(attempt) + 1000) % 89);
    return {17 + a, 23 + b, 59};
}

constexpr int max_attempts = 60;

// A segment with an end in the plane of a polygon. The reference lies on no polygon, so if it is
// the reference's end there is no crossing. If it is the target's, or the whole segment lies in the
// plane, the segment avoids the polygon when all of it is beyond one edge; otherwise nothing is
// claimed. `outside(edge, end)` is 1 where that end is strictly beyond the edge.
template <class Edges, class ReferenceOutside, class TargetOutside>
bool avoids_in_plane(int at_reference, int at_target, const Edges& edges,
                     const ReferenceOutside& reference_outside,
                     const TargetOutside& target_outside) {
    if (at_target != 0) return true;
    return std::any_of(edges.begin(), edges.end(), [&](const auto& e) {
        return target_outside(e) && (at_reference != 0 || reference_outside(e));
    });
}

// The edges of a polygon as planes with the side that is outside.
struct PlaneEdge {
    Plane plane;
    int outside;
};
std::vector<PlaneEdge> plane_edges(const PolygonRef& ref) {
    std::vector<PlaneEdge> out;
    if (ref.fragment != nullptr) {
        for (const EdgeName& e : ref.fragment->edges())
            out.push_back({e.plane.plane(), e.above ? -1 : 1});
    } else if (!ref.source->is_half_space()) {
        for (int i = 0; i < 3; ++i) out.push_back({ref.source->edge_plane(ref.facet, i), 1});
    }
    return out;
}

}  // namespace

PolygonRef make_fragment(const Workbench& bench, const PolygonRef& ref,
                         const WorkPolygon& polygon) {
    std::vector<EdgeName> edges;
    edges.reserve(polygon.edges.size());
    for (const WorkEdge& e : polygon.edges) edges.push_back({bench.name(e.plane), e.above});
    PolygonRef out = ref;
    out.fragment = new Fragment(std::move(edges), outward_box(bench, polygon));
    return out;
}

std::optional<PolygonRef> clip_to_cell(Workbench& bench, const PolygonRef& ref, const Cell& cell) {
    if (cell.contains(ref.box())) return ref;
    WorkPolygon whole = bench.polygon(ref);
    bench.with_edges(whole, ref);
    const WorkPolygon part = bench.clipped(whole, ref.box(), cell);
    if (part.is_empty()) return std::nullopt;
    if (part.points == whole.points) return ref;
    return make_fragment(bench, ref, part);
}

bool meets_cell(Workbench& bench, const PolygonRef& ref, const Cell& cell) {
    if (cell.contains(ref.box())) return true;
    if (ref.fragment == nullptr && !ref.source->is_half_space()) {
        for (int i = 0; i < 3; ++i) {
            Box corner;
            corner.add(ref.source->corner(ref.facet, i));
            if (cell.contains(corner)) return true;
        }
    }
    bench.clear();
    WorkPolygon whole = bench.polygon(ref);
    bench.with_edges(whole, ref);
    return !bench.clipped(whole, ref.box(), cell).is_empty();
}

std::optional<int> trace_winding(std::span<const PolygonRef> polygons, bool flipped,
                                 const FinePoint& from, const FinePoint& to) {
    const Approximation start = approximate(from);
    const TraceTarget target(to);
    const Box segment = box_of_segment(start, target.approximation());
    int winding = 0;
    for (const PolygonRef& ref : polygons) {
        if (!ref.box().overlaps(segment)) continue;
        const Plane support = ref.source->support(ref.facet);
        const int at_start = side(from, start, support);
        const int at_end = side(target, support);
        if (at_start == at_end && at_start != 0) continue;
        const std::vector<PlaneEdge> edges = plane_edges(ref);
        if (at_start == 0 || at_end == 0) {
            const auto from_outside = [&](const PlaneEdge& e) {
                return side(from, start, e.plane) * e.outside > 0;
            };
            const auto to_outside = [&](const PlaneEdge& e) {
                return side(target, e.plane) * e.outside > 0;
            };
            if (avoids_in_plane(at_start, at_end, edges, from_outside, to_outside)) continue;
            return std::nullopt;
        }
        const SupportCrossing crossing(from, start, target, support);
        int worst = -1;
        for (const PlaneEdge& e : edges)
            worst = std::max(worst, e.outside * crossing.side_of(e.plane));
        if (worst == 0) return std::nullopt;
        if (worst > 0) continue;
        const bool entering = at_start > 0;
        winding += entering != (ref.flipped != flipped) ? 1 : -1;
    }
    return winding;
}

void check_budget(const EvaluateOptions& options, const EvaluateStats& stats) {
    if (options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed))
        throw CancelledError();
    if (options.max_work != 0 && stats.cells + stats.pairs_boxes > options.max_work)
        throw LimitError("the work budget of " + std::to_string(options.max_work) + " is spent");
}

class LeafArranger::Impl {
public:
    std::vector<PolygonRef> arrange(const LeafProblem& problem, SlotValues& values,
                                    EvaluateStats& stats);
    std::vector<FacetName> incomplete;

private:
    void load();
    void relate_pairs();
    void relate(Index s, Index t);
    // The edge planes of a whole facet are made when something asks for them: most facets of a leaf
    // meet nothing.
    const WorkPolygon& with_edges(Index i) {
        Item& item = items_[u(i)];
        bench_.with_edges(item.shape, item.ref);
        return item.shape;
    }
    [[nodiscard]] int shared_corners(const Item& a, const Item& b) const;
    void relate_coplanar(Index s, Index t);
    [[nodiscard]] bool separated_by_edges_of(Item& a, const Item& b);
    [[nodiscard]] bool cuts(const WorkPolygon& piece, Index cutter);
    [[nodiscard]] bool segment_meets_interior(const WorkPolygon& piece, PlaneId line,
                                              const WorkPolygon& cutter);
    void make_pieces(Index s);
    void split_all(std::size_t first, PlaneId plane, const WorkPolygon& cutter);
    void resolve_covers(std::size_t first);
    [[nodiscard]] bool covered_by(const WorkPolygon& piece, Index t);
    [[nodiscard]] bool speaks_before(const Item& a, const Item& b) const;

    void make_patches();
    [[nodiscard]] bool edge_ends_in_cell(const Item& item, int k) const;
    [[nodiscard]] static Key128 edge_key(const Item& item, int k);
    [[nodiscard]] Index patch_of(Index i);
    void classify_all();
    void classify_whole(Index i);
    void emit_pieces(Index s, std::size_t first);

    struct Sides {
        bool above = false;
        bool below = false;
    };
    [[nodiscard]] std::optional<Sides> classify(Index item, const WorkPolygon& shape,
                                                const std::vector<int>& step);
    [[nodiscard]] bool trace(const TraceTarget& target, PlaneId own_class, Index own_operand,
                             std::vector<int>& w);
    [[nodiscard]] bool formula_at(const std::vector<int>& windings);
    void next_reference();
    void emit(const PolygonRef& ref, bool above, bool below);
    std::vector<int> step_of(Index item) const;

    Workbench bench_;
    const LeafProblem* problem_ = nullptr;
    SlotValues* values_ = nullptr;
    EvaluateStats* stats_ = nullptr;

    std::vector<Item> items_;
    std::vector<Piece> pieces_;
    std::vector<std::vector<int>> steps_;
    struct EdgeUsers {
        std::array<Index, 2> item{};
        Index count = 0;
    };
    FlatMap edge_ids_;
    std::vector<EdgeUsers> edge_users_;
    std::vector<Index> patch_;
    std::vector<Index> patch_within_cell_;   // of a patch: one of its facets that lies in the cell
    std::vector<std::int8_t> patch_result_;  // -1 unknown, bit 0 above, bit 1 below
    std::vector<PolygonRef> out_;

    FinePoint reference_;
    Approximation reference_approximation_;
    std::vector<int> reference_windings_;
    int reference_attempt_ = 0;
};

LeafArranger::LeafArranger() : impl_(std::make_unique<Impl>()) {}
LeafArranger::~LeafArranger() = default;

std::vector<FacetName>& LeafArranger::incomplete() { return impl_->incomplete; }

std::vector<PolygonRef> LeafArranger::arrange(const LeafProblem& problem, SlotValues& values,
                                              EvaluateStats& stats) {
    return impl_->arrange(problem, values, stats);
}

std::vector<PolygonRef> LeafArranger::Impl::arrange(const LeafProblem& problem, SlotValues& values,
                                                    EvaluateStats& stats) {
    problem_ = &problem;
    values_ = &values;
    stats_ = &stats;
    bench_.clear();
    items_.clear();
    pieces_.clear();
    steps_.clear();
    out_.clear();
    reference_ = problem.reference;
    reference_approximation_ = approximate(reference_);
    reference_attempt_ = 0;
    reference_windings_.clear();
    for (const LeafOperand& o : problem.operands) reference_windings_.push_back(o.winding);

    load();
    relate_pairs();
    for (Item& item : items_) item.ref.touched = item.ref.touched || item.touched;
    make_patches();
    try {
        classify_all();
    } catch (...) {
        const PolygonList freed(std::move(out_));  // the fragments made so far
        throw;
    }
    ++stats.mixed_leaves;
    return std::move(out_);
}

void LeafArranger::Impl::classify_all() {
    for (Index i = 0; i < static_cast<Index>(items_.size()); ++i) {
        const Item& item = items_[u(i)];
        if (item.cutters.empty() && item.covers.empty()) {
            classify_whole(i);
        } else {
            const std::size_t first = pieces_.size();
            make_pieces(i);
            emit_pieces(i, first);
        }
    }
}

void LeafArranger::Impl::load() {
    const Box cell = problem_->cell.lattice_box();
    for (std::size_t o = 0; o < problem_->operands.size(); ++o) {
        const LeafOperand& operand = problem_->operands[o];
        for (const PolygonRef& ref : operand.polygons) {
            Item item;
            item.ref = ref;
            item.ref.flipped = ref.flipped != operand.flipped;
            item.orientation = item.ref.flipped ? -1 : 1;
            item.operand = static_cast<Index>(o);
            item.shape = bench_.polygon(ref);
            if (item.shape.is_empty())
                item.shape = bench_.clipped(item.shape, ref.box(), problem_->cell);
            // A cell without lattice points still has an inside: keep one unit around it.
            item.box = ref.box();
            for (std::size_t k = 0; k < 3; ++k) {
                item.box.lo[k] = std::max(item.box.lo[k], cell.lo[k] - 1);
                item.box.hi[k] = std::min(item.box.hi[k], cell.hi[k] + 1);
            }
            if (!item.shape.is_empty()) items_.push_back(std::move(item));
        }
    }
}

void LeafArranger::Impl::relate_pairs() {
    const auto n = static_cast<Index>(items_.size());
    for (Index i = 0; i < n; ++i) {
        check_budget(*problem_->options, *stats_);
        for (Index j = i + 1; j < n; ++j) {
            const Item& a = items_[u(i)];
            const Item& b = items_[u(j)];
            if (a.operand == b.operand && problem_->operands[u(a.operand)].embedded) continue;
            if (!a.box.overlaps(b.box)) continue;
            ++stats_->pairs_boxes;
            relate(i, j);
        }
    }
}

// Corners of sources that two whole facets have in common.
int LeafArranger::Impl::shared_corners(const Item& a, const Item& b) const {
    if (a.ref.source != b.ref.source || a.ref.fragment != nullptr || b.ref.fragment != nullptr)
        return 0;
    int n = 0;
    for (const PointId p : a.shape.points)
        n += static_cast<int>(std::count(b.shape.points.begin(), b.shape.points.end(), p));
    return n;
}

void LeafArranger::Impl::relate(Index s, Index t) {
    Item& a = items_[u(s)];
    Item& b = items_[u(t)];
    const auto range = [&](const WorkPolygon& w, PlaneId plane) {
        int lo = 2;
        int hi = -2;
        for (const PointId p : w.points) {
            const int x = bench_.side(p, plane);
            lo = std::min(lo, x);
            hi = std::max(hi, x);
        }
        return std::pair{lo, hi};
    };
    const auto [b_lo, b_hi] = range(b.shape, a.shape.support);
    if (b_lo > 0 || b_hi < 0) return;
    if (b_lo == 0 && b_hi == 0) {
        bench_.declare_same(a.shape.support, b.shape.support);
        relate_coplanar(s, t);
        return;
    }
    const auto [a_lo, a_hi] = range(a.shape, b.shape.support);
    if (a_lo > 0 || a_hi < 0) return;
    const int shared = a.operand == b.operand ? shared_corners(a, b) : 0;
    // Two facets in different planes with a common edge meet nowhere else; with one common corner
    // and the rest of one of them strictly on one side they meet in that corner only.
    if (shared >= 2) return;
    if (shared == 1 && (b_lo == 0 || b_hi == 0) &&
        std::count_if(b.shape.points.begin(), b.shape.points.end(),
                      [&](PointId p) { return bench_.side(p, a.shape.support) == 0; }) == 1)
        return;
    if (shared == 1 && (a_lo == 0 || a_hi == 0) &&
        std::count_if(a.shape.points.begin(), a.shape.points.end(),
                      [&](PointId p) { return bench_.side(p, b.shape.support) == 0; }) == 1)
        return;
    a.touched = true;
    b.touched = true;
    bool cutting = false;
    if (a_lo < 0 && a_hi > 0 && cuts(with_edges(s), t)) {
        a.cutters.push_back(t);
        cutting = true;
    }
    if (b_lo < 0 && b_hi > 0 && cuts(with_edges(t), s)) {
        b.cutters.push_back(s);
        cutting = true;
    }
    if (cutting) ++stats_->pairs_cutting;
}

bool LeafArranger::Impl::separated_by_edges_of(Item& a, const Item& b) {
    bench_.with_edges(a.shape, a.ref);
    return std::any_of(a.shape.edges.begin(), a.shape.edges.end(), [&](const WorkEdge& e) {
        const int outside = e.above ? -1 : 1;
        return std::all_of(b.shape.points.begin(), b.shape.points.end(),
                           [&](PointId p) { return bench_.side(p, e.plane) * outside >= 0; });
    });
}

void LeafArranger::Impl::relate_coplanar(Index s, Index t) {
    Item& a = items_[u(s)];
    Item& b = items_[u(t)];
    const bool same_surface = a.operand == b.operand && shared_corners(a, b) == 2;
    if (separated_by_edges_of(a, b) || separated_by_edges_of(b, a)) {
        if (!same_surface) {
            a.touched = true;
            b.touched = true;
        }
        return;
    }
    a.touched = true;
    b.touched = true;
    a.covers.push_back(t);
    b.covers.push_back(s);
}

// Does the line `line` ∩ support, restricted to the convex polygon `cutter`, run through the
// interior of the piece? The interval of the line within the piece is clipped by the edges of the
// cutter; at every step its ends are exact points.
bool LeafArranger::Impl::segment_meets_interior(const WorkPolygon& piece, PlaneId line,
                                                const WorkPolygon& cutter) {
    const std::size_t n = piece.points.size();
    std::array<PointId, 2> ends{-1, -1};
    bool above = false;
    bool below = false;
    std::size_t found = 0;
    // Sides once around; ends of the interval are vertices on the line or crossings of edges.
    int here = bench_.side(piece.points[0], line);
    const int first = here;
    for (std::size_t i = 0; i < n; ++i) {
        const int next = i + 1 < n ? bench_.side(piece.points[i + 1], line) : first;
        above = above || here > 0;
        below = below || here < 0;
        if (here == 0 && found < 2) {
            ends[found++] = piece.points[i];
        } else if (here * next < 0 && found < 2) {
            ends[found++] = bench_.meet(piece.support, piece.edges[i].plane, line);
        }
        here = next;
    }
    if (!above || !below || found < 2) return false;
    for (const WorkEdge& e : cutter.edges) {
        const int outside = e.above ? -1 : 1;
        const int s0 = bench_.side(ends[0], e.plane) * outside;
        const int s1 = bench_.side(ends[1], e.plane) * outside;
        // An edge of the cutter along the line itself: the surface may go on behind that edge on
        // the other side of the piece's plane, so touching along an edge counts as cutting.
        if (s0 == 0 && s1 == 0) continue;
        if (s0 >= 0 && s1 >= 0) return false;
        if (s0 > 0) ends[0] = bench_.meet(piece.support, line, e.plane);
        if (s1 > 0) ends[1] = bench_.meet(piece.support, line, e.plane);
    }
    return true;
}

bool LeafArranger::Impl::cuts(const WorkPolygon& piece, Index cutter) {
    const WorkPolygon& c = with_edges(cutter);
    return segment_meets_interior(piece, c.support, c);
}

void LeafArranger::Impl::split_all(std::size_t first, PlaneId plane, const WorkPolygon& cutter) {
    const std::size_t end = pieces_.size();
    for (std::size_t i = first; i < end; ++i) {
        if (!segment_meets_interior(pieces_[i].shape, plane, cutter)) continue;
        WorkPolygon below;
        WorkPolygon above;
        if (!bench_.split(pieces_[i].shape, plane, below, above)) continue;
        Piece other = pieces_[i];
        other.shape = std::move(above);
        pieces_[i].shape = std::move(below);
        pieces_.push_back(std::move(other));
    }
}

void LeafArranger::Impl::make_pieces(Index s) {
    const Item& item = items_[u(s)];
    Piece start;
    start.item = s;
    start.shape = bench_.clipped(with_edges(s), item.ref.box(), problem_->cell);
    if (start.shape.is_empty()) return;
    const std::size_t first = pieces_.size();
    pieces_.push_back(std::move(start));
    for (const Index t : items_[u(s)].cutters)
        split_all(first, items_[u(t)].shape.support, items_[u(t)].shape);
    for (const Index t : items_[u(s)].covers) {
        // The edges of the covering facet are lines in the plane of s, given by its edge planes.
        const WorkPolygon cover = with_edges(t);
        for (const WorkEdge& e : cover.edges) split_all(first, e.plane, cover);
    }
    resolve_covers(first);
    stats_->pieces += pieces_.size() - first;
}

bool LeafArranger::Impl::covered_by(const WorkPolygon& piece, Index t) {
    const WorkPolygon& cover = with_edges(t);
    return std::all_of(cover.edges.begin(), cover.edges.end(), [&](const WorkEdge& e) {
        const int outside = e.above ? -1 : 1;
        return std::all_of(piece.points.begin(), piece.points.end(),
                           [&](PointId p) { return bench_.side(p, e.plane) * outside <= 0; });
    });
}

bool LeafArranger::Impl::speaks_before(const Item& a, const Item& b) const {
    const auto key = [&](const Item& i) {
        return std::tuple(problem_->operands[u(i.operand)].slot, i.ref.source->serial(),
                          i.ref.facet);
    };
    if (key(a) != key(b)) return key(a) < key(b);
    return &a < &b;
}

std::vector<int> LeafArranger::Impl::step_of(Index item) const {
    std::vector<int> step(problem_->operands.size(), 0);
    step[u(items_[u(item)].operand)] += items_[u(item)].orientation;
    return step;
}

void LeafArranger::Impl::resolve_covers(std::size_t first) {
    for (std::size_t i = first; i < pieces_.size(); ++i) {
        Piece& piece = pieces_[i];
        const Item& item = items_[u(piece.item)];
        std::vector<int> step = step_of(piece.item);
        for (const Index t : item.covers) {
            if (!covered_by(piece.shape, t)) continue;
            const Item& other = items_[u(t)];
            if (speaks_before(other, item)) {
                piece.dropped = true;
                if (!problem_->cell.contains(item.ref.box()))
                    incomplete.push_back({item.ref.source->serial(), item.ref.facet});
                break;
            }
            // Orientation of the cover relative to this item's support.
            const bool same = same_orientation(bench_.plane_at(item.shape.support),
                                               bench_.plane_at(other.shape.support));
            step[u(other.operand)] += same ? other.orientation : -other.orientation;
        }
        piece.step = static_cast<int>(steps_.size());
        steps_.push_back(std::move(step));
    }
}

// Untouched whole facets of one operand that share an edge with an end in the cell lie in one
// patch: nothing else comes near that edge, so both have the same on either side. Where a boundary
// that may meet itself has more than two facets at an edge, they are different sheets.
void LeafArranger::Impl::make_patches() {
    const auto n = items_.size();
    patch_.resize(n);
    std::iota(patch_.begin(), patch_.end(), 0);
    patch_result_.assign(n, -1);
    edge_ids_.clear();
    edge_users_.clear();
    for (std::size_t i = 0; i < n; ++i) {
        const Item& item = items_[i];
        if (item.ref.fragment != nullptr || item.ref.source->is_half_space()) continue;
        for (int k = 0; k < 3; ++k) {
            if (!edge_ends_in_cell(item, k)) continue;
            const auto next = static_cast<Index>(edge_users_.size());
            const auto [id, inserted] = edge_ids_.insert(edge_key(item, k), next);
            if (inserted) edge_users_.push_back({});
            EdgeUsers& users = edge_users_[u(id)];
            if (users.count < 2) users.item[u(users.count)] = static_cast<Index>(i);
            ++users.count;
        }
    }
    for (const EdgeUsers& e : edge_users_) {
        if (e.count < 2) continue;
        const Item& a = items_[u(e.item[0])];
        const Item& b = items_[u(e.item[1])];
        if (a.touched || b.touched || a.operand != b.operand) continue;
        if (a.orientation != b.orientation) continue;
        if (e.count > 2 && !problem_->operands[u(a.operand)].embedded) continue;
        patch_[u(patch_of(e.item[0]))] = patch_of(e.item[1]);
    }
    patch_within_cell_.assign(n, -1);
    for (std::size_t i = 0; i < n; ++i)
        if (problem_->cell.contains(items_[i].ref.box()))
            patch_within_cell_[u(patch_of(static_cast<Index>(i)))] = static_cast<Index>(i);
}

bool LeafArranger::Impl::edge_ends_in_cell(const Item& item, int k) const {
    const auto in_cell = [&](int corner) {
        Box b;
        b.add(item.ref.source->corner(item.ref.facet, corner));
        return problem_->cell.contains(b);
    };
    return in_cell(k) || in_cell((k + 1) % 3);
}

Key128 LeafArranger::Impl::edge_key(const Item& item, int k) {
    const auto v = item.ref.source->corner_index(item.ref.facet, k);
    const auto w = item.ref.source->corner_index(item.ref.facet, (k + 1) % 3);
    return {(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(item.ref.source)) << 16) ^
                static_cast<std::uint64_t>(item.operand),
            (std::uint64_t{std::min(v, w)} << 32) | std::max(v, w)};
}

Index LeafArranger::Impl::patch_of(Index i) {
    while (patch_[u(i)] != i) i = patch_[u(i)] = patch_[u(patch_[u(i)])];
    return i;
}

void LeafArranger::Impl::classify_whole(Index i) {
    const Index patch = patch_of(i);
    std::int8_t& result = patch_result_[u(patch)];
    if (result < 0) {
        // A facet within the cell needs no clipping.
        const Index speaker = patch_within_cell_[u(patch)] >= 0 ? patch_within_cell_[u(patch)] : i;
        const Item& item = items_[u(speaker)];
        const bool within = problem_->cell.contains(item.ref.box()) && !item.shape.is_empty();
        const WorkPolygon part =
            within ? item.shape
                   : bench_.clipped(with_edges(speaker), item.ref.box(), problem_->cell);
        if (part.is_empty()) return;  // listed for its box, but not in the cell
        const auto sides = classify(speaker, part, step_of(speaker));
        TRISECT_EXPECTS(sides.has_value(), "no segment to a facet is free of degeneracies");
        result = static_cast<std::int8_t>((sides->above ? 1 : 0) | (sides->below ? 2 : 0));
    }
    emit(items_[u(i)].ref, (result & 1) != 0, (result & 2) != 0);
}

void LeafArranger::Impl::emit_pieces(Index s, std::size_t first) {
    const Item& item = items_[u(s)];
    std::vector<Index> kept;
    std::vector<bool> flips;
    for (std::size_t i = first; i < pieces_.size(); ++i) {
        const Piece& piece = pieces_[i];
        if (piece.dropped) continue;
        const auto sides = classify(s, piece.shape, steps_[u(piece.step)]);
        TRISECT_EXPECTS(sides.has_value(), "no segment to a piece is free of degeneracies");
        if (sides->above == sides->below) continue;
        kept.push_back(static_cast<Index>(i));
        flips.push_back(sides->above);
    }
    const bool uniform =
        std::adjacent_find(flips.begin(), flips.end(), std::not_equal_to<>()) == flips.end();
    if (kept.size() == pieces_.size() - first && uniform) {
        // Every cut was in vain here: keep what there was. What cuts a facet somewhere must show in
        // every cell, though (see PolygonRef), so only a facet within the cell stays whole.
        if (kept.empty()) return;
        const auto part = item.cutters.empty() && item.covers.empty()
                              ? std::optional<PolygonRef>(item.ref)
                              : clip_to_cell(bench_, item.ref, problem_->cell);
        if (part) emit(*part, flips[0], !flips[0]);
        return;
    }
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const PolygonRef part = make_fragment(bench_, item.ref, pieces_[u(kept[k])].shape);
        emit(part, flips[k], !flips[k]);
    }
}

// A polygon bounds the result when it is inside on one side only; its outside faces upwards, unless
// flipped.
void LeafArranger::Impl::emit(const PolygonRef& ref, bool above, bool below) {
    if (above == below) return;
    PolygonRef out = ref;
    out.flipped = above;
    out_.push_back(out);
}

bool LeafArranger::Impl::formula_at(const std::vector<int>& windings) {
    for (std::size_t o = 0; o < windings.size(); ++o) {
        const LeafOperand& operand = problem_->operands[o];
        (*values_)[u(operand.slot)] = is_inside(windings[o], problem_->options->winding) ? 1 : 0;
    }
    return value_of(*problem_->formula, *values_);
}

// Winding numbers of the operands at the target, leaving out polygons in the plane of the target
// and those of the target's own operand when the caller knows its winding numbers (-1: none).
bool LeafArranger::Impl::trace(const TraceTarget& target, PlaneId own_class, Index own_operand,
                               std::vector<int>& w) {
    w = reference_windings_;
    const Box segment = box_of_segment(reference_approximation_, target.approximation());
    for (Item& item : items_) {
        if (item.operand == own_operand || !item.ref.box().overlaps(segment)) continue;
        const Plane& support = bench_.plane_at(item.shape.support);
        if (own_class >= 0 && bench_.plane_class(item.shape.support) == own_class) continue;
        if (item.side_of_reference == 2)
            item.side_of_reference = side(reference_, reference_approximation_, support);
        const int at_start = item.side_of_reference;
        const int at_end = side(target, support);
        if (at_start == at_end && at_start != 0) continue;
        bench_.with_edges(item.shape, item.ref);
        if (at_start == 0 || at_end == 0) {
            const auto from_outside = [&](const WorkEdge& e) {
                return side(reference_, reference_approximation_, bench_.plane_at(e.plane)) *
                           (e.above ? -1 : 1) >
                       0;
            };
            const auto to_outside = [&](const WorkEdge& e) {
                return side(target, bench_.plane_at(e.plane)) * (e.above ? -1 : 1) > 0;
            };
            if (avoids_in_plane(at_start, at_end, item.shape.edges, from_outside, to_outside))
                continue;
            return false;
        }
        const SupportCrossing crossing(reference_, reference_approximation_, target,
                                       bench_.plane_at(item.shape.support));
        int worst = -1;
        for (const WorkEdge& e : item.shape.edges) {
            const int s = crossing.side_of(bench_.plane_at(e.plane));
            worst = std::max(worst, e.above ? -s : s);
            if (worst > 0) break;
        }
        if (worst == 0) return false;
        if (worst > 0) continue;
        w[u(item.operand)] += at_start > 0 ? item.orientation : -item.orientation;
    }
    return true;
}

std::optional<LeafArranger::Impl::Sides> LeafArranger::Impl::classify(
    Index item, const WorkPolygon& shape, const std::vector<int>& step) {
    check_budget(*problem_->options, *stats_);
    const PlaneId support = items_[u(item)].shape.support;
    const std::array<PointId, 3> corners = spread_vertices(shape);
    // An embedded operand has 0 outside its own facets and 1 inside.
    const Index own = items_[u(item)].operand;
    const Index known = problem_->operands[u(own)].embedded ? own : -1;
    std::vector<int> w;
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        if (attempt > 0) ++stats_->traces_retried;
        if (attempt % 6 == 5) next_reference();
        const int at_reference =
            side(reference_, reference_approximation_, bench_.plane_at(support));
        if (at_reference == 0) {
            next_reference();
            continue;
        }
        ++stats_->traces;
        const TraceTarget target(bench_, corners, weights_of_attempt(attempt));
        if (!trace(target, bench_.plane_class(support), known, w)) continue;
        if (known >= 0) {
            const bool outside_is_near = (items_[u(item)].orientation > 0) == (at_reference > 0);
            w[u(known)] = outside_is_near ? 0 : 1;
        }
        // w holds on the side of the reference; crossing to the other side takes the step.
        Sides sides;
        const bool near = formula_at(w);
        for (std::size_t o = 0; o < w.size(); ++o) w[o] += at_reference * step[o];
        const bool far = formula_at(w);
        sides.above = at_reference > 0 ? near : far;
        sides.below = at_reference > 0 ? far : near;
        return sides;
    }
    return std::nullopt;
}

// Another reference in the cell: some point between the old one and a pseudo-random corner of the
// polygons' box, at even positions so that it lies on no wall.
void LeafArranger::Impl::next_reference() {
    Box around;
    for (const Item& item : items_) around.add(item.box);
    for (int k = 0; k < 200; ++k) {
        FinePoint p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t lo =
                std::max(problem_->cell.lo[axis] + 1, (around.lo[axis] - 1) * wall_scale);
            const std::int64_t hi =
                std::min(problem_->cell.hi[axis] - 1, (around.hi[axis] + 1) * wall_scale);
            const auto seed = static_cast<std::uint64_t>(++reference_attempt_) * 3 + axis;
            const auto range = static_cast<std::uint64_t>(std::max<std::int64_t>(hi - lo, 1));
            const auto c = lo + static_cast<std::int64_t>(mix64(seed) % range);
            p.c[axis] = (c & 1) != 0 ? c + 1 : c;
        }
        if (!problem_->cell.contains(p) || p == reference_) continue;
        std::vector<int> w;
        if (!trace(TraceTarget(p), -1, -1, w)) continue;
        reference_ = p;
        reference_approximation_ = approximate(p);
        reference_windings_ = w;
        for (Item& item : items_) item.side_of_reference = 2;
        return;
    }
}

}  // namespace trisect::detail
