// SPDX-License-Identifier: Apache-2.0
//
// ContactQuery: the search for the first event of two solids.
// Motions are rational; how the boundaries are given is left open.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include <trisect/brep/algebraic_number.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/motion/ball_motion.h>
#include <trisect/bsp/interference/motion/contact_event.h>
#include <trisect/bsp/interference/motion/event_model.h>
#include <trisect/bsp/interference/motion/facing_cones.h>
#include <trisect/bsp/interference/motion/motion_piece.h>
#include <trisect/bsp/interference/motion/pair_events.h>
#include <trisect/bsp/interference/motion/solved_pairs.h>
#include <trisect/kernel/number/gmp.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// The search, for one question. Static queries and the names of what meets are left to the kinds
/// of boundaries.
class ContactQuery {
public:
    ContactQuery(const ContactQuery&) = delete;
    ContactQuery& operator=(const ContactQuery&) = delete;
    virtual ~ContactQuery() = default;

    /// What first_contact says, but for empty solids, of which nothing is looked at.
    /// \throw UsageError when the motions do not run together
    void run(ContactEvent event);

    [[nodiscard]] const std::optional<AlgebraicNumber>& time() const { return time_; }
    [[nodiscard]] Relation at_start() const { return at_start_; }
    [[nodiscard]] const FirstContactCounters& counters() const { return counters_; }

protected:
    /// All must outlive this.
    ContactQuery(EventModel& a, const Motion& motion_a, EventModel& b, const Motion& motion_b)
        : a_(a), motion_a_(motion_a), b_(b), motion_b_(motion_b) {}

    [[nodiscard]] virtual Relation relation_at(const Pose& pose_a, const Pose& pose_b) = 0;
    /// What meets at the answer: events, or all contacts of two poses.
    virtual void take_witnesses(const EventsAtATime& events, const RelativeMotion& motion) = 0;
    virtual void take_witnesses_at(const Pose& pose_a, const Pose& pose_b) = 0;
    /// What of a search for the first contact need not be looked at; or null.
    [[nodiscard]] virtual RecedingFaces* receding() { return nullptr; }

private:
    [[nodiscard]] Relation relation_at(std::size_t piece, const mpq_class& s);
    void touch_in_piece(std::size_t piece);
    void overlap_in_piece(std::size_t piece, bool& apart);
    [[nodiscard]] bool overlap_between(std::size_t piece, EventsAtATime& last, const RealRoot& end,
                                       bool& apart);
    void enter_piece(std::size_t piece);
    void search(EarliestEvents& events, SolvedPairs* solved = nullptr);
    void search_exactly(EarliestEvents& events);
    void answer(std::size_t piece, const EventsAtATime& events);
    void answer_with_contacts(std::size_t piece);

    EventModel& a_;
    const Motion& motion_a_;
    EventModel& b_;
    const Motion& motion_b_;
    std::unique_ptr<RelativeMotion> motion_;
    std::unique_ptr<PairEvents> pairs_;
    std::unique_ptr<BallMotion> filter_;   // null when degrees are too high
    std::unique_ptr<SolvedPairs> solved_;  // null with it
    RecedingFaces* receding_ = nullptr;    // null when nothing may be left out
    std::optional<AlgebraicNumber> time_;
    Relation at_start_ = Relation::Disjoint;
    FirstContactCounters counters_;
};

}  // namespace trisect::detail
