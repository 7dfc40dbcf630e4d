// SPDX-License-Identifier: Apache-2.0
//
// info A: counts, bounds, volume, area, shells, genus, lattice.
#include "commands.h"
#include "description.h"
#include "mesh_files.h"

namespace trisect::app {

void add_info_command(CLI::App& app, InfoOptions& options) {
    CLI::App* command = app.add_subcommand("info", "counts, bounds, volume, area, lattice");
    command->add_option("A", options.input, "mesh file")->required();
    command->add_flag("--exact", options.exact, "also the volume as a fraction");
}

Outcome run_info(Session& session, const InfoOptions& options) {
    session.plan(2);
    const PolygonMesh mesh =
        session.stage("read", [&] { return read_input(session, options.input); });
    const Description description = session.stage("measure", [&] {
        return describe(import_input(session, mesh, options.input), {options.exact});
    });
    Outcome out;
    out.document["schema"] = "trisect.info/1";
    out.document["file"] = options.input;
    out.document.update(to_json(description));
    out.document["seconds"] = session.seconds();
    out.answer = to_text(description);
    return out;
}

}  // namespace trisect::app
