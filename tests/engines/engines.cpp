// SPDX-License-Identifier: Apache-2.0

#include "engines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <variant>

#include <trisect/bsp/assembly/assembly.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>
#include <trisect/bsp/many_meshes/parity/exclusive_or_without_tree.h>
#include <trisect/bsp/two_meshes/two_meshes_without_tree.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace engines {

namespace {

using Matrix = std::array<std::array<std::int64_t, 3>, 3>;

std::int64_t determinant(const Matrix& m) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += m[0][i] *
               (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]);
    return sum;
}

template <int N>
reference::Integer integer(const trisect::WideInt<N>& v) {
    const bool negative = v.is_negative();
    const trisect::WideInt<N> a = v.abs();
    reference::Integer r = 0;
    for (int i = N - 1; i >= 0; --i) {
        r <<= 32;
        r += static_cast<unsigned long>(a.limb(i) >> 32);
        r <<= 32;
        r += static_cast<unsigned long>(a.limb(i) & 0xffffffffU);
    }
    if (negative) r = -r;
    return r;
}

reference::Point3 rational_point(const trisect::Point& p, trisect::Lattice lattice) {
    const trisect::HomogeneousPoint h = p.homogeneous();
    reference::Point3 out;
    for (std::size_t k = 0; k < 3; ++k) {
        out[k] = reference::Rational(integer(h.xyz[k]), integer(h.w));
        out[k].canonicalize();
        out[k] <<= static_cast<unsigned long>(lattice.exponent);
    }
    return out;
}

}  // namespace

trisect::LatticeMesh lattice_mesh(const reference::Operand& operand, int bits) {
    const auto scaled = [bits](std::int64_t v) {
        return trisect::Coordinate(std::ldexp(static_cast<double>(v), -bits));
    };
    trisect::LatticeMesh mesh;
    std::map<std::array<std::int64_t, 3>, std::uint32_t> index;
    for (const auto& t : operand) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::array<std::int64_t, 3> p{t[i][0], t[i][1], t[i][2]};
            const auto [at, inserted] =
                index.insert({p, static_cast<std::uint32_t>(mesh.points.size())});
            if (inserted) mesh.points.push_back({scaled(p[0]), scaled(p[1]), scaled(p[2])});
            corners[i] = at->second;
        }
        mesh.triangles.push_back(corners);
    }
    mesh.lattice.exponent = bits;
    return mesh;
}

trisect::Solid solid(const reference::Operand& operand, trisect::Embedding embedding, int bits) {
    return trisect::Solid::from_lattice_mesh(lattice_mesh(operand, bits), embedding);
}

trisect::Expression formula(const reference::Expression& expression,
                            const std::vector<trisect::Solid>& solids) {
    using Kind = reference::Expression::Kind;
    if (expression.kind == Kind::Leaf) return solids[expression.operand];
    trisect::Expression out = formula(expression.children[0], solids);
    if (expression.kind == Kind::Complement) return ~out;
    for (std::size_t i = 1; i < expression.children.size(); ++i) {
        const trisect::Expression next = formula(expression.children[i], solids);
        switch (expression.kind) {
            case Kind::Union:
                out = out | next;
                break;
            case Kind::Intersection:
                out = out & next;
                break;
            case Kind::Difference:
                out = out - next;
                break;
            default:
                out = out ^ next;
                break;
        }
    }
    return out;
}

std::vector<reference::Polygon> polygons(const trisect::Brep& brep) {
    std::vector<reference::Polygon> out;
    for (const trisect::FaceId f : brep.faces()) {
        const trisect::Plane& p = brep.plane(f);
        const auto unit = static_cast<unsigned long>(brep.lattice().exponent);
        reference::Polygon polygon{
            {integer(p.normal(0)), integer(p.normal(1)), integer(p.normal(2)),
             reference::Integer(integer(p.offset()) << unit)},
            {}};
        for (const trisect::LoopId l : brep.loops(f)) {
            auto& loop = polygon.loops.emplace_back();
            for (const trisect::HalfedgeId h : brep.halfedges(l))
                loop.push_back(rational_point(brep.point(brep.origin(h)), brep.lattice()));
        }
        out.push_back(std::move(polygon));
    }
    return out;
}

