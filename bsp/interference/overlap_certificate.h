// SPDX-License-Identifier: Apache-2.0
//
// Certificates of the first overlap of moving solids, or of none.
// The interiors meet from a time on and not before. Another program can check that with nothing
// but fractions.
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

/// A plane that moves, with a part of A not above it and triangles of B not below it; both may
/// touch it. Coordinates are those of a solid before its motion, in the user's units.
struct SupportingPlane {
    enum class Kind : std::uint8_t {
        OfA,   ///< `plane` is carried along with A
        OfB,   ///< `plane` is carried along with B
        Edges  ///< through the point `through` of A, with the product of two directions for its
               ///< normal: `along_a`, carried along with A, and `along_b`, carried along with B
    };
    Kind kind = Kind::OfA;
    SeparatingPlane plane;
    ExactPoint along_a;
    ExactPoint along_b;
    ExactPoint through;
};

/// A range of time, a part of A and a range of B's triangles; divided, or kept apart by one plane
/// for all its time. Children are the next node and `other`.
struct ClearanceNode {
    enum class Kind : std::uint8_t { Separated, SplitTime, SplitA, SplitB };
    Kind kind = Kind::Separated;
    std::uint32_t other = 0;
    ExactRational time;   ///< of SplitTime: the end of the first child and beginning of the second
    SeparatingPlane cut;  ///< of SplitA: carried along with A; what is below it is the first child
    SupportingPlane plane;  ///< of Separated
};

/// Tetrahedra within A and within B, before motions. Their interiors meet at all times after the
/// event, up to `until`.
struct OverlapWitness {
    std::array<ExactPoint, 4> in_a;
    std::array<ExactPoint, 4> in_b;
    ExactRational until;  ///< within the piece
};

/// That interiors do not meet up to a time, itself included, but at all times shortly after it; or
/// that they never meet.
///
/// `at_start` proves how the solids lie at the start: where interiors meet there, nothing else is
/// needed. Otherwise `clearance` has a tree for each piece of the motions up to the event: at every
/// time, for every triangle of B, A is a sum of parts whose convex hulls have no interior point in
/// common with the triangle. So the part of the boundary of B inside A has no area but where it
/// lies in a plane that divides parts, and there it does not move across that plane for longer than
/// a moment; therefore the volume that the solids have in common does not change, and stays 0.
struct OverlapCertificate {
    bool is_complete = false;
    std::string missing;  ///< why it is not complete
    bool is_overlap = false;
    InterferenceCertificate at_start;

    /// Of the event: the piece, and the parameter within the piece, below 1: the only root of the
    /// polynomial (constant coefficient first) between `lower` and `upper`; without a polynomial 0.
    std::size_t piece = 0;
    std::vector<ExactRational> polynomial;
    ExactRational lower;
    ExactRational upper;
    OverlapWitness after;

    /// In the order of the trees' ranges; they fill all faces.
    std::vector<CertifiedTriangle> triangles_a;
    std::vector<CertifiedTriangle> triangles_b;
    std::vector<std::vector<ClearanceNode>> clearance;
};

/// Asks for the first overlap (ContactEvent::Overlap) and looks for a certificate. It stays
/// incomplete, and `missing` says why, where planes have to change at times that are no fractions,
/// where no tetrahedra of a few kinds overlap right after the event, or after `max_nodes` a piece.
/// Costs some hundred times the answer. \throw what first_contact throws.
[[nodiscard]] OverlapCertificate certify_first_overlap(const InterferenceModel& a,
                                                       const Motion& motion_a,
                                                       const InterferenceModel& b,
                                                       const Motion& motion_b,
                                                       std::size_t max_nodes = 20000);

/// Why a certificate does not hold for these boundaries and motions; nothing when it does. Uses the
/// boundaries, the polynomials of the motions and fractions alone. An incomplete certificate holds
/// when its start does.
[[nodiscard]] std::optional<Refusal> check(const OverlapCertificate& certificate, const Brep& a,
                                           const Motion& motion_a, const Brep& b,
                                           const Motion& motion_b);

}  // namespace trisect
