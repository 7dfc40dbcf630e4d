// SPDX-License-Identifier: Apache-2.0
//
// Maps that take the lattice onto itself move the tree (moved_tree.h). A translation that does not
// is rounded as a whole: to a finer lattice, as far as the solid leaves room for one.
//
// Other maps are applied to exact vertices, in fractions. Every coordinate is then rounded once, to
// the nearest double of the user's, and the lattice is chosen as by an import of these.

#include <trisect/bsp/solid_transform.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <trisect/brep/import/thin_triangles.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/kinds/facet_kinds.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/measure/exact_values.h>
#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/evaluate/half_space.h>
#include <trisect/bsp/evaluate/on_common_lattice.h>
#include <trisect/bsp/solid/moved_points.h>
#include <trisect/bsp/solid/moved_tree.h>
#include <trisect/bsp/solid/uncut_root.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect {

namespace {

using detail::LatticeMove;
using detail::MovedPoints;
using detail::SolidState;
using StatePtr = std::shared_ptr<const SolidState>;

// The signed permutation, if the map has one; without its translation.
std::optional<LatticeMove> permutation_of(const Pose& pose) {
    LatticeMove move;
    for (std::size_t i = 0; i < 3; ++i) {
        int entries = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            const Pose::Number& v = pose.matrix(i, j);
            if (v.is_zero()) continue;
            if (v.abs() != pose.denominator()) return std::nullopt;
            ++entries;
            move.from[i] = static_cast<std::uint8_t>(j);
            move.sign[i] = v.is_negative() ? -1 : 1;
        }
        if (entries != 1) return std::nullopt;
    }
    return move;
}

// t / S, in the user's units.
mpq_class translation_of(const Pose& pose, std::size_t i) {
    return detail::fraction(detail::to_integer(pose.translation(i)),
                            detail::to_integer(pose.denominator()));
}

mpq_class in_units(mpq_class v, Lattice lattice) {
    if (lattice.exponent < 0) {
        v <<= static_cast<unsigned long>(-lattice.exponent);
    } else {
        v >>= static_cast<unsigned long>(lattice.exponent);
    }
    return v;
}

mpz_class floor_of(const mpq_class& v) {
    mpz_class out;
    mpz_fdiv_q(out.get_mpz_t(), v.get_num_mpz_t(), v.get_den_mpz_t());
    return out;
}

// \throw LimitError beyond the range in which coordinates may be moved
std::int64_t rounded(const mpq_class& v) {
    const mpz_class r = floor_of(v + mpq_class(1, 2));
    if (abs(r) >= 2 * detail::to_gmp(coordinate_limit))
        throw LimitError("a transformed coordinate leaves the lattice");
    return detail::to_int64(r);
}

double size_of(const mpq_class& units, Lattice lattice) {
    return lattice.to_double(std::fabs(units.get_d()));
}

// Of the moved solid, in units of its lattice, about.
mpz_class largest_coordinate(const SolidState& state, const Pose& pose) {
    const detail::Box box = detail::box_of(state.root());
    std::int64_t largest = 0;
    if (!box.is_empty())
        for (std::size_t k = 0; k < 3; ++k)
            largest = std::max({largest, std::abs(box.lo[k]), std::abs(box.hi[k])});
    mpq_class by = 0;
    for (std::size_t i = 0; i < 3; ++i)
        by = std::max(by, mpq_class(abs(in_units(translation_of(pose, i), state.lattice))));
    return floor_of(by) + detail::to_gmp(largest) + 4;
}

// The nearest finer lattice on which the translation is exact, if the moved solid has room on it;
// or else the finest one that leaves room to grow.
Lattice wanted_lattice(const SolidState& state, const Pose& pose) {
    const mpz_class largest = largest_coordinate(state, pose);
    const auto has_room = [&](Lattice l, int bits) {
        const mpz_class there = largest
                                << static_cast<unsigned long>(state.lattice.exponent - l.exponent);
        return mpz_sizeinbase(there.get_mpz_t(), 2) <= static_cast<std::size_t>(bits);
    };
    const auto is_exact = [&](Lattice l) {
        for (std::size_t i = 0; i < 3; ++i)
            if (in_units(translation_of(pose, i), l).get_den() != 1) return false;
        return true;
    };
    Lattice finest = state.lattice;
    for (Lattice l = state.lattice; has_room(l, coordinate_bits); l.exponent -= 8) {
        if (is_exact(l)) return l;
        if (has_room(l, coordinate_bits - growth_bits)) finest = l;
    }
    return finest;
}

