// SPDX-License-Identifier: Apache-2.0
//
// ContainedCells: cells contained in one operand, with polygons of others.
// These polygons are not compared with each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/expression.h>

namespace trisect::detail {

/// Remembers such cells until all other crossings are known. Then it shows which facets may bound
/// the result elsewhere: only of those the crossings in such cells count (traced_facets.h).
class ContainedCells {
public:
    /// \pre all operands of the task with polygons are lists of whole facets of one source each
    void add(const CellTask& task);
    /// What another thread has remembered of the same formula.
    void append(const ContainedCells& part);
    /// Adds the crossings in these cells of all facets that leaves have `seen` crossed, by number;
    /// other facets of crossings are hidden. \pre `crossings` has what all leaves have found, not
    /// yet arranged
    void compare(std::span<const std::uint32_t> seen, const EvaluateSettings& options,
                 EvaluateStats& stats, Crossings& crossings) const;

private:
    template <class IsCrossed>
    void add_crossings(const IsCrossed& is_crossed, const EvaluateSettings& options,
                       EvaluateStats& stats, Crossings& crossings) const;

    struct Operand {
        std::int32_t slot = -1;
        const Source* source = nullptr;
        bool flipped = false;       // the polygons
        bool complemented = false;  // the operand
        int winding = 0;
        std::size_t end = 0;  // of its facets in facets_
    };
    struct Covered {
        Cell cell;
        FinePoint reference;
        std::size_t end = 0;  // of its operands in operands_
    };
    std::vector<Covered> cells_;
    std::vector<Operand> operands_;
    std::vector<std::uint32_t> facets_;
};

}  // namespace trisect::detail
