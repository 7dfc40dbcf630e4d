// SPDX-License-Identifier: Apache-2.0
//
// verify OP A B [MORE...] RESULT: certifies a result that somebody else computed. What the verdicts
// mean, and why they are proved, is said in bsp/verify.h.
//
// Where a file is an exact boundary, the sets are compared as they are. Only when they differ are
// its corners rounded to doubles, for the radius and the witness.
#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/bsp/verify.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "check_page.h"
#include "choice.h"
#include "commands.h"
#include "mesh_files.h"
#include "operand.h"
#include "operation_name.h"
#include "page_entities.h"
#include "report_json.h"
#include "values.h"

namespace trisect::app {
namespace {

/// JSON knows no infinity.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(); }

std::string point_text(const ExactPoint& p) {
    return fmt::format("({}, {}, {})", p[0].to_string(), p[1].to_string(), p[2].to_string());
}

Json witness_json(const Witness& w, const std::vector<std::string>& files) {
    Json out;
    out["point"] = {w.point[0].to_string(), w.point[1].to_string(), w.point[2].to_string()};
    out["rounded"] = {w.point[0].to_double(), w.point[1].to_double(), w.point[2].to_double()};
    out["winding_numbers"] = w.winding;
    out["in_exact"] = w.in_exact;
    out["in_result"] = w.in_result;
    out["distance_to_exact"] = number_json(w.distance_to_exact);
    out["distance_to_result"] = number_json(w.distance_to_result);
    out["holds_as_given"] = w.holds_as_given;
    out["faces"] = Json::array();
    for (const BlamedFace& f : w.faces)
        out["faces"].push_back({{"file", files[f.mesh]}, {"face", f.face}});
    return out;
}

Json document_of(const VerifyReport& report, const VerifyCommandOptions& options) {
    Json out;
    out["schema"] = "trisect.verify/1";
    out["op"] = options.operation;
    out["inputs"] = std::vector<std::string>(options.files.begin(), options.files.end() - 1);
    out["result"] = options.files.back();
    out["verdict"] = to_string(report.verdict);
    out["within"] = options.within ? Json(*options.within) : Json();
    out["radius"] = {{"lower", number_json(report.lower)}, {"upper", number_json(report.upper)}};
    out["witness"] = report.witness ? witness_json(*report.witness, options.files) : Json();
    out["result_inside_out"] = report.result_inside_out;
    out["defects"] = defects_json(report.result_defects);
    out["lattice"] = {{"exponent", report.lattice.exponent}, {"moved", report.moved}};
    out["components"] = report.components;
    out["pieces"] = report.pieces;
    out["failed_cuts"] = report.failed_cuts;
    return out;
}

std::string witness_text(const Witness& w, const std::vector<std::string>& files) {
    std::string out =
        fmt::format("  witness   {}\n  about     ({}, {}, {})\n", point_text(w.point),
                    number_text(w.point[0].to_double()), number_text(w.point[1].to_double()),
                    number_text(w.point[2].to_double()));
    for (std::size_t i = 0; i < files.size(); ++i)
        out += fmt::format("  winding   {} about it by {}\n", w.winding[i], files[i]);
    out += fmt::format("  exact     {}; result: {}\n", w.in_exact ? "inside" : "outside",
                       w.in_result ? "inside" : "outside");
    out += fmt::format("  distance  at least {} from the exact boundary, {} from the result's\n",
                       number_text(w.distance_to_exact), number_text(w.distance_to_result));
    if (!w.holds_as_given) out += "  rounding  the meshes as given may differ there: see lattice\n";
    std::size_t shown = 0;
    for (const BlamedFace& f : w.faces) {
        if (++shown > 8) break;
        out += fmt::format("  face      {} of {}\n", f.face, files[f.mesh]);
    }
    return out;
}

std::string radius_text(const VerifyReport& report) {
    std::string out = fmt::format("  radius    at least {}", number_text(report.lower));
    if (!std::isnan(report.upper)) out += fmt::format(", at most {}", number_text(report.upper));
    return out + "\n";
}

std::string answer_of(const VerifyReport& report, const VerifyCommandOptions& options) {
    std::string out = std::string(to_string(report.verdict)) + "\n";
    if (report.result_inside_out) out += "  the result's boundary is inside out\n";
    if (report.verdict == Verdict::NotClosed) return out + report.result_defects.to_string();
    if (report.verdict != Verdict::Equal && !std::isnan(report.lower)) out += radius_text(report);
    if (report.witness) out += witness_text(*report.witness, options.files);
    return out;
}

int code_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::Equal:
        case Verdict::Within:
            return exit_done;
        case Verdict::Undecided:
            return static_cast<int>(ErrorCode::Limit);
        default:
            return exit_findings;
    }
}

void note_moves(Session& session, const VerifyReport& report,
                const std::vector<std::string>& files) {
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (report.moved[i] == 0) continue;
        session.note(fmt::format("{}: placed on the lattice of unit 2^{}: moved by at most {}",
                                 files[i], report.lattice.exponent, number_text(report.moved[i])));
    }
}

