// SPDX-License-Identifier: Apache-2.0
//
// What leaf_arrangement.cpp does, for the common case that needs no more than doubles. There every
// facet gets planes in wide integers, its points get names in hash tables, and every question may
// end in exact arithmetic. Here a leaf is a few flat arrays: corners in doubles, which hold lattice
// points exactly, pairs of facets by orientations of corners, and constructed points by doubles
// with a bound. A point on a line that was cut before is known to be on it by name
// (plain_cutting.cpp); every other sign that doubles cannot tell ends the attempt, and the leaf is
// arranged the long way. So the short way never decides anything that it does not know; leaves with
// touching or coincident facets lose the attempt, which mostly ends at the first such pair.
//
// Fragments of earlier results are convex polygons whose vertices are kept as doubles with a bound,
// and whose edges name the planes that cut them out. So they are items like whole facets, of up to
// twenty corners, and what is constructed from them is known by names as well. Along a chain of
// cuts nearly all leaves hold some.
//
// EvaluateStats::plain_leaves counts the leaves that it served, plain_fragments their fragments.

#include <trisect/bsp/detail/plain_leaf.h>

#include <trisect/bsp/detail/polygon_in_cell.h>

namespace trisect::detail {

bool PlainLeaf::arrange(const LeafProblem& problem, EvaluateStats& stats,
                        std::vector<PolygonRef>& out) {
    return try_to_arrange(problem, true, stats, out);
}

std::optional<std::size_t> PlainLeaf::arrange_uncrossed(const LeafProblem& problem,
                                                        EvaluateStats& stats,
                                                        std::vector<PolygonRef>& out) {
    if (!try_to_arrange(problem, false, stats, out)) return std::nullopt;
    return crossed_;
}

bool PlainLeaf::try_to_arrange(const LeafProblem& problem, bool crossed_too, EvaluateStats& stats,
                               std::vector<PolygonRef>& out) {
    if (!facets_.list(problem)) return false;
    const EvaluateStats before = stats;
    bool done = false;
    const auto undo = [&] {
        stats = before;
        end_fragments(out);  // those made so far
        out.clear();
    };
    try {
        done = arrange_listed(crossed_too, stats, out);
    } catch (...) {
        undo();
        throw;
    }
    if (!done) undo();
    return done;
}

bool PlainLeaf::arrange_listed(bool crossed_too, EvaluateStats& stats,
                               std::vector<PolygonRef>& out) {
    if (!pairs_.relate_all(facets_, !crossed_too, stats)) return false;
    windings_.start(facets_, pairs_);
    formula_.start(facets_.problem());
    crossed_ = 0;
    cutting_.start(facets_, pairs_, windings_, formula_, stats);
    for (LeafIndex i = 0; i < facets_.size(); ++i) {
        const bool crossed = !pairs_.contacts(i).empty();
        if (crossed && !crossed_too) {
            ++crossed_;
            continue;
        }
        if (crossed) {
            facets_[i].ref.touched = true;
        } else if (!facets_[i].ref.touched) {
            ++stats.untouched_polygons;
        }
        const PlainCutting::Result result = crossed ? cutting_.cut(i) : cutting_.whole(i);
        if (result.kind == PlainCutting::Remains::Doubtful) return false;
        emit(i, result, out);
    }
    ++stats.mixed_leaves;
    ++stats.plain_leaves;
    stats.plain_fragments += facets_.fragment_count();
    return true;
}

void PlainLeaf::add_crossings(std::vector<FacetCrossing>& out) const {
    for (const PlainCrossing& c : pairs_.crossings()) {
        FacetCrossing& made = out.emplace_back();
        for (std::size_t k = 0; k < 2; ++k) {
            made.facets[k] = facets_[c.items[k]].ref.facet;
            const PlainEnd& end = c.ends[k];
            made.ends[k] = {facets_.in_lattice(end.at), end.of_second, end.edge};
        }
    }
}

// The outside faces upwards, unless flipped.
void PlainLeaf::emit(LeafIndex item, const PlainCutting::Result& result,
                     std::vector<PolygonRef>& out) {
    const auto add = [&](PolygonRef ref, bool inside_above) {
        ref.flipped = inside_above;
        out.push_back(ref);
    };
    if (result.kind == PlainCutting::Remains::Uncut) {
        // What cuts a facet somewhere must show in every cell (see PolygonRef), so only a facet
        // within the cell stays whole.
        const bool part = !pairs_.contacts(item).empty() && cutting_.was_clipped();
        make_room(out);
        add(part ? cutting_.fragment(cutting_.clipped()) : facets_[item].ref, result.inside_above);
    } else if (result.kind == PlainCutting::Remains::Parts) {
        for (const PlainPart& p : cutting_.parts()) {
            if (p.state != PlainPart::State::Kept) continue;
            make_room(out);
            add(cutting_.fragment(p), p.inside_above);
        }
    }
}

}  // namespace trisect::detail
