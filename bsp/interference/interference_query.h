// SPDX-License-Identifier: Apache-2.0
//
// InterferenceQuery: the relation of two solids over similar poses.
#pragma once

#include <cstdint>
#include <memory>

#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// What queries did (kernel/diagnostics.h).
struct InterferenceQueryCounters {
    std::uint64_t asked = 0;
    std::uint64_t node_tests = 0;      ///< tests of one box against four
    std::uint64_t plane_tests = 0;     ///< the same by planes that were kept, or of two triangles
    std::uint64_t triangle_pairs = 0;  ///< pairs of triangles compared in doubles
    std::uint64_t fresh_walks = 0;     ///< from the roots of both trees
    std::uint64_t resumed_fronts = 0;  ///< a lost crossing, and on from where all was apart before
    std::uint64_t by_balls = 0;        ///< Overlapping by balls inside both solids
    std::uint64_t kept = 0;   ///< relations that followed from the last one: the bodies had
                              ///< moved less than what was between them, or no boundary
                              ///< had met the other on the way
    std::uint64_t exact = 0;  ///< left to interfere(), which needs exact poses

    InterferenceQueryCounters& operator+=(const InterferenceQueryCounters& o);
    InterferenceQueryCounters& operator-=(const InterferenceQueryCounters& o);
};

/// Answers what interfere() answers, and remembers where the solids were close or crossed. Any
/// sequence of poses is right; those that change little are cheap: the work follows from how far
/// the bodies have moved against the gaps between their parts, not from their size.
///
/// Of solids it walks their own trees (solid_interference.h), and goes on from where it was when
/// one of them is replaced by what a cut left of it.
///
/// An object is for one thread; any number of them may share models and solids. One that was moved
/// from can only be assigned to or ended.
class InterferenceQuery {
public:
    InterferenceQuery(const InterferenceModel& a, const InterferenceModel& b);
    /// \throw UnsupportedError when a solid is unbounded; what evaluate() throws, for a solid that
    /// must be resolved.
    InterferenceQuery(const Solid& a, const Solid& b);
    ~InterferenceQuery();
    InterferenceQuery(InterferenceQuery&&) noexcept;
    InterferenceQuery& operator=(InterferenceQuery&&) noexcept;

    /// Relation of A under its pose to B under its pose. \throw what interfere() throws.
    [[nodiscard]] Relation relation(const Pose& pose_a, const Pose& pose_b);
    /// Goes on with another solid in the place of one. What is known about parts that both solids
    /// share is kept: after a small cut nearly all. \throw UsageError for a query of models; as the
    /// constructor, which changes nothing.
    void replace_a(const Solid& a);
    void replace_b(const Solid& b);
    /// The next question starts from the roots.
    void forget();

    class State;

private:
    std::unique_ptr<State> state_;
};

}  // namespace trisect
