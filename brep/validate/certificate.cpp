// SPDX-License-Identifier: Apache-2.0
//
// The check reads the result as the next program will: points of equal value are one vertex, and
// only coordinates and corners count. A mesh of triangles that is plainly manifold is checked over
// its neighbours (manifold_mesh.h), any other one is validated. How far a vertex moved is the exact
// difference between the point and the written double, a rational that is rounded once.
#include <trisect/brep/certificate.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/import/own_lattice.h>
#include <trisect/brep/import/weld_points.h>
#include <trisect/brep/measure/exact_values.h>
#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/brep/validate/checked_mesh.h>
#include <trisect/brep/validate/manifold_mesh.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/nearest_float.h>

namespace trisect {
namespace {

/// How far written coordinates are from the exact ones: number and largest distance of one
/// coordinate. Distances stay fractions that are not reduced; only the largest one is.
class Moves {
public:
    explicit Moves(Lattice lattice) : exponent_(lattice.exponent) {}

    void add(const Point& exact, const Point3d& written) {
        const HomogeneousPoint h = exact.homogeneous();
        const mpz_class w = detail::to_integer(h.w);
        bool moved = false;
        for (std::size_t axis = 0; axis < 3; ++axis)
            moved = add(detail::to_integer(h.xyz[axis]), w, written[axis]) || moved;
        count_ += moved ? 1 : 0;
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] double largest() const {
        if (count_ == 0) return 0;
        return detail::to_rational(distance_, weight_).scaled(scale_).to_double();
    }

private:
    // The coordinate is x / w units; written is a whole number times a power of two as well. Their
    // distance is distance / |w| · 2^scale. True if it is not 0.
    bool add(const mpz_class& x, const mpz_class& w, double written) {
        int written_exponent = 0;
        const mpz_class digits(std::ldexp(std::frexp(written, &written_exponent), 53));
        written_exponent -= 53;
        const int scale = std::min(exponent_, written_exponent);
        mpz_class distance = x << static_cast<unsigned long>(exponent_ - scale);
        distance -= (digits * w) << static_cast<unsigned long>(written_exponent - scale);
        if (distance == 0) return false;
        keep_larger(abs(distance), abs(w), scale);
        return true;
    }

    void keep_larger(mpz_class distance, mpz_class weight, int scale) {
        const double estimate = estimate_of(distance, weight, scale);
        // Estimates are good to some 2^-51; those below the range of doubles are compared.
        if (estimate < estimate_ * (1 - 0x1p-45) && estimate_ > 0x1p-1000) return;
        const int both = std::min(scale, scale_);
        const mpz_class mine = (distance * weight_) << static_cast<unsigned long>(scale - both);
        const mpz_class other = (distance_ * weight) << static_cast<unsigned long>(scale_ - both);
        if (mine <= other) return;
        distance_ = std::move(distance);
        weight_ = std::move(weight);
        scale_ = scale;
        estimate_ = estimate;
    }

    static double estimate_of(const mpz_class& distance, const mpz_class& weight, int scale) {
        long a = 0;
        long b = 0;
        const double quotient =
            mpz_get_d_2exp(&a, distance.get_mpz_t()) / mpz_get_d_2exp(&b, weight.get_mpz_t());
        return std::ldexp(quotient, static_cast<int>(a - b) + scale);
    }