std::string difference(const trisect::Brep& brep, const reference::CanonicalBoundary& expected) {
    const auto found = reference::canonical_boundary(polygons(brep));
    if (std::string why = reference::explain_difference(found, expected); !why.empty()) return why;
    // Vertices: the real ones, those where separate sheets touch, and those where several straight
    // creases cross. A vertex with two edges only is one at which nothing happens.
    std::set<reference::Point3> used;
    const auto real = reference::real_vertices(expected);
    for (const trisect::VertexId v : brep.vertices()) {
        const reference::Point3 p = rational_point(brep.point(v), brep.lattice());
        used.insert(p);
        if (!real.contains(p) && brep.copies(v).empty() && brep.outgoing_halfedges(v).size() == 2)
            return "a vertex at which no face turns";
    }
    for (const reference::Point3& p : real)
        if (!used.contains(p)) return "a real vertex is missing";
    return {};
}

std::string open_edge(const trisect::PolygonMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t a = loop[i];
            const std::uint32_t b = loop[(i + 1) % loop.size()];
            balance[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    for (const auto& [edge, count] : balance)
        if (count != 0)
            return "edge " + std::to_string(edge.first) + "-" + std::to_string(edge.second) +
                   " of the mesh is open";
    return {};
}

reference::Operand mapped(const reference::Operand& operand, reference::Random& random) {
    Matrix m{};
    while (determinant(m) == 0)
        for (auto& row : m)
            for (auto& x : row) x = random.between(-9, 9);
    const std::array<std::int64_t, 3> by{random.between(-50, 50), random.between(-50, 50),
                                         random.between(-50, 50)};
    reference::Operand out = operand;
    for (auto& triangle : out)
        for (auto& p : triangle) {
            std::array<std::int64_t, 3> q{};
            for (std::size_t i = 0; i < 3; ++i)
                q[i] = by[i] + m[i][0] * (p[0] - 7) + m[i][1] * (p[1] - 7) + m[i][2] * (p[2] - 7);
            p = {q[0], q[1], q[2]};
        }
    return determinant(m) < 0 ? reference::reversed(out) : out;
}

namespace {

// Nothing where it cannot be assembled.
std::optional<trisect::PolygonMesh> mesh_of(const trisect::detail::SolidState& state) {
    try {
        return trisect::detail::assemble_mesh(state);
    } catch (const trisect::UnsupportedError&) {
        return std::nullopt;
    }
}

bool are_equal(const std::optional<trisect::PolygonMesh>& a,
               const std::optional<trisect::PolygonMesh>& b) {
    return a.has_value() == b.has_value() &&
           (!a || (a->corners == b->corners && a->points == b->points));
}

}  // namespace

trisect::PolygonMesh boundary_mesh(const trisect::Solid& solid) {
    return trisect::detail::assemble_mesh(*trisect::detail::state_of(solid), nullptr, true, 0);
}

// A limit of work is counted by cells.
trisect::Solid evaluate_by_cells(const trisect::Expression& expression,
                                 const trisect::EvaluateOptions& options,
                                 trisect::test::EvaluateStats* stats) {
    const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});
    return trisect::test::evaluate(expression, options, stats);
}

std::optional<std::string> undivided_difference(const trisect::Expression& expression,
                                                const trisect::EvaluateOptions& options,
                                                bool* conforming) {
    using namespace trisect::detail;
    const Translation t = each_once(expression);
    std::vector<std::shared_ptr<const SolidState>> states;
    for (const trisect::Solid& s : t.slots) states.push_back(trisect::detail::state_of(s));
    const auto same_lattice = [&](const auto& s) { return s->lattice == states[0]->lattice; };
    if (!std::ranges::all_of(states, same_lattice)) return std::nullopt;
    const bool whole = std::ranges::all_of(states, [](const auto& s) { return s->whole; });
    EvaluateStats stats;
    const FormulaRule undivided{[](const auto& formula, const auto& solids, const auto& with) {
                                    return are_two_meshes(formula, solids, with, 1);
                                },
                                &evaluate_without_tree};
    const EvaluateSettings settings{options,
                                    whole ? SplittingOffset::of_thread() : usual_splitting_offset};
    const auto state = evaluate_by(undivided, t.formula, states, settings, stats);
    if (state == nullptr) return std::nullopt;
    if (conforming != nullptr) *conforming = stats.conforming_pairs != 0;
    const trisect::Solid cells = evaluate_by_cells(expression, options);
    const auto expected = mesh_of(*trisect::detail::state_of(cells));
    const auto mesh = mesh_of(*state);
    const auto& found = *std::get<UndividedMeshes>(state->form).crossings;
    // Where facets coincide, which of them stands for both may differ, and so may triangles.
    const bool may_coincide = stats.doubtful_pairs != 0 || found.pairs.empty();
    if (may_coincide && mesh && expected) {
        if (std::string why = open_edge(*mesh); !why.empty()) return "open: " + why;
        // Outlines that cross in a facet in special position may take a tree. Its results are
        // compared as well.
        const bool needs_tree = state->lazy_tree()->is_cut();
        if (needs_tree && found.special.empty()) return "a tree was made for a mesh";
        if (state->lattice.exponent >= 0) {
            const auto boundary = reference::canonical_boundary(polygons(cells.to_brep()));
            if (std::string why = difference(assemble_brep(*state, {}), boundary); !why.empty())
                return "another boundary: " + why;
        }
        if (!needs_tree && found.special.empty() && state->lazy_tree()->is_cut())
            return "a tree was made for a boundary";
        if (found.shown.empty()) return std::string();
        const auto uncertain_mesh = [&] {
            SolidState uncertain = *state;
            auto crossings = std::make_shared<Crossings>(found);
            crossings->uncertain.push_back(crossings->shown.front());
            std::get<UndividedMeshes>(uncertain.form).crossings = crossings;
            return mesh_of(uncertain);
        };
        if (!are_equal(uncertain_mesh(), expected)) return "another mesh out of a tree";
        return std::string();
    }
    if (!are_equal(mesh, expected)) return "another mesh";
    if (!expected) return std::string();
    if (state->lazy_tree()->is_cut()) return "a tree was made for a mesh";
    // Where an outline is in doubt a tree is made after all.
    SolidState uncertain = *state;
    auto& meshes = std::get<UndividedMeshes>(uncertain.form);
    auto crossings = std::make_shared<Crossings>(*meshes.crossings);
    crossings->uncertain.push_back(crossings->shown.front());
    meshes.crossings = crossings;
    if (!are_equal(mesh_of(uncertain), expected)) return "another mesh out of a tree";
    if (!state->lazy_tree()->is_cut()) return "no tree was made";
    return std::string();
}

