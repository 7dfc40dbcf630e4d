// SPDX-License-Identifier: Apache-2.0
//
// info A: counts, bounds, volume, area, shells, genus, lattice, span of the coordinates.
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/kernel/lattice.h>

#include <fmt/format.h>

#include <array>
#include <optional>

#include "commands.h"
#include "description.h"
#include "import_notes.h"
#include "mesh_files.h"
#include "report_json.h"

namespace trisect::app {

void add_info_command(CLI::App& app, InfoOptions& options) {
    CLI::App* command = app.add_subcommand("info", "counts, bounds, volume, area, lattice");
    command->add_option("A", options.input, "mesh file, or an exact boundary (.exact)")->required();
    command->add_flag("--exact", options.exact, "also the volume as a fraction");
}

namespace {

Description describe_exact(Session& session, const InfoOptions& options) {
    const Brep brep = session.stage("read", [&] { return read_exact(options.input); });
    return session.stage("measure", [&] { return describe(brep, {options.exact}); });
}

Description describe_mesh(Session& session, const InfoOptions& options, int& span, Json& parts) {
    InputModel input =
        session.stage("read", [&] { return read_input_model(session, options.input); });
    const std::string unit = input.model.unit;
    if (holds_models(input.format)) parts = model_json(input.model);
    const PolygonMesh mesh = one_mesh(std::move(input.model));
    return session.stage("measure", [&] {
        span = span_bits(mesh.points);
        const ImportedMesh imported = import_input(session, mesh, options.input);
        note_imports(session,
                     std::array{ImportNote{options.input, imported.report, unit, input.report}});
        return describe(imported, {options.exact});
    });
}

}  // namespace

Outcome run_info(Session& session, const InfoOptions& options) {
    session.plan(2);
    Json parts = Json::object();
    std::optional<int> span;  // an exact boundary has planes instead of coordinates
    const Description description = has_exact_boundary(options.input)
                                        ? describe_exact(session, options)
                                        : describe_mesh(session, options, span.emplace(), parts);
    Outcome out;
    out.document["schema"] = "trisect.info/1";
    out.document["file"] = options.input;
    out.document.update(to_json(description));
    out.document.update(parts);
    out.document["span_bits"] = span ? Json(*span) : Json();
    out.document["seconds"] = session.seconds();
    out.answer = to_text(description);
    if (span) out.answer += fmt::format("{:<11}{} bits\n", "span", *span);
    return out;
}

}  // namespace trisect::app
