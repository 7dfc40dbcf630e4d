// SPDX-License-Identifier: Apache-2.0
//
// The table of docs/booleans.md, whose test compares names, conditions and what is kept. A
// condition is cheap and may say yes too often: the rule itself finds out. So arrangements of small
// cells have none; those of larger ones look at both ends of each list, because facets of one plane
// often stand together and the first one alone says little about the others.

#include <trisect/bsp/evaluate/rules.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include <trisect/bsp/cells/axis_polygon.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/divide/crowded_cell.h>
#include <trisect/bsp/evaluate/evaluator.h>
#include <trisect/bsp/evaluate/outline_prisms.h>
#include <trisect/bsp/half_spaces/between_half_spaces.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/bsp/many_meshes/crowd.h>
#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>
#include <trisect/bsp/many_meshes/parity/exclusive_or_without_tree.h>
#include <trisect/bsp/two_meshes/few_facets.h>
#include <trisect/bsp/two_meshes/two_meshes.h>
#include <trisect/bsp/two_meshes/two_meshes_without_tree.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

// Largest leaves, in units of EvaluateOptions::leaf_polygons.
constexpr std::uint32_t usual_leaf = 1;
constexpr std::uint32_t grid_leaf = 8;
constexpr std::uint32_t small_operands_leaf = 8;
// Operands are small where at least such a part of all their facets is in the cell.
constexpr std::uint64_t small_operands_part = 8;

// Where so many operands fill a cell, each with half a leaf on average, the formula is halved.
// Pairs are what a leaf costs, and those of all operands with all others are more than those within
// both halves and of what is left of these. In smaller cells more polygons would be cut. A union of
// imported meshes keeps more than an intersection, and its leaves would cut nothing.
constexpr std::size_t many_operands_in_cell = 6;
constexpr std::size_t many_operands_of_union = 16;
constexpr std::uint64_t leaf_of_operands = 2;

// Splitters in a row that do not divide the polygons of a cell, weighted by stalled_after(), and
// its depth, after which no more are tried.
constexpr std::uint64_t many_polygons = 400;
constexpr int most_stalled = 3;
constexpr int most_stalled_of_many = 12;
constexpr int most_depth = 400;

// Pairs are what a leaf costs. Both sides of a splitter may have such a part of those of the cell
// for it to be worth it, and for it to be of any use.
constexpr double large_cell = 4000;
constexpr double worthy_part = 0.8;
constexpr double worthy_part_of_large = 1.6;
constexpr double useful_part = 1.05;
// Both sides are large with more than such a part of the polygons.
constexpr double large_side = 0.5;
constexpr int price_of_useless = 12;
constexpr int price_of_large_sides = 4;
constexpr int price_of_unworthy = 1;

// --- Conditions.

bool is_constant(const CellView& view) {
    const CellTask& task = view.task;
    if (task.formula->kind == Residual::Kind::Constant) return true;
    if (task.operands.size() != 1) return false;
    const auto values = values_of_one(*task.formula, task.operands[0].slot, view.values);
    return values.outside == values.inside;
}

bool is_of_one_operand(const CellView& view) {
    return view.task.operands.size() == 1 && view.task.operands[0].embedded;
}

// Whether the first and the last polygon of a list or a leaf pass a test.
template <class Test>
bool ends_pass(const CellOperand& o, const Test& test) {
    if (o.is_list) {
        const auto list = o.list();
        return test(o.polygon(list.front().id)) && test(o.polygon(list.back().id));
    }
    if (!o.node->is_leaf() || o.node->polygons().empty()) return false;
    const PolygonList& polygons = o.node->polygons();
    return test(polygons[0]) && test(polygons[polygons.size() - 1]);
}

bool are_across_axes_at_ends(const CellView& view) {
    const auto is_across = [](const PolygonRef& r) { return is_axis_polygon(r); };
    return std::ranges::all_of(view.task.operands,
                               [&](const CellOperand& o) { return ends_pass(o, is_across); });
}

bool may_be_across_axes(const CellView& view) {
    return view.is_small() || are_across_axes_at_ends(view);
}

bool are_prisms_at_ends(const CellView& view) {
    const auto may_be_of_prism = [&](const PolygonRef& r) {
        return PrismFacets::may_be_of_prism(r) && view.task.cell.contains(r.box());
    };
    return view.task.operands.size() >= 2 &&
           std::ranges::all_of(view.task.operands, [&](const CellOperand& o) {
               return o.embedded && ends_pass(o, may_be_of_prism);
           });
}

