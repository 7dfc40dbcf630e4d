// SPDX-License-Identifier: Apache-2.0
//
// Iterated local snap rounding.
//
// Rounding moves vertices, and faces that were closer than that may meet. To resolve the
// intersections exactly and to round again mostly removes them, but not always: the new corners are
// as near to each other as the old faces were. Around them the surface must become coarser. So the
// corners of faces that meet are put on a grid that grows from round to round; what is thinner than
// its cells collapses, and what is left crosses at angles that rounding does not destroy (Valque
// and Lazard 2025; Zhou, Grinspun, Zorin and Jacobson 2016).
//
// Thin triangles, which rounding turns over, are given up first: that mends most results of
// programs that users wrote. Touching is another matter. Where an edge of the exact solid lies in a
// face of it, rounding makes them cross or come apart, and no grid helps. There the face is
// divided, so that it shares the edge.
//
// Bound: moving the corners of a triangle by d at most moves each of its points by d at most. A
// point that is farther from the boundary than it moves is not crossed by it on the way, so its
// winding number stays. Resolving a boundary keeps the set of positive winding numbers. The moves
// of all rounds add up.

#include <trisect/bsp/certified_rounding.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/import/thin_triangles.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/verify/contact_division.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/support/nearest_float.h>

namespace trisect {

namespace {

using Outcome = CertifiedRounding::Outcome;

// More pairs of faces that meet are no contacts, but a mesh that rounding has ruined.
constexpr std::size_t most_contacts = 4096;

double largest_coordinate(const PolygonMesh& mesh) {
    double largest = 0;
    for (const Point3d& p : mesh.points)
        for (const double c : p) largest = std::max(largest, std::abs(c));
    return largest;
}

// Twice the distance of doubles at the largest coordinate; rounding may take that up to the next
// power of two, which is 2^52 units. Floats are so much farther apart that a finer unit only takes
// rounds: 2^45 units.
std::optional<int> exponent_for(const PolygonMesh& mesh, Precision precision) {
    const double largest = largest_coordinate(mesh);
    if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
    const int bits = std::ilogb(largest * (1 + 0x1p-30)) + 1;
    return bits -
           (precision == Precision::Float ? coordinate_bits - growth_bits : coordinate_bits - 1);
}

double snapped(double value, double unit) { return std::nearbyint(value / unit) * unit; }

double rounded(double value, double unit, Precision precision) {
    // A float of many units is a multiple of the unit already, a small multiple of it is a float.
    if (precision == Precision::Float) value = detail::nearest_float(value);
    return snapped(value, unit);
}

// The coordinates of floats as doubles.
void to_floats(PolygonMesh& mesh) {
    for (Point3d& p : mesh.points)
        for (double& c : p) c = detail::nearest_float(c);
}

// How far apart an edge and the face that it lies in may be after rounding: both have moved, and
// distances are taken in doubles.
double reach_of(const PolygonMesh& mesh, double max_move) {
    return 4 * std::max(max_move, largest_coordinate(mesh) * 0x1p-52);
}

// Triangles thinner than so many units in the last place given up, whether that mends all or not.
std::optional<MendedRounding> without_thin(const PolygonMesh& mesh, const Certificate& before,
                                           Precision precision, double units) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face(f).size() != 3) return std::nullopt;
    PolygonMesh plain = mesh;
    if (precision == Precision::Float) to_floats(plain);
    const double place = precision == Precision::Float ? 0x1p-23 : 0x1p-52;
    detail::ThickMesh thick = detail::thick_mesh(plain, units * place);
    MendedRounding out;
    out.mesh = std::move(thick.mesh);
    out.parents = std::move(thick.origin);
    out.certificate = certify(out.mesh);
    out.certificate.max_move = detail::sum_up(before.max_move, thick.move);
    out.certificate.rounded_vertices = before.rounded_vertices;
    out.radius = detail::sum_up(out.certificate.max_move, thick.reach);
    out.gave_thin_up = true;
    return out;
}

class Rounding {
public:
    Rounding(const Brep& brep, const RoundingOptions& options) : brep_(brep), options_(options) {}

    CertifiedRounding run() {
        result_.mesh = to_polygon_mesh(brep_);
        if (take(brep_, Outcome::Plain) || conform_plain()) return std::move(result_);
        const std::optional<int> exponent = exponent_for(result_.mesh, options_.precision);
        if (!exponent) return std::move(result_);
        lattice_.exponent = *exponent;
        result_.unit = std::ldexp(1.0, lattice_.exponent);
        put_on_grid();
        if (take(brep_, Outcome::Gridded) || conform()) return std::move(result_);
        while (result_.rounds < options_.max_rounds) {
            if (resolve()) return std::move(result_);
        }
        return std::move(result_);
    }

private:
    // Certifies the mesh as a rounding of an exact boundary; true if that is proved.
    bool take(const Brep& exact, Outcome outcome) {
        const bool plain = outcome == Outcome::Plain;
        result_.certificate = certify(exact, result_.mesh, options_.precision);
        if (plain && options_.precision == Precision::Float && result_.certificate.holds())
            to_floats(result_.mesh);
        if (!plain) radius_ = detail::sum_up(radius_, result_.certificate.max_move);
        const bool holds = result_.certificate.holds();
        if (holds) result_.outcome = outcome;
        result_.radius = plain ? result_.certificate.max_move : radius_;
        return holds;
    }

    void put_on_grid() {
        for (Point3d& p : result_.mesh.points)
            for (double& c : p) c = rounded(c, result_.unit, options_.precision);
    }

