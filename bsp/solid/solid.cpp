// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/solid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/brep/embedding_findings.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/assembly/outline_names.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/divide/refine_leaf.h>
#include <trisect/bsp/evaluate/half_space.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>
#include <trisect/bsp/solid/inside_out.h>
#include <trisect/bsp/solid/uncut_root.h>
#include <trisect/bsp/solid_of_findings.h>
#include <trisect/bsp/two_meshes/two_meshes.h>
#include <trisect/bsp/two_meshes/two_meshes_without_tree.h>
#include <trisect/kernel/plane_on_lattice.h>

namespace trisect {

namespace {

using detail::CellNode;
using detail::FinePoint;
using detail::PolygonList;
using detail::SolidState;

detail::CellTree tree_of(std::shared_ptr<const CellNode> root) {
    return {{std::move(root), false}, {}, nullptr};
}

std::shared_ptr<const SolidState> constant_state(bool inside) {
    auto s = std::make_shared<SolidState>();
    s->form = tree_of(CellNode::leaf(PolygonList(), FinePoint{}, inside ? 1 : 0, false));
    s->lattice_matters = false;
    s->far_out = inside ? 1 : 0;
    return s;
}

bool is_constant(const SolidState& s, bool inside) {
    const auto* const tree = std::get_if<detail::CellTree>(&s.form);
    if (tree == nullptr) return false;
    const CellNode& n = *tree->root.node;
    return n.is_leaf() && n.size() == 0 && ((n.winding() > 0) != tree->root.complemented) == inside;
}

// Whether a polygon is found that is listed in a cell and lies in it, which bounds the set; leaves
// that were put off are arranged until there is one. Otherwise `lists` says whether any is listed.
bool finds_boundary(const CellNode& node, const detail::Cell& cell, bool& lists) {
    if (node.size() == 0) return false;
    if (!node.is_leaf())
        return finds_boundary(*node.child(0).node, cell.below(node.axis(), node.splitter()),
                              lists) ||
               finds_boundary(*node.child(1).node, cell.above(node.axis(), node.splitter()), lists);
    const PolygonList& polygons = node.polygons();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        lists = true;
        if (cell.contains(polygons[i].box())) return true;
    }
    return false;
}

// Of a set that no leaf of a single cell shows to be constant. Lists may have what misses their
// cell, and leaves that were put off may turn out empty.
bool has_boundary(const Solid& solid) {
    const SolidState& s = *detail::state_of(solid);
    bool lists = true;
    if (const auto* const tree = std::get_if<detail::CellTree>(&s.form)) {
        lists = false;
        if (finds_boundary(*tree->root.node, detail::Cell{}, lists)) return true;
    } else if (const auto* const meshes = std::get_if<detail::UndividedMeshes>(&s.form)) {
        // In sheets of no thickness whole facets face each other.
        if (!meshes->may_have_sheets &&
            std::ranges::any_of(meshes->uncrossed, [](const auto& u) { return !u.facets.empty(); }))
            return true;
    } else if (const auto* const flat = std::get_if<detail::FlatPrism>(&s.form)) {
        return !flat->operand->resolved().is_empty();
    } else if (std::get<detail::PrismOutlines>(s.form).whole->size() != 0) {
        return true;
    }
    return lists && (s.far_out < 0 || !solid.to_exact_mesh(1).triangles.empty());
}

// Only sets made of half-spaces alone do not store it; the boundary decides. What it leaves to
// whole space and the empty set their trees decide.
bool is_unbounded(const Solid& solid) {
    if (detail::state_of(solid)->far_out >= 0) return detail::state_of(solid)->far_out != 0;
    const Brep brep = solid.to_brep();
    return brep.is_empty() ? solid.is_whole_space() : exact_volume(brep).sign() < 0;
}

// Outlines of planes are divided into faces by the assembly, but have one name for all.
bool has_all_of_brep(const SolidState& s, const AssembleOptions& options) {
    const auto* const prisms = std::get_if<detail::PrismOutlines>(&s.form);
    return prisms == nullptr || (options.maximal_faces && prisms->outlines->names_hold_everywhere &&
                                 prisms->outlines->first_facets.empty());
}

// The same where names have to be proved, which needs the faces.
std::optional<Brep> brep_with_proved_names(const SolidState& s, const AssembleOptions& options) {
    const auto* const prisms = std::get_if<detail::PrismOutlines>(&s.form);
    if (prisms == nullptr || !options.maximal_faces || !prisms->outlines->names_hold_everywhere)
        return std::nullopt;
    Brep brep = detail::assemble_brep(s, options);
    if (!detail::names_are_proved(brep, *prisms->outlines)) return std::nullopt;
    return brep;
}

// However far larger one of them is: prisms are compared once.
bool are_two(const detail::Residual::Ref& formula, const detail::SolidStates& solids,
             const detail::EvaluateSettings& settings) {
    if (solids.size() != 2 || settings.budget != nullptr || !detail::crossings_of(*formula, solids))
        return false;
    const detail::TwoMeshes two(solids);
    return two.nodes[0]->refinement() == nullptr && two.nodes[1]->refinement() == nullptr &&
           two.have_outer_references();
}

// Prisms whose outlines have no names, pair by pair: a tree would cut all that they have in common.
// Null where that does not serve, and where they have a tree already.
std::shared_ptr<const SolidState> pair_by_pair(const SolidState& solid) {
    const auto* const prisms = std::get_if<detail::PrismOutlines>(&solid.form);
    if (prisms == nullptr || prisms->tree->formula() == nullptr || prisms->tree->is_cut())
        return nullptr;
    detail::EvaluateStats ignored;
    for (const detail::FormulaRule& rule :
         {detail::FormulaRule{&detail::may_be_many_meshes, &detail::evaluate_many_without_tree},
          detail::FormulaRule{&are_two, &detail::evaluate_without_tree}})
        if (auto state = detail::evaluate_by(rule, prisms->tree->formula(), prisms->tree->solids(),
                                             prisms->tree->settings(), ignored))
            return state;
    return nullptr;
}

EmbeddingFindings findings_of(const LatticeMesh& mesh, Embedding embedding) {
    if (embedding == Embedding::Check) return find_embedding(mesh);
    return {.is_embedded = embedding == Embedding::Assume, .kinds = {}};
}

Solid of_lattice_mesh(LatticeMesh mesh, EmbeddingFindings findings, std::uint32_t threads,
                      bool t_edges = false) {
    if (mesh.triangles.empty()) return {};
    const Lattice lattice = mesh.lattice;
    auto source = detail::Source::make(std::move(mesh), threads);
    if (findings.kinds)
        source = detail::Source::of_kinds(std::move(source), *std::move(findings.kinds));
    auto state = std::make_shared<SolidState>();
    state->lattice = lattice;
    state->form = tree_of(detail::uncut_root(*source, t_edges));
    state->embedded = findings.is_embedded;
    state->whole = source->is_whole();
    state->source = source->serial();
    return detail::solid_of(std::move(state));
}

Solid of_import(ImportedMesh imported, Embedding embedding, InsideOut inside_out,
                std::uint32_t threads) {
    if (!imported.report.closed) throw InvalidSolid(imported.report.defects);
    if (imported.report.inside_out) detail::require_accepted(embedding, inside_out);
    if (imported.mesh.triangles.empty()) return {};
    EmbeddingFindings findings = findings_of(imported.mesh, embedding);
    return of_lattice_mesh(std::move(imported.mesh), std::move(findings), threads,
                           imported.report.t_edges != 0);
}

// One on which the plane is some 2^24 units from the origin, so that points near its foot have
// coordinates of middle size. Any would do: a half-space moves to the lattice of what it cuts.
Lattice lattice_for(const std::array<double, 4>& plane) {
    const double size = std::max({std::fabs(plane[0]), std::fabs(plane[1]), std::fabs(plane[2])});
    if (plane[3] == 0 || size == 0 || !std::isfinite(size) || !std::isfinite(plane[3]))
        return {-24};
    const int magnitude = std::ilogb(plane[3]) - std::ilogb(size);
    return {8 * static_cast<int>(std::floor(magnitude / 8.0)) - 24};
}

}  // namespace