// The same set on the wanted lattice, or one between, as fine as there is room.
StatePtr refined_towards(const StatePtr& state, Lattice wanted) {
    for (Lattice l = wanted; l < state->lattice; l.exponent += 8) {
        try {
            return detail::moved_to_lattice(state, l);
        } catch (const LimitError&) {  // no room: a coarser one
        }
    }
    return state;
}

// Coordinates with fractions stay on their lattice. Nothing where a translation is not by whole
// units, or a moved coordinate is no double.
std::optional<StatePtr> moved_with_fractions(StatePtr state, LatticeMove move, const Pose& pose) {
    for (std::size_t i = 0; i < 3; ++i) {
        const mpq_class t = in_units(translation_of(pose, i), state->lattice);
        if (t.get_den() != 1 || abs(t.get_num()) >= detail::to_gmp(coordinate_limit))
            return std::nullopt;
        move.by[i] = detail::to_int64(t.get_num());
    }
    // Splitting planes that are turned over are not where coordinates with fractions need them.
    if (std::ranges::min(move.sign) < 0) state = detail::without_tree(state);
    try {
        return detail::moved_state(*state, move);
    } catch (const LimitError&) {
        return std::nullopt;
    }
}

// Nothing where the moved solid would be larger than its lattice, unless it is unbounded.
std::optional<StatePtr> moved(StatePtr state, LatticeMove move, const Pose& pose,
                              LatticeReport& report) {
    const LatticeReport before = report;
    const bool is_bounded = state->far_out >= 0;
    state = refined_towards(state, wanted_lattice(*state, pose));
    report.lattice = state->lattice;
    mpq_class largest = 0;
    StatePtr out;
    try {
        for (std::size_t i = 0; i < 3; ++i) {
            const mpq_class t = in_units(translation_of(pose, i), state->lattice);
            move.by[i] = rounded(t);
            largest = std::max(largest, mpq_class(abs(t - mpq_class(detail::to_gmp(move.by[i])))));
        }
        out = detail::moved_state(*state, move);
    } catch (const LimitError&) {
        if (!is_bounded) throw;
        report = before;
        return std::nullopt;
    }
    report.lossless = largest == 0;
    report.max_move = size_of(largest, state->lattice);
    // Sets of half-spaces may have no mesh.
    if (!report.lossless && out->far_out >= 0)
        report.moved = detail::solid_of(out).to_exact_mesh().points.size();
    return out;
}

void check_finite(const Point3d& p) {
    for (const double c : p)
        if (!std::isfinite(c))
            throw LimitError("a transformed coordinate is beyond the largest double");
}

bool has_area(const Point3d& a, const Point3d& b, const Point3d& c) {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t u = (i + 1) % 3;
        const std::size_t v = (i + 2) % 3;
        const double normal = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
        square += normal * normal;
    }
    return square > 0;
}

// The nearest doubles, and how far they are from the exact points.
std::vector<Point3d> rounded_points(const ExactMesh& mesh, const MovedPoints& mover,
                                    LatticeReport& report) {
    std::vector<Point3d> points;
    points.reserve(mesh.points.size());
    mpq_class largest = 0;
    for (const Point& point : mesh.points) {
        const MovedPoints::Exact p = mover.exact(point);
        const Point3d& q = points.emplace_back(detail::to_doubles(p));
        check_finite(q);
        mpq_class move = 0;
        for (std::size_t i = 0; i < 3; ++i)
            move = std::max(move, mpq_class(abs(p[i] - mpq_class(q[i]))));
        if (move != 0) ++report.moved;
        largest = std::max(largest, move);
    }
    report.max_move = detail::to_doubles({largest, 0, 0})[0];
    report.lossless = report.moved == 0;
    return points;
}

