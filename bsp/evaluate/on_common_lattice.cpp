// SPDX-License-Identifier: Apache-2.0
//
// Moving to another lattice multiplies coordinates by a power of two and changes nothing. A finer
// one needs room above the largest coordinate, a coarser one bits behind the point. Where whole
// coordinates have room on the finest lattice they stay whole; else the coarser operands stay as
// they are, and the finer ones move. So a cut by a small tool costs what is near it.
//
// Where neither is possible, because one operand is huge and another one fine, the common lattice
// is as fine as the huge one allows and the fine one is rounded to it, corner by corner, like an
// import: a boundary that was closed stays closed, but facets may turn over or cross, so the result
// is resolved and not taken to be embedded.

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

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/evaluate/half_space.h>
#include <trisect/bsp/evaluate/named_boundary.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

std::string unit_text(int exponent) { return "2^" + std::to_string(exponent); }

// Rebuilds one tree as a single unrefined leaf on a finer lattice, or the same. Splitting planes of
// the old tree survive as edges of fragments only: on the finer lattice they would no longer be off
// the lattice.
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
        const auto source = node.polygons().whole_source()->on_lattice(exponent_);
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
        if (!r) r = s->on_lattice(exponent_);
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

// Exponents of lattices are mostly multiples of 8.
constexpr int usual_step = 8;

// The finest exponent, multiples of a step below, to which coordinates of this size can be moved.
int finest_for(std::int64_t largest, int exponent, int step) {
    int room = 0;
    while (room < coordinate_bits && largest < (coordinate_limit >> (room + step))) room += step;
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
    const auto sources = sources_of(*out);
    out->whole = std::ranges::all_of(
        sources, [](const Source* s) { return s->is_half_space() || s->is_whole(); });
    return out;
}

// The plane of the points x 2^-bits.
Plane scaled(const Plane& p, int bits) {
    const auto n = [&](int i) { return p.normal(i).shifted_left(bits); };
    return {n(0), n(1), n(2), p.offset()};
}

// The same boundary on a lattice of a unit 2^bits times as large.
Brep on_coarser_lattice(const Brep& brep, int bits) {
    BrepBuilder builder(Lattice{brep.lattice().exponent + bits});
    const double factor = std::ldexp(1, -bits);
    for (const VertexId v : brep.vertices()) {
        const Point& p = brep.point(v);
        if (p.is_lattice()) {
            const auto c = [&](int k) { return Coordinate(p.lattice()[k].to_double() * factor); };
            builder.add_vertex(LatticePoint{c(0), c(1), c(2)});
        } else {
            const auto& planes = p.plane_point()->planes;
            builder.add_vertex(
                Point(scaled(planes[0], bits), scaled(planes[1], bits), scaled(planes[2], bits)));
        }
    }
    std::vector<std::vector<std::uint32_t>> loops;
    for (const FaceId f : brep.faces()) {
        loops.clear();
        for (const LoopId l : brep.loops(f)) {
            auto& loop = loops.emplace_back();
            for (const HalfedgeId h : brep.halfedges(l)) loop.push_back(brep.origin(h).index);
        }
        builder.add_face(scaled(brep.plane(f), bits), loops, brep.source(f));
    }
    return std::move(builder).build();
}

// A leaf of facets as they were imported.
bool lists_whole_facets(const CellNode& node) {
    if (!node.is_leaf() || node.deferred() != nullptr) return false;
    const PolygonList& polygons = node.polygons();
    return std::all_of(polygons.begin(), polygons.end(), [](const PolygonRef& r) {
        return r.fragment == nullptr && !r.source->is_half_space();
    });
}

CellRef coarser_leaf(const SolidState& state, int exponent) {
    const CellRef& root = state.root();
    std::unordered_map<const Source*, std::shared_ptr<const Source>> sources;
    Box all;
    for (const Source* s : sources_of(state)) {
        const auto& made = sources[s] = s->on_lattice(exponent);
        all.add(made->box());
    }
    const int far_out = (state.far_out == 1) != root.complemented ? 1 : 0;
    const PolygonList& polygons = root.node->polygons();
    if (const Source* whole = polygons.whole_source();
        whole != nullptr && polygons.has_all_facets() && !polygons.flipped())
        return {CellNode::leaf(PolygonList::all_facets(*sources.at(whole)), point_beyond(all),
                               far_out, root.node->is_mixed()),
                root.complemented};
    std::vector<PolygonRef> refs(polygons.begin(), polygons.end());
    for (PolygonRef& r : refs) r.source = sources.at(r.source).get();
    return {CellNode::leaf(PolygonList(std::move(refs)), point_beyond(all), far_out,
                           root.node->is_mixed()),
            root.complemented};
}

