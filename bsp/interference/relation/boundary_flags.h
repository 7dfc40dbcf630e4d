// SPDX-License-Identifier: Apache-2.0
//
// BoundaryFlags: positions of each boundary, and the resulting relation.
#pragma once

#include <trisect/bsp/interference/interference.h>

namespace trisect::detail {

/// Which parts two boundaries have with respect to the other solid. Each flag is an existence
/// statement, so flags of different places are united.
struct BoundaryFlags {
    bool a_in = false;   ///< A's boundary meets the interior of B
    bool a_out = false;  ///< A's boundary meets the exterior of B
    bool b_in = false;
    bool b_out = false;
    bool same = false;      ///< they share a piece of area with equal normals
    bool opposite = false;  ///< they share a piece of area with opposite normals
    bool meet = false;      ///< they have a point in common

    BoundaryFlags& operator|=(const BoundaryFlags& o) {
        a_in = a_in || o.a_in;
        a_out = a_out || o.a_out;
        b_in = b_in || o.b_in;
        b_out = b_out || o.b_out;
        same = same || o.same;
        opposite = opposite || o.opposite;
        meet = meet || o.meet;
        return *this;
    }
    /// The boundaries pass through each other.
    void set_crossing() { a_in = a_out = b_in = b_out = meet = true; }

    [[nodiscard]] bool interiors_meet() const { return a_in || b_in || same; }
    /// So far as these flags are complete.
    [[nodiscard]] bool a_within_b() const { return !a_out && !b_in && !opposite; }
    [[nodiscard]] bool b_within_a() const { return !b_out && !a_in && !opposite; }
    /// Whether more flags cannot change the relation any more.
    [[nodiscard]] bool is_decided() const {
        return interiors_meet() && !a_within_b() && !b_within_a();
    }
    /// Of two solids that are not empty, from all flags.
    ///
    /// Interiors meet if some boundary enters the other's interior, or if the boundaries coincide
    /// somewhere with the inside on one side; for if interiors meet and no boundary enters, both
    /// interiors are unions of components of the complement of both boundaries, and share one,
    /// whose boundary is of both. A is a subset of the closed set B unless A's boundary leaves B,
    /// B's boundary enters A (behind it is a part of A outside B) or they are back to back.
    [[nodiscard]] Relation relation() const {
        if (!interiors_meet()) return meet ? Relation::Touching : Relation::Disjoint;
        if (a_within_b()) return b_within_a() ? Relation::Equal : Relation::Inside;
        return b_within_a() ? Relation::Contains : Relation::Overlapping;
    }
};

}  // namespace trisect::detail