void detail::require_accepted(Embedding embedding, InsideOut inside_out) {
    if (embedding == Embedding::Assume)
        throw Error(ErrorCode::InvalidSolid, "the boundary is inside out: its volume is negative");
    if (inside_out == InsideOut::Refuse)
        throw Error(ErrorCode::InvalidSolid,
                    "the boundary is inside out: its volume is negative; turn its faces over, or "
                    "accept it (inside_out) and evaluate by the winding rule 'nonzero'");
}

const std::shared_ptr<const SolidState>& Solid::empty_state() {
    // Never destroyed, nor is whole space: solids may be made after main().
    static const auto& empty = *new auto(constant_state(false));
    return empty;
}

Solid::Solid() : state_(empty_state()) {}

Solid Solid::whole_space() {
    static const auto& whole = *new auto(constant_state(true));
    return Solid(whole);
}

Solid Solid::half_space(const std::array<double, 4>& plane) {
    const Lattice lattice = lattice_for(plane);
    return half_space(plane_on_lattice(plane, lattice), lattice);
}

Solid Solid::half_space(const Plane& plane, Lattice lattice) {
    if (!plane.is_valid()) throw UsageError("half-space of a plane without normal");
    const auto source = detail::Source::half_space(plane, lattice);
    auto state = std::make_shared<SolidState>();
    state->lattice = lattice;
    state->form = detail::CellTree{detail::half_space_root(*source), {}, nullptr};
    state->far_out = -1;
    return detail::solid_of(std::move(state));
}