bool may_be_prisms(const CellView& view) { return view.is_small() || are_prisms_at_ends(view); }

bool is_any(const CellView&) { return true; }

// Nothing is dropped in an exclusive or.
bool drops_nothing(const Residual& operation) {
    return operation.kind == Residual::Kind::Xor &&
           std::ranges::all_of(operation.children, [](const Residual::Ref& term) {
               const bool negated = term->kind == Residual::Kind::Not;
               return (negated ? *term->children[0] : *term).kind == Residual::Kind::Slot;
           });
}

// Grids and prisms are arranged all at once.
bool are_many_all_over(const CellView& view) {
    const std::size_t n = view.task.operands.size();
    if (n < many_operands_in_cell) return false;
    const Residual& formula = *view.task.formula;
    const Residual& operation =
        formula.kind == Residual::Kind::Not ? *formula.children[0] : formula;
    if (drops_nothing(operation)) return false;
    if (view.collects && operation.kind == Residual::Kind::Or && n < many_operands_of_union)
        return false;
    if (!view.undividable) {
        const std::uint64_t leaf = view.options.leaf_polygons;
        if (view.size <= leaf || leaf_of_operands * view.size > n * leaf) return false;
        if (!is_crowded(view.task)) return false;
    }
    return !are_across_axes_at_ends(view) && !are_prisms_at_ends(view);
}

// A splitter pays where an operand is all on one side of it, and most where it covers the
// other side. Small operands do not cover much, and splitters cut most of their facets, so
// that these are listed and compared again and again.
bool are_small_operands(const CellView& view) {
    if (view.is_small() || !view.collects || view.task.operands.size() < 3) return false;
    std::uint64_t all = 0;
    for (const CellOperand& o : view.task.operands) {
        if (!o.is_list && !o.node->is_leaf()) return false;
        all += o.node->size();
    }
    return small_operands_part * view.size >= all;
}

bool may_be_divided(const CellView& view) { return !view.undividable; }

// One arrangement of segments is for prisms of few facets that cross each other everywhere.
constexpr std::uint64_t few_of_prism = 64;

// Of facets at these quarters of all lists.
template <class Test>
bool are_all_at(const SolidStates& solids, std::initializer_list<std::size_t> quarters,
                const Test& test) {
    return std::ranges::all_of(solids, [&](const auto& s) {
        const PolygonList& polygons = s->root().node->polygons();
        return std::ranges::all_of(
            quarters, [&](std::size_t q) { return test(polygons[q * (polygons.size() - 1) / 4]); });
    });
}

// Spheres may end in caps.
bool are_mostly_across_axes(const SolidStates& solids) {
    return are_all_at(solids, {0, 4, 2, 1, 3},
                      [](const PolygonRef& r) { return is_axis_polygon(r); });
}

// Of so few facets leaves are faster, but not exact ones.
constexpr std::size_t facets_of_tetrahedron = 4;

std::vector<Box> boxes_of_meshes(const SolidStates& solids) {
    std::vector<Box> out;
    for (const auto& s : solids) out.push_back(s->root().node->polygons()[0].source->box());
    return out;
}

// Whether two boxes have more than a face in common, and begin or end in one plane.
bool are_flush(const Box& a, const Box& b) {
    bool flush = false;
    for (std::size_t k = 0; k < 3; ++k) {
        if (a.lo[k] >= b.hi[k] || b.lo[k] >= a.hi[k]) return false;
        flush = flush || a.lo[k] == b.lo[k] || a.hi[k] == b.hi[k];
    }
    return flush;
}

}  // namespace

bool are_one_grid(const SolidStates& solids, const EvaluateSettings& options) {
    std::uint64_t all = 0;
    for (const auto& s : solids) all += s->root().node->size();
    return all <= std::uint64_t{grid_leaf} * options.leaf_polygons &&
           are_mostly_across_axes(solids) && !do_lie_apart(solids) &&
           std::ranges::all_of(solids, [](const auto& s) {
               const PolygonList& polygons = s->root().node->polygons();
               return std::all_of(polygons.begin(), polygons.end(),
                                  [](const PolygonRef& r) { return is_axis_polygon(r); });
           });
}

