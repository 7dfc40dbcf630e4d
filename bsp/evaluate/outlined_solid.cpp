// SPDX-License-Identifier: Apache-2.0
//
// A tree divides what it lists into convex pieces. Whoever writes a result to a file needs none of
// them, and for a plate with thousands of holes in one face making them takes ten times as long as
// finding out where the holes are. So they are made on demand of those that need them: a query, a
// B-rep, the next operation.

#include <trisect/bsp/cells/outlined_solid.h>

#include <algorithm>
#include <span>
#include <utility>

#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/evaluate/evaluator.h>
#include <trisect/bsp/leaf/prism/prism_arrangement.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

OutlinedSolid::OutlinedSolid(NamedOutlines outlines, Residual::Ref formula,
                             std::vector<std::shared_ptr<const SolidState>> solids,
                             const EvaluateOptions& options)
    : outlines_(std::move(outlines)),
      formula_(std::move(formula)),
      solids_(std::move(solids)),
      options_(options) {
    options_.cancel = nullptr;
}

OutlinedSolid::OutlinedSolid(std::vector<UncrossedFacets> uncrossed, Residual::Ref formula,
                             std::vector<std::shared_ptr<const SolidState>> solids,
                             const EvaluateOptions& options)
    : OutlinedSolid(NamedOutlines(), std::move(formula), std::move(solids), options) {
    uncrossed_ = std::move(uncrossed);
}

const std::shared_ptr<const SolidState>& OutlinedSolid::cut() const {
    const std::lock_guard lock(cutting_);
    if (cut_ != nullptr) return cut_;
    EvaluateOptions options = options_;
    options.cancel = cancel_of_thread();
    Evaluation evaluation = evaluate_formula(formula_, solids_, options);
    auto state = std::make_shared<SolidState>();
    state->lattice = solids_[0]->lattice;
    state->root = std::move(evaluation.root);
    state->far_out = far_out_of(*formula_, solids_);
    state->incomplete = std::move(evaluation.incomplete);
    auto& incomplete = state->incomplete;
    std::sort(incomplete.begin(), incomplete.end());
    incomplete.erase(std::unique(incomplete.begin(), incomplete.end()), incomplete.end());
    state->crossings = std::move(evaluation.crossings);
    return cut_ = std::move(state);
}

std::int8_t far_out_of(const Residual& formula,
                       std::span<const std::shared_ptr<const SolidState>> solids) {
    SlotValues values;
    values.reserve(solids.size());
    for (const auto& s : solids) values.push_back(s->far_out);
    return static_cast<std::int8_t>(bounded_value_of(formula, values));
}

bool OutlinedSolid::is_cut() const {
    const std::lock_guard lock(cutting_);
    return cut_ != nullptr;
}

namespace {

// Of an operand that is all facets of one mesh: the mesh, else null.
const Source* only_mesh_of(const SolidState& solid) {
    const CellNode& root = *solid.root.node;
    if (!solid.embedded || !root.is_leaf() || root.deferred() != nullptr || root.size() == 0)
        return nullptr;
    const PolygonList& polygons = root.polygons();
    const Source* const source = polygons[0].source;
    if (source->is_half_space() || source->facet_count() != polygons.size()) return nullptr;
    if (polygons.has_all_facets()) return source;
    // As moving to a finer lattice leaves it.
    std::uint32_t next = 0;
    const auto is_next = [&](const PolygonRef& r) {
        return r.source == source && r.fragment == nullptr && !r.touched && r.facet == next++;
    };
    return std::all_of(polygons.begin(), polygons.end(), is_next) ? source : nullptr;
}

}  // namespace

std::shared_ptr<const SolidState> outline_prisms(
    const Residual::Ref& formula, const std::vector<std::shared_ptr<const SolidState>>& solids,
    const EvaluateOptions& options, EvaluateStats& stats) {
    if (solids.size() < 2 || options.max_work != 0 || options.max_memory != 0) return nullptr;
    std::uint64_t total = 0;
    for (const auto& s : solids) total += s->root.node->size();
    if (total <= prism_leaf_factor * options.leaf_polygons) return nullptr;
    Box all;
    for (const auto& s : solids) {
        const Source* const mesh = only_mesh_of(*s);
        if (mesh == nullptr || !lies_outside(s->root.node->reference(), mesh->box()) ||
            !PrismFacets::may_be_of_prism({mesh, nullptr, 0, false, false}))
            return nullptr;
        all.add(mesh->box());
    }
    std::vector<PolygonRef> polygons;
    polygons.reserve(total);
    for (const auto& s : solids)
        for (const PolygonRef r : s->root.node->polygons()) polygons.push_back(r);
    std::vector<LeafOperand> operands;
    SlotValues values;
    std::size_t first = 0;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const CellRef& root = solids[i]->root;
        operands.push_back({static_cast<std::int32_t>(i),
                            std::span(polygons).subspan(first, root.node->size()),
                            root.complemented, true,
                            complemented_winding(root.node->winding(), root.complemented)});
        first += root.node->size();
        values.push_back(is_inside(operands.back().winding, options.winding) ? 1 : 0);
    }
    const FinePoint reference = point_beyond(all);
    EvaluateStats made;
    PrismArrangement arrangement;
    if (!arrangement.arrange({Cell{}, reference, operands, formula.get(), &options}, made))
        return nullptr;
    made.cells = made.mixed_leaves = made.prism_leaves = 1;
    made.listed_polygons = total;
    stats = made;
    auto state = std::make_shared<SolidState>();
    state->lattice = solids[0]->lattice;
    state->far_out = far_out_of(*formula, solids);
    state->root = {CellNode::leaf(PolygonList(std::move(arrangement.whole())), reference,
                                  value_of(*formula, values) ? 1 : 0, true),
                   false};
    if (!arrangement.outlines().faces.empty())
        state->outlined = std::make_shared<const OutlinedSolid>(std::move(arrangement.outlines()),
                                                                formula, solids, options);
    return state;
}

}  // namespace trisect::detail