trisect::detail::Translation each_once(const trisect::Expression& expression) {
    using namespace trisect::detail;
    Translation t = with_named_slots(translate(expression));
    if (auto copies = with_copies(t)) return *std::move(copies);
    return t;
}

std::optional<std::string> pairwise_difference(const trisect::Expression& expression,
                                               const trisect::EvaluateOptions& options,
                                               const reference::CanonicalBoundary& expected,
                                               std::uint64_t& doubtful) {
    using namespace trisect::detail;
    const Translation t = each_once(expression);
    std::vector<std::shared_ptr<const SolidState>> states;
    for (const trisect::Solid& s : t.slots) states.push_back(trisect::detail::state_of(s));
    const auto same_lattice = [&](const auto& s) { return s->lattice == states[0]->lattice; };
    if (!std::ranges::all_of(states, same_lattice)) return std::nullopt;
    std::optional<trisect::PolygonMesh> first;
    const auto why_not = [&](const SolidState& state, const auto& mesh) {
        std::string why = difference(assemble_brep(state, {}), expected);
        if (why.empty() && mesh) why = open_edge(*mesh);
        // Lines in which faces may go straight across each other take a tree.
        const bool may_need_tree =
            std::get<UndividedMeshes>(state.form).may_have_straight_crossings;
        if (why.empty() && !may_need_tree && state.lazy_tree()->is_cut()) why = "a tree was made";
        return why;
    };
    EvaluateStats ignored;
    const auto with_sheets =
        evaluate_by({&may_be_many_meshes, &evaluate_many_with_sheets}, t.formula, states,
                    EvaluateSettings{options, usual_splitting_offset}, ignored);
    if (with_sheets != nullptr) {
        const std::string why = why_not(*with_sheets, mesh_of(*with_sheets));
        if (!why.empty()) return "with sheets: " + why;
    }
    const FormulaRule many{&may_be_many_meshes, &evaluate_many_without_tree};
    const FormulaRule parity{&is_exclusive_or_of_many, &evaluate_touching_exclusive_or};
    const bool is_parity = is_exclusive_or_of_many(
        t.formula, states, EvaluateSettings{options, usual_splitting_offset});
    for (const std::uint32_t threads : {1U, 2U, 4U}) {
        trisect::EvaluateOptions with = options;
        with.threads = threads;
        EvaluateStats stats;
        const auto state = evaluate_by(is_parity ? parity : many, t.formula, states,
                                       EvaluateSettings{with, usual_splitting_offset}, stats);
        if (state == nullptr && threads == 1) return std::nullopt;
        if (state == nullptr) return "not by " + std::to_string(threads) + " threads";
        const auto mesh = mesh_of(*state);
        if (threads == 1) {
            doubtful = stats.doubtful_pairs;
            first = mesh;
            const std::string why = why_not(*state, mesh);
            if (!why.empty()) return why;
        }
        if (!are_equal(mesh, first))
            return "another mesh by " + std::to_string(threads) + " threads";
    }
    return std::string();
}

}  // namespace engines