bool are_equal(Session& session, BooleanOperation operation,
               const std::vector<std::string>& files) {
    std::vector<Solid> solids;
    for (Operand& o : session.stage("read", [&] { return read_operands(session, files, {}); }))
        solids.push_back(std::move(o.solid));
    return session.interruptible_stage("compare", [&] {
        const Expression exact =
            expression_of(operation, std::span(solids).first(solids.size() - 1));
        return evaluate(exact ^ solids.back(), session.evaluation_options({})).is_empty();
    });
}

std::vector<PolygonMesh> read_meshes(Session& session, const std::vector<std::string>& files) {
    return session.stage("read", [&] {
        std::vector<PolygonMesh> out;
        for (const std::string& name : files)
            out.push_back(has_exact_boundary(name)
                              ? to_polygon_mesh(read_exact(std::filesystem::path(name)))
                              : read_input(session, name));
        return out;
    });
}

struct Verified {
    VerifyReport report;
    std::vector<PolygonMesh> meshes;  ///< the result last; none where they were not read
};

Verified verify_meshes(Session& session, BooleanOperation operation,
                       const VerifyCommandOptions& options) {
    std::vector<PolygonMesh> meshes = read_meshes(session, options.files);
    const std::span<const PolygonMesh> operands = std::span(meshes).first(meshes.size() - 1);
    VerifyOptions verification;
    verification.within = options.within;
    verification.piece_limit = options.pieces;
    verification.evaluate = session.evaluation_options({});
    if (session.options().lattice) verification.lattice = Lattice{*session.options().lattice};
    VerifyReport report = session.interruptible_stage(
        "verify", [&] { return verify(operation, operands, meshes.back(), verification); });
    note_moves(session, report, options.files);
    return {std::move(report), std::move(meshes)};
}

Verified verify_exactly(Session& session, BooleanOperation operation,
                        const VerifyCommandOptions& options) {
    if (options.within)
        throw UsageError("--within: distances from exact boundaries (.exact) are not certified");
    if (are_equal(session, operation, options.files)) return {VerifyReport(), {}};
    Verified out = verify_meshes(session, operation, options);
    VerifyReport& report = out.report;
    session.note("exact boundaries were rounded to doubles for the radius and the witness");
    if (report.verdict == Verdict::Equal)
        report.lower = report.upper = std::numeric_limits<double>::quiet_NaN();
    if (report.verdict != Verdict::NotClosed) report.verdict = Verdict::Different;
    return out;
}

void write_page(Session& session, const VerifyCommandOptions& options,
                const std::vector<PolygonMesh>& meshes, const VerifyReport& report) {
    session.stage("page", [&] {
        std::vector<std::string> names;
        for (const std::string& file : options.files) names.push_back(short_name(file));
        std::vector<std::string> summary{to_string(report.verdict)};
        if (report.verdict != Verdict::Equal && !std::isnan(report.lower)) {
            const std::string radius = radius_text(report);
            summary.push_back(radius.substr(2, radius.size() - 3));
        }
        session.write_output(options.page, verify_page(fmt::format("{}: is it the {}?",
                                                                   names.back(), options.operation),
                                                       names, meshes, report, std::move(summary)));
    });
}

}  // namespace

void add_verify_command(CLI::App& app, VerifyCommandOptions& options) {
    CLI::App* command = app.add_subcommand(
        "verify", "is a mesh the result of a boolean? exit code 1 with a witness if not");
    add_word_option(*command, "OP", options.operation,
                    {"union", "intersection", "difference", "xor"}, "what was computed")
        ->required();
    command
        ->add_option("A B RESULT", options.files,
                     "operands, and last the mesh to be certified; also exact boundaries (.exact)")
        ->required()
        ->expected(3, 1 << 20);
    command
        ->add_option_function<std::string>(
            "--within",
            [&options](const std::string& text) {
                options.within = parse_number(text, "--within");
                if (*options.within < 0) throw UsageError("--within: must not be negative");
            },
            "accept a result all of whose differences are within this distance (maximum norm) of "
            "both boundaries")
        ->type_name("R");
    command
        ->add_option_function<std::string>(
            "--pieces",
            [&options](const std::string& text) {
                const std::int64_t n = parse_integer(text, "--pieces");
                if (n < 1) throw UsageError("--pieces: must be positive");
                options.pieces = static_cast<std::uint64_t>(n);
            },
            "most pieces that the difference is cut into (default 10000)")
        ->type_name("N");
    add_page_option(*command, options.page);
}

Outcome run_verify(Session& session, const VerifyCommandOptions& options) {
    check_standard_input(options.files);
    const BooleanOperation operation = operation_named(options.operation);
    const bool exact = std::ranges::any_of(options.files, has_exact_boundary);
    check_page_name(session, options.page);
    session.plan((exact ? 4 : 2) + (options.page.empty() ? 0 : 1));
    Verified verified = exact ? verify_exactly(session, operation, options)
                              : verify_meshes(session, operation, options);
    const VerifyReport& report = verified.report;
    Outcome out;
    out.code = code_of(report.verdict);
    out.document = document_of(report, options);
    out.document["seconds"] = session.seconds();
    out.answer = answer_of(report, options);
    if (!options.page.empty()) {
        if (verified.meshes.empty()) verified.meshes = read_meshes(session, options.files);
        write_page(session, options, verified.meshes, report);
    }
    return out;
}

}  // namespace trisect::app
