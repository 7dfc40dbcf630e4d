// SPDX-License-Identifier: Apache-2.0
//
// Two facets that are strictly on one side of each other's plane have nothing in common; that, by
// doubles with a proved bound, disposes of most pairs whose boxes meet. Corners that two facets of
// one mesh share are on both planes by name, and facets around a common corner are the many pairs
// of a fan, so they cost no arithmetic.

#include <trisect/bsp/leaf/exact/leaf_pairs.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <trisect/bsp/cells/trace/trace.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/leaf/split_piece.h>
#include <trisect/kernel/number/separating_plane.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/triangle_pair.h>

namespace trisect::detail {

namespace {

// Where the corners of a polygon are with respect to a plane.
struct SideRange {
    int lo = 2;
    int hi = -2;
    int zeros = 0;
    Few<std::int8_t> sides;
    [[nodiscard]] bool is_off() const { return lo > 0 || hi < 0; }
    [[nodiscard]] bool is_on() const { return lo == 0 && hi == 0; }
    [[nodiscard]] bool straddles() const { return lo < 0 && hi > 0; }
    /// Touches the plane in one corner.
    [[nodiscard]] bool rests_on_a_corner() const { return !straddles() && zeros == 1; }
};

// Compares two items of a leaf.
class Relation {
public:
    Relation(LeafWork& work, LeafIndex s, LeafIndex t)
        : work_(work), bench_(work.bench), s_(s), t_(t), a_(work.shape(s)), b_(work.shape(t)) {
        const LeafItem& i = work.item(s);
        const LeafItem& j = work.item(t);
        same_mesh_ = i.operand == j.operand && i.ref.source == j.ref.source &&
                     i.ref.fragment == nullptr && j.ref.fragment == nullptr;
    }

