// SPDX-License-Identifier: Apache-2.0
//
// As in interference.cpp, six flags decide the relation. A crossing that doubles see sets four of
// them at once. Pairs that they do not decide are compared exactly, polygon by polygon, and the
// cones at the points where they meet say what each boundary does there. What meets nothing lies on
// one side as a whole (solid_sides.h).

#include <trisect/bsp/interference/tree/solid_pair.h>

#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/crossings_tell.h>
#include <trisect/bsp/interference/tree/exact_contacts.h>
#include <trisect/bsp/interference/tree/solid_sides.h>

namespace trisect::detail {

namespace {

using TrianglePairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

class SolidPair {
public:
    SolidPair(const SolidBoundary& a, const Pose& pose_a, const SolidBoundary& b,
              const Pose& pose_b)
        : a_(a), pose_a_(pose_a), b_(b), pose_b_(pose_b) {
        to_a_ = approximate_map(pose_a, a.lattice, pose_b, b.lattice);
        if (!to_a_.is_usable() && poses().to_a.has_doubles()) to_a_ = approximate_map(poses().to_a);
        to_b_ = approximate_map(pose_b, b.lattice, pose_a, a.lattice);
        if (!to_b_.is_usable() && poses().to_b.has_doubles()) to_b_ = approximate_map(poses().to_b);
        in_doubles_ = to_a_.is_usable() && to_b_.is_usable();
    }
    [[nodiscard]] SolidInterference relate(bool contacts, WalkCounters* counters) {
        SolidInterference result;
        TrianglePairs pairs;
        if (walk(contacts, pairs, counters)) {
            result.relation = Relation::Overlapping;
            return result;
        }
        BoundaryFlags flags;
        if (!pairs.empty()) {
            ExactContacts exact(poses());
            for (const auto& [i, j] : pairs)
                exact.compare(a_.origin(i).polygon(), b_.origin(j).polygon());
            exact.find_places();
            flags = exact.flags();
            if (contacts) result.contacts = exact.contacts();
        }
        add_sides(flags);
        result.relation = flags.relation();
        return result;
    }

    void add_sides(BoundaryFlags& flags) {
        if (flags.is_decided()) return;
        const Sides of_b = sides_of(SolidSides(b_, pose_b_, a_, pose_a_, to_a_));
        flags.b_in = flags.b_in || of_b.in;
        flags.b_out = flags.b_out || of_b.out;
        if (flags.is_decided()) return;
        const Sides of_a = sides_of(SolidSides(a_, pose_a_, b_, pose_b_, to_b_));
        flags.a_in = flags.a_in || of_a.in;
        flags.a_out = flags.a_out || of_a.out;
    }

private:
    [[nodiscard]] Sides sides_of(SolidSides sides) const {
        return in_doubles_ ? sides.find() : sides.find_exactly();
    }
    // Without `all`, true at a crossing that shows that the solids overlap. Pairs that are not
    // certainly apart.
    bool walk(bool all, TrianglePairs& pairs, WalkCounters* counters) {
        if (!in_doubles_) {
            // Nothing is known before the exact tests.
            const std::uint32_t of_b = b_.open_all();
            for (std::uint32_t i = 0; i < a_.open_all(); ++i)
                for (std::uint32_t j = 0; j < of_b; ++j) pairs.emplace_back(i, j);
            return false;
        }
        ObbWalk::Stack stack;
        stack.reserve(256);
        ObbWalk walk(a_.boxed(), b_.boxed(), to_a_, stack);
        const bool stopped = walk.run([&](std::uint32_t i, std::uint32_t j, PairVerdict verdict) {
            if (!all && verdict == PairVerdict::Crossing && crossing_tells(a_, i, b_, j, to_a_))
                return true;
            pairs.emplace_back(i, j);
            return false;
        });
        if (counters != nullptr) *counters += walk.counters();
        return stopped;
    }

    const PosedPair& poses() {
        if (!poses_) poses_.emplace(pose_a_, a_.lattice, pose_b_, b_.lattice);
        return *poses_;
    }
    const SolidBoundary& a_;
    const Pose& pose_a_;
    const SolidBoundary& b_;
    const Pose& pose_b_;
    ApproximateMap to_a_;
    ApproximateMap to_b_;
    bool in_doubles_ = true;
    std::optional<PosedPair> poses_;
};

}  // namespace

SolidInterference relation_of(const SolidBoundary& a, const Pose& pose_a, const SolidBoundary& b,
                              const Pose& pose_b, const SolidInterferenceOptions& options,
                              WalkCounters* counters) {
    if (a.is_empty() || b.is_empty()) return {};
    return SolidPair(a, pose_a, b, pose_b).relate(options.contacts, counters);
}

Relation relation_of_apart(const SolidBoundary& a, const Pose& pose_a, const SolidBoundary& b,
                           const Pose& pose_b) {
    BoundaryFlags flags;
    SolidPair(a, pose_a, b, pose_b).add_sides(flags);
    return flags.relation();
}

}  // namespace trisect::detail
