// SPDX-License-Identifier: Apache-2.0
//
// Clearance: leaves of overlap certificates, for their checker.
// The search for such certificates may use it, too.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/certified_motion.h>
#include <trisect/bsp/interference/certificate/certified_part.h>
#include <trisect/bsp/interference/certificate/certified_time.h>
#include <trisect/bsp/interference/overlap_certificate.h>

namespace trisect::detail::certified {

/// Subject of a node of `OverlapCertificate::clearance`.
struct ClearanceRange {
    std::shared_ptr<const Part> part;
    std::size_t b0 = 0;
    std::size_t b1 = 0;
    ExactRational from;
    ExactRational to;

    /// What a node's children have; or why there is no such node.
    [[nodiscard]] std::string divide(const ClearanceNode& node, ClearanceRange& first,
                                     ClearanceRange& second) const;
};

/// One piece of two motions, over [0, 1] or up to an event.
class Clearance {
public:
    Clearance(const Piece& a, const Piece& b, const Boundary& boundary_b,
              std::optional<RootTime> event)
        : to_a_(seen_from(a, b)),
          to_b_(seen_from(b, a)),
          b_(boundary_b),
          event_(std::move(event)) {}

    /// Where ranges end: at the event's bracket, from which they go on to the event.
    [[nodiscard]] ExactRational end() const { return event_ ? event_->lower() : ExactRational(1); }
    /// Whether both solids keep their dimension.
    [[nodiscard]] bool is_regular() const;
    /// Whether, at all times of the range, the plane has the part below or in it and the corners of
    /// B above or in it; and is a plane, but for single moments.
    [[nodiscard]] bool are_apart(const ClearanceRange& r, const std::vector<std::uint32_t>& of_b,
                                 const SupportingPlane& plane);
    /// B as A sees it.
    [[nodiscard]] const Piece& to_a() const { return to_a_; }
    [[nodiscard]] const Piece& to_b() const { return to_b_; }

private:
    [[nodiscard]] bool goes_to_the_event(const ClearanceRange& r) const {
        return event_ && r.to == event_->lower();
    }
    [[nodiscard]] bool is_not_negative(const Polynomial& p, const ClearanceRange& r) const;
    template <class Points, class ToPoint>
    [[nodiscard]] bool stay_above(const Points& points, ToPoint point, bool are_of_b,
                                  const ClearanceRange& r, const SeparatingPlane& plane);
    [[nodiscard]] bool are_apart_by_edges(const ClearanceRange& r,
                                          const std::vector<std::uint32_t>& of_b,
                                          const SupportingPlane& plane) const;

    Piece to_a_;
    Piece to_b_;
    const Boundary& b_;
    std::optional<RootTime> event_;
    std::map<std::tuple<bool, ExactRational, ExactRational>, ControlMaps> controls_;
};

}  // namespace trisect::detail::certified
