// SPDX-License-Identifier: Apache-2.0
//
// AllCrossings: the crossings between all facets of many operands.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/special_position.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Compares the halves of the operands with each other, and each half in itself likewise.
class AllCrossings {
public:
    using Solid = OutlineStore::Solid;
    using Pairs = PoolVector<FacetCrossing>;

    /// What to do where operands touch.
    enum class Touching { GoOn, Stop };

    /// `store`: all operands, in their order.
    AllCrossings(const ManyMeshes& meshes, const OutlineStore& store, std::span<const Solid> solids,
                 const EvaluateSettings& options, Touching touching, bool parallel);
    ~AllCrossings();
    AllCrossings(const AllCrossings&) = delete;
    AllCrossings& operator=(const AllCrossings&) = delete;

    /// Each pair once, in an order that does not depend on the number of threads. False where a
    /// pair is not decided, and where operands touch if that is to stop it.
    [[nodiscard]] bool find(Pairs& out, EvaluateStats& stats);

    /// What touches; in no order.
    template <class Each>
    void for_each_special(const Each& each) {
        finders_.for_each([&](const Finder& f) { each(special_of(f)); });
    }

private:
    struct Finder;
    [[nodiscard]] static const SpecialPosition& special_of(const Finder& finder);
    [[nodiscard]] bool find_among(std::size_t first, std::size_t end, Pairs& out,
                                  EvaluateStats& stats);
    [[nodiscard]] bool find_between(std::size_t first, std::size_t middle, std::size_t end,
                                    Pairs& out, EvaluateStats& stats);
    [[nodiscard]] OutlinedSolid view(std::size_t first, std::size_t end) const;

    const ManyMeshes& meshes_;
    const OutlineStore& store_;
    std::span<const Solid> solids_;
    const EvaluateSettings& options_;
    Touching touching_;
    bool parallel_;
    std::atomic<bool> is_stopped_{false};
    PerThread<Finder> finders_;
};

}  // namespace trisect::detail
