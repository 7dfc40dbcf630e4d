// SPDX-License-Identifier: Apache-2.0
#include "mill_checkpoint.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <iterator>

namespace trisect::app {
namespace {

constexpr const char* checkpoint_schema = "trisect.mill-checkpoint/1";
constexpr std::uint64_t checkpoint_limit = std::uint64_t{4} << 30;

MillRecord record_of(const Json& row) {
    MillRecord r;
    r.removed = row.at(0).get<double>();
    r.times = {row.at(1).get<double>(), row.at(2).get<double>(), row.at(3).get<double>(),
               row.at(4).get<double>()};
    r.has_collision = row.at(5).get<int>() != 0;
    return r;
}

const char* kind_of(const MillStep& step) {
    if (step.is_placement) return "placement";
    return step.is_rapid ? "rapid" : "cut";
}

}  // namespace

std::string checkpoint_text(const MillJob& job, const MillRun& run) {
    std::string out = fmt::format("{{\"schema\": \"{}\",\n\"inputs\": \"{:016x}\",\n\"steps\": [",
                                  checkpoint_schema, job.hash);
    const char* separator = "\n";
    for (const MillRecord& r : run.records()) {
        const MillTimes& t = r.times;
        fmt::format_to(std::back_inserter(out), "{}[{},{:.4f},{:.4f},{:.4f},{:.4f},{}]", separator,
                       r.removed, t.sweep, t.cut, t.volume, t.check, r.has_collision ? 1 : 0);
        separator = ",\n";
    }
    return out + "],\n\"collisions\": " + Json(run.collisions()).dump() + "}\n";
}

MillCheckpoint read_checkpoint(const std::string& file, const MillJob& job) {
    const FileBytes bytes = read_file(file, checkpoint_limit);
    const FilePlace place{file, 1, 0, 0};
    MillCheckpoint out;
    try {
        const Json document = Json::parse(bytes.view());
        if (document.at("schema") != checkpoint_schema)
            throw InputError(place, "is no checkpoint of a mill");
        if (document.at("inputs") != fmt::format("{:016x}", job.hash))
            throw InputError(place, "is of other inputs or options than these");
        for (const Json& row : document.at("steps")) out.records.push_back(record_of(row));
        out.collisions = document.at("collisions");
    } catch (const Json::exception& e) {
        throw InputError(place, std::string("is no checkpoint of a mill: ") + e.what());
    }
    if (out.records.size() > job.steps.size())
        throw InputError(place, "has more steps than the path");
    return out;
}

std::string step_table(const MillJob& job, const MillRun& run) {
    std::string out =
        "step,line,kind,x,y,z,seconds,removed,sweep_ms,cut_ms,volume_ms,check_ms,collision\n";
    for (std::size_t i = 0; i < run.done(); ++i) {
        const MillStep& s = job.steps[i];
        const MillRecord& r = run.records()[i];
        const Point3d p = job.grid.to_user(s.to);
        fmt::format_to(std::back_inserter(out),
                       "{},{},{},{},{},{},{:.4f},{},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", i + 1,
                       s.line, kind_of(s), p[0], p[1], p[2], s.end_time, r.removed, r.times.sweep,
                       r.times.cut, r.times.volume, r.times.check, r.has_collision ? 1 : 0);
    }
    return out;
}

}  // namespace trisect::app