    // Whether the items are in contact; then `of_first` and `of_second` say how.
    bool find(LeafContact& of_first, LeafContact& of_second) {
        of_first = {t_, false, false};
        of_second = {s_, false, false};
        const SideRange b_range = range(b_, a_);
        if (b_range.is_off()) return false;
        if (b_range.is_on()) {
            bench_.declare_same(a_.support, b_.support);
            if (separated_by_edges(s_, b_) || separated_by_edges(t_, a_))
                return !(same_mesh_ && shared_corners() == 2);
            of_first.overlaps = of_second.overlaps = true;
            return true;
        }
        const SideRange a_range = range(a_, b_);
        if (a_range.is_off()) return false;
        if (same_mesh_ && meets_in_common_corners_only(a_range, b_range)) return false;
        if (a_range.straddles() && b_range.straddles() && a_range.zeros + b_range.zeros == 0) {
            const TrianglePair pair = as_triangles(a_range, b_range);
            if (pair == TrianglePair::Disjoint) return false;
            if (pair == TrianglePair::Crossing) {
                if (meets_plane_outside_cell(a_, a_range, b_.support) ||
                    meets_plane_outside_cell(b_, b_range, a_.support))
                    return false;
                of_first.cuts = of_second.cuts = true;
                return true;
            }
        }
        if (a_range.straddles() && b_range.straddles()) {
            // The common line of the planes runs through both interiors.
            of_first.cuts = of_second.cuts = cuts(s_, t_);
        } else if (a_range.straddles()) {
            of_first.cuts = cuts(s_, t_);
        } else if (b_range.straddles()) {
            of_second.cuts = cuts(t_, s_);
        }
        // They meet, but elsewhere: in this cell the two are as if they did not.
        if ((of_first.cuts || of_second.cuts) &&
            is_outside_cell(bench_.approximation(ends_[0]), bench_.approximation(ends_[1])))
            return false;
        return true;
    }

private:
    // Does item t run through the interior of item s, by more than a point? Leaves `ends_`.
    [[nodiscard]] bool cuts(LeafIndex s, LeafIndex t) {
        (void)work_.with_edges(s);
        const WorkPolygon& cutter = work_.with_edges(t);
        return segment_meets_interior(bench_, work_.item(s).shape, cutter.support, cutter, ends_);
    }
    // Two whole facets, by their corners alone.
    [[nodiscard]] TrianglePair as_triangles(const SideRange& a, const SideRange& b) const {
        const auto sided = [&](const WorkPolygon& w, const SideRange& r, SidedTriangle& out) {
            if (w.points.size() != 3) return false;
            for (std::size_t k = 0; k < 3; ++k) {
                if (!bench_.is_corner(w.points[k])) return false;
                out.corners[k] = bench_.lattice(w.points[k]);
                out.sides[k] = r.sides[k];
            }
            return true;
        };
        SidedTriangle s;
        SidedTriangle t;
        if (!sided(a_, a, s) || !sided(b_, b, t)) return TrianglePair::Unknown;
        return relate_triangles(s, t);
    }
    // Where a triangle crosses a plane: surely not in the cell?
    [[nodiscard]] bool meets_plane_outside_cell(const WorkPolygon& w, const SideRange& r,
                                                PlaneId plane) const {
        std::array<Approximation, 2> ends;
        std::size_t found = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (r.sides[k] == r.sides[next]) continue;
            const auto x =
                approximate_crossing(bench_.approximation(w.points[k]),
                                     bench_.approximation(w.points[next]), bench_.plane_at(plane));
            if (!x) return false;
            ends[found++] = *x;
        }
        return is_outside_cell(ends[0], ends[1]);
    }
    // Surely: a segment on a splitting plane is not.
    [[nodiscard]] bool is_outside_cell(const Approximation& a, const Approximation& b) const {
        const Cell& cell = work_.problem->cell;
        for (std::size_t k = 0; k < 3; ++k) {
            const double slack =
                2 * (a.error + b.error) + 0x1p-45 * (std::fabs(a.c[k]) + std::fabs(b.c[k]));
            const auto scale = static_cast<double>(splitting_scale);
            const double lo = (std::min(a.c[k], b.c[k]) - slack) * scale;
            const double hi = (std::max(a.c[k], b.c[k]) + slack) * scale;
            if (hi < static_cast<double>(cell.lo[k]) || lo > static_cast<double>(cell.hi[k]))
                return true;
        }
        return false;
    }
    [[nodiscard]] static bool has_corner(const WorkPolygon& w, PointId p) {
        return std::find(w.points.begin(), w.points.end(), p) != w.points.end();
    }
    // Of the corners of `w` with respect to the support of `other`.
    [[nodiscard]] SideRange range(const WorkPolygon& w, const WorkPolygon& other) const {
        SideRange r;
        for (const PointId p : w.points) {
            const int x = same_mesh_ && has_corner(other, p) ? 0 : bench_.side(p, other.support);
            r.lo = std::min(r.lo, x);
            r.hi = std::max(r.hi, x);
            if (x == 0) ++r.zeros;
            r.sides.push_back(static_cast<std::int8_t>(x));
        }
        return r;
    }
    [[nodiscard]] int shared_corners() const {
        return static_cast<int>(std::count_if(a_.points.begin(), a_.points.end(),
                                              [&](PointId p) { return has_corner(b_, p); }));
    }
    // Two facets in different planes with a common edge meet nowhere else; with one common corner
    // and the rest of one of them strictly on one side they meet in that corner only.
    [[nodiscard]] bool meets_in_common_corners_only(const SideRange& a, const SideRange& b) const {
        const int shared = shared_corners();
        return shared >= 2 || (shared == 1 && (a.rests_on_a_corner() || b.rests_on_a_corner()));
    }
    // Whether `other`, in the plane of an item, lies beyond one of the item's edges.
    [[nodiscard]] bool separated_by_edges(LeafIndex item, const WorkPolygon& other) {
        const auto& edges = work_.with_edges(item).edges;
        return std::any_of(edges.begin(), edges.end(), [&](const WorkEdge& e) {
            const int outside = e.above ? -1 : 1;
            return std::all_of(other.points.begin(), other.points.end(),
                               [&](PointId p) { return bench_.side(p, e.plane) * outside >= 0; });
        });
    }

