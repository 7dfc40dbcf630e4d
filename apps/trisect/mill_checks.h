// SPDX-License-Identifier: Apache-2.0
//
// MillChecks: exact checks of tool and holder, and collisions with names.
#pragma once

#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/solid.h>

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "mill_job.h"
#include "mill_tool.h"
#include "outcome.h"

namespace trisect::app {

/// The checks of a run. It learns the names of faces that steps cut, so that a collision says which
/// step made the face that the holder meets.
class MillChecks {
public:
    MillChecks(const MillJob& job, const MillOptions& options);

    /// The tool's faces of step `index` may become faces of the stock.
    void name_cut(const SweptTool& tool, std::size_t index);

    /// The tool on its way: through fixtures, and where it must not cut through the stock as it
    /// was before.
    [[nodiscard]] std::vector<Json> of_tool(std::size_t index, const SweptTool& tool,
                                            const Solid& stock) const;
    /// The holder at the end of the step and between its ends, after the cut.
    [[nodiscard]] std::vector<Json> of_holder(std::size_t index, const Solid& stock);

private:
    /// Of the holder between the ends of a step.
    void check_way(std::size_t index, const Solid& stock, std::vector<Json>& out);

    struct Pair {
        const char* kind;
        const char* name_a;
        const Solid& a;
        const Pose& pose_a;
        const std::string& name_b;
        const Solid& b;
    };
    void check(const Pair& pair, std::size_t index, bool touch_counts,
               std::vector<Json>& out) const;
    [[nodiscard]] Json collision(const Pair& pair, std::size_t index, Relation relation) const;
    [[nodiscard]] Json entity_json(const EntityName& entity) const;
    [[nodiscard]] std::string face_name(const FaceSource& face) const;
    void add_place(const Pair& pair, Json& out) const;

    const MillJob& job_;
    std::optional<MillTool> holder_parts_;
    bool touch_;
    std::string stock_name_ = "stock";
    std::unordered_map<std::uint32_t, std::string> bodies_;
    std::unordered_map<std::uint32_t, std::size_t> cuts_;  // steps
};

/// A sentence for people, and lines of the faces that meet.
[[nodiscard]] std::string collision_text(const Json& collision, std::size_t step_count);

}  // namespace trisect::app
