// SPDX-License-Identifier: Apache-2.0
//
// PairsOfMeshes: all pairs of facets of two meshes that cross.
#pragma once

#include <memory>
#include <optional>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/evaluate_stats.h>
#include <trisect/bsp/two_meshes/equal_facets.h>
#include <trisect/bsp/two_meshes/pair_search.h>
#include <trisect/bsp/two_meshes/two_meshes.h>

namespace trisect::detail {

/// What has been found out about two meshes.
struct FoundPairs {
    Crossings crossings;
    std::optional<EqualFacets> equal;
    bool shares_facets = false;  ///< a facet bounds the result for both meshes
    bool has_sheets = false;     ///< no move was as wanted (sheets.h)
    bool is_general = false;     ///< all pairs are in general position
    /// The first move was as wanted and as wished. What one operation wants another one with the
    /// same value of the first mesh wishes: their first move is the same, and as they wish.
    bool has_first_move = false;
};

/// Whether one mesh is taken from the other one, on which it does not stand, and their boxes begin
/// and end at the same places along an axis: facets there would want opposite directions.
[[nodiscard]] bool are_flush_on_both_sides(const TwoMeshes& two, const Crossings& crossings);

/// Pairs that doubles leave open are decided as if one mesh were moved.
class PairsOfMeshes {
public:
    /// All but the settings outlive it.
    PairsOfMeshes(const TwoMeshes& two, const TwoLists& near, const EvaluateSettings& options,
                  MemoryBudget& memory, bool parallel, const Crossings& operands);
    PairsOfMeshes(const PairsOfMeshes&) = delete;
    PairsOfMeshes& operator=(const PairsOfMeshes&) = delete;
    ~PairsOfMeshes();

    struct How {
        bool recognises_equal = true;  ///< facets of both; else they are as others of one plane
        bool leaves_sheets = true;     ///< else nothing where no move is as wanted
    };
    /// Arranged. Nothing when a pair cannot be decided.
    [[nodiscard]] std::optional<FoundPairs> find(const How& how, EvaluateStats& stats);

private:
    class Search;
    std::unique_ptr<Search> search_;
};

}  // namespace trisect::detail
