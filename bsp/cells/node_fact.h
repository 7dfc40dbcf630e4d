// SPDX-License-Identifier: Apache-2.0
//
// NodeFact: something derived from a node of a cell tree.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

/// A function of a node's cell and of the polygons that are listed there, clipped to the cell: of
/// no neighbour, no version and no complement. So all versions of a solid that share the node share
/// the fact. Immutable, or made so that threads may share it.
class NodeFact {
public:
    NodeFact() = default;
    NodeFact(const NodeFact&) = delete;
    NodeFact& operator=(const NodeFact&) = delete;
    virtual ~NodeFact() = default;
};

/// The place of one fact: empty until it is first needed. Safe from any thread.
class FactSlot {
public:
    FactSlot() = default;
    FactSlot(const FactSlot&) = delete;
    FactSlot& operator=(const FactSlot&) = delete;
    ~FactSlot() { delete fact_.load(std::memory_order_relaxed); }

    /// Null when it is still to be made.
    [[nodiscard]] const NodeFact* get() const { return fact_.load(std::memory_order_acquire); }
    /// What there is, or else what make() returns, a unique pointer. `make` runs once for a slot
    /// and must not make facts of the same or another node.
    template <class Make>
    const NodeFact& get_or(const Make& make) const {
        if (const NodeFact* there = get()) return *there;
        const WorkLock lock(mutex_of(this));
        if (const NodeFact* there = get()) return *there;
        std::unique_ptr<const NodeFact> made = make();
        const NodeFact& fact = *made;
        fact_.store(made.release(), std::memory_order_release);
        return fact;
    }

private:
    // Shared by many slots: a mutex in each would be larger than most nodes' facts.
    [[nodiscard]] static std::mutex& mutex_of(const void* slot);

    mutable std::atomic<const NodeFact*> fact_{nullptr};
};

}  // namespace trisect::detail
