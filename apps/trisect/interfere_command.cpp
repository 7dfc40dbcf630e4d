// SPDX-License-Identifier: Apache-2.0
//
// interfere A B: how two solids lie to each other, each under a pose: disjoint, touching,
// overlapping, one inside the other, or equal; and which faces, edges and vertices of the two meet.
// The numbers of a pose are taken exactly as given, and the solids are not moved, so nothing is
// rounded on the way.
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "commands.h"
#include "interfere_page.h"
#include "matrix_file.h"
#include "mesh_files.h"
#include "operand.h"
#include "page_entities.h"
#include "values.h"

namespace trisect::app {
namespace {

struct PosedOperand {
    Operand operand;
    std::array<double, 12> rows{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    Pose pose;
    InterferenceModel model;
};

Pose pose_of(const std::array<double, 12>& rows, const std::string& file) {
    try {
        return Pose::from_doubles(rows);
    } catch (const UsageError& e) {
        throw InputError(FilePlace{file, 1, 1, 0}, e.what());
    }
}

const char* kind_name(const BoundaryEntity& entity) {
    if (entity.is_vertex()) return "vertex";
    return entity.is_edge() ? "edge" : "face";
}

constexpr std::array<const char*, 3> dimension_names{"points", "segments", "area"};

/// Where the entity is, in the coordinates of the file.
Json entity_json(const BoundaryEntity& entity, const InterferenceModel& model) {
    const Brep& brep = model.brep();
    const auto point = [&](VertexId v) {
        const std::array<double, 3> p = brep.point(v).nearest();
        const Lattice lattice = model.lattice();
        return Json{lattice.to_double(p[0]), lattice.to_double(p[1]), lattice.to_double(p[2])};
    };
    Json out;
    out[kind_name(entity)] = entity.index();
    if (entity.is_vertex()) out["point"] = point(entity.vertex());
    if (entity.is_edge()) {
        const HalfedgeId h = brep.halfedge(entity.edge());
        out["from"] = point(brep.origin(h));
        out["to"] = point(brep.target(h));
    }
    if (entity.is_face()) out["source"] = brep.source(entity.face()).face;
    return out;
}

Json contact_json(const Contact& contact, const PosedOperand& a, const PosedOperand& b) {
    Json out;
    out["a"] = entity_json(contact.a, a.model);
    out["b"] = entity_json(contact.b, b.model);
    out["dimension"] = contact.dimension;
    if (contact.dimension == 2) out["opposite"] = contact.opposite;
    return out;
}

std::string contact_text(const Contact& contact) {
    std::string out =
        fmt::format("{} {} of A, {} {} of B: {}", kind_name(contact.a), contact.a.index(),
                    kind_name(contact.b), contact.b.index(), dimension_names.at(contact.dimension));
    if (contact.dimension == 2) out += contact.opposite ? ", face to face" : ", on one side";
    return out + "\n";
}

Json distance_json(const BoundaryDistance& distance, const PosedOperand& a, const PosedOperand& b) {
    Json out;
    out["lower"] = distance.lower;
    out["upper"] = distance.upper;
    out["a"] = entity_json(distance.a, a.model);
    out["b"] = entity_json(distance.b, b.model);
    out["on_a"] = distance.on_a;
    out["on_b"] = distance.on_b;
    return out;
}

std::string distance_text(const BoundaryDistance& distance) {
    return fmt::format("distance from {} to {}: {} {} of A, {} {} of B\n",
                       number_text(distance.lower), number_text(distance.upper),
                       kind_name(distance.a), distance.a.index(), kind_name(distance.b),
                       distance.b.index());
}

/// --distance and --nearer-than; the distance, if it was asked for and there is one.
std::optional<BoundaryDistance> add_distances(Session& session, const InterfereOptions& options,
                                              const PosedOperand& a, const PosedOperand& b,
                                              Outcome& out) {
    std::optional<BoundaryDistance> distance;
    if (options.distance) {
        distance = session.stage(
            "distance", [&] { return boundary_distance(a.model, a.pose, b.model, b.pose); });
        out.document["distance"] = distance ? distance_json(*distance, a, b) : Json();
        if (distance) out.answer += distance_text(*distance);
    }
    if (options.nearer_than) {
        const double limit = *options.nearer_than;
        const bool nearer = session.stage("nearer", [&] {
            return out.code == exit_findings ||
                   are_nearer_than(a.model, a.pose, b.model, b.pose, limit);
        });
        out.code = nearer ? exit_findings : exit_done;
        out.document["nearer"] = nearer;
        out.answer +=
            fmt::format("{} than {}\n", nearer ? "nearer" : "not nearer", number_text(limit));
    }
    return distance;
}

void write_page(Session& session, const InterfereOptions& options,
                const std::array<PosedOperand, 2>& solids, const InterferenceResult& result,
                const std::optional<BoundaryDistance>& distance) {
    session.stage("page", [&] {
        std::array<PlacedBody, 2> bodies;
        for (std::size_t i = 0; i < 2; ++i)
            bodies.at(i) = {short_name(options.inputs.at(i)), solids.at(i).model,
                            solids.at(i).rows};
        session.write_output(options.page, interfere_page(bodies, result, distance));
    });
}

PosedOperand posed(Operand operand, const std::string& pose_file) {
    PosedOperand out;
    out.operand = std::move(operand);
    if (!pose_file.empty()) {
        out.rows = read_matrix(pose_file);
        out.pose = pose_of(out.rows, pose_file);
    }
    return out;
}

}  // namespace

void add_interfere_command(CLI::App& app, InterfereOptions& options) {
    CLI::App* command = app.add_subcommand(
        "interfere", "how two solids under poses lie to each other; exit code 1 if they meet");
    command->add_option("A", options.inputs[0], "mesh file")->required();
    command->add_option("B", options.inputs[1], "mesh file")->required();
    command
        ->add_option("--pose-a", options.poses[0],
                     "file of twelve numbers: the 3x4 matrix of A's pose, row by row; '-' is the "
                     "standard input")
        ->type_name("FILE");
    command->add_option("--pose-b", options.poses[1], "the same for B")->type_name("FILE");
    command->add_flag("--contacts", options.contacts,
                      "list the faces, edges and vertices that meet (with --json always)");
    command->add_flag("--distance", options.distance,
                      "also the distance of the boundaries, as an interval that holds it");
    command
        ->add_option_function<std::string>(
            "--nearer-than",
            [&options](const auto& text) {
                options.nearer_than = parse_number(text, "--nearer-than");
                if (*options.nearer_than < 0)
                    throw UsageError("--nearer-than: must not be negative");
            },
            "also whether they are nearer than D; then exit code 1 if they are")
        ->type_name("D");
    add_page_option(*command, options.page);
    add_operand_options(*command, options.operands);
}

Outcome run_interfere(Session& session, const InterfereOptions& options) {
    check_standard_input(
        std::array{options.inputs[0], options.inputs[1], options.poses[0], options.poses[1]});
    check_page_name(session, options.page);
    session.plan(4 + (options.distance ? 1 : 0) + (options.nearer_than ? 1 : 0) +
                 (options.page.empty() ? 0 : 1));
    std::array<PosedOperand, 2> solids;
    session.stage("read", [&] {
        std::vector<Operand> read = read_operands(session, options.inputs, options.operands);
        for (std::size_t i = 0; i < 2; ++i) solids[i] = posed(std::move(read[i]), options.poses[i]);
    });
    PosedOperand& a = solids[0];
    PosedOperand& b = solids[1];
    session.interruptible_stage("resolve", [&] {
        for (PosedOperand& s : solids)
            s.operand.solid = resolved(session, s.operand.solid, options.operands);
        return true;
    });
    session.stage("prepare", [&] {
        for (PosedOperand& s : solids) s.model = InterferenceModel(s.operand.solid);
    });
    InterferenceOptions query;
    query.regions = !options.page.empty();
    query.contacts = options.contacts || session.options().json || query.regions;
    const InterferenceResult result = session.stage(
        "interfere", [&] { return interfere(a.model, a.pose, b.model, b.pose, query); });

    Outcome out;
    out.code = result.relation == Relation::Disjoint ? exit_done : exit_findings;
    out.document["schema"] = "trisect.interfere/1";
    out.document["inputs"] = {a.operand.facts, b.operand.facts};
    out.document["poses"] = {a.rows, b.rows};
    out.document["relation"] = to_string(result.relation);
    out.document["contacts"] = Json::array();
    for (const Contact& contact : result.contacts)
        out.document["contacts"].push_back(contact_json(contact, a, b));
    out.answer = std::string(to_string(result.relation)) + "\n";
    if (options.contacts)
        for (const Contact& contact : result.contacts) out.answer += contact_text(contact);
    const auto distance = add_distances(session, options, a, b, out);
    if (!options.page.empty()) write_page(session, options, solids, result, distance);
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace trisect::app
