// SPDX-License-Identifier: Apache-2.0
//
// MillRun: the stock, cut step by step, with checks and times.
#pragma once

#include <trisect/bsp/solid.h>

#include <cstddef>
#include <vector>

#include "mill_checks.h"
#include "mill_job.h"

namespace trisect::app {

/// What a step took, in milliseconds.
struct MillTimes {
    double sweep = 0;   ///< the tool's swept solid
    double cut = 0;     ///< stock less tool
    double volume = 0;  ///< what was removed, and its volume
    double check = 0;   ///< all checks
    [[nodiscard]] double total() const { return sweep + cut + volume + check; }
};

/// A step that was done.
struct MillRecord {
    double removed = 0;  ///< volume, correctly rounded
    MillTimes times;
    bool has_collision = false;
};

class MillRun {
public:
    MillRun(const MillJob& job, const MillOptions& options);

    /// Cuts again what was cut before, without measures and checks; what is evaluated is the same.
    void repeat(const MillRecord& record);
    /// The next step, wholly or, where it throws, not at all.
    void step();
    void add_collisions(const Json& list) {
        collisions_.insert(collisions_.end(), list.begin(), list.end());
    }

    [[nodiscard]] const Solid& stock() const { return stock_; }
    [[nodiscard]] std::size_t done() const { return records_.size(); }
    [[nodiscard]] bool is_finished() const { return done() == job_.steps.size(); }
    [[nodiscard]] bool has_collision() const { return !collisions_.empty(); }
    [[nodiscard]] const std::vector<MillRecord>& records() const { return records_; }
    [[nodiscard]] const std::vector<Json>& collisions() const { return collisions_; }
    /// The sum over all steps.
    [[nodiscard]] double removed() const;

private:
    /// Of the next step.
    [[nodiscard]] SweptTool swept();
    [[nodiscard]] Solid cut(const SweptTool& tool) const;

    const MillJob& job_;
    MillTool tool_;
    MillChecks checks_;
    Solid stock_;
    std::vector<MillRecord> records_;
    std::vector<Json> collisions_;
};

}  // namespace trisect::app
