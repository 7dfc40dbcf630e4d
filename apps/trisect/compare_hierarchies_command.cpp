// SPDX-License-Identifier: Apache-2.0
//
// compare-hierarchies A B --motion FILE: what each structure for interference queries costs while B
// moves: built, counted, predicted by the cost function, measured. All of them give the same exact
// answers; where two do not, that is a defect and said as one.
#include "compare_hierarchies_command.h"

#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "../scenes/comparison.h"
#include "command_with.h"
#include "commands.h"
#include "hierarchies_page.h"
#include "motion_file.h"
#include "operand.h"
#include "output_name.h"
#include "page_entities.h"
#include "values.h"

namespace trisect::app {
namespace {

struct CompareHierarchiesOptions {
    std::array<std::string, 2> inputs;
    std::string motion;  ///< a file: how the second one moves
    std::int64_t frames = 100;
    std::vector<std::string> structures;  ///< by name; empty: all
    std::string chart;                    ///< empty: none
    std::string page;                     ///< empty: none
    OperandOptions operands;
};

std::vector<hierarchies::StructureKind> kinds_of(const std::vector<std::string>& names) {
    std::vector<hierarchies::StructureKind> kinds;
    for (const std::string& name : names) {
        const auto kind = hierarchies::structure_kind(name);
        if (!kind) {
            std::string known;
            for (const auto& i : hierarchies::all_structures())
                known += (known.empty() ? "" : ", ") + std::string(i.name);
            throw UsageError("--structure: '" + name + "' is none of " + known);
        }
        kinds.push_back(*kind);
    }
    return kinds;
}

std::vector<Pose> frames_of(const Motion& motion, std::int64_t frames) {
    std::vector<Pose> poses;
    const ExactRational end(static_cast<std::int64_t>(motion.piece_count()));
    for (std::int64_t i = 0; i < frames; ++i)
        poses.push_back(motion.pose_at(end * ExactRational(i) / ExactRational(frames - 1)));
    return poses;
}

Json question_json(const scenes::QuestionCost& q) {
    Json out;
    out["updates"] = q.counters.updates;
    out["volume_tests"] = q.counters.volume_tests;
    out["primitive_tests"] = q.counters.primitive_tests;
    out["closest_tests"] = q.counters.closest_tests;
    out["exact_tests"] = q.counters.exact_tests;
    out["predicted_seconds"] = q.predicted;
    out["measured_seconds"] = q.measured;
    return out;
}

Json structures_json(const scenes::Comparison& comparison) {
    Json out = Json::array();
    for (const scenes::StructureCost& s : comparison.structures) {
        Json row;
        row["name"] = s.name;
        row["build_seconds"] = s.build.seconds;
        row["bytes"] = s.build.bytes;
        row["volumes"] = s.build.volumes;
        row["depth"] = s.build.depth;
        for (const scenes::QuestionCost& q : s.questions)
            row[scenes::to_string(q.question)] = question_json(q);
        out.push_back(std::move(row));
    }
    return out;
}

std::string answers_text(const scenes::Comparison& comparison) {
    std::string out = fmt::format("{} frames:", comparison.frames);
    for (const auto& [relation, n] : comparison.answers.relations)
        out += fmt::format(" {} {}", relation, n);
    return out + fmt::format("; pairs of faces that meet {}; least distance {}\n\n",
                             comparison.answers.face_pairs,
                             number_text(comparison.answers.least_distance));
}

void write_page(Session& session, const CompareHierarchiesOptions& options,
                const std::array<InterferenceModel, 2>& models, const Motion& motion,
                const scenes::Comparison& comparison) {
    std::array<PlacedBody, 2> bodies;
    for (std::size_t i = 0; i < 2; ++i)
        bodies.at(i) = {short_name(options.inputs.at(i)), models.at(i), identity_pose};
    std::vector<PosePlace> places;
    for (std::int64_t i = 0; i < options.frames; ++i)
        places.push_back(motion.approximate_pose_at(static_cast<double>(motion.piece_count()) *
                                                    static_cast<double>(i) /
                                                    static_cast<double>(options.frames - 1)));
    session.write_output(options.page, hierarchies_page(bodies, frames_of(motion, options.frames),
                                                        places, comparison));
}

void add_command(CLI::App& app, CompareHierarchiesOptions& options) {
    CLI::App* command = app.add_subcommand(
        "compare-hierarchies", "what structures for interference queries cost while a solid moves");
    command->add_option("A", options.inputs[0], "mesh file")->required();
    command->add_option("B", options.inputs[1], "mesh file of the solid that moves")->required();
    command
        ->add_option("--motion", options.motion,
                     "how B moves: a pose of twelve numbers a line, or 'screw' lines")
        ->required()
        ->type_name("FILE");
    command
        ->add_option_function<std::string>(
            "--frames",
            [&options](const std::string& s) { options.frames = parse_integer(s, "--frames"); },
            "poses along the motion, at equal steps of its parameter (100)")
        ->type_name("N");
    command
        ->add_option("--structure", options.structures,
                     "only this one; may be given several times (all but all-pairs)")
        ->type_name("NAME");
    command->add_option("--svg", options.chart, "chart (SVG)")->type_name("FILE");
    add_page_option(*command, options.page);
    add_operand_options(*command, options.operands);
}

Outcome run_command(Session& session, const CompareHierarchiesOptions& options) {
    check_output_name(session, options.chart, ".svg");
    check_page_name(session, options.page);
    check_outputs(session, {options.chart, options.page}, Answer::Printed);
    if (options.frames < 2 || options.frames > 100000)
        throw UsageError("--frames: from 2 to 100000");
    scenes::ComparisonOptions comparison_options;
    comparison_options.kinds = kinds_of(options.structures);
    session.plan(options.page.empty() ? 3 : 4);
    const FileMotion motion = read_motion(options.motion);
    const Motion* rational = std::get_if<Motion>(&motion);
    if (rational == nullptr)
        throw UnsupportedError(options.motion + ": structures are compared on rational motions");
    const std::vector<Pose> poses = frames_of(*rational, options.frames);
    const std::vector<Operand> operands = session.stage(
        "read", [&] { return read_operands(session, options.inputs, options.operands); });
    const std::array models = session.stage("prepare", [&] {
        return std::array{InterferenceModel(operands[0].solid),
                          InterferenceModel(operands[1].solid)};
    });
    for (std::size_t i = 0; i < 2; ++i)
        if (models.at(i).is_empty())
            throw UsageError(options.inputs.at(i) + ": an empty solid needs no structure");
    const scenes::Comparison comparison = session.stage("compare", [&] {
        return scenes::compare(models[0], models[1], poses, comparison_options);
    });
    if (!comparison.disagreement.empty()) throw std::logic_error(comparison.disagreement);
    Outcome out;
    out.document["schema"] = "trisect.compare-hierarchies/1";
    out.document["inputs"] = {operands[0].facts, operands[1].facts};
    out.document["frames"] = comparison.frames;
    out.document["relations"] = comparison.answers.relations;
    out.document["meeting_frames"] = comparison.answers.meeting_frames;
    out.document["face_pairs"] = comparison.answers.face_pairs;
    out.document["least_distance"] = comparison.answers.least_distance;
    out.document["structures"] = structures_json(comparison);
    out.document["output"] = options.chart.empty() ? Json() : Json(options.chart);
    if (!options.chart.empty())
        session.write_output(
            options.chart,
            scenes::chart_of(comparison, fmt::format("{} frames of B against A", poses.size())));
    if (!options.page.empty())
        session.stage("page", [&] { write_page(session, options, models, *rational, comparison); });
    out.document["seconds"] = session.seconds();
    (options.chart == "-" ? out.remarks : out.answer) =
        answers_text(comparison) + scenes::table_of(comparison);
    return out;
}

}  // namespace

std::unique_ptr<SubCommand> compare_hierarchies_command() {
    return command_with(add_command, run_command);
}

}  // namespace trisect::app
