// SPDX-License-Identifier: Apache-2.0
//
// Certificates of the first contact of moving solids, or of none.
// Another program can check them with nothing but fractions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/refusal.h>

namespace trisect {

/// A plane that moves, and separates triangles of A from those of B. Coordinates are those of a
/// solid before its motion, in the user's units.
struct MovingSeparator {
    enum class Kind : std::uint8_t {
        OfA,   ///< `plane` is carried along with A: A is not above it, B is strictly above
        OfB,   ///< `plane` is carried along with B: B is not below it, A is strictly below
        Edges  ///< the plane through the edge `edge_a`, parallel to the edge `edge_b`; its normal,
               ///< the product of their directions, turned round if `flipped`, points to B
    };
    Kind kind = Kind::OfA;
    SeparatingPlane plane;
    std::array<VertexId, 2> edge_a;
    std::array<VertexId, 2> edge_b;
    bool flipped = false;
};

/// A range of time, of A's triangles and of B's; halved, or kept apart by one plane for all its
/// time. Children are the next node and `other`.
struct FreedomNode {
    enum class Kind : std::uint8_t { Separated, SplitTime, SplitA, SplitB };
    Kind kind = Kind::Separated;
    std::uint32_t other = 0;
    ExactRational time;  ///< of SplitTime: the end of the first child and beginning of the second
    MovingSeparator separator;
};

/// That a triangle of A and a triangle of B have a point in common at the time of contact.
struct CommonPoint {
    enum class Kind : std::uint8_t {
        VertexOfB,  ///< vertex_b is on triangle_a
        VertexOfA,  ///< vertex_a is on triangle_b
        Edges       ///< the edges cross
    };
    Kind kind = Kind::VertexOfB;
    CertifiedTriangle triangle_a;
    CertifiedTriangle triangle_b;
    VertexId vertex_a;
    VertexId vertex_b;
    std::array<VertexId, 2> edge_a;
    std::array<VertexId, 2> edge_b;
};

/// Contact at the start: `at_start`. Otherwise `at_start` proves that the solids are disjoint
/// there; `freedom` has a tree for each piece of the motions, up to that of the contact, and keeps
/// boundaries apart from 0 to 1 or, in the last one, to the contact.
struct ContactCertificate {
    bool is_complete = false;
    bool is_contact = false;
    InterferenceCertificate at_start;

    /// Of the contact: the piece, and the parameter within the piece: the only root of the
    /// polynomial (constant coefficient first) between `lower` and `upper`.
    std::size_t piece = 0;
    std::vector<ExactRational> polynomial;
    ExactRational lower;
    ExactRational upper;
    CommonPoint common_point;

    /// In the order of the trees' ranges; they fill all faces.
    std::vector<CertifiedTriangle> triangles_a;
    std::vector<CertifiedTriangle> triangles_b;
    std::vector<std::vector<FreedomNode>> freedom;
};

/// Asks for the first touch and looks for a certificate. It may stay incomplete where solids come
/// together in a way for which no plane of these kinds separates their triangles up to the end (a
/// vertex that arrives at a vertex or edge from outside of all candidates), or after `max_nodes`.
/// Costs a hundred times the answer. \throw what first_contact throws.
[[nodiscard]] ContactCertificate certify_first_contact(const InterferenceModel& a,
                                                       const Motion& motion_a,
                                                       const InterferenceModel& b,
                                                       const Motion& motion_b,
                                                       std::size_t max_nodes = 200000);

/// Why a certificate does not hold for these boundaries and motions; nothing when it does. Uses the
/// boundaries, the polynomials of the motions and fractions alone: roots are counted by Sturm's
/// theorem. An incomplete certificate holds when all it contains does.
[[nodiscard]] std::optional<Refusal> check(const ContactCertificate& certificate, const Brep& a,
                                           const Motion& motion_a, const Brep& b,
                                           const Motion& motion_b);

}  // namespace trisect