PolygonMesh rounded_mesh(const ExactMesh& mesh, const Pose& pose, bool turn_over,
                         LatticeReport* report) {
    const MovedPoints mover(pose, mesh.lattice);
    PolygonMesh out;
    if (report != nullptr) {
        out.points = rounded_points(mesh, mover, *report);
    } else {
        out.points.reserve(mesh.points.size());
        for (const Point& p : mesh.points) check_finite(out.points.emplace_back(mover.nearest(p)));
    }
    for (const auto& t : mesh.triangles) {
        if (report != nullptr && !has_area(out.points[t[0]], out.points[t[1]], out.points[t[2]]))
            ++report->flipped_faces;
        out.add_triangle(t[0], t[turn_over ? 2 : 1], t[turn_over ? 1 : 2]);
    }
    return out;
}

// Names without repetition, and the number of each triangle's.
std::pair<std::vector<FaceSource>, std::vector<std::uint32_t>> numbered(
    const std::vector<FaceSource>& names) {
    std::pair<std::vector<FaceSource>, std::vector<std::uint32_t>> out;
    std::map<FaceSource, std::uint32_t> numbers;
    for (const FaceSource& n : names) {
        const auto [at, is_new] =
            numbers.try_emplace(n, static_cast<std::uint32_t>(out.first.size()));
        if (is_new) out.first.push_back(n);
        out.second.push_back(at->second);
    }
    return out;
}

// What is left of a solid after rounding, as a mesh.
struct RoundedSolid {
    LatticeMesh mesh;
    std::vector<FaceSource> names;
    bool t_edges = false;
    bool is_embedded = false;
};

StatePtr state_of(RoundedSolid made, std::uint32_t operand, bool is_complement) {
    auto state = std::make_shared<SolidState>();
    state->lattice = made.mesh.lattice;
    state->embedded = made.is_embedded;
    std::optional<std::vector<detail::FacetKind>> kinds;
    if (!made.is_embedded) kinds = detail::facet_kinds(made.mesh);
    auto source =
        detail::Source::named(detail::Source::make(std::move(made.mesh)), std::move(made.names));
    if (kinds) source = detail::Source::of_kinds(std::move(source), *std::move(kinds));
    state->form =
        detail::CellTree{{detail::uncut_root(*source, made.t_edges), is_complement}, {}, nullptr};
    state->whole = source->is_whole();
    state->source = operand != 0 ? operand : source->serial();
    state->far_out = is_complement ? 1 : 0;
    return state;
}

// Whether a vertex lies beside its rounded place.
bool is_rounded(const ExactMesh& exact, const Pose& pose, const PolygonMesh& there) {
    const MovedPoints mover(pose, exact.lattice);
    for (std::size_t v = 0; v < exact.points.size(); ++v) {
        const MovedPoints::Exact p = mover.exact(exact.points[v]);
        for (std::size_t i = 0; i < 3; ++i)
            if (p[i] != mpq_class(there.points[v][i])) return true;
    }
    return false;
}

// Nothing where no triangle is left.
// `origin`: of its triangles among those of the mesh before it.
std::optional<RoundedSolid> imported(const PolygonMesh& rounded,
                                     std::span<const std::uint32_t> origin, const ExactMesh& before,
                                     LatticeReport* report) {
    ImportedMesh made = import_mesh(rounded);
    // Where triangles that rounding made flat are gone, fronts and backs may be left. The sum over
    // the triangles is asked, not the boundary of the set: they may meet each other.
    if (made.mesh.triangles.empty() || (made.mesh.triangles.size() < before.triangles.size() &&
                                        exact_volume(made.mesh).sign() == 0))
        return std::nullopt;
    if (report != nullptr) {
        const LatticeReport& import = made.report.lattice;
        report->lattice = import.lattice;
        if (!import.lossless) {  // more than 126 bits
            report->lossless = false;
            report->moved = std::max(report->moved, import.moved);
            report->max_move += import.max_move;
        }
    }
    auto [names, number] = numbered(before.source);
    std::vector<std::uint32_t> faces;
    faces.reserve(made.mesh.triangles.size());
    for (std::uint32_t t = 0; t < made.mesh.triangles.size(); ++t)
        faces.push_back(number[origin[made.mesh.face_of(t)]]);
    made.mesh.face_of_triangle = std::move(faces);
    const bool embedded = is_embedded(made.mesh);
    // Corners of triangles that are gone lie inside edges of others.
    const bool t_edges = made.report.t_edges != 0;
    return RoundedSolid{std::move(made.mesh), std::move(names), t_edges, embedded};
}

