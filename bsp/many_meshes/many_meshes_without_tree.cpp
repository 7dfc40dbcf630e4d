// SPDX-License-Identifier: Apache-2.0
//
// In such a formula an operand bounds the result where all others are open (crossings.h), so it is
// an intersection, of what the operands leave open. It is made pair by pair, in a balanced tree:
// operands that fill one place cut each other down, and a facet is compared with what is left of
// the others. Where all were compared with all, most crossings would not be in the result.
//
// Intermediate results are parts of whole facets by name (outlined_solid.h), so nothing gets less
// exact on the way, and no polygon is cut.
//
// Of unions and intersections of each other the terms of the innermost come first. A union is the
// complement of what the complements of its terms have in common. Where something touches there,
// faces of the result may go straight across each other in a line that an outline lacks; assembly
// looks for such lines.
//
// Where meshes touch, operands are moved by less than any number (operand_shifts.h), which puts all
// in general position. Assembly moves them back: parts without an area are left out then. Facets
// that cover a part of a plane leave a sheet of no thickness if they are moved the wrong way; then
// all is done once more with other moves. Where no moves serve all of them, as for tubes within
// each other whose ends are flush, assembly takes the sheets out (sheets.h).

#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/many_meshes/balanced_tree.h>
#include <trisect/bsp/many_meshes/crowd.h>
#include <trisect/bsp/many_meshes/decided_operands.h>
#include <trisect/bsp/many_meshes/form_of_outlines.h>
#include <trisect/bsp/many_meshes/formula_reach.h>
#include <trisect/bsp/many_meshes/imported_operands.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/settled_part.h>
#include <trisect/bsp/many_meshes/thin_facets.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {

