// SPDX-License-Identifier: Apache-2.0
//
// sweep A B --motion FILE: when does B, moving, first touch A; or, with --until overlap, how far
// can it go. The time is exact; so is "no contact". Of motions by key frames or of constant angular
// speed the answer is a certified interval.
#include <trisect/bsp/interference/enclosed_contact.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "choice.h"
#include "commands.h"
#include "motion_file.h"
#include "operand.h"
#include "page_entities.h"
#include "sweep_page.h"
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

Json statistics_json(const FirstContactCounters& counters) {
    Json out;
    out["intervals"] = counters.intervals;
    out["box_tests"] = counters.box_tests;
    out["triangle_pairs"] = counters.triangle_pairs;
    return out;
}

std::string answer_text(const FirstContact& c) {
    std::string out = fmt::format("contact at {}\n", number_text(c.time->to_double()));
    for (const ContactWitness& w : c.witnesses)
        out += fmt::format("A {}, B {}\n", entity_text(w.a), entity_text(w.b));
    return out;
}

std::string answer_text(const EnclosedContact& c) {
    using Outcome = EnclosedContact::Outcome;
    if (c.outcome == Outcome::None) return "no contact\n";
    std::string out = fmt::format("no contact before {}\n", number_text(c.free_until));
    if (c.contact_by) out += fmt::format("contact at {}\n", number_text(*c.contact_by));
    if (!c.is_narrow)
        for (const TimeSpan& s : c.undecided)
            out += fmt::format("undecided from {} to {}\n", number_text(s.from), number_text(s.to));
    for (const ContactWitness& w : c.witnesses)
        out += fmt::format("A {}, B {}\n", entity_text(w.a), entity_text(w.b));
    return out;
}

double width_of(const SweepOptions& options, double unless_given) {
    if (options.width > 0) return options.width;
    if (options.width == 0) return unless_given;
    throw UsageError("--width: must be positive");
}

Json witnesses_json(const std::vector<ContactWitness>& witnesses,
                    const std::array<InterferenceModel, 2>& models) {
    Json out = Json::array();
    for (const ContactWitness& w : witnesses)
        out.push_back(
            {{"a", entity_json(w.a, models[0].brep())}, {"b", entity_json(w.b, models[1].brep())}});
    return out;
}

using Models = std::array<InterferenceModel, 2>;

PageMotion page_motion(const SweepOptions& options, const Motion& a, const Motion& b) {
    PageMotion out;
    out.end = static_cast<double>(std::max(a.piece_count(), b.piece_count()));
    out.unit = "parameter";
    out.frames = options.frames;
    const std::array both{&a, &b};
    for (std::size_t i = 0; i < 2; ++i)
        if (const Motion* m = both.at(i); i == 1 || !m->is_still())
            out.pose.at(i) = [m](double s) {
                return m->approximate_pose_at(std::min(s, static_cast<double>(m->piece_count())));
            };
    return out;
}

PageMotion page_motion(const SweepOptions& options, const EnclosedMotion& a,
                       const EnclosedMotion& b) {
    PageMotion out;
    out.end = b.duration();
    out.unit = "time";
    out.frames = options.frames;
    const std::array both{&a, &b};
    for (std::size_t i = 0; i < 2; ++i)
        if (const EnclosedMotion* m = both.at(i); i == 1 || !m->is_still())
            out.pose.at(i) = [m](double t) {
                const double at = std::min(t, m->duration());
                return m->enclose(at, at).motion.approximate_pose_at(0);
            };
    return out;
}

/// The answer, line by line, without the witnesses, which are findings.
std::vector<std::string> summary_of(const std::string& answer) {
    std::vector<std::string> out;
    for (std::size_t at = 0; at < answer.size();) {
        const std::size_t end = answer.find('\n', at);
        std::string line = answer.substr(at, end - at);
        if (!line.starts_with("A ")) out.push_back(std::move(line));
        at = end + 1;
    }
    return out;
}

void write_page(Session& session, const SweepOptions& options, const Models& models,
                const PageMotion& motion, ShownContact contact, const Outcome& out) {
    if (options.page.empty()) return;
    session.stage("page", [&] {
        contact.summary = summary_of(out.answer);
        std::array<PlacedBody, 2> bodies;
        for (std::size_t i = 0; i < 2; ++i)
            bodies.at(i) = {short_name(options.inputs.at(i)), models.at(i), identity_pose};
        session.write_output(options.page, sweep_page(bodies, motion, contact));
    });
}

// Both are rational: exact.
void sweep(Session& session, const SweepOptions& options, const Models& models,
           const Motion& motion_a, const Motion& motion_b, Outcome& out) {
    const double width = width_of(options, 0x1p-40);
    const Diagnostics<FirstContactCounters> diagnostics;
    const FirstContact contact = session.stage("sweep", [&] {
        return first_contact(models[0], motion_a, models[1], motion_b, {options.event});
    });
    out.code = contact.exists() ? exit_findings : exit_done;
    out.document["until"] = options.event == ContactEvent::Touch ? "touch" : "overlap";
    out.document["pieces"] = std::max(motion_a.piece_count(), motion_b.piece_count());
    out.document["at_start"] = to_string(contact.at_start);
    out.document["contact"] = contact.exists();
    out.answer = "no contact\n";
    if (contact.exists()) {
        out.document["time"] = time_json(*contact.time, ExactRational::from_double(width));
        out.document["witnesses"] = witnesses_json(contact.witnesses, models);
        out.answer = answer_text(contact);
    }
    out.document["statistics"] = statistics_json(diagnostics.counters());
    ShownContact shown;
    if (contact.exists()) shown.time = contact.time->to_double();
    shown.witnesses = contact.witnesses;
    write_page(session, options, models, page_motion(options, motion_a, motion_b), std::move(shown),
               out);
}