namespace {

bool are_two_meshes_now(const Residual::Ref& formula, const SolidStates& solids,
                        const EvaluateSettings& options) {
    if (!are_two_meshes(formula, solids, options, facets_of_tetrahedron)) return false;
    if (do_lie_apart(solids)) return true;
    return (are_two_meshes(formula, solids, options) ||
            (are_apart_or_touch(solids) && !are_mostly_across_axes(solids))) &&
           !are_one_grid(solids, options);
}

// Of two meshes without common planes pairs are found as soon. Of large ones cells would cut walls.
// Of few facets pieces cost more than outlines, but walls that touch are found late, and nothing is
// outlined of what is across the axes or apart.
bool are_prisms_beyond_leaves(const Residual::Ref& formula, const SolidStates& solids,
                              const EvaluateSettings& options) {
    if (!may_be_prisms_of_one_axis(formula, solids, options)) return false;
    const std::vector<Box> boxes = boxes_of_meshes(solids);
    if (are_two_meshes_now(formula, solids, options))
        return TwoMeshes(solids).are_of_a_size() && are_flush(boxes[0], boxes[1]) &&
               !are_mostly_across_axes(solids);
    std::uint64_t all = 0;
    for (const auto& s : solids) all += s->root().node->size();
    if (all > std::uint64_t{prism_leaf_factor} * options.leaf_polygons)
        return !are_apart(boxes) || (!may_be_many_meshes(formula, solids, options) &&
                                     !is_exclusive_or_of_many(formula, solids, options));
    return !are_mostly_across_axes(solids) && !do_stand(boxes) && !are_apart(boxes);
}

// Which are one leaf, if they are of one axis.
bool are_few_of_prisms(const SolidStates& solids, const EvaluateSettings& options) {
    std::uint64_t all = 0;
    for (const auto& s : solids) all += s->root().node->size();
    return all <= std::uint64_t{prism_leaf_factor} * options.leaf_polygons &&
           all <= solids.size() * few_of_prism && are_all_at(solids, {0, 4}, [](const auto& r) {
               return PrismFacets::may_be_of_prism(r);
           });
}

// Where facets across the axes, or few of prisms in one place, have planes in common, one leaf has
// them all. But prisms whose caps meet are no arrangement of segments, and solids within each other
// are compared with their neighbours.
bool are_many_beyond_leaves(const Residual::Ref& formula, const SolidStates& solids,
                            const EvaluateSettings& options) {
    if (!are_many_meshes(formula, solids, options)) return false;
    if (are_mostly_across_axes(solids)) return are_nested(solids) || do_lie_apart(solids);
    if (!do_fill_one_place(solids) || do_stand_on_each_other(solids)) return true;
    return !are_few_of_prisms(solids, options);
}

bool is_parity_beyond_leaves(const Residual::Ref& formula, const SolidStates& solids,
                             const EvaluateSettings& options) {
    if (!is_exclusive_or_of_many(formula, solids, options)) return false;
    return do_lie_apart(solids) ||
           (!are_mostly_across_axes(solids) && !are_few_of_prisms(solids, options));
}

// --- The table.

template <auto Arranger>
LeafArrangement& arranger(LeafArrangers& all) {
    return all.*Arranger;
}

constexpr LeafRule by_doubles(std::uint32_t reach, bool (*applies)(const CellView&)) {
    return {reach, applies, &arranger<&LeafArrangers::doubles>};
}

using Stats = EvaluateCounters;

constexpr std::size_t formula_rows = 5;
constexpr std::size_t constant_rows = 2;

constexpr std::array all_rules{
    Rule{
        "outlines of prisms",
        "meshes of prisms along one axis; of two that are compared as meshes, of a size, those "
        "whose "
        "boxes overlap and begin or end in one plane, and that are not all across the axes; others "
        "that are larger together than a leaf of prisms, or not all across the axes nor most of "
        "them on each other, and not apart; no limits",
        "whole facets, outlines by name", &Stats::prism_leaves,
        FormulaRule{&are_prisms_beyond_leaves, &outline_prisms}},
    Rule{
        "two meshes",
        "∪, ∩, − or ⊕ of two imported meshes, 16 facets each or 64 and 4, or 4 where they are "
        "apart, or touch and not all across the axes, without an index, of a size, or of which the "
        "larger one is not large and was not compared so before; not 8 leaves or less whose facets "
        "are all across the axes, unless apart; no work limit",
        "uncrossed facets, crossings", &Stats::filtered_leaves,
        FormulaRule{&are_two_meshes_now, &evaluate_without_tree}},
    Rule{"half-spaces",
         "∩ or − of one imported mesh and half-spaces, or what complements make of it; parallel "
         "planes, none through a corner; no work limit",
         "uncrossed facets, crossings", &Stats::half_space_cuts,
         FormulaRule{&is_mesh_with_half_spaces, &evaluate_between_half_spaces}},
    Rule{"exclusive or of many",
         "⊕ of three imported meshes or more, none with an index, apart, or neither all across the "
         "axes nor few of prisms, that do not touch; no limits",
         "uncrossed facets, outlines", &Stats::filtered_leaves,
         FormulaRule{&is_parity_beyond_leaves, &evaluate_exclusive_or_without_tree}},
    Rule{
        "many meshes",
        "∪, ∩ or − of three imported meshes or more, or of such, whose boxes mostly overlap, or "
        "stand on each other, or the first one's has half of all, or the largest one meets more "
        "than 64, or whose boxes touch or are apart, or of thin facets, or nested; where many, "
        "most "
        "facets in the formula's reach; none with an index, not all across the axes, unless within "
        "each other or apart, or a leaf of prisms; no limits",
        "uncrossed facets, outlines", &Stats::filtered_leaves,
        FormulaRule{&are_many_beyond_leaves, &evaluate_many_without_tree}},
    Rule{"constant", "the formula has one value in the cell", "an empty leaf",
         &Stats::constant_cells, CellRule{&is_constant, &CellSteps::make_constant}},
    Rule{"share", "one operand is left, and it is embedded",
         "the operand's subtree or list, or its complement", &Stats::shared_cells,
         CellRule{&is_of_one_operand, &CellSteps::share}},
    Rule{"grid", "up to 8 leaves; all facets axis-perpendicular",
         "rectangles; of imported meshes an occupancy grid", &Stats::grid_leaves,
         LeafRule{grid_leaf, &may_be_across_axes, &arranger<&LeafArrangers::grid>}},
    Rule{"halve",
         "more than a leaf, half a leaf an operand; 6 operands or more, 16 in a union, whose boxes "
         "mostly overlap",
         "what the halves of the formula leave, combined", &Stats::halved_cells,
         CellRule{&are_many_all_over, &CellSteps::halve}},
    Rule{"general position", "one leaf; embedded operands in general position",
         "fragments; of imported meshes uncrossed facets and crossings", &Stats::filtered_leaves,
         by_doubles(usual_leaf, &is_any)},
    Rule{"prisms", "up to 40 leaves; prisms along one axis, whole in the cell", "fragments",
         &Stats::prism_leaves,
         LeafRule{prism_leaf_factor, &may_be_prisms, &arranger<&LeafArrangers::prisms>}},
    Rule{"small operands",
         "up to 8 leaves; three imported meshes or more, an eighth of their facets in the cell",
         "as in general position", &Stats::filtered_leaves,
         by_doubles(small_operands_leaf, &are_small_operands)},
    Rule{"exact", "one leaf; any polygons", "fragments", &Stats::exact_leaves,
         LeafRule{usual_leaf, &is_any, &arranger<&LeafArrangers::exact>}},
    Rule{"divide",
         "a splitting plane separates the polygons; else leaves of any size, from the grid on",
         "a splitting plane and two cells", &Stats::divided_cells,
         CellRule{&may_be_divided, &CellSteps::divide}},
};

std::shared_ptr<const SolidState> tree_of(const Residual::Ref& formula, const SolidStates& solids,
                                          const EvaluateSettings& options) {
    EvaluateSettings settings = options;
    LimitedEvaluation limited(settings);
    EvaluateStats made;
    auto tree = evaluate_tree(formula, solids, settings, made);
    limited.finish(made);
    return tree;
}

LeafResult arrange_leaf(const LeafProblem& problem, LeafArrangers& arrangers) {
    const CellTask no_task;
    SlotValues no_values;
    LeafFindings findings;
    const CellView view{no_task, *problem.options, no_values, false, true};
    for (const Rule& rule : polygon_rules()) {
        const auto* const leaf = std::get_if<LeafRule>(&rule.how);
        if (leaf == nullptr || !leaf->may_serve(view)) continue;
        if (auto result = leaf->arrangement(arrangers).arrange(problem, findings))
            return *std::move(result);
    }
    TRISECT_EXPECTS(false, "every leaf can be arranged exactly");
    return LeafPolygons{};
}

}  // namespace

