// SPDX-License-Identifier: Apache-2.0
//
// Moving to a finer lattice shifts integers and changes nothing. It needs room above the largest
// coordinate. Where that is missing, because one operand is huge and another one fine, the common
// lattice is as fine as the huge one allows and the fine one is rounded to it, corner by corner,
// like an import: a boundary that was closed stays closed, but facets may turn over or cross, so
// the result is resolved and not taken to be embedded.

#include <trisect/bsp/evaluate/on_common_lattice.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/evaluate/half_space.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

std::string unit_text(int exponent) { return "2^" + std::to_string(exponent); }

// Rebuilds one tree as a single unrefined leaf on a finer lattice. Splitting planes of the old tree
// survive as edges of fragments only: on the finer lattice they would no longer be off the lattice.
// Space is smaller there. What half-spaces bound beyond its limits is cut off.
class Refiner {
public:
    Refiner(int from, int to) : shift_(from - to), exponent_(to) {}
    Refiner(const Refiner&) = delete;
    Refiner& operator=(const Refiner&) = delete;
    ~Refiner() { end_fragments(out_); }  // where an exception ended the walk

    CellRef refine(const CellRef& root) {
        if (is_whole_mesh(*root.node)) return refine_mesh(root);
        visit(root, Cell{});
        const Reference at = reference_of(root);
        return {CellNode::leaf(PolygonList(std::move(out_)), shifted(at.point), at.winding, mixed_),
                false};
    }

private:
    // As it was imported.
    [[nodiscard]] static bool is_whole_mesh(const CellNode& node) {
        return node.is_leaf() && node.deferred() == nullptr && node.polygons().has_all_facets() &&
               !node.polygons().flipped() && !node.polygons().whole_source()->is_half_space();
    }

    // Stays one, and so goes every way that whole meshes go.
    [[nodiscard]] CellRef refine_mesh(const CellRef& root) const {
        const CellNode& node = *root.node;
        const auto source = node.polygons().whole_source()->refined(exponent_);
        return {CellNode::leaf(PolygonList::all_facets(*source), shifted(node.reference()),
                               node.winding(), node.is_mixed()),
                root.complemented};
    }

    struct Reference {
        FinePoint point;
        int winding = 0;
    };

    // That of some leaf, or another point where it is out of space.
    [[nodiscard]] Reference reference_of(const CellRef& root) const {
        const CellNode* node = root.node.get();
        bool complemented = root.complemented;
        while (!node->is_leaf()) {
            complemented = complemented != node->child(0).complemented;
            node = node->child(0).node.get();
        }
        if (is_in_space(node->reference()))
            return {node->reference(), complemented ? 1 - node->winding() : node->winding()};
        for (std::int64_t k = 1; k < 40; ++k) {
            const FinePoint p{{2 * k, 6 * k * k, 10 * k * k * k}};
            if (!is_in_space(p)) break;
            if (const auto winding = winding_in_tree(*root.node, root.complemented, Cell{}, p))
                return {p, *winding};
        }
        throw LimitError(
            "no point of a solid of half-spaces is left on the common lattice of unit " +
            unit_text(exponent_));
    }

    [[nodiscard]] bool is_in_space(std::int64_t v) const {
        return shift_ < 62 && v <= (universe_limit >> shift_) && v >= -(universe_limit >> shift_);
    }
    [[nodiscard]] bool is_in_space(const FinePoint& p) const {
        return std::ranges::all_of(p.c, [this](std::int64_t c) { return is_in_space(c); });
    }
    [[nodiscard]] bool is_in_space(const Box& box) const {
        const auto is_in = [this](std::int64_t c) {
            return shift_ < 53 && std::abs(c) < (coordinate_limit >> shift_);
        };
        return std::ranges::all_of(box.lo, is_in) && std::ranges::all_of(box.hi, is_in);
    }

    // What of a fragment of a half-space's plane is within space on the new lattice.
    [[nodiscard]] std::optional<PolygonRef> within_space(const PolygonRef& ref) {
        PolygonRef plane = ref;
        plane.source = renamed(ref.source);
        plane.fragment = nullptr;
        fine_.clear();
        WorkPolygon part = fine_.polygon(plane);
        fine_.with_edges(part, plane);
        part = fine_.clipped(std::move(part), plane.box(), Cell{});
        for (const EdgeName& e : ref.fragment->edges()) {
            if (part.is_empty()) return std::nullopt;
            if (e.plane.is_splitter() && !is_in_space(e.plane.position())) {
                if ((e.plane.position() > 0) == e.above) return std::nullopt;
                continue;  // all of space is on that side
            }
            part = fine_.clipped(std::move(part), fine_.plane(renamed(e).plane), e.above ? 1 : -1);
        }
        if (part.is_empty()) return std::nullopt;
        return make_fragment(fine_, plane, part);
    }

