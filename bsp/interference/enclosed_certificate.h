// SPDX-License-Identifier: Apache-2.0
//
// Certificates of first contact for enclosed motions.
// No rational formula describes such a motion. Another program can check them with the enclosures
// of the motions and fractions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/bsp/interference/enclosed_contact.h>
#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/refusal.h>

namespace trisect {

/// A range of time, of A's triangles and of B's; halved, or kept apart for all its time by a plane
/// at rest in the world: A's corners under their enclosure are below it and B's above, by more than
/// both enclosures deviate. Children are the next node and `other`.
struct EnclosedFreedomNode {
    enum class Kind : std::uint8_t { Separated, SplitTime, SplitA, SplitB };
    Kind kind = Kind::Separated;
    std::uint32_t other = 0;
    double time = 0;  ///< of SplitTime
    SeparatingPlane plane;
};

/// That the solids have no common point during a span of time. Their boundaries are apart all over
/// it (`freedom`); so whether one is within the other is the same all over it, and `at_start`
/// proves Disjoint for the poses of the enclosures of the first moment, which `start` keeps apart
/// from the true ones: a tree for that moment alone.
struct FreeSpan {
    TimeSpan span;
    InterferenceCertificate at_start;
    std::vector<EnclosedFreedomNode> start;
    std::vector<EnclosedFreedomNode> freedom;
};

/// An answer with its proof: no contact in the free spans, and one at `contact_by`, where `in_both`
/// is inside both solids, deeper than the enclosures deviate. All other times up to it, or to the
/// end, the answer calls undecided. Its witnesses are not proved.
struct EnclosedCertificate {
    bool is_complete = false;
    EnclosedContact answer;
    std::vector<FreeSpan> free;  ///< ascending
    std::optional<ExactPoint> in_both;
    /// In the order of the trees' ranges; they fill all faces.
    std::vector<CertifiedTriangle> triangles_a;
    std::vector<CertifiedTriangle> triangles_b;
};

/// Asks for the first contact and looks for a certificate of the answer. It may stay incomplete
/// where the deepest point found is not deep enough, where solids graze each other and a free span
/// ends nearer to the contact than doubles can decide, or after `max_nodes` a span. Costs some
/// hundred times the answer. \throw what enclosed_first_contact throws.
[[nodiscard]] EnclosedCertificate certify_enclosed_contact(
    const InterferenceModel& a, const EnclosedMotion& motion_a, const InterferenceModel& b,
    const EnclosedMotion& motion_b, const EnclosedContactOptions& options = {},
    std::size_t max_nodes = 200000);

/// Why a certificate does not hold for these boundaries and motions; nothing when it does. Trusts
/// the motions' enclosures and uses the boundaries, polynomials and fractions alone. An incomplete
/// certificate holds when all it contains does; its answer is not looked at then.
[[nodiscard]] std::optional<Refusal> check(const EnclosedCertificate& certificate, const Brep& a,
                                           const EnclosedMotion& motion_a, const Brep& b,
                                           const EnclosedMotion& motion_b);

}  // namespace trisect
