// SPDX-License-Identifier: Apache-2.0
//
// CommonPart: the intersection of two outlined solids.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/many_meshes/outlines/outline_store.h>
#include <trisect/bsp/many_meshes/special_position.h>
#include <trisect/bsp/many_meshes/vertex_sides.h>

namespace trisect::detail {

/// Keeps its memory from one intersection to the next.
class CommonPart {
public:
    CommonPart(const ManyMeshes& meshes, const EvaluateSettings& options);
    ~CommonPart();
    CommonPart(const CommonPart&) = delete;
    CommonPart& operator=(const CommonPart&) = delete;

    /// With the solids of the calling thread.
    [[nodiscard]] OutlineStore& store();
    /// What the last two solids of the store both leave open, which takes their place. Nothing
    /// where sides are not known. O(n log n) where facets meet few others.
    using Solid = OutlineStore::Solid;
    using Known = std::span<const VertexSides::Side>;
    struct How {
        /// By vertex of the second one, the first one's side on which it is, as far as that is
        /// known beforehand; empty where nothing is.
        Known known;
        /// 1, or 0 for all, where they have nothing else to do.
        std::uint32_t threads = 1;
    };
    [[nodiscard]] std::optional<Solid> of(const Solid& first, const Solid& second,
                                          EvaluateStats& stats, const How& how);
    /// Whether the corner of an operand is in a set. \pre it is on no boundary of the set. O(n)
    [[nodiscard]] bool is_open_at_corner(const OutlineVertex& corner,
                                         const OutlinedSolid& solid) const;
    /// Of all so far.
    [[nodiscard]] const SpecialPosition& special() const;

private:
    class Steps;
    std::unique_ptr<Steps> steps_;
};

}  // namespace trisect::detail