namespace {

// So few facets are compared pair by pair wherever they are, where enough operands may touch
// others: cells would be arranged exactly. More are where most may bound the result.
constexpr std::size_t few_facets = 20000;

bool are_few(const SolidStates& solids) {
    std::size_t facets = 0;
    for (const auto& s : solids) facets += source_of(*s).facet_count();
    return facets <= few_facets;
}

// Whether facets are thin, by are_mostly_thin(): needles; of less thin ones, facets of formulas in
// two levels.
constexpr double thin = 40;
constexpr double thin_of_nested = 8;
constexpr std::size_t least_of_thin = 128;  // facets an operand

bool are_thin(const Residual& formula, const SolidStates& solids) {
    std::vector<const Source*> sources;
    std::size_t facets = 0;
    for (const auto& s : solids) {
        sources.push_back(&source_of(*s));
        facets += source_of(*s).facet_count();
    }
    if (facets < least_of_thin * sources.size()) return false;
    return are_mostly_thin(sources, crossings_of(formula, solids) ? thin : thin_of_nested);
}

// About how many facets of an imported mesh are beside a box, by some of them.
std::size_t facets_beside(const Source& source, const Box& box) {
    constexpr std::size_t most_looked_at = 64;
    const LatticeMesh& mesh = source.mesh();
    const std::size_t count = source.facet_count();
    if (!source.box().overlaps(box)) return count;
    if (box.intersected(source.box()) == source.box()) return 0;
    const std::size_t looked_at = std::min(count, most_looked_at);
    std::size_t beside = 0;
    for (std::size_t i = 0; i < looked_at; ++i) {
        Box facet;
        for (const std::uint32_t corner : mesh.triangles[i * count / looked_at])
            facet.add(mesh.points[corner]);
        if (!facet.overlaps(box)) ++beside;
    }
    return beside * count / looked_at;
}

// Whether most facets are beside all that the result may have, as in an intersection of what is
// scattered, or a small part less large ones: cells drop them at once.
bool are_mostly_beside(const Residual& formula, const SolidStates& solids) {
    const std::optional<Box> reach = reach_of(formula, solids);
    if (!reach) return false;
    if (reach->is_empty()) return true;
    std::size_t beside = 0;
    std::size_t all = 0;
    for (const auto& s : solids) {
        all += source_of(*s).facet_count();
        beside += facets_beside(source_of(*s), *reach);
    }
    return 2 * beside > all;
}

std::int64_t size_of(const Box& b) {
    return (b.hi[0] - b.lo[0]) + (b.hi[1] - b.lo[1]) + (b.hi[2] - b.lo[2]);
}

// What is left open gets smaller. But in a union of differences, where some meet as in a union and
// others as in a difference, all grow, and those that are subtracted more than the others.
OperandShifts::Growth growth_of(const ManyMeshes& meshes, std::uint32_t slot) {
    OperandShifts::Growth out;
    const bool shrinks = meshes.operands->operands[slot].is_open_below();
    out.sign = static_cast<std::int8_t>(shrinks ? -1 : 1);
    if (meshes.nested == nullptr) return out;
    out.cuts = !meshes.nested->is_positive(slot);
    if (!out.cuts && !meshes.nested->is_intersected(slot)) out.sign = 1;
    return out;
}

std::vector<OperandShifts::Growth> growths_of(const ManyMeshes& meshes) {
    std::vector<OperandShifts::Growth> out;
    for (std::size_t i = 0; i < meshes.sources.size(); ++i) {
        const Box& b = meshes.sources[i]->box();
        const auto middle = [&](std::size_t k) { return b.lo[k] + (b.hi[k] - b.lo[k]) / 2; };
        out.push_back(growth_of(meshes, static_cast<std::uint32_t>(i)));
        out.back().centre = {middle(0), middle(1), middle(2)};
        out.back().size = size_of(b);
    }
    return out;
}

// How often all may be done, and whether meshes grow and shrink the wrong way.
struct Turns {
    int most = 4;
    bool are_backwards = false;
};

// Sheets cost little beside another turn where so many facets come to each move that is wanted.
constexpr std::size_t facets_to_leave_sheets = 24;

// What all operands leave open together, and the facets in special position.
struct CommonOfAll {
    OutlineStore store;
    std::vector<std::uint32_t> special;  // ascending
    bool has_sheets = false;             // or may have
};

// Facets in special position get vertices of others into their edges; then those that share an edge
// with them need the same.
void add_sharing(CommonOfAll& common, std::size_t facet_count) {
    if (common.special.empty()) return;
    std::vector<std::uint8_t> is_special(facet_count);
    for (const std::uint32_t f : common.special) is_special[f] = 1;
    common.special.clear();
    for (std::uint32_t f = 0; f < facet_count; ++f)
        if (is_special[f] != 0) common.special.push_back(f);
    const auto look = [&](const OutlinedSolid& part) {
        for (const OutlinedSolid::Facet& f : part.facets) {
            if (is_special[f.number] != 0) continue;
            const auto edges = part.edges_of(f);
            if (std::ranges::any_of(edges, [&](const OutlinedSolid::Edge& e) {
                    const FacetCrossing* line = part.line_of(e);
                    return line != nullptr &&
                           (is_special[line->facets[0]] != 0 || is_special[line->facets[1]] != 0);
                }))
                common.special.push_back(f.number);
        }
    };
    const auto look_at_kept = [&](const SettledPart& part) {
        for (const OutlinedFacets::Facet& f : part.kept) {
            if (is_special[f.number] != 0) continue;
            const auto edges = std::span(part.kept_edges).subspan(f.first, f.count);
            if (std::ranges::any_of(edges, [&](const OutlinedFacets::Edge& e) {
                    return e.edge < 0 && is_special[e.cutter] != 0;
                }))
                common.special.push_back(f.number);
        }
    };
    const OutlinedSolid solid = common.store.view({});
    look(solid);
    for (const auto& part : solid.settled) {
        look(part->view());
        look_at_kept(*part);
    }
    std::ranges::sort(common.special);
}

// Nothing where it cannot be found. Sheets of no thickness are left where they are few, once no
// other moves are found, and after the last turn.
std::optional<CommonOfAll> common_of_all(ManyMeshes& meshes, const SolidStates& solids,
                                         const EvaluateSettings& options, const Turns& turns,
                                         std::uint32_t threads, EvaluateStats& stats) {
    std::vector<OperandShifts::Growth> growths = growths_of(meshes);
    for (OperandShifts::Growth& g : growths)
        if (turns.are_backwards) g.sign = static_cast<std::int8_t>(-g.sign);
    std::optional<OperandShifts> shifts(growths);
    std::vector<OperandShifts::Wanted> wanted;
    for (int turn = 0;; ++turn) {
        meshes.shifts = &*shifts;
        BalancedTree tree(meshes, solids, options, threads != 1);
        EvaluateStats made;
        if (!tree.of_all(made)) return std::nullopt;
        CommonOfAll out;
        bool as_wanted = true;
        tree.for_each_special([&](const SpecialPosition& s) {
            out.special.insert(out.special.end(), s.facets().begin(), s.facets().end());
            for (const OperandShifts::Wanted& w : s.wanted()) {
                as_wanted = as_wanted && shifts->satisfies(w);
                wanted.push_back(w);
            }
        });
        std::ranges::sort(wanted);
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        const bool leaves_sheets =
            turn + 1 == turns.most || facets_to_leave_sheets * wanted.size() < meshes.facet_count();
        std::optional<OperandShifts> next;
        if (!as_wanted && !leaves_sheets) next = OperandShifts::satisfying(growths, wanted);
        if (!next) {
            out.store = tree.take_store();
            add_sharing(out, meshes.facet_count());
            out.has_sheets = !as_wanted;
            stats = made;
            return out;
        }
        shifts = std::move(next);
    }
}

// Operands as in an intersection, of what they are or their complements.
std::optional<Crossings> nested_crossings(const NestedFormula& nested, const SolidStates& solids) {
    std::optional<Crossings> out = crossing_operands(solids);
    if (!out) return std::nullopt;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        Crossings::Operand& o = out->operands[i];
        o.open = nested.is_positive(i) ? 1 : 0;
        o.inside_above = o.flipped == nested.is_positive(i);
    }
    return out;
}