StatePtr rounded(const Solid& solid, const Pose& pose, LatticeReport* report) {
    const SolidState& state = *detail::state_of(solid);
    const bool is_complement = state.far_out == 1;
    const ExactMesh mesh = solid.to_exact_mesh();
    if (state.far_out < 0 && exact_volume(mesh).sign() < 0)
        throw UnsupportedError("an unbounded set of half-spaces cannot be moved off the lattice");
    const bool turn_over = pose.is_mirror() != is_complement;
    const PolygonMesh there = rounded_mesh(mesh, pose, turn_over, report);
    std::vector<std::uint32_t> same(mesh.triangles.size());
    std::iota(same.begin(), same.end(), 0U);
    const LatticeReport before = report == nullptr ? LatticeReport() : *report;
    std::optional<RoundedSolid> out = imported(there, same, mesh, report);
    if (!out) throw Error(ErrorCode::InvalidSolid, "nothing is left of a transformed solid");
    const auto taken = [&](std::optional<RoundedSolid>& made) {
        return state_of(*std::move(made), solid.source_id(), is_complement);
    };
    // What was not rounded met itself before, and stays so.
    if (out->is_embedded || !is_rounded(mesh, pose, there)) return taken(out);
    // Thin triangles that were turned over meet their neighbours.
    for (const double units : {4.0, 16.0}) {
        const detail::ThickMesh thick = detail::thick_mesh(there, units * 0x1p-52);
        LatticeReport other = before;
        other.max_move += thick.move;
        std::optional<RoundedSolid> embedded = imported(thick.mesh, thick.origin, mesh, &other);
        if (!embedded || !embedded->is_embedded) continue;
        if (report != nullptr) *report = other;
        return taken(embedded);
    }
    return taken(out);
}

}  // namespace

Solid transformed(const Solid& solid, const Pose& pose, LatticeReport* report) {
    LatticeReport made;
    made.lattice = solid.lattice();
    Solid out = solid;
    if (detail::state_of(solid)->lattice_matters && !(pose == Pose())) {
        std::optional<StatePtr> there;
        // Others are rounded from a mesh, which takes no tree.
        if (const auto permutation = permutation_of(pose)) {
            const StatePtr state = detail::cut_state(solid);
            there = state->whole ? moved(state, *permutation, pose, made)
                                 : moved_with_fractions(state, *permutation, pose);
        }
        out = detail::solid_of(there ? *there
                                     : rounded(solid, pose, report == nullptr ? nullptr : &made));
    }
    if (report != nullptr) *report = made;
    return out;
}

Solid transformed(const Solid& solid, const AffineMap& map, LatticeReport* report) {
    std::array<double, 12> rows{};
    for (std::size_t i = 0; i < 12; ++i) rows[i] = map.rows[i / 4][i % 4];
    return transformed(solid, Pose::from_doubles(rows), report);
}

PolygonMesh transformed_mesh(const ExactMesh& mesh, const AffineMap& map) {
    std::array<double, 12> rows{};
    for (std::size_t i = 0; i < 12; ++i) rows[i] = map.rows[i / 4][i % 4];
    const Pose pose = Pose::from_doubles(rows);
    return rounded_mesh(mesh, pose, pose.is_mirror(), nullptr);
}

}  // namespace trisect