    [[nodiscard]] EdgeName renamed(EdgeName e) {
        e.plane.owner = e.plane.is_splitter()
                            ? static_cast<std::uint64_t>(shifted(e.plane.position()))
                            : reinterpret_cast<std::uintptr_t>(renamed(e.plane.source()));
        return e;
    }

    [[nodiscard]] FinePoint shifted(FinePoint p) const {
        for (std::int64_t& c : p.c) c = shifted(c);
        return p;
    }

    [[nodiscard]] std::int64_t shifted(std::int64_t v) const {
        if (!is_in_space(v))
            throw LimitError("a cell splitter leaves the range of the common lattice of unit 2^" +
                             std::to_string(exponent_));
        return v << shift_;
    }

    const Source* renamed(const Source* s) {
        auto& r = sources_[s];
        if (!r) r = s->refined(exponent_);
        return r.get();
    }

    PolygonRef renamed(const PolygonRef& ref) {
        PolygonRef out = ref;
        out.source = renamed(ref.source);
        if (ref.fragment == nullptr) return out;
        std::vector<EdgeName> edges;
        for (const EdgeName& e : ref.fragment->edges()) edges.push_back(renamed(e));
        Box box = ref.fragment->box();
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] *= std::int64_t{1} << shift_;
            box.hi[k] *= std::int64_t{1} << shift_;
        }
        const double factor = std::ldexp(1.0, static_cast<int>(shift_));
        std::vector<Approximation> vertices(ref.fragment->vertices().begin(),
                                            ref.fragment->vertices().end());
        for (Approximation& v : vertices) {
            for (double& c : v.c) c *= factor;
            v.error *= factor;
        }
        out.fragment = Fragment::make(edges, vertices, box);
        return out;
    }

    void visit(const CellRef& ref, const Cell& cell) {
        const CellNode& node = *ref.node;
        if (!node.is_leaf()) {
            for (int i = 0; i < 2; ++i) {
                CellRef c = node.child(i);
                c.complemented = c.complemented != ref.complemented;
                const Cell part = i == 0 ? cell.below(node.axis(), node.splitter())
                                         : cell.above(node.axis(), node.splitter());
                with_enough_stack([&] { visit(c, part); });
            }
            return;
        }
        mixed_ = mixed_ || node.is_mixed();
        for (const PolygonRef& r : node.polygons()) {
            bench_.clear();
            const auto part = clip_to_cell(bench_, r, cell);
            if (!part) continue;
            // Holds a clipped fragment until its copy on the new lattice is made.
            const PolygonList hold({*part});
            make_room(out_);
            const bool is_plane = part->fragment != nullptr && part->source->is_half_space() &&
                                  !is_in_space(part->fragment->box());
            const auto fine = is_plane ? within_space(*part) : std::optional(renamed(*part));
            if (!fine) continue;
            out_.push_back(*fine);
            out_.back().flipped = part->flipped != ref.complemented;
        }
    }

    int shift_;
    int exponent_;
    bool mixed_ = false;
    std::vector<PolygonRef> out_;
    Workbench bench_;
    Workbench fine_;  // on the new lattice
    std::unordered_map<const Source*, std::shared_ptr<const Source>> sources_;
};

// The sources of all polygons of a state.
std::unordered_set<const Source*> sources_of(const SolidState& state) {
    std::unordered_set<const Source*> out;
    std::vector<const CellNode*> pending{state.root().node.get()};
    while (!pending.empty()) {
        const CellNode& n = *pending.back();
        pending.pop_back();
        if (n.is_leaf()) {
            for (const PolygonRef& r : n.polygons()) out.insert(r.source);
        } else {
            for (int i = 0; i < 2; ++i) pending.push_back(n.child(i).node.get());
        }
    }
    return out;
}

// A few units are added for reference points and splitting planes, which lie just beyond the
// corners.
std::int64_t largest_coordinate(const std::unordered_set<const Source*>& sources) {
    std::int64_t largest = 0;
    for (const Source* s : sources) {
        if (s->is_unbounded()) continue;
        for (std::size_t k = 0; k < 3; ++k)
            largest = std::max({largest, std::abs(s->box().lo[k]), std::abs(s->box().hi[k])});
    }
    return largest + 4;
}

// The finest exponent, a multiple of 8, to which coordinates of this size can be moved.
int finest_for(std::int64_t largest, int exponent) {
    int room = 0;
    while (room < coordinate_bits && largest < (coordinate_limit >> (room + 8))) room += 8;
    return exponent - room;
}

// The boundary in triangles with coordinates as doubles, which are exact for an imported solid.
// `unbounded` says that it is turned over and bounds the complement.
struct Boundary {
    PolygonMesh mesh;
    bool unbounded = false;
};

