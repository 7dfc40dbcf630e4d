// SPDX-License-Identifier: Apache-2.0
//
// enclosed_first_contact: certified first contact of solids under enclosed motions.
// No rational formula describes such a motion. Answers are proved, as narrow as requested; times
// that cannot be decided are reported.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference_model.h>

namespace trisect {

struct TimeSpan {
    double from = 0;
    double to = 0;
    friend bool operator==(const TimeSpan&, const TimeSpan&) = default;
};

struct EnclosedContactOptions {
    /// How far apart free_until and contact_by may be, in units of time; positive.
    double width = 1e-9;
};

struct EnclosedContact {
    enum class Outcome : std::uint8_t {
        None,      ///< proved: at no time have the solids a point in common
        Contact,   ///< proved: they have at contact_by, and not before free_until
        Undecided  ///< they may touch during `undecided`, and certainly do at no other time
    };

    Outcome outcome = Outcome::None;
    /// Proved: no common point at any time before this one.
    double free_until = 0;
    /// Proved: at this time the solids have a point in common.
    std::optional<double> contact_by;
    /// Whether contact_by - free_until is at most the width requested. When it is not, the solids
    /// come so near each other at free_until, without certainly meeting, that nothing is decided.
    bool is_narrow = false;
    /// The times before contact_by, or before the end, at which it could neither be proved that the
    /// solids are apart nor that they meet; ascending. Where they touch without passing through
    /// each other (grazing, resting, sliding) no enclosure can prove a contact, however narrow.
    std::vector<TimeSpan> undecided;
    /// Where faces certainly pass through each other at contact_by: one pair of faces. Empty when a
    /// point inside both solids proves the contact.
    std::vector<ContactWitness> witnesses;
};

/// The first contact of two solids in enclosed motion, over the whole time.
///
/// Both motions have the same duration, or one of them stands still. A contact at the start, the
/// end or a break counts. Solids that touch at the start, or within each other touch, are
/// undecided there; a contact is also that one solid is within the other.
///
/// Ranges of time are halved until boxes grown by the sweep, or a plane for each pair of triangles
/// that are left, prove the solids apart by more than the enclosures deviate. At the end of a short
/// range that resists, a crossing of faces or a point well inside both proves a contact. What has
/// neither is halved down to 2^-40 of the duration and is undecided then; after that the rest of
/// the time is looked at in parts of a thousandth of the duration (or the width).
///
/// Cost: some 0.1 ms for each range of time beside its walk; a near miss takes ranges as short as
/// the gap is small; long contact without a crossing takes a thousand of them.
/// \throw UsageError when the width is not positive or durations differ, UnsupportedError when the
/// relative motion of two rational enclosures has a degree above 8, LimitError when poses of the
/// enclosures are too wide for the static query that says whether one solid is within the other
/// (kernel/pose.h); and what the motions throw.
[[nodiscard]] EnclosedContact enclosed_first_contact(const InterferenceModel& a,
                                                     const EnclosedMotion& motion_a,
                                                     const InterferenceModel& b,
                                                     const EnclosedMotion& motion_b,
                                                     const EnclosedContactOptions& options = {});

}  // namespace trisect