    LeafWork& work_;
    Workbench& bench_;
    LeafIndex s_;
    LeafIndex t_;
    const WorkPolygon& a_;
    const WorkPolygon& b_;
    bool same_mesh_;
    std::array<PointId, 2> ends_{-1, -1};
};

}  // namespace

void LeafPairs::relate_all(LeafWork& work) {
    contacts_.clear();
    list_candidates(work);
    sort_along(work, best_axis(work));
    list_facets(work);
    sweep(work);
    work.set_contacts(contacts_);
}

// Items that may meet one of another operand, or of their own if that is not embedded.
void LeafPairs::list_candidates(const LeafWork& work) {
    const std::size_t n = work.problem->operands.size();
    candidates_.clear();
    // With many operands the boxes of the others overlap nearly everything.
    const bool compare = n <= 8;
    operand_boxes_.assign(n, Box{});
    if (compare)
        for (const LeafItem& item : work.items)
            operand_boxes_[as_index(item.operand)].add(item.box);
    for (LeafIndex i = 0; i < work.item_count(); ++i) {
        const LeafItem& item = work.item(i);
        const bool embedded = work.operand_of(item).embedded;
        bool candidate = !compare || !embedded;
        for (std::size_t o = 0; o < n && !candidate; ++o)
            candidate = o != as_index(item.operand) && operand_boxes_[o].overlaps(item.box);
        if (candidate) candidates_.push_back({{}, {}, i, item.operand, embedded});
    }
}

// The axis on which the fewest boxes overlap: where their lengths sum up to the smallest part of
// the whole extent.
int LeafPairs::best_axis(const LeafWork& work) const {
    Box all;
    std::array<double, 3> lengths{};
    for (const Candidate& c : candidates_) {
        const Box& b = work.item(c.item).box;
        all.add(b);
        for (std::size_t k = 0; k < 3; ++k) lengths[k] += static_cast<double>(b.hi[k] - b.lo[k]);
    }
    int best = 0;
    double best_share = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double share = lengths[k] / (static_cast<double>(all.hi[k] - all.lo[k]) + 1);
        if (k == 0 || share < best_share) {
            best = static_cast<int>(k);
            best_share = share;
        }
    }
    return best;
}

void LeafPairs::sort_along(const LeafWork& work, int axis) {
    for (Candidate& c : candidates_) {
        const Box& b = work.item(c.item).box;
        for (std::size_t k = 0; k < 3; ++k) {
            c.lo[k] = b.lo[(k + static_cast<std::size_t>(axis)) % 3];
            c.hi[k] = b.hi[(k + static_cast<std::size_t>(axis)) % 3];
        }
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
        return a.lo[0] != b.lo[0] ? a.lo[0] < b.lo[0] : a.item < b.item;
    });
}

void LeafPairs::list_facets(const LeafWork& work) {
    facets_.assign(candidates_.size(), Facet{});
    largest_ = {};
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const LeafItem& item = work.item(candidates_[i].item);
        if (item.ref.fragment != nullptr || item.ref.source->is_half_space()) continue;
        Facet& f = facets_[i];
        f.surface = item.surface;
        for (int v = 0; v < 3; ++v) {
            const auto c = static_cast<std::size_t>(v);
            f.corners[c] = approximate(item.ref.source->corner(item.ref.facet, v)).c;
            f.vertices[c] = item.ref.source->corner_index(item.ref.facet, v);
            for (std::size_t k = 0; k < 3; ++k)
                largest_[k] = std::max(largest_[k], std::fabs(f.corners[c][k]));
        }
    }
}