std::span<const Rule> rules() { return all_rules; }

std::span<const Rule> formula_rules() { return rules().first(formula_rows); }

const FormulaRule& rule_of_prisms() { return std::get<FormulaRule>(rules().front().how); }

std::span<const Rule> constant_rules() { return rules().subspan(formula_rows, constant_rows); }

std::span<const Rule> polygon_rules() { return rules().subspan(formula_rows + constant_rows); }

std::shared_ptr<SolidState> state_of_value(SolidForm form, const Residual& formula,
                                           const SolidStates& solids,
                                           const EvaluateSettings& options) {
    auto state = std::make_shared<SolidState>();
    if (!solids.empty()) state->lattice = solids[0]->lattice;
    state->form = std::move(form);
    state->whole = std::ranges::all_of(solids, [](const auto& s) { return s->whole; });
    if (auto* const tree = std::get_if<CellTree>(&state->form))
        tree->has_usual_offsets =
            options.splitting_offset == usual_splitting_offset &&
            std::ranges::all_of(solids, [](const auto& s) { return s->tree().has_usual_offsets; });
    state->far_out = far_out_of(formula, solids);
    return state;
}

std::shared_ptr<const LazyTree> lazy_tree_of(const Residual::Ref& formula,
                                             const SolidStates& solids,
                                             const EvaluateSettings& options) {
    return std::make_shared<const LazyTree>(formula, solids, options, &tree_of);
}

