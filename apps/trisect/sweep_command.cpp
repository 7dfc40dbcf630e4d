// SPDX-License-Identifier: Apache-2.0
//
// sweep A B --motion FILE: when does B, moving, first touch A; or, with --until overlap, how far
// can it go. The time is exact; so is "no contact".
#include <trisect/bsp/first_contact.h>
#include <trisect/bsp/interference_model.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "commands.h"
#include "motion_file.h"
#include "operand.h"
#include "values.h"

namespace trisect::app {
namespace {

Json entity_json(const BoundaryEntity& entity, const Brep& brep) {
    Json out;
    if (entity.is_vertex()) {
        out["vertex"] = entity.index();
        Json point = Json::array();
        for (const double c : brep.point(entity.vertex()).nearest())
            point.push_back(brep.lattice().to_double(c));
        out["point"] = std::move(point);
    } else if (entity.is_edge()) {
        out["edge"] = entity.index();
    } else {
        out["face"] = entity.index();
        out["source_face"] = brep.source(entity.face()).face;
    }
    return out;
}

std::string entity_text(const BoundaryEntity& entity) {
    const char* kind = entity.is_vertex() ? "vertex" : entity.is_edge() ? "edge" : "face";
    return fmt::format("{} {}", kind, entity.index());
}

Json time_json(const AlgebraicNumber& time, const ExactRational& width) {
    const AlgebraicNumber narrow = time.refined(width);
    Json out;
    out["value"] = time.to_double();
    out["lower"] = narrow.lower().to_string();
    out["upper"] = narrow.upper().to_string();
    Json polynomial = Json::array();
    for (const ExactRational& c : narrow.polynomial()) polynomial.push_back(c.to_string());
    out["polynomial"] = std::move(polynomial);
    return out;
}

Json stats_json(const FirstContactStats& stats) {
    Json out;
    out["intervals"] = stats.intervals;
    out["box_tests"] = stats.box_tests;
    out["triangle_pairs"] = stats.triangle_pairs;
    return out;
}

std::string answer_text(const FirstContact& c) {
    std::string out = fmt::format("contact at {}\n", number_text(c.time->to_double()));
    for (const ContactWitness& w : c.witnesses)
        out += fmt::format("A {}, B {}\n", entity_text(w.a), entity_text(w.b));
    return out;
}

ExactRational width_of(const SweepOptions& options) {
    try {
        const ExactRational width = ExactRational::from_double(options.width);
        if (width.sign() > 0) return width;
    } catch (const UsageError&) {
    }
    throw UsageError("--width: must be positive");
}

}  // namespace

void add_sweep_command(CLI::App& app, SweepOptions& options) {
    CLI::App* command = app.add_subcommand(
        "sweep", "when does a moving solid first touch another? exit code 1 if it does");
    command->add_option("A", options.inputs[0], "mesh file")->required();
    command->add_option("B", options.inputs[1], "mesh file of the solid that moves")->required();
    command
        ->add_option("--motion", options.motion,
                     "how B moves: a pose of twelve numbers a line, or 'screw' lines")
        ->required()
        ->type_name("FILE");
    command->add_option("--motion-of-a", options.motion_of_a, "how A moves meanwhile")
        ->type_name("FILE");
    static const std::map<std::string, ContactEvent> events{{"touch", ContactEvent::Touch},
                                                            {"overlap", ContactEvent::Overlap}};
    command
        ->add_option("--until", options.event,
                     "touch (the default), or overlap: sliding and grazing go on")
        ->transform(CLI::CheckedTransformer(events))
        ->type_name("touch|overlap");
    command
        ->add_option_function<std::string>(
            "--width",
            [&options](const std::string& s) { options.width = parse_number(s, "--width"); },
            "of the interval around the exact time in the document")
        ->type_name("W");
    add_operand_options(*command, options.operands);
}

Outcome run_sweep(Session& session, const SweepOptions& options) {
    const ExactRational width = width_of(options);
    session.plan(3);
    const Motion motion_a =
        options.motion_of_a.empty() ? Motion() : read_motion(options.motion_of_a);
    const Motion motion_b = read_motion(options.motion);
    const std::vector<Operand> operands = session.stage(
        "read", [&] { return read_operands(session, options.inputs, options.operands); });
    const std::array models = session.stage("prepare", [&] {
        return std::array{InterferenceModel(operands[0].solid),
                          InterferenceModel(operands[1].solid)};
    });
    const FirstContact contact = session.stage("sweep", [&] {
        return first_contact(models[0], motion_a, models[1], motion_b, {options.event});
    });
    Outcome out;
    out.code = contact.exists() ? exit_findings : exit_done;
    out.document["schema"] = "trisect.sweep/1";
    out.document["inputs"] = {operands[0].facts, operands[1].facts};
    out.document["until"] = options.event == ContactEvent::Touch ? "touch" : "overlap";
    out.document["pieces"] = std::max(motion_a.piece_count(), motion_b.piece_count());
    out.document["at_start"] = to_string(contact.at_start);
    out.document["contact"] = contact.exists();
    out.answer = "no contact\n";
    if (contact.exists()) {
        out.document["time"] = time_json(*contact.time, width);
        Json witnesses = Json::array();
        for (const ContactWitness& w : contact.witnesses)
            witnesses.push_back({{"a", entity_json(w.a, models[0].brep())},
                                 {"b", entity_json(w.b, models[1].brep())}});
        out.document["witnesses"] = std::move(witnesses);
        out.answer = answer_text(contact);
    }
    out.document["statistics"] = stats_json(contact.stats);
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace trisect::app
