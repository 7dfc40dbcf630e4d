// SPDX-License-Identifier: Apache-2.0
//
// The recursion does not begin with all of space but with a cell whose splitting planes are just
// beyond the window. Every operand is a leaf of that cell, which lists the facets near it, as any
// leaf does further down; the rest of the mesh is not looked at. All that a leaf needs from outside
// is a winding number, at one point for all operands. It is traced along an axis from beyond the
// mesh. The window is an operand like the others and ends before the cell: so the result has no
// boundary in the cell's own planes, and empty cells around it make it a tree of all space.

#include <trisect/bsp/evaluate_within.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/brep/kinds/facet_kinds.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/trace/trace_winding.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/evaluate/evaluator.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect {

namespace {

using detail::Box;
using detail::Cell;
using detail::CellNode;
using detail::CellRef;
using detail::FinePoint;
using detail::PolygonList;
using detail::PolygonRef;
using detail::SolidState;
using detail::Source;
using detail::splitting_scale;
using detail::usual_splitting_offset;

const Source& mesh_of(const SolidState& state) {
    const CellNode& root = *state.root().node;
    const Source* const source = root.is_leaf() ? root.polygons().whole_source() : nullptr;
    if (source == nullptr || source->is_half_space() || !root.polygons().has_all_facets() ||
        state.root().complemented)
        throw UsageError("evaluate_within takes meshes as they were imported");
    return *source;
}

Box box_of_window(const SolidState& state) {
    const Source& source = mesh_of(state);
    const LatticeMesh& mesh = source.mesh();
    bool is_box = mesh.points.size() == 8 && source.facet_count() == 12;
    for (const LatticePoint& p : mesh.points)
        for (int k = 0; k < 3; ++k) {
            const std::int64_t at = detail::position_of(p[k]);
            const auto axis = static_cast<std::size_t>(k);
            is_box = is_box && (at == source.box().lo[axis] || at == source.box().hi[axis]);
        }
    if (!is_box) throw UsageError("the window of evaluate_within is no box along the axes");
    return source.box();
}

// The splitting planes beyond a box of positions, with a free lattice plane between them and it.
Cell cell_around(const Box& box) {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k) {
        cell.lo[k] = (box.lo[k] - 2) * splitting_scale + std::int64_t{usual_splitting_offset};
        cell.hi[k] = (box.hi[k] + 1) * splitting_scale + std::int64_t{usual_splitting_offset};
    }
    return cell;
}

// The facets whose boxes meet the cell; those in it come first.
struct NearFacets {
    std::vector<std::uint32_t> facets;
    std::size_t contained = 0;
};

NearFacets facets_near(const Source& source, const Cell& cell) {
    NearFacets out;
    std::vector<std::uint32_t> across;
    for (std::uint32_t f = 0; f < source.facet_count(); ++f) {
        const Box box = source.facet_box(f);
        if (!cell.meets(box)) continue;
        (cell.contains(box) ? out.facets : across).push_back(f);
    }
    out.contained = out.facets.size();
    out.facets.insert(out.facets.end(), across.begin(), across.end());
    return out;
}

// A position in a range that is more than a unit, for a point of reference.
std::int64_t position_in(std::int64_t lo, std::int64_t hi, std::uint64_t seed) {
    const auto range = static_cast<std::uint64_t>(hi - lo - 12);
    return detail::reference_position(
        lo + 6 + static_cast<std::int64_t>(detail::mix64(seed) % range), 1);
}

// In the cell, and near what is in there.
FinePoint point_in(const Cell& cell, const Box& near, std::uint64_t attempt) {
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k) {
        std::int64_t lo = cell.lo[k];
        std::int64_t hi = cell.hi[k];
        if (!near.is_empty()) {
            lo = std::max(lo, (near.lo[k] - 2) * splitting_scale);
            hi = std::min(hi, (near.hi[k] + 2) * splitting_scale);
        }
        if (hi - lo < splitting_scale) {
            lo = std::clamp(lo, cell.lo[k], cell.hi[k] - splitting_scale);
            hi = lo + splitting_scale;
        }
        p.c[k] = position_in(lo, hi, attempt * 3 + k);
    }
    return p;
}

// From below the mesh, along y.
std::optional<int> winding_at(const Source& source, const FinePoint& p) {
    FinePoint outside = p;
    outside.c[1] = std::min(p.c[1], (source.box().lo[1] - 3) * splitting_scale + 6);
    if (outside == p) return 0;
    Box way;
    for (std::size_t k = 0; k < 3; ++k) {
        way.lo[k] = detail::lattice_below(outside.c[k]) - 1;
        way.hi[k] = detail::lattice_below(p.c[k]) + 2;
    }
    std::vector<PolygonRef> met;
    for (std::uint32_t f = 0; f < source.facet_count(); ++f)
        if (way.overlaps(source.facet_box(f))) met.push_back({&source, nullptr, f, false, false});
    return detail::trace_winding(met, false, outside, p);
}