    bool resolve() {
        const std::set<std::uint32_t> hot = hot_points();
        if (result_.rounds > 0) snap(hot);
        ++result_.rounds;
        SolidOptions import;
        import.import.lattice = lattice_;
        import.embedding = Embedding::Resolve;
        const Brep exact =
            evaluate(Expression(Solid::from_mesh(result_.mesh, import)), options_.evaluate)
                .to_brep();
        result_.mesh = to_polygon_mesh(exact);
        put_on_grid();
        return take(exact, Outcome::Repaired) || conform();
    }

    // Divides faces where they touch each other, as long as that helps.
    bool conform() {
        // Both faces have moved.
        const double reach = 4 * (result_.unit + result_.certificate.max_move);
        const Certificate moves = result_.certificate;
        detail::ContactDivision division(std::move(result_.mesh), result_.unit, lattice_,
                                         [this](const Point3d& p) {
                                             Point3d r = p;
                                             for (double& c : r)
                                                 c = rounded(c, result_.unit, options_.precision);
                                             return r;
                                         });
        const bool holds = division.run(reach);
        if (result_.rounds == 0) result_.first_pairs = division.first_pairs;
        result_.mesh = std::move(division.mesh);
        if (!division.certificate) return false;
        radius_ = detail::sum_up(radius_, division.moved);
        result_.radius = radius_;
        result_.certificate = *division.certificate;
        result_.certificate.max_move = moves.max_move;
        result_.certificate.rounded_vertices = moves.rounded_vertices;
        if (holds) result_.outcome = Outcome::Repaired;
        return holds;
    }

    // The same with the nearest doubles, or floats, as they are.
    bool conform_plain() {
        std::optional<MendedRounding> divided =
            mended_rounding(result_.mesh, result_.certificate, options_.precision);
        if (!divided) return false;
        result_.first_pairs = result_.certificate.self_intersecting_pairs.value_or(0);
        result_.mesh = std::move(divided->mesh);
        result_.certificate = divided->certificate;
        result_.radius = divided->radius;
        result_.outcome = Outcome::Repaired;
        return true;
    }

    // Points of faces that meet.
    std::set<std::uint32_t> hot_points() {
        const ValidationReport report = detail::listed_defects(result_.mesh, lattice_);
        std::set<std::uint32_t> hot;
        for (const Defect& d : report.defects()) {
            if (d.severity() != Severity::Error) continue;
            for (const std::uint32_t f : d.faces)
                for (const std::uint32_t v : result_.mesh.face(f)) hot.insert(v);
        }
        return hot;
    }

    // Points of equal value move together.
    void snap(const std::set<std::uint32_t>& hot) {
        const double grid = std::ldexp(result_.unit, 2 * static_cast<int>(result_.rounds));
        std::set<Point3d> places;
        for (const std::uint32_t v : hot) places.insert(result_.mesh.points[v]);
        double most = 0;
        for (Point3d& p : result_.mesh.points) {
            if (!places.contains(p)) continue;
            bool moved = false;
            for (double& c : p) {
                const double to = rounded(snapped(c, grid), result_.unit, options_.precision);
                most = std::max(most, std::abs(to - c));  // exact: multiples of the unit
                moved = moved || to != c;
                c = to;
            }
            result_.snapped_vertices += moved ? 1 : 0;
        }
        radius_ = detail::sum_up(radius_, most);
    }

    const Brep& brep_;
    const RoundingOptions& options_;
    Lattice lattice_;
    double radius_ = 0;
    CertifiedRounding result_;
};

}  // namespace

std::optional<MendedRounding> divided_at_contacts(const PolygonMesh& mesh,
                                                  const Certificate& certificate,
                                                  Precision precision) {
    const std::size_t pairs = certificate.self_intersecting_pairs.value_or(0);
    if (!certificate.closed || pairs == 0 || pairs > most_contacts) return std::nullopt;
    PolygonMesh plain = mesh;
    if (precision == Precision::Float) to_floats(plain);
    const double reach = reach_of(plain, certificate.max_move);
    detail::ContactDivision division(std::move(plain), 0, std::nullopt, [&](const Point3d& p) {
        Point3d r = p;
        if (precision == Precision::Float)
            for (double& c : r) c = detail::nearest_float(c);
        return r;
    });
    if (!division.run(reach)) return std::nullopt;
    MendedRounding out;
    out.mesh = std::move(division.mesh);
    out.parents = std::move(division.parents);
    out.certificate = *division.certificate;
    out.certificate.max_move = certificate.max_move;
    out.certificate.rounded_vertices = certificate.rounded_vertices;
    out.radius = detail::sum_up(certificate.max_move, division.moved);
    out.divided = out.mesh.face_count() - mesh.face_count();
    return out;
}

std::optional<MendedRounding> mended_rounding(const PolygonMesh& mesh,
                                              const Certificate& certificate, Precision precision) {
    if (!certificate.closed || certificate.self_intersecting_pairs.value_or(0) == 0)
        return std::nullopt;
    std::optional<MendedRounding> thick;
    for (const double units : {4.0, 16.0}) {
        thick = without_thin(mesh, certificate, precision, units);
        if (!thick) break;
        if (thick->certificate.holds()) return thick;
    }
    if (auto divided = divided_at_contacts(mesh, certificate, precision)) return divided;
    if (!thick) return std::nullopt;
    auto both = divided_at_contacts(thick->mesh, thick->certificate, precision);
    if (!both) return std::nullopt;
    both->radius = detail::sum_up(both->radius, thick->radius);
    both->gave_thin_up = true;
    for (std::uint32_t& parent : both->parents) parent = thick->parents[parent];
    return both;
}

CertifiedRounding certified_rounding(const Brep& brep, const RoundingOptions& options) {
    return Rounding(brep, options).run();
}

}  // namespace trisect
