// SPDX-License-Identifier: Apache-2.0
//
// check A: does the mesh bound a solid? Every defect with its place, and what else there is to say
// about the file.
//
// An exact boundary was checked when it was read: corners on their planes, edges that cancel. What
// remains are holes outside their faces, and whether it meets itself. Its signed volume is the
// integral of the winding number w; evaluation knows the volumes of w > 0 and of w != 0. If all
// three fractions are equal, w is nowhere negative and nowhere above one.
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/expression.h>

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check_page.h"
#include "commands.h"
#include "import_notes.h"
#include "mesh_files.h"
#include "page_entities.h"
#include "report_json.h"
#include "values.h"
#include "way_out.h"

namespace trisect::app {
namespace {

std::string answer_text(const ValidationReport& report, std::span<const FileRemark> remarks,
                        const std::string& name) {
    if (report.empty() && remarks.empty()) {
        return fmt::format("{}: a solid, nothing found\n", name);
    }
    std::string out;
    for (const FileRemark& remark : remarks) {
        out += fmt::format("remark: {} {}\n  {}\n", remark.count, name_of(remark.kind),
                           remark.sentence);
    }
    if (!report.empty()) out += report.to_string();
    if (!out.empty() && out.back() != '\n') out += '\n';
    out += ways_out_text(report);
    return out + fmt::format("{}: {}; {} errors, {} warnings, {} remarks\n", name,
                             report.is_solid() ? "a solid" : "not a solid",
                             report.count(Severity::Error), report.count(Severity::Warning),
                             remarks.size());
}

struct Findings {
    ValidationReport report;
    std::vector<FileRemark> remarks;
    PageShape shape;  ///< for the page, if there is one
};

Findings check_mesh(Session& session, const std::string& name, const ValidateOptions& options,
                    bool shown) {
    auto [mesh, remarks] =
        session.stage("read", [&] { return read_input_with_remarks(session, name); });
    ValidationReport report =
        session.stage("check", [&, &shape = mesh] { return validate_input(shape, name, options); });
    return {std::move(report), std::move(remarks), shown ? shape_of(mesh) : PageShape()};
}

bool winds_once(const Session& session, const Brep& brep) {
    const ExactRational signed_volume = exact_volume(brep);
    const Solid solid = Solid::from_brep(brep, Embedding::Resolve);
    using Winding = EvaluateOptions::Winding;
    const auto has_signed_volume = [&](Winding winding) {
        EvaluateOptions options = session.evaluation_options({});
        options.winding = winding;
        return exact_volume(evaluate(solid, options).to_brep()) == signed_volume;
    };
    return has_signed_volume(Winding::Positive) && has_signed_volume(Winding::NonZero);
}

Findings check_exact(Session& session, const std::string& name, const ValidateOptions& options,
                     bool shown) {
    const Brep brep =
        session.stage("read", [&] { return read_exact(std::filesystem::path(name)); });
    return session.interruptible_stage("check", [&] {
        ValidationReport report = validate(brep, options);
        if (!brep.is_empty() && !winds_once(session, brep))
            report.add(DefectKind::SelfIntersection, [&] {
                const Point3d place = bounds(brep)->lo;
                return Defect{DefectKind::SelfIntersection,
                              {},
                              {},
                              place,
                              "the boundary winds around some points more than once or a negative "
                              "number of times; it begins at " +
                                  place_text(place)};
            });
        return Findings{std::move(report), {}, shown ? shape_of(brep) : PageShape()};
    });
}

void write_page(Session& session, const CheckOptions& options, PageShape shape,
                const ValidationReport& report, std::span<const FileRemark> remarks) {
    session.stage("page", [&] {
        std::vector<std::string> sentences;
        for (const FileRemark& r : remarks) sentences.push_back(r.sentence);
        session.write_output(options.page, check_page(short_name(options.input), std::move(shape),
                                                      report, std::move(sentences)));
    });
}

Json ways_out_json(const ValidationReport& report) {
    Json out = Json::object();
    for (std::size_t k = 0; k < defect_kind_count; ++k)
        if (const auto kind = static_cast<DefectKind>(k); report.count(kind) != 0)
            out[std::string(name_of(kind))] = way_out(kind);
    return out;
}

}  // namespace

void add_check_command(CLI::App& app, CheckOptions& options) {
    CLI::App* command =
        app.add_subcommand("check", "does a mesh bound a solid? exit code 1 if anything is found");
    command->add_option("A", options.input, "mesh file, or an exact boundary (.exact)")->required();
    command
        ->add_option_function<std::string>(
            "--places",
            [&options](const std::string& text) {
                const std::int64_t n = parse_integer(text, "--places");
                if (n < 0) throw UsageError("--places: must not be negative");
                options.places = static_cast<std::uint64_t>(n);
            },
            "defects listed of each kind (default 100)")
        ->type_name("N");
    add_page_option(*command, options.page);
}

Outcome run_check(Session& session, const CheckOptions& options) {
    const bool shown = !options.page.empty();
    check_page_name(session, options.page);
    session.plan(shown ? 3 : 2);
    ValidateOptions validation;
    validation.list_limit = options.places;
    if (session.options().lattice) validation.lattice = Lattice{*session.options().lattice};
    auto [report, remarks, shape] = has_exact_boundary(options.input)
                                        ? check_exact(session, options.input, validation, shown)
                                        : check_mesh(session, options.input, validation, shown);
    const LatticeReport& lattice = report.lattice();
    note_rounding(session, lattice, options.input);
    if (shown) write_page(session, options, std::move(shape), report, remarks);
    Outcome out;
    out.code = report.empty() && remarks.empty() ? exit_done : exit_findings;
    out.document["schema"] = "trisect.check/1";
    out.document["file"] = options.input;
    out.document["solid"] = report.is_solid();
    out.document["errors"] = report.count(Severity::Error);
    out.document["warnings"] = report.count(Severity::Warning);
    out.document["counts"] = defect_counts_json(report);
    out.document["defects"] = defects_json(report);
    out.document["ways_out"] = ways_out_json(report);
    out.document["remarks"] = remarks_json(remarks);
    out.document["lattice"] = lattice_json(lattice);
    out.document["seconds"] = session.seconds();
    out.answer = answer_text(report, remarks, options.input);
    return out;
}

}  // namespace trisect::app
