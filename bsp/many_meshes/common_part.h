// SPDX-License-Identifier: Apache-2.0
//
// CommonPart: the intersection of two outlined solids.
#pragma once

#include <memory>
#include <optional>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/many_meshes/outlined_solid.h>
#include <trisect/bsp/many_meshes/spare_outlines.h>
#include <trisect/bsp/many_meshes/special_position.h>

namespace trisect::detail {

/// Keeps its memory from one intersection to the next.
class CommonPart {
public:
    CommonPart(const ManyMeshes& meshes, const EvaluateSettings& options);
    ~CommonPart();
    CommonPart(const CommonPart&) = delete;
    CommonPart& operator=(const CommonPart&) = delete;

    [[nodiscard]] SpareOutlines& spare();
    /// What both leave open. Nothing where sides are not known. O(n log n) where facets meet few
    /// others.
    [[nodiscard]] std::optional<OutlinedSolid> of(OutlinedSolid first, OutlinedSolid second,
                                                  EvaluateStats& stats);
    /// Of all so far.
    [[nodiscard]] const SpecialPosition& special() const;

private:
    class Steps;
    std::unique_ptr<Steps> steps_;
};

}  // namespace trisect::detail
