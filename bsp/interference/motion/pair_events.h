// SPDX-License-Identifier: Apache-2.0
//
// PairEvents: the events of two triangles of moving solids.
// They are computed in doubles first, and exactly where these cannot decide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/contact_event.h>
#include <trisect/bsp/interference/motion/event_model.h>
#include <trisect/bsp/interference/motion/feature_contact.h>
#include <trisect/bsp/interference/motion/motion_piece.h>

namespace trisect::detail {

/// Events are isolated times of contact: a vertex on a closed triangle, or the interiors of two
/// edges crossing, when they have not been coplanar for good. Those are enough. Where solids begin
/// to touch, or while they slide begin to overlap, some vertex or edge arrives in the plane of a
/// feature that it meets there; if all that meet had been coplanar for good, all would go on
/// meeting in the same way.
class PairEvents {
public:
    PairEvents(const EventModel& a, const EventModel& b, const RelativeMotion& motion);
    ~PairEvents();
    PairEvents(const PairEvents&) = delete;
    PairEvents& operator=(const PairEvents&) = delete;

    /// The events of two triangles in the closed interval of `over`, at least those up to the first
    /// one known. `over` is a part of the motion. Best called with the same triangle of B many
    /// times in a row.
    void find(std::uint32_t triangle_a, std::uint32_t triangle_b, const BallMotion& over,
              EarliestEvents& events);
    /// The same without the doubles.
    void find_exactly(std::uint32_t triangle_a, std::uint32_t triangle_b,
                      const TimeInterval& interval, EarliestEvents& events);

private:
    struct Scalars;
    enum class Kind : std::uint8_t { VertexFace, FaceVertex, EdgeEdge };
    struct Features {
        Kind kind = Kind::VertexFace;
        std::uint32_t triangle_a = 0;
        std::uint32_t triangle_b = 0;
        std::size_t i = 0;  // corner or side of a
        std::size_t j = 0;  // corner or side of b
    };

    struct Moved;
    struct Resting;

    [[nodiscard]] const Moved& moved(std::uint32_t triangle_b, const BallMotion& over);
    void vertex_of_b(const Features& f, const Resting& a, const BallPolynomial& height,
                     const BallMotion& over, EarliestEvents& events);
    void vertex_of_a(const Features& f, const Resting& a, const BallPolynomial& height,
                     const BallMotion& over, EarliestEvents& events);
    void edges(const Features& f, const Resting& a, const BallMotion& over, EarliestEvents& events);
    void narrow(const Features& f, const BallMotion& over, const Scalars& scalars,
                EarliestEvents& events);
    // The exact stage, in exact_pair_events.cpp.
    void decide(const Features& f, const TimeInterval& interval, EarliestEvents& events);
    [[nodiscard]] IntegerPolynomial coplanarity_of(const Features& f) const;
    [[nodiscard]] bool are_coplanar_for_good(const Features& f) const;
    void add_if_they_meet(const Features& f, RealRoot& s, EarliestEvents& events);

    const EventModel& a_;
    const EventModel& b_;
    const RelativeMotion& motion_;
    std::unique_ptr<Moved> moved_;  // of the last question
};

}  // namespace trisect::detail
