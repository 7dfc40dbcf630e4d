// SPDX-License-Identifier: Apache-2.0
//
// first_contact: when do two moving solids first touch? Exact for rational motions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/algebraic_number.h>
#include <trisect/brep/brep.h>
#include <trisect/bsp/interference_model.h>
#include <trisect/bsp/motion.h>

namespace trisect {

/// Where on a boundary: a vertex, else an edge, else a face is valid. `near_face` is a face at the
/// place in any case.
struct BoundaryFeature {
    VertexId vertex;
    EdgeId edge;
    FaceId face;
    FaceId near_face;
    friend auto operator<=>(const BoundaryFeature&, const BoundaryFeature&) = default;
};

/// A pair of features that meet. One of them is a vertex, or both are edges that cross.
struct ContactWitness {
    BoundaryFeature a;
    BoundaryFeature b;
    friend auto operator<=>(const ContactWitness&, const ContactWitness&) = default;
};

/// What a search did, besides motion_counters().
struct FirstContactStats {
    std::uint64_t intervals = 0;       ///< parts of the range of the parameter looked at
    std::uint64_t box_tests = 0;       ///< one swept box against four
    std::uint64_t triangle_pairs = 0;  ///< pairs of triangles whose events were asked for
};

struct FirstContact {
    /// Nothing is a proof that there is no contact.
    [[nodiscard]] bool exists() const { return time.has_value(); }

    /// The parameter of the motions, exact; two of them compare exactly.
    std::optional<AlgebraicNumber> time;
    /// All pairs of features that arrive at that time, sorted, each once.
    std::vector<ContactWitness> witnesses;
    FirstContactStats stats;
};

/// The first value of the parameter at which the boundaries of the two solids touch.
///
/// Both motions run over the same range: they have the same number of pieces, or one of them stands
/// still. A touch at either end of the range counts.
///
/// \pre The interiors are apart at the start. A solid within the other one, or already crossing
/// it, is a static question; what is reported then is the next time at which some vertex or edge
/// arrives at the other boundary.
///
/// Cost: one walk down both trees for each part of the range before the contact, shorter parts
/// where the solids are near each other. \throw UsageError when the motions do not match.
[[nodiscard]] FirstContact first_contact(const InterferenceModel& a, const Motion& motion_a,
                                         const InterferenceModel& b, const Motion& motion_b);

}  // namespace trisect