bool is_nested(const Residual& formula, const SolidStates& solids) {
    const auto nested = NestedFormula::read(formula, solids.size());
    return nested && nested_crossings(*nested, solids);
}

// What is evaluated: all operands, but those of a nested formula that others decide.
struct Operands {
    SolidStates solids;
    std::optional<NestedFormula> nested;
    Crossings crossings;
    bool neighbours_come_first = false;
};

// Most of many small operands may be beside large ones: nothing is made for facets of these.
void leave_out_decided(Operands& all, std::uint32_t threads) {
    std::vector<const Source*> sources;
    std::vector<std::uint8_t> open_far_out;
    for (std::size_t i = 0; i < all.solids.size(); ++i) {
        sources.push_back(&source_of(*all.solids[i]));
        open_far_out.push_back(is_open_far_out(*all.solids[i], all.crossings.operands[i]) ? 1 : 0);
    }
    const std::vector<std::uint8_t> decided =
        decided_operands(*all.nested, sources, open_far_out, threads);
    SolidStates kept;
    for (std::size_t i = 0; i < all.solids.size(); ++i)
        if (decided[i] == 0) kept.push_back(all.solids[i]);
    if (kept.size() == all.solids.size() || kept.size() < 2) return;
    NestedFormula nested = all.nested->without(decided);
    std::optional<Crossings> crossings = nested_crossings(nested, kept);
    if (!crossings) return;
    all.solids = std::move(kept);
    all.nested = std::move(nested);
    all.crossings = *std::move(crossings);
}

// Where operands of a nested formula do not fill one place, neighbours among them come first, and
// those that others decide are left out.
Operands operands_of(const Residual& formula, const SolidStates& solids, std::uint32_t threads) {
    Operands out;
    out.solids = solids;
    if (auto flat = crossings_of(formula, solids)) {
        out.crossings = *std::move(flat);
        return out;
    }
    out.nested = NestedFormula::read(formula, solids.size());
    out.crossings = *nested_crossings(*out.nested, solids);
    out.neighbours_come_first = crowd_of(boxes_of(solids)) != Crowd::All;
    if (out.neighbours_come_first) leave_out_decided(out, threads);
    return out;
}

}  // namespace

bool may_be_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                        const EvaluateSettings& options) {
    if (solids.size() < 3 || options.budget != nullptr || options.max_memory != 0 ||
        (!crossings_of(*formula, solids) && !is_nested(*formula, solids)))
        return false;
    return std::ranges::all_of(solids, [](const auto& s) {
        return s->root().node->refinement() == nullptr &&
               lies_outside(s->root().node->reference(), source_of(*s).box());
    });
}

