// SPDX-License-Identifier: Apache-2.0
//
// The proofs are in the header. What is found here is found by the engine: the symmetric difference
// D as one expression, its reach from both boundaries (bsp/verify/difference_radius.h), and a point
// in it. What is said about that point is then worked out anew from the definition.
//
// Comparing volumes, the usual check, misses what cancels and what is thin, and a distance between
// surfaces alone misses a missing inside: a box with a double skin has the same surface as a full
// one.
#include <trisect/bsp/verify.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure/grid_distance.h>
#include <trisect/bsp/verify/corner_match.h>
#include <trisect/bsp/verify/difference_radius.h>
#include <trisect/bsp/verify/difference_witness.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/infinity.h>

namespace trisect {

namespace {

using detail::GridTriangle;
using detail::GridTriangles;
using detail::infinity;

/// The finest that holds the largest coordinate: cuts through its points come close to every edge.
Lattice common_lattice(std::span<const PolygonMesh> operands, const PolygonMesh& result) {
    std::vector<Point3d> all;
    for (const PolygonMesh& m : operands) all.insert(all.end(), m.points.begin(), m.points.end());
    all.insert(all.end(), result.points.begin(), result.points.end());
    double most = 0;
    for (const Point3d& p : all)
        for (const double c : p) most = std::max(most, std::fabs(c));
    int exponent = choose_lattice(all).exponent;
    if (most == 0) return {exponent};
    while (exponent > -1000 && most < std::ldexp(1.0, coordinate_bits - 1 + exponent - 8))
        exponent -= 8;
    return {exponent};
}

// Rounded to whole coordinates.
ImportedMesh rounded(const PolygonMesh& mesh, Lattice lattice) {
    ImportOptions options;
    options.lattice = lattice;
    options.require_closed = false;
    return import_mesh(mesh, options);
}

// With all digits of its own lattice where this one holds them behind the point.
ImportedMesh placed(const PolygonMesh& mesh, Lattice lattice) {
    ImportOptions options;
    options.require_closed = false;
    ImportedMesh out = import_mesh(mesh, options);
    const double factor = std::ldexp(1.0, out.mesh.lattice.exponent - lattice.exponent);
    for (LatticePoint& p : out.mesh.points) {
        const std::array<double, 3> c{p.x.to_double() * factor, p.y.to_double() * factor,
                                      p.z.to_double() * factor};
        for (const double v : c)
            if (std::fabs(v) >= static_cast<double>(coordinate_limit) ||
                (v != 0 && detail::dyadic(v).exponent < -fraction_limit))
                return rounded(mesh, lattice);
        p = {Coordinate(c[0]), Coordinate(c[1]), Coordinate(c[2])};
    }
    out.mesh.lattice = lattice;
    return out;
}

GridTriangles grid_triangles_of(const LatticeMesh& mesh) {
    std::vector<GridTriangle> out;
    out.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles)
        out.emplace_back(detail::to_grid(mesh.points[t[0]]), detail::to_grid(mesh.points[t[1]]),
                         detail::to_grid(mesh.points[t[2]]));
    return GridTriangles(std::move(out));
}

class Verification {
public:
    Verification(BooleanOperation operation, std::span<const PolygonMesh> operands,
                 const PolygonMesh& result, const VerifyOptions& options)
        : operation_(operation), options_(options) {
        lattice_ = options.lattice ? *options.lattice : common_lattice(operands, result);
        unit_ = std::ldexp(1.0, lattice_.exponent);
        for (const PolygonMesh& m : operands) place_operand(m);
        place(result);
        report_.lattice = lattice_;
    }

