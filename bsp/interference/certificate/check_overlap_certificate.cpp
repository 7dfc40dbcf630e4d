// SPDX-License-Identifier: Apache-2.0
//
// The checker shares nothing with what decides. Before the event: parts of A, made by clipping its
// triangles, and planes that keep triangles of B out of their convex hulls (why that is enough
// stands in overlap_certificate.h). After it: two tetrahedra that no plane separates.

#include <trisect/bsp/interference/overlap_certificate.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <trisect/bsp/interference/certificate/certified_clearance.h>
#include <trisect/bsp/interference/certificate/certified_tetrahedron.h>
#include <trisect/bsp/interference/certificate/certified_walk.h>

namespace trisect::detail::certified {

namespace {

class OverlapChecker {
public:
    OverlapChecker(const OverlapCertificate& c, const Brep& a, const Motion& motion_a,
                   const Brep& b, const Motion& motion_b)
        : c_(c), motion_a_(motion_a), motion_b_(motion_b), a_(a), b_(b) {}

    std::string run() {
        if (const auto refusal = check(c_.at_start, a_.brep(), motion_a_.pose_at(0), b_.brep(),
                                       motion_b_.pose_at(0)))
            return "at the start: " + refusal->reason;
        if (!c_.is_complete) return {};
        if (!c_.at_start.is_complete) return "the start is not proved";
        if (interiors_meet(c_.at_start.relation))
            return c_.is_overlap ? "" : "the solids overlap at the start";
        if (a_.brep().is_empty() || b_.brep().is_empty())
            return c_.is_overlap ? "an empty solid overlaps nothing" : "";
        if (!a_.is_filled_by(c_.triangles_a) || !b_.is_filled_by(c_.triangles_b))
            return "the triangles do not fill the faces";
        const std::size_t pieces = std::max(motion_a_.piece_count(), motion_b_.piece_count());
        if (c_.is_overlap && c_.piece >= pieces) return "there is no such piece";
        // An event at the very start of a piece needs nothing of that piece.
        const bool is_within_piece = !c_.polynomial.empty();
        if (c_.clearance.size() != (c_.is_overlap ? c_.piece + (is_within_piece ? 1 : 0) : pieces))
            return "pieces of the motion are missing";
        std::optional<RootTime> event;
        if (c_.is_overlap && is_within_piece) {
            event.emplace(c_.polynomial, c_.lower, c_.upper);
            if (std::string w = event->wrong(); !w.empty()) return w;
        }
        whole_ = std::make_shared<const Part>(a_, c_.triangles_a);
        for (std::size_t i = 0; i < c_.clearance.size(); ++i)
            if (std::string w = wrong_piece(
                    i, c_.is_overlap && i == c_.piece ? event : std::optional<RootTime>());
                !w.empty())
                return w;
        return c_.is_overlap ? wrong_overlap(event) : "";
    }

private:
    [[nodiscard]] Clearance clearance_of(std::size_t piece, std::optional<RootTime> event) const {
        return {piece_of(motion_a_, piece), piece_of(motion_b_, piece), b_, std::move(event)};
    }
    std::string wrong_piece(std::size_t i, std::optional<RootTime> event) const {
        Clearance clearance = clearance_of(i, std::move(event));
        if (!clearance.is_regular()) return "a solid becomes flat";
        const std::span triangles(c_.triangles_b);
        return wrong_tree(
            c_.clearance[i],
            ClearanceRange{whole_, 0, triangles.size(), ExactRational(), clearance.end()},
            [&](const ClearanceNode& node, const ClearanceRange& r) {
                const auto of_b = corners_of(triangles.subspan(r.b0, r.b1 - r.b0));
                return clearance.are_apart(r, of_b, node.plane) ? "" : "a plane does not separate";
            });
    }
    std::string wrong_overlap(const std::optional<RootTime>& event) const {
        const OverlapWitness& w = c_.after;
        if (w.until.sign() <= 0 || ExactRational(1) < w.until) return "no time after the event";
        if (!is_within(w.in_a, a_, c_.triangles_a) || !is_within(w.in_b, b_, c_.triangles_b))
            return "a tetrahedron is not within its solid";
        const Clearance whole_piece = clearance_of(c_.piece, std::nullopt);
        if (!whole_piece.is_regular()) return "a solid becomes flat";
        return keep_overlapping(w.in_a, w.in_b, whole_piece.to_a(),
                                [&](const Polynomial& p) {
                                    return event ? event->is_positive_after(p, w.until)
                                                 : is_positive_after_zero(p, w.until);
                                })
                   ? ""
                   : "the tetrahedra do not overlap right after the event";
    }

    const OverlapCertificate& c_;
    const Motion& motion_a_;
    const Motion& motion_b_;
    Boundary a_;
    Boundary b_;
    std::shared_ptr<const Part> whole_;
};

}  // namespace

}  // namespace trisect::detail::certified

namespace trisect {

std::optional<Refusal> check(const OverlapCertificate& certificate, const Brep& a,
                             const Motion& motion_a, const Brep& b, const Motion& motion_b) {
    std::string reason =
        detail::certified::OverlapChecker(certificate, a, motion_a, b, motion_b).run();
    if (reason.empty()) return std::nullopt;
    return Refusal{std::move(reason)};
}

}  // namespace trisect
