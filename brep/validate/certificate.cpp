// SPDX-License-Identifier: Apache-2.0
//
// The check reads the result as the next program will: points of equal value are one vertex, and
// nothing is known but coordinates and corners. How far a vertex moved is the exact difference
// between the point and the written double, a rational that is rounded once.
#include <trisect/brep/certificate.h>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

ExactRational absolute(const ExactRational& value) { return value.sign() < 0 ? -value : value; }

/// How far the written point is from the exact one, along the axis where that is most.
ExactRational move_of(const Point& exact, Lattice lattice, const Point3d& written) {
    const HomogeneousPoint h = exact.homogeneous();
    const ExactRational w(h.w);
    ExactRational most;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const ExactRational x = (ExactRational(h.xyz[axis]) / w).scaled(lattice.exponent);
        const ExactRational move = absolute(x - ExactRational::from_double(written[axis]));
        if (move > most) most = move;
    }
    return most;
}

/// Lattice points are doubles: only other points, and floats, can have moved.
bool cannot_have_moved(const Point& exact, Lattice lattice, const Point3d& written) {
    if (!exact.is_lattice()) return false;
    return to_user(exact.lattice(), lattice) == written && lattice.exponent > -1000;
}

void measure_moves(const Brep& brep, const PolygonMesh& written, Certificate& out) {
    ExactRational most;
    for (const VertexId v : brep.vertices()) {
        const Point3d& point = written.points[v.index];
        if (cannot_have_moved(brep.point(v), brep.lattice(), point)) continue;
        const ExactRational move = move_of(brep.point(v), brep.lattice(), point);
        if (move.sign() == 0) continue;
        ++out.rounded_vertices;
        if (move > most) most = move;
    }
    out.max_move = most.to_double();
}

void round_to_floats(PolygonMesh& mesh) {
    for (Point3d& p : mesh.points) {
        for (double& c : p) c = static_cast<double>(static_cast<float>(c));
    }
}

ValidationReport checked(const PolygonMesh& mesh, bool self_intersection) {
    ValidateOptions options;
    options.list_limit = 0;
    options.self_intersection = self_intersection;
    return validate(mesh, options);
}

/// Nothing when the work would go beyond the limit of validation. Walls that collapsed are pairs
/// of faces with the same corners, which validation counts by themselves.
std::optional<std::size_t> self_intersecting_pairs(const PolygonMesh& mesh) {
    try {
        const ValidationReport report = checked(mesh, true);
        return report.count(DefectKind::SelfIntersection) +
               report.count(DefectKind::DuplicateFace) +
               report.count(DefectKind::DuplicateOppositeFaces);
    } catch (const LimitError&) {
        return std::nullopt;
    }
}

}  // namespace

Certificate certify(const PolygonMesh& mesh) {
    Certificate out;
    const ValidationReport topology = checked(mesh, false);
    const auto has_none = [&](DefectKind kind) { return topology.count(kind) == 0; };
    out.closed = has_none(DefectKind::OpenEdge);
    out.oriented = out.closed && has_none(DefectKind::FlippedFace) &&
                   has_none(DefectKind::InsideOutShell) && has_none(DefectKind::ShellNesting);
    // On a lattice that rounds once more the answer would be about another mesh.
    if (topology.lattice().lossless) out.self_intersecting_pairs = self_intersecting_pairs(mesh);
    if (!out.self_intersecting_pairs)
        out.undecided = topology.lattice().lossless ? Undecided::Work : Undecided::Span;
    return out;
}

Certificate certify(const Brep& brep, PolygonMesh mesh, Precision precision) {
    if (precision == Precision::Float) round_to_floats(mesh);
    Certificate out = certify(mesh);
    measure_moves(brep, mesh, out);
    return out;
}

}  // namespace trisect
