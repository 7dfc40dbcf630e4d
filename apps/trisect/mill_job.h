// SPDX-License-Identifier: Apache-2.0
//
// MillJob: stock, tool, holder, fixtures and steps of a run, prepared.
#pragma once

#include <trisect/brep/measure.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mill_grid.h"
#include "mill_path.h"
#include "mill_tool.h"
#include "options.h"
#include "session.h"

namespace trisect::app {

/// A move with its ends on the grid.
struct MillStep {
    bool is_rapid = false;
    bool is_placement = false;
    Point3d from{};  ///< lattice units
    Point3d to{};
    std::uint32_t orientation = 0;
    std::uint64_t line = 0;
    double end_time = 0;  ///< seconds since the start
};

/// A solid that is not cut.
struct MillBody {
    std::string name;  ///< "holder", or a fixture's file
    Solid solid;
    std::uint32_t source = 0;
};

struct MillJob {
    Solid stock;
    std::uint32_t stock_source = 0;
    double stock_volume = 0;
    std::optional<Bounds> stock_bounds;
    MillGrid grid{Lattice{}, 0};
    std::optional<MillTool> tool;
    MillBody holder;
    /// For checks between the ends of moves; empty otherwise.
    std::optional<MillTool> holder_parts;
    std::vector<MillBody> fixtures;
    ToolPath path;
    std::vector<MillStep> steps;
    std::uint64_t hash = 0;  ///< of all inputs and of the options that a result depends on
    Json facts;

    /// Where tool and holder are at the end of a step; the position is exact.
    [[nodiscard]] Pose pose_after(const MillStep& step) const;
};

/// Reads, checks and prepares all inputs.
[[nodiscard]] MillJob read_mill_job(Session& session, const MillOptions& options);

}  // namespace trisect::app
