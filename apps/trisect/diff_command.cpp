// SPDX-License-Identifier: Apache-2.0
//
// diff A B: do two meshes bound the same set? Decided by the symmetric difference, exactly: equal
// sets may have different triangles, and sets that differ by less than any printed digit differ.
#include <trisect/bsp/expression.h>

#include <fmt/format.h>

#include <array>

#include "commands.h"
#include "description.h"
#include "import_notes.h"
#include "mesh_files.h"
#include "operand.h"
#include "report_json.h"
#include "values.h"

namespace trisect::app {
namespace {

Json measure_json(const Description& description) {
    Json out;
    out["volume"] = description.volume ? Json(*description.volume) : Json();
    if (description.volume_exact) out["volume_exact"] = description.volume_exact->to_string();
    const Json all = to_json(description);
    for (const char* key : {"shells", "faces", "bounds"}) out[key] = all[key];
    return out;
}

Description describe_set(const Solid& solid, bool exact) {
    return describe(solid.to_brep(), {exact});
}

std::string answer_text(const Description& both, const Description& first,
                        const Description& second) {
    std::string out = "different\n";
    const auto line = [&out](const char* name, const Description& d) {
        out += fmt::format("{:<9}volume {} in {} shells\n", name, number_text(d.volume.value_or(0)),
                           d.shells);
        if (d.volume_exact) out += fmt::format("{:<9}{}\n", "", d.volume_exact->to_string());
        if (d.bounds) {
            out += fmt::format("{:<9}{} to {}\n", "", place_text(d.bounds->lo),
                               place_text(d.bounds->hi));
        }
    };
    line("xor", both);
    line("only A", first);
    line("only B", second);
    return out;
}

}  // namespace

void add_diff_command(CLI::App& app, DiffOptions& options) {
    CLI::App* command = app.add_subcommand("diff", "are two sets equal? exit code 1 if not");
    command->add_option("A", options.inputs[0], "mesh file, or an exact boundary (.exact)")
        ->required();
    command->add_option("B", options.inputs[1], "the same")->required();
    command->add_flag("--exact", options.exact, "also the volumes as fractions");
    add_operand_options(*command, options.operands);
}

Outcome run_diff(Session& session, const DiffOptions& options) {
    session.plan(3);
    const std::vector<Operand> operands = session.stage(
        "read", [&] { return read_operands(session, options.inputs, options.operands); });
    const EvaluateOptions evaluation = session.evaluation_options(options.operands);
    const Expression a = operands[0].solid;
    const Expression b = operands[1].solid;
    EvaluateReport report;
    // Not taken apart by name: lambdas cannot capture structured bindings in clang 14.
    const auto sets = session.interruptible_stage("evaluate", [&] {
        return std::array{evaluate(a ^ b, evaluation, &report), evaluate(a - b, evaluation),
                          evaluate(b - a, evaluation)};
    });
    note_rounding(session, report.lattice, "the operands");
    Outcome out;
    const bool equal = sets[0].is_empty();
    out.code = equal ? exit_done : exit_findings;
    out.document["schema"] = "trisect.diff/1";
    out.document["inputs"] = {operands[0].facts, operands[1].facts};
    out.document["equal"] = equal;
    out.document["lattice"] = lattice_json(report.lattice);
    session.stage("measure", [&] {
        const Description both = describe_set(sets[0], options.exact);
        const Description first = describe_set(sets[1], options.exact);
        const Description second = describe_set(sets[2], options.exact);
        out.document["symmetric_difference"] = measure_json(both);
        out.document["only_first"] = measure_json(first);
        out.document["only_second"] = measure_json(second);
        out.answer = equal ? "equal\n" : answer_text(both, first, second);
    });
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace trisect::app