// An import keeps its facets. Of a result the boundary is taken: splitting planes of its tree would
// have no positions on the coarser lattice.
std::shared_ptr<const SolidState> coarser(const std::shared_ptr<const SolidState>& state,
                                          Lattice lattice) {
    auto out = std::make_shared<SolidState>(*state);
    if (lists_whole_facets(*state->root().node)) {
        out->form = CellTree{coarser_leaf(*state, lattice.exponent),
                             {},
                             {},
                             state->tree().may_have_straight_crossings};
        out->whole = false;
    } else {
        const bool unbounded = state->far_out == 1;
        auto bounded = std::make_shared<SolidState>(*state);
        if (unbounded) {
            auto& tree = std::get<CellTree>(bounded->form);
            tree.root.complemented = !tree.root.complemented;
            tree.crossings = nullptr;  // of the set, not of its complement
            bounded->far_out = 0;
        }
        const Brep brep = solid_of(std::move(bounded)).to_brep();
        const Solid moved =
            named_solid(on_coarser_lattice(brep, lattice.exponent - state->lattice.exponent));
        *out = *state_of(moved);
        out->source = state->source;
        if (unbounded) {
            CellRef& root = std::get<CellTree>(out->form).root;
            root.complemented = !root.complemented;
            out->far_out = 1;
        }
    }
    out->lattice = lattice;
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

// A half-space has a place on every lattice.
bool is_free(const SolidState& s) { return !s.lattice_matters || is_half_space(s); }

// An operand that has a place on some lattices only.
struct Placed {
    int exponent = 0;
    bool whole = true;
    std::uint64_t size = 0;
    const SolidState* state = nullptr;

    [[nodiscard]] int finest(int step) const {
        return finest_for(largest_coordinate(sources_of(*state)), exponent, step);
    }
    /// Without loss; far beyond where planes end. Fractions say so at once, zeros at the ends of
    /// whole coordinates only when all of them are looked at.
    [[nodiscard]] int coarsest(bool with_zeros) const {
        int last = with_zeros ? coordinate_bits : 0;
        for (const Source* s : sources_of(*state)) {
            // Sets of half-spaces may end where space does, and then stay as they are. What
            // half-spaces cut off a bounded set moves with its boundary.
            if (s->is_unbounded() && state->far_out < 0) return exponent;
            const bool looks = with_zeros && !s->is_half_space();
            last = std::min(last, looks ? s->last_bit() : -s->fraction_bits());
        }
        return exponent + fraction_limit + last;
    }
};

struct CommonLattice {
    int exponent = 0;
    bool rounds = false;
};

// Finer operands that are so much smaller move to the coarser lattice, even where both are whole.
constexpr std::uint64_t much_smaller = 8;
constexpr std::uint64_t large_operand = 4096;

CommonLattice common_lattice(const std::vector<Placed>& placed) {
    int finest = std::numeric_limits<int>::max();
    int coarsest = std::numeric_limits<int>::min();
    bool whole = true;
    for (const Placed& p : placed) {
        finest = std::min(finest, p.exponent);
        coarsest = std::max(coarsest, p.exponent);
        whole = whole && p.whole;
    }
    if (finest == coarsest) return {finest, false};
    std::uint64_t moved = 0;
    std::uint64_t fine = 0;
    for (const Placed& p : placed) (p.exponent == finest ? fine : moved) += p.size;
    const auto best_without_fractions = [&](int step) {
        int best = finest;
        for (const Placed& p : placed)
            if (p.exponent != finest) best = std::max(best, p.finest(step));
        return best;
    };
    if (whole && (moved < large_operand || moved < much_smaller * fine) &&
        best_without_fractions(usual_step) == finest)
        return {finest, false};
    const auto coarsest_for_all = [&](bool with_zeros) {
        int most = coarsest;
        for (const Placed& p : placed)
            if (p.exponent < most) most = std::min(most, p.coarsest(with_zeros));
        return most;
    };
    if (coarsest_for_all(false) == coarsest) return {coarsest, false};
    const int most = coarsest_for_all(true);
    if (most == coarsest) return {coarsest, false};
    const int least = best_without_fractions(usual_step);
    if (least > most)
        return best_without_fractions(1) <= most ? CommonLattice{most, false}
                                                 : CommonLattice{least, true};
    const int usual = most - (most % usual_step + usual_step) % usual_step;
    return {usual >= least ? usual : most, false};
}

// Splitting planes of other offsets might separate what coordinates with fractions do not.
void require_usual_offsets(std::vector<std::shared_ptr<const SolidState>>& states) {
    if (std::ranges::all_of(states, [](const auto& s) { return s->whole; })) return;
    for (auto& s : states)
        if (!s->tree().has_usual_offsets) s = refined(s, s->lattice);
}

}  // namespace

std::shared_ptr<const SolidState> moved_to_lattice(const std::shared_ptr<const SolidState>& state,
                                                   Lattice lattice) {
    if (state->lattice == lattice) return state;
    return lattice < state->lattice ? refined(state, lattice) : coarser(state, lattice);
}

std::shared_ptr<const SolidState> without_tree(const std::shared_ptr<const SolidState>& state) {
    return state->root().node->is_leaf() ? state : refined(state, state->lattice);
}

LatticeReport move_to_common_lattice(std::vector<std::shared_ptr<const SolidState>>& states,
                                     EvaluateOptions::Lattices policy) {
    if (std::ranges::all_of(states,
                            [](const auto& s) { return !s->lattice_matters || is_half_space(*s); }))
        return move_half_spaces(states);
    LatticeReport report;
    std::vector<Placed> placed;
    for (const auto& s : states)
        if (!is_free(*s))
            placed.push_back({s->lattice.exponent, s->whole, s->root().node->size(), s.get()});
    if (placed.empty()) return report;
    const CommonLattice common = common_lattice(placed);
    report.lattice.exponent = common.exponent;
    const auto refuse_to_round = [&] {
        refuse(std::ranges::min(placed, {}, &Placed::exponent).exponent, common.exponent);
    };
    if (common.rounds && policy == EvaluateOptions::Lattices::Refuse) refuse_to_round();
    for (auto& s : states) {
        if (!s->lattice_matters || s->lattice.exponent == common.exponent) continue;
        if (is_half_space(*s)) {
            s = half_space_on(*s, report.lattice);
            continue;
        }
        if (s->lattice.exponent > common.exponent || !common.rounds) {
            s = moved_to_lattice(s, report.lattice);
            continue;
        }
        for (const Source* source : sources_of(*s))
            if (source->is_half_space()) refuse_to_round();
        s = rounded(s, report.lattice, report);
    }
    require_usual_offsets(states);
    return report;
}

}  // namespace trisect::detail
