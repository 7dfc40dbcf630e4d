// SPDX-License-Identifier: Apache-2.0
//
// Finding certificates of the first overlap: the proof of how the solids lie at the start, trees of
// planes up to the event (clearance_finder.cpp) and tetrahedra after it (overlap_witness.cpp).

#include <trisect/bsp/interference/overlap_certificate.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <trisect/bsp/interference/certificate/certified_clearance.h>
#include <trisect/bsp/interference/certificate/find/clearance_finder.h>
#include <trisect/bsp/interference/certificate/find/overlap_witness.h>
#include <trisect/bsp/interference/certificate/find/proof_body.h>
#include <trisect/bsp/interference/motion/time_in_piece.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect {

namespace {

using detail::certified::Boundary;
using detail::certified::Clearance;
using detail::certified::Part;
using detail::certified::piece_of;
using detail::certified::RootTime;

// Where the event is. Nothing that follows depends on the end of a piece, so an event there is at
// the start of the next one.
bool name_event(OverlapCertificate& c, const AlgebraicNumber& time) {
    detail::TimeInPiece t = detail::time_in_piece(time);
    if (t.is_end) {
        ++t.piece;
        t.is_start = true;
    }
    c.piece = t.piece;
    if (t.is_start) return true;
    c.polynomial = std::move(t.polynomial);
    c.lower = ExactRational::from_double(t.lower);
    c.upper = ExactRational::from_double(t.upper);
    return RootTime(c.polynomial, c.lower, c.upper).wrong().empty();
}

// Trees for all pieces up to the event.
bool prove_clearance(OverlapCertificate& c, const InterferenceModel& a, const Motion& motion_a,
                     const InterferenceModel& b, const Motion& motion_b, std::size_t max_nodes) {
    const detail::ProofBody body_a(detail::data_of(a));
    const detail::ProofBody body_b(detail::data_of(b));
    c.triangles_a = body_a.triangles;
    c.triangles_b = body_b.triangles;
    const Boundary boundary_a(a.brep());
    const Boundary boundary_b(b.brep());
    const auto whole = std::make_shared<const Part>(boundary_a, c.triangles_a);
    const bool is_within_piece = c.is_overlap && !c.polynomial.empty();
    const std::size_t pieces = c.is_overlap
                                   ? c.piece + (is_within_piece ? 1 : 0)
                                   : std::max(motion_a.piece_count(), motion_b.piece_count());
    for (std::size_t i = 0; i < pieces; ++i) {
        std::optional<RootTime> event;
        if (is_within_piece && i == c.piece) event.emplace(c.polynomial, c.lower, c.upper);
        Clearance clearance(piece_of(motion_a, i), piece_of(motion_b, i), boundary_b,
                            std::move(event));
        detail::ClearanceFinder finder(clearance, body_b, max_nodes);
        auto tree = finder.find(whole);
        if (!tree) {
            c.missing = finder.failure();
            c.clearance.clear();
            return false;
        }
        c.clearance.push_back(std::move(*tree));
    }
    return true;
}

}  // namespace

OverlapCertificate certify_first_overlap(const InterferenceModel& a, const Motion& motion_a,
                                         const InterferenceModel& b, const Motion& motion_b,
                                         std::size_t max_nodes) {
    OverlapCertificate c;
    FirstContactOptions options;
    options.event = ContactEvent::Overlap;
    const FirstContact overlap = first_contact(a, motion_a, b, motion_b, options);
    c.is_overlap = overlap.exists();
    c.at_start = certify_relation(a, motion_a.pose_at(0), b, motion_b.pose_at(0));
    if (!c.at_start.is_complete) {
        c.missing = "the proof of the start";
        return c;
    }
    if (interiors_meet(c.at_start.relation) || a.is_empty() || b.is_empty()) {
        c.is_complete = true;
        return c;
    }
    if (c.is_overlap && !name_event(c, *overlap.time)) {
        c.missing = "a bracket of the event";
        return c;
    }
    if (!prove_clearance(c, a, motion_a, b, motion_b, max_nodes)) return c;
    if (c.is_overlap) {
        auto witness = detail::find_overlap_witness(c, a, motion_a, b, motion_b);
        if (!witness) {
            c.missing = "tetrahedra that overlap right after the event";
            return c;
        }
        c.after = std::move(*witness);
    }
    c.is_complete = true;
    return c;
}

}  // namespace trisect
