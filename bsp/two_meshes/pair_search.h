// SPDX-License-Identifier: Apache-2.0
//
// PairSearch: search for the pairs of facets in which two meshes cross.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/evaluate_stats.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/two_meshes/conforming/conforming_meshes.h>

namespace trisect::detail {

/// Facets of either mesh.
using TwoLists = std::array<std::vector<std::uint32_t>, 2>;

/// Cells with fewer facets are not worth a task of their own.
inline constexpr std::uint64_t parallel_facets = 4096;

class PairSearch {
public:
    struct Outcome {
        bool is_hopeless = false;  ///< no move along the axes, or not the one that was tried, is
                                   ///< as wanted; then the search ended
        bool has_equal = false;    ///< some facet has an equal; all else is left out then
        bool is_certain = true;    ///< all pairs were decided
        /// Directions, by their signs, in which the second mesh must be moved: else both meshes
        /// bound the result where they have a part of a plane in common. They do not depend on how
        /// it was moved.
        std::vector<std::array<int, 3>> wanted;
        /// The same where only one does, and the first one had better.
        std::vector<std::array<int, 3>> wished;
        bool is_as_wanted = true;  ///< it was moved so
        bool is_as_wished = true;
        bool has_wish = false;    ///< where corners move, or the mesh grows
        bool has_sheets = false;  ///< likewise: it was not moved so, as `most_sheets` allows
    };

    /// `nodes` list the two meshes.
    PairSearch(const std::array<const CellNode*, 2>& nodes, const EvaluateSettings& options,
               MemoryBudget& memory, bool parallel)
        : nodes_(nodes), options_(options), memory_(memory), parallel_(parallel) {}

    std::vector<TwoLists> parts;   ///< all of one list with all of the other, part after part
    bool recognises_equal = true;  ///< else they are as other facets of one plane
    /// Growth is hopeless only where more pairs of facets of one plane are moved against what is
    /// wanted; if 0, at the first one of which both cover a part of it.
    std::uint64_t most_sheets = 0;
    /// If not null, all that is done is to call it cell by cell; the first false makes it hopeless.
    const PairsCheck* check = nullptr;

    /// Appends the crossings, and facets in special position.
    [[nodiscard]] Outcome run(Crossings& crossings, EvaluateStats& stats) const;

private:
    std::array<const CellNode*, 2> nodes_;
    const EvaluateSettings& options_;
    MemoryBudget& memory_;
    bool parallel_;
};

}  // namespace trisect::detail