bool are_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                     const EvaluateSettings& options) {
    if (!may_be_many_meshes(formula, solids, options)) return false;
    const std::vector<Box> boxes = boxes_of(solids);
    const Crowd crowd = crowd_of(boxes);
    if (crowd == Crowd::All || crowd == Crowd::InFirst) return true;
    const bool few = are_few(solids);
    const bool is_flat = crossings_of(*formula, solids).has_value();
    // What says it of nested ones is found sooner than what comes next.
    if (!is_flat && !are_mostly_beside(*formula, solids)) return true;
    if (do_stand(boxes) || (few && may_touch_or_are_apart(boxes))) return true;
    if (!is_flat || are_mostly_beside(*formula, solids)) return false;
    // Few ones have been found not to touch.
    if (!few && may_touch_or_are_apart(boxes)) return true;
    return crowd == Crowd::Near || meets_many(boxes) || are_thin(*formula, solids);
}

bool do_fill_one_place(const SolidStates& solids) {
    return crowd_of(boxes_of(solids)) == Crowd::All;
}

bool do_stand_on_each_other(const SolidStates& solids) { return do_stand(boxes_of(solids)); }

bool do_lie_apart(const SolidStates& solids) { return are_apart(boxes_of(solids)); }

bool are_nested(const SolidStates& solids) {
    std::vector<Box> boxes = boxes_of(solids);
    std::ranges::sort(boxes, {}, &size_of);
    return std::ranges::adjacent_find(boxes, [](const Box& inner, const Box& outer) {
               return size_of(inner) == size_of(outer) || outer.intersected(inner) != inner;
           }) == boxes.end();
}

namespace {

// The box is that of all operands, also those that are left out.
ManyMeshes meshes_of(const Operands& operands, const Box& all, std::uint32_t threads) {
    ManyMeshes out;
    out.nested = operands.nested ? &*operands.nested : nullptr;
    out.neighbours_come_first = operands.neighbours_come_first;
    out.operands = &operands.crossings;
    std::vector<const LatticeMesh*> meshes;
    std::size_t facets = 0;
    for (const auto& s : operands.solids) {
        const Source& source = source_of(*s);
        out.sources.push_back(&source);
        meshes.push_back(&source.mesh());
        facets += source.facet_count();
    }
    out.slots.reserve(facets);
    for (std::uint32_t slot = 0; slot < meshes.size(); ++slot)
        out.slots.insert(out.slots.end(), meshes[slot]->triangles.size(), slot);
    out.planes.add_all(meshes, threads);
    for (std::size_t k = 0; k < 3; ++k)
        out.extent[k] = static_cast<double>(all.hi[k] - all.lo[k] + 2);
    return out;
}

std::optional<SolidForm> evaluate_in_turns(const Turns& turns, const Residual::Ref& formula,
                                           const SolidStates& solids,
                                           const EvaluateSettings& options, EvaluateStats& stats,
                                           std::shared_ptr<const LazyTree> tree) {
    Operands operands = operands_of(*formula, solids, options.threads);
    Box all;
    for (const auto& s : solids) all.add(source_of(*s).box());
    ManyMeshes meshes = meshes_of(operands, all, options.threads);
    EvaluateStats made;
    auto result = on_threads(options.threads, [&](std::uint32_t threads) {
        return isolated(
            [&] { return common_of_all(meshes, operands.solids, options, turns, threads, made); });
    });
    if (!result) return std::nullopt;
    operands.crossings.special = std::move(result->special);
    UndividedMeshes form = on_threads(options.threads, [&](std::uint32_t threads) {
        return form_of(result->store, meshes, operands.crossings, std::move(tree), threads);
    });
    form.may_have_straight_crossings = operands.nested && !operands.crossings.special.empty();
    form.may_have_sheets = result->has_sheets;
    for (const UncrossedFacets& u : form.uncrossed) made.untouched_polygons += u.facets.size();
    stats = made;
    return form;
}

}  // namespace

std::optional<SolidForm> evaluate_many_without_tree(const Residual::Ref& formula,
                                                    const SolidStates& solids,
                                                    const EvaluateSettings& options,
                                                    EvaluateStats& stats,
                                                    std::shared_ptr<const LazyTree> tree) {
    return evaluate_in_turns({}, formula, solids, options, stats, std::move(tree));
}

std::optional<SolidForm> evaluate_many_with_sheets(const Residual::Ref& formula,
                                                   const SolidStates& solids,
                                                   const EvaluateSettings& options,
                                                   EvaluateStats& stats,
                                                   std::shared_ptr<const LazyTree> tree) {
    return evaluate_in_turns({.most = 1, .are_backwards = true}, formula, solids, options, stats,
                             std::move(tree));
}

}  // namespace trisect::detail