void sweep(Session& session, const SweepOptions& options, const Models& models,
           const EnclosedMotion& motion_a, const EnclosedMotion& motion_b, Outcome& out) {
    using Result = EnclosedContact::Outcome;
    if (options.event != ContactEvent::Touch)
        throw UsageError("--until overlap: needs rational motions, given as lines");
    const double width = width_of(options, 0x1p-30);
    const Diagnostics<FirstContactCounters> diagnostics;
    const EnclosedContact contact = session.stage("sweep", [&] {
        return enclosed_first_contact(models[0], motion_a, models[1], motion_b, {width});
    });
    out.code = contact.outcome == Result::None ? exit_done : exit_findings;
    out.document["until"] = "touch";
    out.document["duration"] = motion_b.duration();
    if (contact.outcome == Result::Undecided)
        out.document["contact"] = nullptr;
    else
        out.document["contact"] = contact.outcome == Result::Contact;
    out.document["free_until"] = contact.free_until;
    if (contact.contact_by) out.document["contact_by"] = *contact.contact_by;
    Json undecided = Json::array();
    for (const TimeSpan& s : contact.undecided) undecided.push_back({s.from, s.to});
    out.document["undecided"] = std::move(undecided);
    out.document["narrow"] = contact.is_narrow;
    out.document["witnesses"] = witnesses_json(contact.witnesses, models);
    out.document["statistics"] = statistics_json(diagnostics.counters());
    out.answer = answer_text(contact);
    write_page(session, options, models, page_motion(options, motion_a, motion_b),
               {contact.contact_by, contact.witnesses, {}}, out);
}

EnclosedMotion enclosed(const FileMotion& motion) {
    const Motion* rational = std::get_if<Motion>(&motion);
    return rational != nullptr ? EnclosedMotion(*rational) : std::get<EnclosedMotion>(motion);
}

}  // namespace

void add_sweep_command(CLI::App& app, SweepOptions& options) {
    CLI::App* command = app.add_subcommand(
        "sweep", "when does a moving solid first touch another? exit code 1 if it does");
    command->add_option("A", options.inputs[0], "mesh file")->required();
    command->add_option("B", options.inputs[1], "mesh file of the solid that moves")->required();
    command
        ->add_option("--motion", options.motion,
                     "how B moves: a pose of twelve numbers a line, or 'screw' lines; or JSON with "
                     "key frames or a turn")
        ->required()
        ->type_name("FILE");
    command->add_option("--motion-of-a", options.motion_of_a, "how A moves meanwhile")
        ->type_name("FILE");
    add_choice_option<ContactEvent>(
        *command, "--until", options.event,
        {{"touch", ContactEvent::Touch}, {"overlap", ContactEvent::Overlap}},
        "touch (the default), or overlap: sliding and grazing go on");
    command
        ->add_option_function<std::string>(
            "--width",
            [&options](const std::string& s) {
                options.width = parse_number(s, "--width");
                if (options.width == 0) options.width = -1;  // refused, unlike none
            },
            "of the interval around the time of contact")
        ->type_name("W");
    add_page_option(*command, options.page);
    command
        ->add_option_function<std::string>(
            "--frames",
            [&options](const std::string& s) {
                const std::int64_t n = parse_integer(s, "--frames");
                if (n < 1 || n > 10000) throw UsageError("--frames: from 1 to 10000");
                options.frames = static_cast<std::uint64_t>(n);
            },
            "of the page, at equal steps (120)")
        ->type_name("N");
    add_operand_options(*command, options.operands);
}

Outcome run_sweep(Session& session, const SweepOptions& options) {
    (void)width_of(options, 1);
    check_page_name(session, options.page);
    session.plan(options.page.empty() ? 3 : 4);
    const FileMotion motion_a =
        options.motion_of_a.empty() ? Motion() : read_motion(options.motion_of_a);
    const FileMotion motion_b = read_motion(options.motion);
    const std::vector<Operand> operands = session.stage(
        "read", [&] { return read_operands(session, options.inputs, options.operands); });
    const Models models = session.stage("prepare", [&] {
        return Models{InterferenceModel(operands[0].solid), InterferenceModel(operands[1].solid)};
    });
    Outcome out;
    out.document["schema"] = "trisect.sweep/1";
    out.document["inputs"] = {operands[0].facts, operands[1].facts};
    const Motion* a = std::get_if<Motion>(&motion_a);
    const Motion* b = std::get_if<Motion>(&motion_b);
    if (a != nullptr && b != nullptr)
        sweep(session, options, models, *a, *b, out);
    else
        sweep(session, options, models, enclosed(motion_a), enclosed(motion_b), out);
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace trisect::app