    VerifyReport run() {
        const ImportReport& import = imports_.back().report;
        report_.result_inside_out = import.inside_out;
        if (!import.closed) {
            report_.verdict = Verdict::NotClosed;
            report_.result_defects = import.defects;
            forget_radius();
            return std::move(report_);
        }
        for (const ImportedMesh& m : imports_)
            solids_.push_back(Solid::from_lattice_mesh(m.mesh, Embedding::Resolve));
        const auto operands = std::span(solids_).first(solids_.size() - 1);
        const Expression exact = expression_of(operation_, operands);
        const Solid difference = evaluate(exact ^ solids_.back(), options_.evaluate);
        if (difference.is_empty()) return std::move(report_);
        const Solid exact_set = evaluate(exact, options_.evaluate);
        exact_brep_ = exact_set.to_brep();
        exact_ = detail::boundary_triangles(exact_brep_);
        result_ = grid_triangles_of(imports_.back().mesh);
        judge(difference);
        return std::move(report_);
    }

private:
    void place(const PolygonMesh& mesh) {
        imports_.push_back(options_.lattice ? rounded(mesh, lattice_) : placed(mesh, lattice_));
        report_.moved.push_back(imports_.back().report.lattice.max_move);
    }
    void place_operand(const PolygonMesh& mesh) {
        place(mesh);
        const ImportReport& report = imports_.back().report;
        const std::string name = "operand " + std::to_string(imports_.size());
        if (!report.closed)
            throw InvalidSolid(report.defects, name + ": the boundary is not closed");
        if (report.inside_out)
            throw InvalidSolid(report.defects, name + ": the boundary is inside out");
    }
    void forget_radius() {
        report_.lower = report_.upper = std::numeric_limits<double>::quiet_NaN();
    }

    void judge(const Solid& difference) {
        detail::DifferenceRadius radius;
        if (exact_->triangles.empty() || result_->empty()) {
            radius.lower = radius.upper = infinity;
            radius.piece = std::make_shared<Brep>(difference.to_brep());
            radius.vertex = VertexId(0);
            radius.components = radius.piece->counts().shells;
        } else {
            detail::RadiusOptions options;
            if (options_.within) options.within = *options_.within / unit_;
            options.evaluate = options_.evaluate;
            options.piece_limit = options_.piece_limit;
            options.match_corners = [this](double reach) {
                return detail::matched_corners(exact_brep_, *exact_, imports_.back().mesh, reach);
            };
            radius = detail::difference_radius(difference, exact_->triangles, *result_, options);
        }
        report_.lower = radius.lower * unit_;
        report_.upper = radius.upper * unit_;
        report_.pieces = radius.pieces;
        report_.components = radius.components;
        report_.failed_cuts = radius.failed_cuts;
        const double within = options_.within.value_or(0);
        if (report_.upper <= within) {
            report_.verdict = Verdict::Within;
            return;
        }
        report_.verdict = Verdict::Undecided;
        if (within > 0 && !(report_.lower > within)) return;
        const detail::WitnessQuestion question{operation_, options_,     lattice_,
                                               imports_,   solids_,      exact_->triangles,
                                               *result_,   report_.moved};
        report_.witness = detail::find_witness(question, radius);
        if (report_.witness) report_.verdict = Verdict::Different;
    }

    const BooleanOperation operation_;
    const VerifyOptions& options_;
    Lattice lattice_;
    double unit_ = 1;
    std::vector<ImportedMesh> imports_;  ///< the operands and RESULT
    std::vector<Solid> solids_;          ///< the same
    Brep exact_brep_;
    std::optional<detail::BoundaryTriangles> exact_;
    std::optional<GridTriangles> result_;
    VerifyReport report_;
};

}  // namespace

const char* to_string(BooleanOperation operation) {
    switch (operation) {
        case BooleanOperation::Union:
            return "union";
        case BooleanOperation::Intersection:
            return "intersection";
        case BooleanOperation::Difference:
            return "difference";
        default:
            return "xor";
    }
}

const char* to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::Equal:
            return "equal";
        case Verdict::Within:
            return "within";
        case Verdict::Different:
            return "different";
        case Verdict::Undecided:
            return "undecided";
        default:
            return "not_closed";
    }
}

Expression expression_of(BooleanOperation operation, std::span<const Solid> operands) {
    const std::vector<Expression> terms(operands.begin(), operands.end());
    if (terms.size() == 1) return terms.front();
    switch (operation) {
        case BooleanOperation::Union:
            return Expression::any_of(terms);
        case BooleanOperation::Intersection:
            return Expression::all_of(terms);
        case BooleanOperation::Difference:
            return terms.front() - Expression::any_of(std::span(terms).subspan(1));
        default:
            break;
    }
    Expression sum = terms.front();
    for (std::size_t i = 1; i < terms.size(); ++i) sum = sum ^ terms[i];
    return sum;
}

VerifyReport verify(BooleanOperation operation, std::span<const PolygonMesh> operands,
                    const PolygonMesh& result, const VerifyOptions& options) {
    if (operands.empty()) throw UsageError("verify: there is no operand");
    if (options.within && !(*options.within >= 0))
        throw UsageError("verify: the distance must not be negative");
    return Verification(operation, operands, result, options).run();
}

}  // namespace trisect
