// SPDX-License-Identifier: Apache-2.0
//
// What exact_leaf.cpp does, for the common case that needs no more than doubles. There every
// facet gets planes in wide integers, its points get names in hash tables, and every question may
// end in exact arithmetic. Here a leaf is a few flat arrays: corners in doubles, which hold lattice
// points exactly, pairs of facets by orientations of corners, and constructed points by doubles
// with a bound. A point on a line that was cut before is known to be on it by name
// (filtered_cutting.cpp), and single signs are decided exactly where that is likely to help, such
// as those of corners on other facets (filtered_pair_relation.cpp); every other sign that doubles
// cannot decide ends the attempt, and the leaf takes the exact path. So the filtered path never
// guesses; leaves with coincident facets, or with edges along others, lose the attempt, which
// mostly ends at the first such pair.
//
// Fragments of earlier results are convex polygons whose vertices are kept as doubles with a bound,
// and whose edges name the planes that cut them out. So they are items like whole facets, of up to
// twenty corners, and what is constructed from them is known by names as well. Along a chain of
// cuts nearly all leaves hold some.
//
// EvaluateCounters::filtered_leaves counts the leaves that it served, filtered_fragments their
// fragments.

#include <trisect/bsp/leaf/doubles/filtered_leaf.h>

#include <algorithm>

#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

std::optional<LeafResult> FilteredLeaf::try_to_arrange(const LeafProblem& problem,
                                                       LeafFindings& findings) {
    if (!facets_.list(problem)) return std::nullopt;
    defers_ = problem.may_defer && findings.crossings && problem.operands.size() >= 2;
    // Crossings are of whole facets.
    if (defers_ && facets_.fragment_count() != 0) return std::nullopt;
    findings_ = &findings;
    covers_before_ = defers_ ? findings.crossings->containments.size() : 0;
    seen_before_ = findings.seen.size();
    bool done = false;
    try {
        done = arrange_listed();
    } catch (...) {
        undo();
        throw;
    }
    if (!done) {
        undo();
        return std::nullopt;
    }
    if (!defers_) return LeafPolygons{listed()};
    pairs_.add_to(*findings.crossings, facets_);
    if (crossed_ == 0) return LeafPolygons{listed()};
    return LeafUncrossed{listed(), crossed_};
}

void FilteredLeaf::undo() {
    if (defers_) findings_->crossings->containments.resize(covers_before_);
    findings_->seen.resize(seen_before_);
    end_fragments(out_);  // those made so far
    out_.clear();
}

bool FilteredLeaf::arrange_listed() {
    EvaluateStats& stats = findings_->stats;
    if (!pairs_.relate_all(facets_, defers_, stats)) return false;
    windings_.start(facets_, pairs_);
    formula_.start(facets_.problem());
    crossed_ = 0;
    start_covers();
    cutting_.start(facets_, pairs_, windings_, formula_, open_, stats);
    for (LeafIndex i = 0; i < facets_.size(); ++i) {
        const bool crossed = !pairs_.contacts(i).empty();
        if (crossed && defers_) {
            ++crossed_;
            if (!add_covers(i)) return false;
            continue;
        }
        if (crossed) {
            facets_[i].ref.touched = true;
        } else if (!facets_[i].ref.touched) {
            ++stats.untouched_polygons;
        }
        const FilteredCutting::Result result = crossed ? cutting_.cut(i) : cutting_.whole(i);
        if (result.kind == FilteredCutting::Remains::Uncertain) return false;
        emit(i, result);
    }
    if (cutting_.found_common_lines()) findings_->may_have_straight_crossings = true;
    stats.filtered_fragments += facets_.fragment_count();
    return true;
}

// Whether a crossing surely has an end in the cell.
bool FilteredLeaf::is_crossed_inside(LeafIndex item) const {
    const auto contacts = pairs_.contacts(item);
    return std::ranges::any_of(contacts, [&](const FilteredContact& c) {
        return std::ranges::any_of(pairs_.crossing(c.crossing).ends, [&](const FilteredEnd& end) {
            for (std::size_t k = 0; k < 3; ++k)
                if (end.at.c[k] - end.at.error < facets_.inner_lo()[k] ||
                    end.at.c[k] + end.at.error > facets_.inner_hi()[k])
                    return false;
            return true;
        });
    });
}

void FilteredLeaf::start_covers() {
    open_.clear();
    slots_.clear();
    if (!defers_) return;
    for (std::size_t o = 0; o < facets_.operand_count(); ++o) {
        open_.push_back(findings_->crossings->operands[slot_of(o)].open);
        slots_.push_back(static_cast<std::uint32_t>(slot_of(o)));
    }
}

// Notes a facet that something crosses, and the operands that it lies in here, of those that do not
// cross it. One whose part in the cell is empty belongs to other cells.
bool FilteredLeaf::add_covers(LeafIndex item) {
    Crossings& crossings = *findings_->crossings;
    std::vector<std::uint32_t>& seen = findings_->seen;
    if (crossings.operands.size() == 2) return true;
    const std::size_t own = as_index(facets_[item].operand);
    const std::uint32_t number = crossings.number_of(slots_[own], facets_[item].ref.facet);
    const auto contacts = pairs_.contacts(item);
    // They come operand by operand.
    std::size_t crossing = 0;
    LeafIndex last = -1;
    for (const FilteredContact& c : contacts) {
        const LeafIndex operand = facets_[c.other].operand;
        crossing += operand != last ? 1 : 0;
        last = operand;
    }
    if (crossing + 1 == open_.size() && is_crossed_inside(item)) {
        seen.push_back(number);
        return true;
    }
    const auto windings = cutting_.windings_on(item);
    if (!windings) return false;
    if (windings->empty()) return true;
    seen.push_back(number);
    for (std::size_t o = 0; o < open_.size(); ++o) {
        if ((*windings)[o] == open_[o] || o == own) continue;
        const bool crosses = std::ranges::any_of(contacts, [&](const FilteredContact& c) {
            return as_index(facets_[c.other].operand) == o;
        });
        if (!crosses) crossings.containments.push_back({number, slots_[o]});
    }
    return true;
}

// The outside faces upwards, unless flipped.
void FilteredLeaf::emit(LeafIndex item, const FilteredCutting::Result& result) {
    const auto add = [&](PolygonRef ref, bool inside_above) {
        ref.flipped = inside_above;
        out_.push_back(ref);
    };
    if (result.kind == FilteredCutting::Remains::Uncut) {
        // What cuts a facet somewhere must show in every cell (see PolygonRef), so only a facet
        // within the cell stays whole.
        const bool part = !pairs_.contacts(item).empty() && cutting_.was_clipped();
        make_room(out_);
        add(part ? cutting_.fragment(cutting_.clipped()) : facets_[item].ref, result.inside_above);
    } else if (result.kind == FilteredCutting::Remains::Parts) {
        for (const FilteredPart& p : cutting_.parts()) {
            if (p.state != FilteredPart::State::Kept) continue;
            make_room(out_);
            add(cutting_.fragment(p), p.inside_above);
        }
    }
}

}  // namespace trisect::detail