    int exponent_;
    std::size_t count_ = 0;
    mpz_class distance_ = 0;  // of the largest one, over weight_, times 2^scale_
    mpz_class weight_ = 1;
    int scale_ = 0;
    double estimate_ = 0;
};

/// Lattice points are doubles: only other points, and floats, can have moved.
bool cannot_have_moved(const Point& exact, Lattice lattice, const Point3d& written) {
    if (!exact.is_lattice()) return false;
    return to_user(exact.lattice(), lattice) == written && lattice.exponent > -1000;
}

void measure_moves(std::span<const Point> exact, Lattice lattice, const PolygonMesh& written,
                   Certificate& out) {
    Moves moves(lattice);
    for (std::size_t v = 0; v < exact.size(); ++v)
        if (!cannot_have_moved(exact[v], lattice, written.points[v]))
            moves.add(exact[v], written.points[v]);
    out.rounded_vertices = moves.count();
    out.max_move = moves.largest();
}

void round_to_floats(PolygonMesh& mesh) {
    for (Point3d& p : mesh.points) {
        for (double& c : p) c = detail::nearest_float(c);
    }
}

Certificate certify_rounded(std::span<const Point> exact, Lattice lattice, PolygonMesh mesh,
                            Precision precision) {
    if (precision == Precision::Float) round_to_floats(mesh);
    Certificate out = certify(mesh);
    measure_moves(exact, lattice, mesh, out);
    return out;
}

ValidationReport checked(const PolygonMesh& mesh, bool self_intersection) {
    ValidateOptions options;
    options.list_limit = 0;
    options.self_intersection = self_intersection;
    return detail::validate_as_written(mesh, options, Fractions::Kept);
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
        detail::check_stop(0);  // a limit of the caller's is no answer
        return std::nullopt;
    }
}

/// `pairs` are not counted where the lattice rounds once more: the answer would be about another
/// mesh.
template <class Count>
void count_pairs(bool lossless, const Count& pairs, Certificate& out) {
    if (lossless) out.self_intersecting_pairs = pairs();
    if (!out.self_intersecting_pairs) out.undecided = lossless ? Undecided::Work : Undecided::Span;
}

Certificate validated(const PolygonMesh& mesh) {
    Certificate out;
    const ValidationReport topology = checked(mesh, false);
    const auto has_none = [&](DefectKind kind) { return topology.count(kind) == 0; };
    out.closed = has_none(DefectKind::OpenEdge);
    out.oriented = out.closed && has_none(DefectKind::FlippedFace) &&
                   has_none(DefectKind::InsideOutShell) && has_none(DefectKind::ShellNesting);
    count_pairs(
        topology.lattice().lossless, [&] { return self_intersecting_pairs(mesh); }, out);
    return out;
}

std::optional<std::vector<detail::ManifoldMesh::Triangle>> triangles_of(const PolygonMesh& mesh) {
    std::vector<detail::ManifoldMesh::Triangle> out;
    out.reserve(mesh.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        if (face.size() != 3 || std::ranges::max(face) >= mesh.points.size()) return std::nullopt;
        out.push_back({face[0], face[1], face[2]});
    }
    return out;
}

/// The same answer over the neighbours of triangles, or nothing.
std::optional<Certificate> certified_manifold(const PolygonMesh& mesh) {
    const auto triangles = triangles_of(mesh);
    if (!triangles) return std::nullopt;
    LatticeReport lattice;
    std::vector<LatticePoint> points =
        detail::points_on_lattice(mesh.points, std::nullopt, Fractions::Kept, lattice);
    if (!detail::weld_in_place(points, points.size()).empty()) return std::nullopt;
    const auto manifold = detail::ManifoldMesh::of(points, *triangles);
    if (!manifold) return std::nullopt;
    const std::optional<bool> nested = manifold->are_shells_nested();
    if (!nested) return std::nullopt;
    Certificate out;
    out.closed = true;
    out.oriented = *nested;
    if (lattice.lossless && manifold->has_no_contact() != true) return std::nullopt;
    count_pairs(
        lattice.lossless, [] { return std::optional<std::size_t>(0); }, out);
    return out;
}

}  // namespace

Certificate certify(const PolygonMesh& mesh) {
    const std::optional<Certificate> quick = certified_manifold(mesh);
    return quick ? *quick : validated(mesh);
}

Certificate certify(const Brep& brep, PolygonMesh mesh, Precision precision) {
    return certify_rounded(brep.points(), brep.lattice(), std::move(mesh), precision);
}

Certificate certify(const ExactMesh& exact, PolygonMesh mesh, Precision precision) {
    return certify_rounded(exact.points, exact.lattice, std::move(mesh), precision);
}

}  // namespace trisect
