// SPDX-License-Identifier: Apache-2.0
#include "mill_run.h"

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>

#include <chrono>
#include <utility>

namespace trisect::app {
namespace {

EvaluateOptions small_work() {
    EvaluateOptions options;
    options.threads = 1;
    return options;
}

/// The result, and the milliseconds it took.
template <class Work>
auto timed(double& milliseconds, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    milliseconds += time.count();
    return result;
}

}  // namespace

MillRun::MillRun(const MillJob& job, const MillOptions& options)
    : job_(job), tool_(*job.tool), checks_(job, options), stock_(job.stock) {}

SweptTool MillRun::swept() {
    const MillStep& step = job_.steps[done()];
    // Where a step ended without a collision the tool is in what was removed, or in the air.
    const bool is_clear = done() > 0 && !records_.back().has_collision;
    return tool_.swept(step.orientation, step.from, step.to, is_clear);
}

Solid MillRun::cut(const SweptTool& tool) const {
    return evaluate(stock_ - tool.solid, small_work());
}

void MillRun::repeat(const MillRecord& record) {
    if (record.removed > 0) {
        const SweptTool tool = swept();
        stock_ = cut(tool);
        checks_.name_cut(tool, done());
    }
    records_.push_back(record);
}

void MillRun::step() {
    const std::size_t index = done();
    const MillStep& step = job_.steps[index];
    MillRecord record;
    MillTimes& times = record.times;
    const SweptTool tool = timed(times.sweep, [&] { return swept(); });
    std::vector<Json> found =
        timed(times.check, [&] { return checks_.of_tool(index, tool, stock_); });
    Solid left = stock_;
    if (!step.is_rapid) {
        record.removed = timed(times.volume,
                               [&] { return volume(evaluate(stock_ & tool.solid, small_work())); });
        if (record.removed > 0) left = timed(times.cut, [&] { return cut(tool); });
    }
    if (record.removed > 0) checks_.name_cut(tool, index);
    const std::vector<Json> of_holder =
        timed(times.check, [&] { return checks_.of_holder(index, left); });
    found.insert(found.end(), of_holder.begin(), of_holder.end());
    record.has_collision = !found.empty();
    stock_ = std::move(left);
    records_.push_back(record);
    collisions_.insert(collisions_.end(), found.begin(), found.end());
}

double MillRun::removed() const {
    double sum = 0;
    for (const MillRecord& r : records_) sum += r.removed;
    return sum;
}

}  // namespace trisect::app
