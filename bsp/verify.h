// SPDX-License-Identifier: Apache-2.0
//
// verify: certified comparison of a mesh with the result of a boolean.
// The mesh may come from any kernel. The answer is a certificate: equal, equal within a stated
// distance, or different with a witness.
//
// The question. A and B are meshes that bound solids, E is the exact result of the operation (the
// regularised set), R the set of points about which the triangles of RESULT wind a positive number
// of times. RESULT must be closed; it may intersect itself, cover itself or be inside out: R is
// what its triangles say. D is the symmetric difference of E and R, and distances are measured in
// the maximum norm, as rounding of coordinates is.
//
// What is certified.
//  * Equal: D is empty. So the boundaries of E and R are the same points.
//  * Within r: every point of D is within r of the boundary of E, and within r of the faces of
//    RESULT. So a point that is farther than r from one of them has the same membership in E and R:
//    no feature, hole, fin or cavity larger than that is missing or too much.
//  * Different, with a witness: a rational point strictly inside one of E and R and strictly
//    outside the other, farther than r from the boundary of E or from the faces of RESULT. Its
//    memberships in A, B and R are winding numbers counted along a ray in rationals
//    (brep/winding_number.h), its membership in E follows from those in A and B by the definition
//    of the operation. So this answer rests on nothing but a page of integer arithmetic, whatever
//    found the point. Should the two not agree, verify() throws an internal error.
//
// Why "within r" is proved. D is evaluated exactly and cut exactly into pieces D = D_1 + ... + D_n.
// For each connected piece there is one triangle T of the boundary of E such that every vertex of
// the piece is within r of T. The points within r of T are the sum of T and a cube: a convex set.
// The piece lies in the convex hull of its vertices, and so within r of T. The same is done with
// the triangles of RESULT. Distances of vertices are bounded from above with certified doubles
// (brep/measure/grid_distance.h).
//
// Most results are E with its corners rounded. Where every corner of RESULT is near a vertex, or a
// point of an edge or face, of the boundary of E, and its triangles moved there cover each face
// once, the largest move bounds the radius (bsp/verify/corner_match.h), and pieces are looked for
// only where that fails.
//
// The certified radius is an interval [lower, upper]: some point of the closure of D is at least
// `lower` away from one of the boundaries, no point of D more than `upper` from either. Pieces are
// cut along the edges of the triangles that they are compared with, until `upper` is at most 3/2 of
// `lower` and three units of the lattice, or `piece_limit` is reached.
//
// Placement. All meshes are placed on one lattice, the finest that holds the largest coordinate:
// its unit is 2^-45 to 2^-52 of that. Coordinates keep 73 bits behind the point. A mesh with more
// is rounded, as are all on a lattice that the caller gives; verdict and bounds are about the
// placed meshes, and `moved` says how far each was rounded. A mesh
// whose corners move by at most m keeps its winding number about every point farther than m from
// its faces (nothing sweeps over the point while the corners move linearly), so a witness farther
// than that from all faces is also one for the meshes as given: `Witness::holds_as_given`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/expression.h>

namespace trisect {

/// Difference takes all other operands from the first one; a point is in the symmetric difference
/// when it is in an odd number of operands.
enum class BooleanOperation : std::uint8_t { Union, Intersection, Difference, SymmetricDifference };

/// "union", "intersection", "difference", "xor".
[[nodiscard]] const char* to_string(BooleanOperation operation);
/// The formula. \pre there is an operand
[[nodiscard]] Expression expression_of(BooleanOperation operation, std::span<const Solid> operands);

struct VerifyOptions {
    /// The distance r of the question "equal within r?", in the user's units. Without it the
    /// question is "equal?", and for different sets the smallest r is looked for.
    std::optional<double> within = std::nullopt;
    /// Of all meshes. Default: see "Placement".
    std::optional<Lattice> lattice = std::nullopt;
    EvaluateOptions evaluate = {};
    /// Pieces that D may be cut into.
    std::size_t piece_limit = 10000;
};

enum class Verdict : std::uint8_t {
    Equal,
    Within,     ///< equal within the given r
    Different,  ///< there is a witness
    Undecided,  ///< r lies between lower and upper, and piece_limit was reached
    NotClosed   ///< RESULT bounds nothing: its faces' boundaries do not cancel
};
/// "equal", "within", "different", "undecided", "not_closed".
[[nodiscard]] const char* to_string(Verdict verdict);

/// A face of one of the meshes.
struct BlamedFace {
    std::uint32_t mesh = 0;  ///< number of the operand; RESULT follows the last one
    std::uint32_t face = 0;
    friend constexpr auto operator<=>(const BlamedFace&, const BlamedFace&) = default;
};

struct Witness {
    ExactPoint point;          ///< in the user's units
    std::vector<int> winding;  ///< of each operand about it, and last of RESULT
    bool in_exact = false;
    bool in_result = false;
    /// Certified lower bounds of its distances, in the user's units; infinite for an empty set. 0
    /// where the point is nearer than some 2^-38 lattice units.
    double distance_to_exact = 0;
    double distance_to_result = 0;
    bool holds_as_given = false;  ///< see "Placement"
    /// Faces that bound the part of D around the witness, the nearest first; at most 32.
    std::vector<BlamedFace> faces;
};

struct VerifyReport {
    Verdict verdict = Verdict::Equal;
    /// Of the certified radius, in the user's units; 0 for equal sets, infinite where one of the
    /// sets is empty, NaN where it was not looked for.
    double lower = 0;
    double upper = 0;
    std::optional<Witness> witness;  ///< of Different
    Lattice lattice;
    std::vector<double> moved;  ///< largest change of a coordinate of each mesh, RESULT last
    bool result_inside_out = false;
    ValidationReport result_defects;  ///< of NotClosed: the open edges
    std::size_t pieces = 0;           ///< that were compared
    std::size_t components = 0;       ///< connected parts of D
    /// Cuts that were given up because a boundary could not be assembled; `upper` is certified
    /// nevertheless, but may be far from `lower`.
    std::size_t failed_cuts = 0;
};

/// \throw InvalidSolid when an operand is not closed or is inside out; LimitError as import and
/// evaluate() do; UsageError for no operand, or an r that is negative or not a number.
[[nodiscard]] VerifyReport verify(BooleanOperation operation, std::span<const PolygonMesh> operands,
                                  const PolygonMesh& result, const VerifyOptions& options = {});

}  // namespace trisect
