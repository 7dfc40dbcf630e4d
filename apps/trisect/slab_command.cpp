// SPDX-License-Identifier: Apache-2.0
#include "slab_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <trisect/kernel/error.h>

#include "output_name.h"
#include "pieces/piece_join.h"

namespace trisect::app {

void add_slab_options(CLI::App& command, BooleanOptions& options) {
    command
        .add_option("--slabs", options.slabs,
                    "evaluate in at least so many slabs of space, one after the other, for inputs "
                    "larger than memory; done by itself where --max-memory is too little without")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));
    command
        .add_option("--pieces", options.pieces,
                    "in slabs: also a native file of each, in this folder")
        ->type_name("FOLDER");
    command.add_flag("--resume", options.resume,
                     "in slabs: go on after a kill, from what is in OUTPUT.slabs");
}

bool wants_slabs(const Session& session, const BooleanOptions& options) {
    if (options.slabs != 0 || options.resume || !options.pieces.empty()) return true;
    const CommonOptions& common = session.options();
    if (common.max_memory == 0 || options.faces || options.source_faces || options.repair ||
        options.operands.properties || options.exact || !options.boundary.empty() ||
        common.lattice || common.format || common.input_format)
        return false;
    SlabOptions asked;
    asked.operation = options.operation;
    asked.inputs = options.inputs;
    asked.output = options.output;
    asked.memory = common.max_memory;
    return needs_slabs(asked);
}

SlabOptions slab_options(const Session& session, const BooleanOptions& options) {
    const CommonOptions& common = session.options();
    if (!is_slab_operation(options.operation))
        throw UsageError("--slabs: not for " + options.operation);
    if (options.faces || options.source_faces || options.repair || options.operands.properties ||
        options.exact || !options.boundary.empty() || common.lattice || common.format ||
        common.input_format)
        throw UsageError(
            "--slabs: not together with --faces, --source-faces, --repair, --properties, --exact, "
            "--boundary, --lattice, --format and --input-format");
    if (!can_join_into(options.output))
        throw UsageError(options.output + ": slabs are joined into .ply or .stl");
    check_outputs(session, {options.output});
    SlabOptions out;
    out.operation = options.operation;
    out.inputs = options.inputs;
    out.output = options.output;
    out.folder = options.output + ".slabs";
    out.memory = common.max_memory;
    out.slabs = options.slabs;
    out.embedding = options.operands.assume_embedded ? Embedding::Assume : Embedding::Check;
    out.resume = options.resume;
    out.natives = options.pieces;
    return out;
}

Outcome slab_outcome(const Session& session, const BooleanOptions& options, const SlabPlan& plan,
                     const JoinedMesh& joined) {
    constexpr std::string_view axes = "xyz";
    Outcome out;
    out.document["schema"] = "trisect.slabs/1";
    out.document["op"] = options.operation;
    out.document["inputs"] = Json::array();
    for (std::size_t i = 0; i < options.inputs.size(); ++i)
        out.document["inputs"].push_back(
            {{"file", options.inputs[i]}, {"triangles", plan.triangles[i]}});
    out.document["embedding"] = options.operands.assume_embedded ? "assumed" : "checked";
    out.document["output"] = {
        {"file", options.output}, {"triangles", joined.triangles}, {"points", joined.points}};
    out.document["slabs"] = {{"count", plan.slabs.count()},
                             {"axis", std::string(1, axes[plan.slabs.axis()])},
                             {"wall_points", joined.wall_points},
                             {"loads", Json::array()}};
    for (std::size_t i = 0; i < plan.slabs.count(); ++i)
        out.document["slabs"]["loads"].push_back(plan.slabs.load(i));
    out.document["seconds"] = session.seconds();
    double total = 0;
    for (const auto& seconds : session.seconds()) total += seconds.get<double>();
    out.remarks =
        fmt::format("{:<13}{} triangles, {} points\n{:<13}{} across {}, {} points on walls\n",
                    options.operation, joined.triangles, joined.points, "slabs", plan.slabs.count(),
                    axes[plan.slabs.axis()], joined.wall_points);
    out.remarks += fmt::format("{:<13}{:.3f} s", "time", total);
    return out;
}

Outcome run_in_slabs(Session& session, const BooleanOptions& options) {
    SlabRun run(slab_options(session, options));
    session.plan(4);
    JoinedMesh joined;
    try {
        session.stage("survey", [&] { run.plan(); });
        session.interruptible_stage("distribute", [&] {
            while (run.distributed() == 0)
                run.distribute(0, 1) ? run.note_distributed(1) : run.move_walls();
            return 0;
        });
        const EvaluateOptions evaluation = session.evaluation_options(options.operands);
        session.interruptible_stage("evaluate", [&] {
            for (const std::size_t slab : run.order())
                if (!run.is_done(slab)) run.evaluate(slab, run.distributed(), evaluation);
            return 0;
        });
        joined = session.stage("join", [&] { return run.join(); });
    } catch (...) {
        if (!options.resume) run.clean();
        throw;
    }
    run.clean();
    return slab_outcome(session, options, run.current_plan(), joined);
}

}  // namespace trisect::app