std::shared_ptr<SolidState> evaluate_by(const FormulaRule& rule, const Residual::Ref& formula,
                                        const SolidStates& solids, const EvaluateSettings& options,
                                        EvaluateStats& stats) {
    if (!rule.applies(formula, solids, options)) return nullptr;
    auto form =
        rule.evaluate(formula, solids, options, stats, lazy_tree_of(formula, solids, options));
    return form ? state_of_value(*std::move(form), *formula, solids, options) : nullptr;
}

std::shared_ptr<SolidState> evaluate_tree(const Residual::Ref& formula, const SolidStates& solids,
                                          const EvaluateSettings& options, EvaluateStats& stats) {
    Evaluation evaluation = evaluate_formula(formula, solids, options);
    stats = evaluation.stats;
    return state_of_value(std::move(evaluation.tree), *formula, solids, options);
}

PolygonList arrange_deferred(const DeferredLeaf& leaf) {
    std::vector<std::vector<PolygonRef>> refs;
    std::vector<LeafOperand> listed;
    refs.reserve(leaf.operands.size());
    for (const DeferredLeaf::Operand& o : leaf.operands) {
        refs.emplace_back(o.polygons.begin(), o.polygons.end());
        listed.push_back({o.slot, refs.back(), o.flipped, true, o.winding});
    }
    EvaluateSettings options;
    options.winding = leaf.rule;
    thread_local LeafArrangers arrangers;
    LeafResult result =
        arrange_leaf({leaf.cell, leaf.reference, listed, leaf.formula.get(), &options}, arrangers);
    return PolygonList(std::move(std::get<LeafPolygons>(result).polygons));
}

ValuesOfOne values_of_one(const Residual& formula, std::int32_t slot, SlotValues& values) {
    auto& v = values[static_cast<std::size_t>(slot)];
    v = 0;
    const bool outside = value_of(formula, values);
    v = 1;
    const bool inside = value_of(formula, values);
    v = -1;
    return {outside, inside};
}

bool splitters_have_failed(const CellTask& task) {
    return task.stalled >= (task.size() > many_polygons ? most_stalled_of_many : most_stalled) ||
           task.depth > most_depth;
}

// A splitter that leaves most pairs on its sides was not worth it, and after a few such splitters
// none will be: long thin facets cross all of them. Where many facets meet in a corner, though,
// splitters around the corner cut off small cells at little cost. Splitters that make more pairs
// than there were never pay: a pair costs a few nanoseconds.
int stalled_after(const CellTask& task, std::uint64_t first, std::uint64_t second) {
    // What is cut off beside all but planes of half-spaces is large, however little is listed
    // there.
    const auto planes = static_cast<std::uint64_t>(
        std::ranges::count_if(task.operands, [](const CellOperand& o) { return o.unbounded; }));
    if (planes > 0 && std::min(first, second) <= planes) return task.stalled;
    const auto total = static_cast<double>(task.size());
    const auto a = static_cast<double>(first);
    const auto b = static_cast<double>(second);
    const double pairs = a * a + b * b;
    if (pairs < (total < large_cell ? worthy_part : worthy_part_of_large) * total * total) return 0;
    if (pairs > useful_part * total * total) return task.stalled + price_of_useless;
    const bool large_sides = std::min(a, b) > large_side * total;
    return task.stalled + (large_sides ? price_of_large_sides : price_of_unworthy);
}

}  // namespace trisect::detail
