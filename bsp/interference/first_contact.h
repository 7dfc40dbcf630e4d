// SPDX-License-Identifier: Apache-2.0
//
// first_contact: exact time of first contact or blocking of moving solids.
// Motions are rational.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/algebraic_number.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/motion.h>

namespace trisect {

/// Two entities that meet. While solids come together one of them is a vertex, or both are edges
/// that cross.
struct ContactWitness {
    BoundaryEntity a;
    BoundaryEntity b;
    friend constexpr auto operator<=>(const ContactWitness&, const ContactWitness&) = default;
};

/// What to look for.
enum class ContactEvent : std::uint8_t {
    /// The first time at which the solids have a point in common.
    Touch,
    /// The time from which on the interiors meet: the last one up to which the motion is possible.
    /// Sliding along each other, grazing in passing and coming apart are no obstacles, at the start
    /// or later.
    Overlap
};

struct FirstContactOptions {
    ContactEvent event = ContactEvent::Touch;
    /// Leave out parts of the boundaries that move away from each other: with Touch no contact
    /// begins there (facing_cones.cpp has the proof). The answer is the same either way. Off, since
    /// the search seldom comes to such parts: a tenth of the tests of boxes at most in what was
    /// measured, for less than the cones cost.
    bool leave_out_receding = false;
};

/// What searches did, besides MotionCounters (kernel/diagnostics.h).
struct FirstContactCounters {
    std::uint64_t intervals = 0;         ///< parts of the range of the parameter looked at
    std::uint64_t box_tests = 0;         ///< one swept box against four
    std::uint64_t triangle_pairs = 0;    ///< pairs of triangles whose events were computed
    std::uint64_t separating_pairs = 0;  ///< pairs of boxes left out since they move apart

    FirstContactCounters& operator+=(const FirstContactCounters& o);
    FirstContactCounters& operator-=(const FirstContactCounters& o);
};

struct FirstContact {
    /// Nothing is a proof that there is no such event.
    [[nodiscard]] bool exists() const { return time.has_value(); }

    /// The parameter of the motions, exact; two of them compare exactly.
    std::optional<AlgebraicNumber> time;
    /// All pairs of entities that arrive at each other at that time, sorted. At the start of the
    /// motion: all pairs that meet there, which are none when one solid is within the other.
    std::vector<ContactWitness> witnesses;
    /// How the solids lie to each other at the start.
    Relation at_start = Relation::Disjoint;
};

/// The first event of two moving solids, from the whole range of the parameter.
///
/// Both motions run over the same range: they have the same number of pieces, or one of them stands
/// still. Both ends belong to the range: a touch exactly at the end counts. Where interiors meet at
/// the start the event is there. For Overlap the time is the end of what is possible, itself
/// included: a block that falls onto a floor overlaps from the time on at which it touches.
///
/// Any rational motions go together; where the relative motion has a degree above 8 (two blends of
/// poses have 3, two screws 5) no filter in doubles is tried and all pairs are decided exactly,
/// which is slow.
///
/// Cost: one static query at the start; then walks down both trees, for parts of the range before
/// the event only, short parts where the solids are near each other. Overlap takes a static query
/// for each contact on the way, and a search each time their number has doubled.
/// \throw UsageError when the motions do not match, LimitError when a pose of the static query is
/// too wide (kernel/pose.h).
[[nodiscard]] FirstContact first_contact(const InterferenceModel& a, const Motion& motion_a,
                                         const InterferenceModel& b, const Motion& motion_b,
                                         const FirstContactOptions& options = {});

}  // namespace trisect
