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
// Touching is another matter. Where an edge of the exact solid lies in a face of it, rounding makes
// them cross or come apart, and no grid helps. There the face is divided, so that it shares the
// edge.
//
// Bound: moving the corners of a triangle by d at most moves each of its points by d at most. A
// point that is farther from the boundary than it moves is not crossed by it on the way, so its
// winding number stays. Resolving a boundary keeps the set of positive winding numbers. The moves
// of all rounds add up.

#include <trisect/bsp/certified_rounding.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/verify/contact_insertion.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/lattice.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect {

namespace {

using Outcome = CertifiedRounding::Outcome;

// Faces are divided at one place in each pass.
constexpr std::size_t max_passes = 16;

// Twice the distance of doubles at the largest coordinate; rounding may take that up to the next
// power of two, which is 2^52 units. Floats are so much farther apart that a finer unit only takes
// rounds: 2^45 units.
std::optional<int> exponent_for(const PolygonMesh& mesh, Precision precision) {
    double largest = 0;
    for (const Point3d& p : mesh.points)
        for (const double c : p) largest = std::max(largest, std::abs(c));
    if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
    const int bits = std::ilogb(largest * (1 + 0x1p-30)) + 1;
    return bits -
           (precision == Precision::Float ? coordinate_bits - growth_bits : coordinate_bits - 1);
}

double snapped(double value, double unit) { return std::nearbyint(value / unit) * unit; }

double rounded(double value, double unit, Precision precision) {
    // A float of many units is a multiple of the unit already, a small multiple of it is a float.
    if (precision == Precision::Float) value = static_cast<double>(static_cast<float>(value));
    return snapped(value, unit);
}

// Sums of doubles, rounded up.
double sum_up(double a, double b) {
    return b == 0 ? a : std::nextafter(a + b, std::numeric_limits<double>::infinity());
}

class Rounding {
public:
    Rounding(const Brep& brep, const RoundingOptions& options) : brep_(brep), options_(options) {}

    CertifiedRounding run() {
        result_.mesh = to_polygon_mesh(brep_);
        if (take(brep_, Outcome::Plain)) return std::move(result_);
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
            for (Point3d& p : result_.mesh.points)
                for (double& c : p) c = static_cast<double>(static_cast<float>(c));
        if (!plain) radius_ = sum_up(radius_, result_.certificate.max_move);
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

    // Without self-intersections where there are too many to list.
    [[nodiscard]] ValidationReport defects() const {
        ValidateOptions validation;
        validation.list_limit = std::size_t{1} << 20U;
        validation.lattice = lattice_;
        try {
            return validate(result_.mesh, validation);
        } catch (const LimitError&) {
            validation.self_intersection = false;
            return validate(result_.mesh, validation);
        }
    }

    // Divides faces where they touch each other, as long as that helps.
    bool conform() {
        // Both faces have moved.
        const double reach = 4 * (result_.unit + result_.certificate.max_move);
        const Certificate moves = result_.certificate;
        std::size_t least = std::numeric_limits<std::size_t>::max();
        for (std::size_t pass = 0; pass < max_passes; ++pass) {
            const ValidationReport report = defects();
            const std::size_t pairs = report.count(DefectKind::SelfIntersection);
            if (pass == 0 && result_.rounds == 0) result_.first_pairs = pairs;
            if (pass > 0 && pairs > 4 * least + 16) return false;
            least = std::min(least, pairs);
            detail::ContactInsertion insertion(result_.mesh, reach, [this](const Point3d& p) {
                Point3d r = p;
                for (double& c : r) c = rounded(c, result_.unit, options_.precision);
                return r;
            });
            for (const Defect& d : report.defects())
                if (d.faces.size() == 2 &&
                    (d.kind == DefectKind::SelfIntersection || d.kind == DefectKind::FacesTouch))
                    insertion.add(d.faces[0], d.faces[1]);
            if (insertion.is_empty()) return false;
            result_.mesh = insertion.divided();
            // Its distances are doubles' ones.
            radius_ = sum_up(radius_, insertion.largest_move() * (1 + 0x1p-20) + result_.unit);
            result_.radius = radius_;
            result_.certificate = certify(result_.mesh);
            result_.certificate.max_move = moves.max_move;
            result_.certificate.rounded_vertices = moves.rounded_vertices;
            if (!result_.certificate.holds()) continue;
            result_.outcome = Outcome::Repaired;
            return true;
        }
        return false;
    }

    // Points of faces that meet.
    std::set<std::uint32_t> hot_points() {
        const ValidationReport report = defects();
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
        radius_ = sum_up(radius_, most);
    }

    const Brep& brep_;
    const RoundingOptions& options_;
    Lattice lattice_;
    double radius_ = 0;
    CertifiedRounding result_;
};

}  // namespace

CertifiedRounding certified_rounding(const Brep& brep, const RoundingOptions& options) {
    return Rounding(brep, options).run();
}

}  // namespace trisect