Boundary boundary_of(const std::shared_ptr<const SolidState>& state) {
    if (state->source != 0) {  // imported, maybe not free of self-intersection: as it came
        const LatticeMesh& mesh = (*state->root().node->polygons().begin()).source->mesh();
        Boundary out;
        out.unbounded = state->root().complemented;
        for (const LatticePoint& p : mesh.points)
            out.mesh.points.push_back(to_user(p, mesh.lattice));
        for (const auto& t : mesh.triangles) out.mesh.add_triangle(t[0], t[1], t[2]);
        return out;
    }
    const Brep brep = solid_of(state).to_brep();
    Boundary out{to_polygon_mesh(brep), exact_volume(brep).sign() < 0};
    if (out.unbounded)
        for (std::size_t f = 0; f < out.mesh.face_count(); ++f)
            std::reverse(out.mesh.corners.begin() + out.mesh.face_begin[f],
                         out.mesh.corners.begin() + out.mesh.face_begin[f + 1]);
    return out;
}

std::shared_ptr<const SolidState> rounded(const std::shared_ptr<const SolidState>& state,
                                          Lattice lattice, LatticeReport& report) {
    Boundary boundary = boundary_of(state);
    ImportOptions options;
    options.lattice = lattice;
    ImportedMesh imported = import_mesh(boundary.mesh, options);
    if (imported.mesh.triangles.empty())
        throw LimitError(
            "the sizes of the operands differ too much: on the common lattice of unit " +
            unit_text(lattice.exponent) + " nothing is left of an operand of unit " +
            unit_text(state->lattice.exponent));
    report.lossless = false;
    report.moved += imported.report.lattice.moved;
    report.max_move = std::max(report.max_move, imported.report.lattice.max_move);
    report.flipped_faces += imported.report.lattice.flipped_faces;
    auto out = std::make_shared<SolidState>(
        *state_of(Solid::from_import(std::move(imported), Embedding::Resolve, InsideOut::Accept)));
    CellRef& root = std::get<CellTree>(out->form).root;
    root.complemented = root.complemented != boundary.unbounded;
    out->far_out = boundary.unbounded ? 1 : 0;
    return out;
}

std::shared_ptr<const SolidState> refined(const std::shared_ptr<const SolidState>& state,
                                          Lattice lattice) {
    auto out = std::make_shared<SolidState>(*state);
    out->lattice = lattice;
    // Refining clips every facet to its cell, so none is incomplete.
    out->form = CellTree{Refiner(state->lattice.exponent, lattice.exponent).refine(state->root()),
                         {},
                         {},
                         state->tree().may_have_straight_crossings};
    return out;
}

// To the coarsest of their lattices: all of them are within the limits of space there, and their
// vertices need be no lattice points.
LatticeReport move_half_spaces(std::vector<std::shared_ptr<const SolidState>>& states) {
    LatticeReport report;
    int coarsest = std::numeric_limits<int>::min();
    for (const auto& s : states)
        if (s->lattice_matters) coarsest = std::max(coarsest, s->lattice.exponent);
    if (coarsest == std::numeric_limits<int>::min()) return report;
    report.lattice.exponent = coarsest;
    for (auto& s : states)
        if (s->lattice_matters && s->lattice.exponent != coarsest)
            s = half_space_on(*s, report.lattice);
    return report;
}

[[noreturn]] void refuse(int finest, int common) {
    throw LimitError("the operands have no common lattice without rounding: the finest unit is " +
                     unit_text(finest) + ", the finest on which all of them fit " +
                     unit_text(common));
}

}  // namespace

LatticeReport move_to_common_lattice(std::vector<std::shared_ptr<const SolidState>>& states,
                                     EvaluateOptions::Lattices policy) {
    if (std::ranges::all_of(states,
                            [](const auto& s) { return !s->lattice_matters || is_half_space(*s); }))
        return move_half_spaces(states);
    LatticeReport report;
    int finest = std::numeric_limits<int>::max();
    // A half-space has a place on every lattice.
    const auto is_free = [](const SolidState& s) { return !s.lattice_matters || is_half_space(s); };
    for (const auto& s : states) {
        if (is_free(*s)) continue;
        finest = std::min(finest, s->lattice.exponent);
    }
    if (finest == std::numeric_limits<int>::max()) return report;
    report.lattice.exponent = finest;
    int& common = report.lattice.exponent;
    for (const auto& s : states)
        if (!is_free(*s) && s->lattice.exponent != finest)
            common = std::max(common,
                              finest_for(largest_coordinate(sources_of(*s)), s->lattice.exponent));
    if (common != finest && policy == EvaluateOptions::Lattices::Refuse) refuse(finest, common);
    for (auto& s : states) {
        if (!s->lattice_matters || s->lattice.exponent == common) continue;
        if (is_half_space(*s)) {
            s = half_space_on(*s, report.lattice);
            continue;
        }
        if (s->lattice.exponent > common) {
            s = refined(s, report.lattice);
            continue;
        }
        for (const Source* source : sources_of(*s))
            if (source->is_half_space()) refuse(finest, common);
        s = rounded(s, report.lattice, report);
    }
    return report;
}

}  // namespace trisect::detail