struct Reference {
    FinePoint point;
    std::vector<int> windings;  // of the solids
};

Reference reference_in(const Cell& cell, const detail::SolidStates& solids) {
    Box near;
    for (const auto& s : solids)
        if (s->lattice_matters) near.add(mesh_of(*s).box());
    Reference out;
    for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
        out.point = point_in(cell, near, attempt);
        out.windings.clear();
        for (const auto& s : solids) {
            const bool inside = s->far_out > 0;
            const auto w =
                s->lattice_matters ? winding_at(mesh_of(*s), out.point) : (inside ? 1 : 0);
            if (w) out.windings.push_back(*w);
        }
        if (out.windings.size() == solids.size()) return out;
    }
    TRISECT_EXPECTS(false, "no reference point found in the window");
    return out;
}

// A mesh, or a constant, as it is in one cell.
std::shared_ptr<const SolidState> in_cell(const SolidState& state, const Cell& cell,
                                          const FinePoint& reference, int winding) {
    PolygonList polygons;
    if (state.lattice_matters) {
        const Source& source = mesh_of(state);
        const NearFacets near = facets_near(source, cell);
        if (!near.facets.empty())
            polygons = PolygonList::whole_facets(source, false, near.facets, near.contained);
    }
    auto out = std::make_shared<SolidState>(state);
    out->form = detail::CellTree{
        {CellNode::leaf(std::move(polygons), reference, winding, false), false}, {}, nullptr};
    return out;
}

// A cell beyond a side of another one: nothing is there.
CellRef beyond(const Cell& cell, std::size_t axis, bool above) {
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k) p.c[k] = position_in(cell.lo[k], cell.hi[k], k + 1);
    p.c[axis] = detail::reference_position(above ? cell.hi[axis] + 600 : cell.lo[axis] - 600, 1);
    return {CellNode::leaf(PolygonList(), p, 0, false), false};
}

// All of space, of which one cell is known and the rest is empty.
CellRef in_space(CellRef node, const Cell& cell) {
    for (std::size_t k = 3; k-- > 0;) {
        const int axis = static_cast<int>(k);
        CellRef below_top{
            CellNode::split(axis, cell.lo[k], beyond(cell, k, false), std::move(node)), false};
        node = {CellNode::split(axis, cell.hi[k], std::move(below_top), beyond(cell, k, true)),
                false};
    }
    return node;
}

}  // namespace

Solid evaluate_within(const Solid& window, const Expression& expression,
                      const EvaluateOptions& options, EvaluateReport* report) {
    const detail::Translation t = detail::translate(Expression::all_of({expression, window}));
    detail::SolidStates states;
    for (const Solid& s : t.slots) states.push_back(detail::cut_state(s));
    const LatticeReport lattice = detail::move_to_common_lattice(states, options.lattices);
    const std::uint64_t serial = detail::state_of(window)->source;
    const auto is_window = [&](const auto& s) { return s->source == serial; };
    const auto at = std::ranges::find_if(states, is_window);
    if (at == states.end()) throw UsageError("the window of evaluate_within is no mesh of its own");
    detail::EvaluateSettings settings{options, usual_splitting_offset};
    detail::LimitedEvaluation limited(settings);
    const Cell cell = cell_around(box_of_window(**at));
    const Reference reference = reference_in(cell, states);
    for (std::size_t i = 0; i < states.size(); ++i)
        states[i] = in_cell(*states[i], cell, reference.point, reference.windings[i]);
    detail::Evaluation evaluation = detail::evaluate_formula(t.formula, states, settings, &cell);
    limited.finish(evaluation.stats);
    detail::counters_of_thread<EvaluateCounters> += evaluation.stats;
    evaluation.tree.root = in_space(std::move(evaluation.tree.root), cell);
    auto state = std::make_shared<SolidState>();
    state->lattice = lattice.lattice;
    state->whole = std::ranges::all_of(states, [](const auto& s) { return s->whole; });
    state->form = std::move(evaluation.tree);
    if (report != nullptr) *report = {lattice, evaluation.stats.memory, evaluation.stats.depth};
    return detail::solid_of(std::move(state));
}

Solid operand_within(LatticeMesh mesh) {
    if (mesh.triangles.empty()) return {};
    std::optional<std::vector<detail::FacetKind>> kinds = detail::facet_kinds(mesh);
    auto state = std::make_shared<SolidState>();
    state->lattice = mesh.lattice;
    auto source = Source::make(std::move(mesh), 1);
    if (kinds) source = Source::of_kinds(std::move(source), *std::move(kinds));
    state->form = detail::CellTree{
        {CellNode::fresh(*source, detail::point_beyond(source->box()), 0, false), false},
        {},
        nullptr};
    state->embedded = false;
    state->whole = source->is_whole();
    state->source = source->serial();
    return detail::solid_of(std::move(state));
}

}  // namespace trisect
