// SPDX-License-Identifier: Apache-2.0
//
// First contact of moving solids by their own trees.
//
// As for placed solids (solid_interference.h) no model is made before, so a solid that was just cut
// is as good as any other one.
#pragma once

#include <compare>
#include <optional>
#include <vector>

#include <trisect/brep/algebraic_number.h>
#include <trisect/bsp/interference/enclosed_contact.h>
#include <trisect/bsp/interference/enclosed_motion.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/motion.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// An entity of A and one of B that meet.
struct NamedWitness {
    EntityName a;
    EntityName b;
    friend constexpr auto operator<=>(const NamedWitness&, const NamedWitness&) = default;
};

/// As FirstContact, with names of entities.
struct NamedFirstContact {
    /// Nothing is a proof that there is no such event.
    [[nodiscard]] bool exists() const { return time.has_value(); }

    /// The parameter of the motions, exact; two of them compare exactly.
    std::optional<AlgebraicNumber> time;
    /// Pairs of entities that arrive at each other at that time, of which one is a vertex or both
    /// are edges, sorted, each once. At the start of the motion: all pairs that meet there, which
    /// are none when one solid is within the other.
    std::vector<NamedWitness> witnesses;
    /// How the solids lie to each other at the start.
    Relation at_start = Relation::Disjoint;
};

/// The first event of two moving solids, from the whole range of the parameter: the same time as
/// that of InterferenceModels of the solids, for motions as there (first_contact.h).
/// `leave_out_receding` changes nothing.
///
/// Cost: as with models, but for bounds of leaves and boxes of triangles that no question came to
/// before, which are made and kept where the way leads near the other solid.
/// \throw UsageError when the motions do not match, UnsupportedError when a solid is unbounded,
/// LimitError when a pose of the static query is too wide (kernel/pose.h); what evaluate() throws.
[[nodiscard]] NamedFirstContact first_contact(const Solid& a, const Motion& motion_a,
                                              const Solid& b, const Motion& motion_b,
                                              const FirstContactOptions& options = {});

/// As EnclosedContact, with names of entities.
struct NamedEnclosedContact {
    using Outcome = EnclosedContact::Outcome;

    Outcome outcome = Outcome::None;
    /// Proved: no common point at any time before this one.
    double free_until = 0;
    /// Proved: at this time the solids have a point in common.
    std::optional<double> contact_by;
    /// Whether contact_by - free_until is at most the width requested.
    bool is_narrow = false;
    /// The times before contact_by, or before the end, of which nothing is proved; ascending.
    std::vector<TimeSpan> undecided;
    /// Where faces certainly pass through each other at contact_by: one pair of faces. Empty when a
    /// point inside both solids proves the contact.
    std::vector<NamedWitness> witnesses;
};

/// The first contact of two solids in enclosed motion, over the whole time: proved as for
/// InterferenceModels of the solids (enclosed_contact.h), though ranges may end at other times.
///
/// Cost: as that of first_contact, for each range of time.
/// \throw as there, and UnsupportedError when a solid is unbounded; what evaluate() throws.
[[nodiscard]] NamedEnclosedContact enclosed_first_contact(
    const Solid& a, const EnclosedMotion& motion_a, const Solid& b, const EnclosedMotion& motion_b,
    const EnclosedContactOptions& options = {});

}  // namespace trisect
