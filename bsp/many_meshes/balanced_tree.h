// SPDX-License-Identifier: Apache-2.0
//
// BalancedTree: operands that are combined pair by pair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/many_meshes/common_part.h>
#include <trisect/bsp/many_meshes/operand_order.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/outlines/settled_parts.h>
#include <trisect/kernel/support/per_thread.h>

namespace trisect::detail {

/// Of a thread, as Diagnostics<HalfCounters> has them (kernel/diagnostics.h): pairs of halves that
/// another thread could have taken one of.
struct HalfCounters {
    std::uint64_t in_place = 0;  ///< both were made by the thread, one behind the other
    std::uint64_t moved = 0;     ///< one comes from the store that it was made in

    HalfCounters& operator-=(const HalfCounters& o) {
        in_place -= o.in_place;
        moved -= o.moved;
        return *this;
    }
};

/// Halves of it are worked on at the same time. What is found does not depend on threads.
class BalancedTree {
public:
    using Solid = OutlineStore::Solid;

    /// `parallel`: on all threads of the arena.
    BalancedTree(const ManyMeshes& meshes, const SolidStates& solids,
                 const EvaluateSettings& options, bool parallel);

    /// What all operands leave open together. Nothing where sides are not known.
    [[nodiscard]] std::optional<Solid> of_all(EvaluateStats& stats) const;
    /// With what that is of, once it is all.
    [[nodiscard]] OutlineStore take_store();

    /// Of all so far; in no order.
    template <class Each>
    void for_each_special(const Each& each) const {
        common_.for_each([&](const CommonPart& c) { each(c.special()); });
    }

private:
    using Slots = std::span<const std::uint32_t>;
    using Clusters = std::span<const std::vector<std::uint32_t>>;
    using Terms = std::span<const std::uint32_t>;
    using Pair = std::pair<std::optional<Solid>, std::optional<Solid>>;

    // Of formulas that are not nested.
    [[nodiscard]] std::optional<Solid> of_operand(std::uint32_t slot) const;
    [[nodiscard]] std::optional<Solid> of_rest(EvaluateStats& stats) const;
    [[nodiscard]] std::optional<Solid> of(Slots slots, EvaluateStats& stats) const;
    [[nodiscard]] std::optional<Solid> of_clusters(Clusters clusters, EvaluateStats& stats) const;

    // Of a node of one that is nested.
    [[nodiscard]] std::optional<Solid> of_node(std::uint32_t number, EvaluateStats& stats) const;
    [[nodiscard]] std::optional<Solid> of_node_with_settled(std::uint32_t number,
                                                            EvaluateStats& stats) const;
    [[nodiscard]] bool has_one_of_neighbours(std::uint32_t number) const;
    [[nodiscard]] std::optional<Solid> of_term_and_neighbours(std::uint32_t number,
                                                              EvaluateStats& stats) const;
    [[nodiscard]] std::optional<Solid> of_terms_and_neighbours(std::uint32_t number,
                                                               EvaluateStats& stats) const;
    [[nodiscard]] std::optional<Solid> of_boundary_and_neighbours(std::uint32_t number,
                                                                  const Solid& boundary,
                                                                  Slots slots, bool complements,
                                                                  EvaluateStats& stats) const;
    [[nodiscard]] std::optional<Solid> of_neighbours(Slots slots, const ClearBox& clear,
                                                     const Settling& how,
                                                     EvaluateStats& stats) const;
    [[nodiscard]] std::optional<Solid> of_terms(Terms terms, bool unites,
                                                EvaluateStats& stats) const;

    // Of two halves; defined with all that calls them.
    template <class Below, class Above>
    [[nodiscard]] Pair both(std::size_t facets, EvaluateStats& stats, const Below& below_by,
                            const Above& above_by) const;
    template <class Below, class Above>
    [[nodiscard]] Pair both_in_parallel(const Below& below_by, const Above& above_by) const;
    template <class By>
    [[nodiscard]] std::optional<Solid> or_nothing(const By& by) const;
    template <class Below, class Above>
    [[nodiscard]] std::optional<Solid> common_of(std::size_t facets, EvaluateStats& stats,
                                                 const Below& below_by,
                                                 const Above& above_by) const;
    [[nodiscard]] CommonPart& common() const;

    [[nodiscard]] std::size_t facets_of_terms(Terms terms) const;
    [[nodiscard]] std::size_t facets_of(Slots slots) const;

    const ManyMeshes& meshes_;
    const EvaluateSettings& options_;
    bool parallel_;
    std::size_t least_in_parallel_;  // facets
    OperandOrder order_;
    mutable PerThread<CommonPart> common_;
};

}  // namespace trisect::detail
