// SPDX-License-Identifier: Apache-2.0
//
// tessellate A -o B --deviation D: Bézier patches as a mesh within a stated distance of them.
#include <fmt/format.h>

#include <trisect/brep/curved/curved_boundary.h>
#include <trisect/brep/curved/tessellate.h>
#include <trisect/brep/io/read_patches.h>
#include <trisect/brep/validate/validate.h>

#include "commands.h"
#include "mesh_files.h"
#include "output_name.h"
#include "values.h"

namespace trisect::app {

void add_tessellate_command(CLI::App& app, TessellateOptions& options) {
    CLI::App* command = app.add_subcommand(
        "tessellate", "make a closed mesh of Bezier patches (bpt), within a certified distance");
    command->add_option("A", options.input, "file of patches that close")->required();
    command->add_option("-o,--output", options.output, "result; '-' is the standard output")
        ->required();
    command
        ->add_option_function<std::string>(
            "--deviation",
            [&options](const auto& s) { options.deviation = parse_number(s, "--deviation"); },
            "how far the mesh may be from the surface, in the file's units")
        ->type_name("D")
        ->required();
}

Outcome run_tessellate(Session& session, const TessellateOptions& options) {
    const MeshFormat format = output_format(session, options.output);
    check_outputs(session, {options.output});
    session.plan(4);
    const CurvedBoundary boundary = session.stage("read", [&] {
        auto patches = read_patches(options.input);
        try {
            return CurvedBoundary(std::move(patches));
        } catch (const UsageError& e) {
            throw InputError(FilePlace{options.input, 0, 0, 0}, e.what());
        }
    });
    const Tessellation result =
        session.stage("tessellate", [&] { return tessellate(boundary, options.deviation); });
    session.stage("check", [&] {
        ValidationReport report = validate(result.mesh);
        if (!report.is_solid())
            throw InvalidSolid(std::move(report),
                               "the patches, tessellated within this deviation, bound no solid");
    });
    const WriteReport written = session.stage(
        "write", [&] { return write_output_mesh(session, options.output, format, result.mesh); });
    Outcome out;
    out.document["schema"] = "trisect.tessellate/1";
    out.document["input"] = options.input;
    out.document["output"] = options.output;
    out.document["format"] = to_string(format);
    out.document["patches"] = boundary.patches().size();
    out.document["vertices"] = result.mesh.points.size();
    out.document["faces"] = result.mesh.face_count();
    out.document["deviation"] = result.deviation;
    out.document["largest_move"] = written.largest_move;
    out.document["seconds"] = session.seconds();
    return out;
}

}  // namespace trisect::app
