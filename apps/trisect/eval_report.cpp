// SPDX-License-Identifier: Apache-2.0
#include "eval_report.h"

#include <cstdint>

#include <fmt/format.h>

#include <sys/resource.h>

#include "values.h"

namespace trisect::app {
namespace {

Json start_of(const EvalOptions& options) {
    Json out;
    out["schema"] = "trisect.eval/1";
    out["input"] = options.input;
    out["output"] = options.output;
    return out;
}

}  // namespace

Json document_of(const EvalOptions& options, const CsgReport& report) {
    Json out = start_of(options);
    out["openscad_grid"] = options.openscad_grid;
    out["nodes"] = report.nodes;
    out["shapes"] = report.leaves;
    out["different_shapes"] = report.meshes;
    out["formulas"] = report.evaluations;
    out["found_again"] = report.found_again;
    Json kinds = Json::object();
    for (const auto& [name, count] : report.by_name)
        kinds[name] = {{"nodes", count.nodes}, {"found_again", count.found_again}};
    out["by_name"] = std::move(kinds);
    out["flat"] = report.is_flat;
    out["remarks"] = report.remarks;
    return out;
}

Json document_of(const EvalOptions& options, const CsgTree& tree) {
    Json out = start_of(options);
    out["nodes"] = tree.nodes.size();
    return out;
}

void add_peak_memory(Json& document) {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    document["peak_memory"] = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::string summary_of(const CsgReport& report, const Json& document) {
    double total = 0;
    for (const auto& seconds : document["seconds"]) total += seconds.get<double>();
    std::string out = fmt::format("{:<13}{}\n", "nodes", report.nodes);
    for (const auto& [name, count] : report.by_name) {
        out += fmt::format("  {:<16}{:>6}", name, count.nodes);
        if (count.found_again > 0) out += fmt::format("  found again {}", count.found_again);
        out += '\n';
    }
    const double megabytes =
        static_cast<double>(document["peak_memory"].get<std::uint64_t>()) / 1e6;
    return out + fmt::format(
                     "{:<13}{}, {} different\n{:<13}{}\n{:<13}{}\n{:<13}{}\n{:<13}{}\n{:<13}{:.1f} "
                     "MB at most\n{:<13}{:.3f} s",
                     "shapes", report.leaves, report.meshes, "formulas", report.evaluations,
                     "found again", report.found_again, "triangles",
                     document["triangles"].get<std::size_t>(), "volume",
                     number_text(document["volume"].get<double>()), "memory", megabytes, "time",
                     total);
}

std::string progress_text(const CsgProgress& progress) {
    const std::string done = fmt::format("{} of {} nodes done", progress.done, progress.count);
    if (progress.node == nullptr) return "the formula of the program, " + done;
    return fmt::format("{}, line {} ({})", progress.node->name.substr(0, 40),
                       progress.node->place.line, done);
}

}  // namespace trisect::app