Solid Solid::from_lattice_mesh(LatticeMesh mesh, Embedding embedding) {
    EmbeddingFindings findings = findings_of(mesh, embedding);
    return of_lattice_mesh(std::move(mesh), std::move(findings), 1);
}

Solid solid_of_findings(LatticeMesh mesh, EmbeddingFindings findings) {
    return of_lattice_mesh(std::move(mesh), std::move(findings), 1);
}

Solid Solid::from_mesh(const PolygonMesh& mesh, const SolidOptions& options) {
    ImportOptions import = options.import;
    import.require_closed = true;
    return of_import(import_mesh(mesh, import), options.embedding, options.inside_out,
                     import.threads);
}

Solid Solid::from_triangles(const TriangleView& mesh, const SolidOptions& options) {
    ImportOptions import = options.import;
    import.require_closed = true;
    return of_import(import_mesh(mesh, import), options.embedding, options.inside_out,
                     import.threads);
}

Solid Solid::from_import(ImportedMesh imported, Embedding embedding, InsideOut inside_out) {
    return of_import(std::move(imported), embedding, inside_out, 1);
}

void Solid::refine(std::uint32_t threads) const {
    detail::refine_all(detail::cut_state(*this)->root(), threads);
}

Lattice Solid::lattice() const { return state()->lattice; }
bool Solid::is_empty() const {
    const SolidState& s = *state();
    return is_constant(s, false) ||
           (s.far_out <= 0 && !is_constant(s, true) && !has_boundary(*this));
}
bool Solid::is_whole_space() const {
    const SolidState& s = *state();
    return is_constant(s, true) ||
           (s.far_out > 0 && !is_constant(s, false) && !has_boundary(*this));
}
std::uint32_t Solid::source_id() const { return static_cast<std::uint32_t>(state()->source); }

Brep Solid::to_brep(const AssembleOptions& options) const {
    const detail::SolidState& own = *state();
    if (has_all_of_brep(own, options)) return detail::assemble_brep(own, options);
    if (auto brep = brep_with_proved_names(own, options)) return *std::move(brep);
    // Where facets of several operands coincide, smaller faces have the names that a tree gives.
    const auto named = options.maximal_faces ? pair_by_pair(own) : nullptr;
    return detail::assemble_brep(named != nullptr ? *named : *detail::cut_state(*this), options);
}

namespace {

void require_bounded(const Solid& solid) {
    if (is_unbounded(solid))
        throw UnsupportedError("the set is unbounded: its mesh would be read as another set");
}

// With the names of maximal faces.
std::shared_ptr<const SolidState> named_state(const Solid& solid) {
    const auto& own = detail::state_of(solid);
    if (has_all_of_brep(*own, {})) return own;
    if (auto named = pair_by_pair(*own)) return named;
    return detail::cut_state(solid);
}

}  // namespace

PolygonMesh Solid::to_mesh(std::uint32_t threads) const {
    require_bounded(*this);
    return detail::assemble_mesh(*state(), nullptr, true, threads);
}

PolygonMesh Solid::to_mesh(MeshMap& map, std::uint32_t threads) const {
    require_bounded(*this);
    map.face.clear();
    return detail::assemble_mesh(*named_state(*this), nullptr, true, threads, &map.source);
}

ExactMesh Solid::to_exact_mesh(std::uint32_t threads) const {
    return detail::assemble_exact_mesh(*named_state(*this), threads);
}

}  // namespace trisect
