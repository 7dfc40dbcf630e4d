// SPDX-License-Identifier: Apache-2.0
//
// BroadPhase: pairs of intersecting boxes of a scene.
// They come before any query about the bodies in them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace trisect::detail {

/// A closed box. Where it stands for a body it contains it: its sides are rounded outwards.
struct BodyBox {
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};

    /// Boxes that touch meet.
    [[nodiscard]] bool meets(const BodyBox& o) const {
        return lo[0] <= o.hi[0] && o.lo[0] <= hi[0] && lo[1] <= o.hi[1] && o.lo[1] <= hi[1] &&
               lo[2] <= o.hi[2] && o.lo[2] <= hi[2];
    }
    friend bool operator==(const BodyBox&, const BodyBox&) = default;
};

/// Two bodies by their slots, the smaller one first.
struct BodyPair {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// What a broad phase did in its last call of `pairs`.
struct BroadPhaseWork {
    std::size_t box_tests = 0;  ///< 0 where the implementation does not say
    std::size_t moves = 0;      ///< entries that changed their place in the order or their cell
    std::size_t cells = 0;      ///< entries in lists of cells, of all boxes together
    std::size_t lookups = 0;    ///< cells looked at for boxes
};

/// Boxes by slots, which are small numbers that the caller gives and may use again after `remove`.
class BroadPhase {
public:
    BroadPhase() = default;
    BroadPhase(const BroadPhase&) = delete;
    BroadPhase& operator=(const BroadPhase&) = delete;
    virtual ~BroadPhase() = default;

    /// \pre no box has this slot.
    virtual void insert(std::uint32_t slot, const BodyBox& box) = 0;
    /// \pre a box has this slot, for both.
    virtual void update(std::uint32_t slot, const BodyBox& box) = 0;
    virtual void remove(std::uint32_t slot) = 0;
    /// Puts all pairs of boxes that meet into `out`, in ascending order. The answer depends on the
    /// boxes alone, not on their history.
    virtual void pairs(std::vector<BodyPair>& out) = 0;

    [[nodiscard]] const BroadPhaseWork& work() const { return counts_; }
    /// Memory of boxes and what orders them: what is in use, not what is reserved.
    [[nodiscard]] virtual std::size_t bytes() const = 0;

protected:
    BroadPhaseWork counts_;
};

/// Boxes in order along an axis, swept. A call costs O(n) when the order has hardly changed, and
/// the pairs that meet along that axis.
[[nodiscard]] std::unique_ptr<BroadPhase> make_sweep_and_prune();

/// An R-tree, packed anew when something moved; O(n log n) and what it returns.
[[nodiscard]] std::unique_ptr<BroadPhase> make_box_tree();

}  // namespace trisect::detail