// The bound is that of filtered_side() for the largest coordinates of the leaf.
void LeafPairs::make_plane(LeafWork& work, std::size_t i) {
    Facet& f = facets_[i];
    const Plane& p = work.bench.plane_at(work.shape(candidates_[i].item).support);
    f.offset = p.approx_offset();
    double terms = std::fabs(f.offset);
    for (std::size_t k = 0; k < 3; ++k) {
        f.normal[k] = p.approx_normal(static_cast<int>(k));
        terms += std::fabs(f.normal[k]) * largest_[k];
    }
    f.bound = 0x1p-50 * terms;
}

// Whether the second facet is strictly on one side of the first one's plane, corners apart that
// the two share. Then they meet in those corners only, or in the edge between them.
bool LeafPairs::separates(LeafWork& work, std::size_t i, std::size_t j) {
    if (facets_[i].bound < 0) make_plane(work, i);
    const Facet& f = facets_[i];
    const Facet& g = facets_[j];
    const bool same_mesh = f.surface == g.surface;
    bool above = true;
    bool below = true;
    int shared = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = g.vertices[c];
        if (same_mesh && (v == f.vertices[0] || v == f.vertices[1] || v == f.vertices[2])) {
            ++shared;
            continue;
        }
        const auto& p = g.corners[c];
        const double s =
            ((f.normal[0] * p[0] + f.normal[1] * p[1]) + f.normal[2] * p[2]) + f.offset;
        above = above && s > f.bound;
        below = below && s < -f.bound;
    }
    return (above || below) && shared < 3;
}

// Whether some other plane does, as of triangles of one face that was turned and rounded. Those of
// different meshes that come here mostly touch.
bool LeafPairs::are_apart_otherwise(std::size_t i, std::size_t j) const {
    const Facet& f = facets_[i];
    const Facet& g = facets_[j];
    if (f.surface != g.surface) return false;
    std::size_t shared = 0;
    std::array<std::size_t, 2> at{};  // of one shared corner
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
            if (f.vertices[a] == g.vertices[b]) {
                ++shared;
                at = {a, b};
            }
    if (shared == 0) return have_plane_between(f.corners, g.corners);
    if (shared != 1) return false;
    const auto others = [](const Facet& t, std::size_t c) {
        return std::array<Vector3, 2>{t.corners[(c + 1) % 3], t.corners[(c + 2) % 3]};
    };
    return have_plane_between(f.corners[at[0]], others(f, at[0]), others(g, at[1]));
}

void LeafPairs::sweep(LeafWork& work) {
    std::uint64_t separated = 0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
        check_budget(*work.problem->options, *work.stats);
        const Candidate& a = candidates_[i];
        for (std::size_t j = i + 1; j < candidates_.size(); ++j) {
            const Candidate& b = candidates_[j];
            if (b.lo[0] > a.hi[0]) break;
            if (a.skips_own && a.operand == b.operand) continue;
            if (a.lo[1] > b.hi[1] || b.lo[1] > a.hi[1] || a.lo[2] > b.hi[2] || b.lo[2] > a.hi[2])
                continue;
            ++work.stats->pairs_boxes;
            if (facets_[i].surface >= 0 && facets_[j].surface >= 0 &&
                (separates(work, i, j) || separates(work, j, i) || are_apart_otherwise(i, j))) {
                ++separated;
                continue;
            }
            relate(work, std::min(a.item, b.item), std::max(a.item, b.item));
        }
    }
    detail::counters_of_thread<PredicateCounters>.filtered += 3 * separated;
    for (const auto& [i, contact] : contacts_) {
        LeafItem& item = work.item(i);
        item.ref.touched = true;
        item.cut = item.cut || contact.cuts;
        item.overlapped = item.overlapped || contact.overlaps;
    }
}

void LeafPairs::relate(LeafWork& work, LeafIndex s, LeafIndex t) {
    LeafContact first;
    LeafContact second;
    if (!Relation(work, s, t).find(first, second)) return;
    ++work.stats->pairs_touching;
    if (first.cuts || second.cuts) ++work.stats->pairs_cutting;
    contacts_.emplace_back(s, first);
    contacts_.emplace_back(t, second);
}

}  // namespace trisect::detail
