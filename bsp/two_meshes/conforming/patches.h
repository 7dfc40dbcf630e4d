// SPDX-License-Identifier: Apache-2.0
//
// Patches: sets of facets on one side of another mesh, or on it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

/// How a facet lies to the other mesh.
enum class FacetRelation : std::uint8_t {
    Unknown,
    Above,  ///< of the other mesh's facets
    Below,
    Same,     ///< facets of the other mesh cover it and face the same way
    Opposite  ///< they face the other way
};

/// Items that are joined, and what is found out about a set of them.
class Patches {
public:
    /// Each of them alone. Memory is the arena's.
    Patches(std::uint32_t count, StackArena& arena)
        : count_(count),
          parents_(arena.take<std::uint32_t>(count)),
          facts_(arena.take<Facts>(count)) {
        std::iota(parents_, parents_ + count, 0U);
        std::fill(facts_, facts_ + count, Facts{});
    }
    [[nodiscard]] std::uint32_t root(std::uint32_t i) const {
        while (parents_[i] != i) i = parents_[i];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = shortened(a);
        b = shortened(b);
        if (a == b) return;
        if (b < a) std::swap(a, b);
        parents_[b] = a;
        if (facts_[b].is_covered) facts_[a].is_covered = true;
        if (facts_[b].side != FacetRelation::Unknown) set_side(a, facts_[b].side);
    }
    /// Facets of both meshes that cover a part of a plane are in one set.
    void join_covering(std::uint32_t a, std::uint32_t b) {
        join(a, b);
        facts_[root(a)].is_covered = true;
    }
    void set_side(std::uint32_t i, FacetRelation side) {
        FacetRelation& known = facts_[root(i)].side;
        if (known != FacetRelation::Unknown && known != side) is_consistent_ = false;
        known = side;
    }
    [[nodiscard]] FacetRelation side(std::uint32_t i) const { return facts_[root(i)].side; }
    [[nodiscard]] bool is_covered(std::uint32_t i) const { return facts_[root(i)].is_covered; }
    /// Once all are joined; then others may read from several threads. Parents come before their
    /// children.
    void flatten() {
        for (std::uint32_t i = 0; i < count_; ++i) parents_[i] = parents_[parents_[i]];
    }
    /// Whether no set was found to be on two sides.
    [[nodiscard]] bool is_consistent() const { return is_consistent_; }

private:
    struct Facts {
        FacetRelation side = FacetRelation::Unknown;
        bool is_covered = false;
    };
    // The root; halves the path.
    [[nodiscard]] std::uint32_t shortened(std::uint32_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }

    std::uint32_t count_;
    std::uint32_t* parents_;
    Facts* facts_;  // of roots
    bool is_consistent_ = true;
};

}  // namespace trisect::detail
