// SPDX-License-Identifier: Apache-2.0
//
// union, intersection, difference and xor of two or more meshes, and resolve, the union of one. The
// whole formula is evaluated in one pass; difference is A minus all the others.
#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/diagnostics.h>

#include <fmt/format.h>

#include <vector>

#include "certificate.h"
#include "commands.h"
#include "description.h"
#include "formula.h"
#include "import_notes.h"
#include "mesh_files.h"
#include "operand.h"
#include "operand_model.h"
#include "output_name.h"
#include "parallel_each.h"
#include "slab_command.h"
#include "values.h"

namespace trisect::app {
namespace {

/// Everything the command found out.
struct BooleanResult {
    Description description;
    WriteReport written;
    std::optional<Certificate> certificate;
    std::optional<CertifiedRounding> rounding;
    std::optional<Mending> mending;
    EvaluateReport report;
    EvaluateCounters counters;
    Json properties;  ///< what the output has; null: not asked for
};

/// Whether faces are wanted, or something that only faces have.
bool needs_brep(const BooleanOptions& options) {
    return options.faces || options.source_faces || options.repair || !options.boundary.empty() ||
           options.operands.properties;
}

DescriptionOptions description_options(const Session& session, const BooleanOptions& options) {
    return {options.exact, session.options().json};
}

AssembleOptions assemble_options(const BooleanOptions& options) {
    AssembleOptions assembly;
    assembly.maximal_faces = !options.source_faces && !options.operands.properties;
    return assembly;
}

/// Faces of a STEP file whose rounded corners are in no plane: the certificate is of triangles.
void note_uneven(Session& session, const BooleanOptions& options, const PolygonMesh& mesh) {
    ImportOptions import;
    import.require_closed = false;
    const std::size_t uneven = import_mesh(mesh, import).report.nonplanar_faces;
    if (uneven == 0) return;
    session.note(fmt::format(
        "{}: the rounded corners of {} faces are not in one plane to the last digit; the "
        "certificate is of their triangles, the file has the faces",
        options.output, uneven));
}

/// Triangles that meet, where a certificate found some. Whether there were any.
bool mend_contacts(PolygonMesh& mesh, std::vector<FaceSource>& sources, MeshFormat format,
                   BooleanResult& result) {
    if (result.certificate)
        result.mending = mend_output(mesh, sources, *result.certificate, format);
    return result.mending.has_value();
}

/// Channels of corners, materials and pictures.
Json properties_json(const Model& model) {
    Json out;
    out["channels"] = Json::array();
    for (const ModelPart& part : model.parts)
        for (const PropertyChannel& channel : part.properties.channels)
            out["channels"].push_back(channel.name);
    out["materials"] = Json::array();
    for (const ModelMaterial& material : model.materials) out["materials"].push_back(material.name);
    out["textures"] = model.textures.size();
    return out;
}

/// By faces: assembles, certifies or repairs, and writes.
void deliver_brep(Session& session, const BooleanOptions& options,
                  const std::vector<Operand>& operands, const Solid& solid, MeshFormat format,
                  BooleanResult& result) {
    PolygonMesh mesh;
    MeshMap map;
    const Brep brep = session.stage("assemble", [&] {
        Brep boundary = solid.to_brep(assemble_options(options));
        mesh = to_polygon_mesh(boundary, {}, &map);
        return boundary;
    });
    session.stage("describe", [&] {
        result.description = describe(brep, description_options(session, options));
        result.description.lattice = result.report.lattice;
    });
    if (options.repair) {
        session.interruptible_stage("certify", [&] {
            result.rounding =
                round_output(brep, format, session.evaluation_options(options.operands));
            return 0;
        });
        result.certificate = result.rounding->certificate;
        mesh = result.rounding->mesh;
    } else if (options.certificate) {
        session.stage("certify", [&] {
            result.certificate = certify_output(brep, mesh, format);
            // Faces of STEP are written as they are.
            if (format != MeshFormat::Step) mend_contacts(mesh, map.source, format, result);
        });
    }
    session.stage("write", [&] {
        if (!options.boundary.empty()) session.write_output(options.boundary, exact_text(brep));
        if (format == MeshFormat::Step && !result.rounding) {
            mesh = output_polygons(brep, format, &map);
            note_uneven(session, options, mesh);
        }
        if (options.operands.properties) {
            Model model =
                property_model(std::move(mesh), map.source, operands, options.operation, format);
            result.properties = properties_json(model);
            result.written =
                write_output_model(session, options.output, format, std::move(model), true);
            return;
        }
        // What a repair moved has no operands any more.
        result.written =
            holds_models(format) && !result.rounding
                ? write_output_model(session, options.output, format,
                                     operand_model(mesh, map.source, operands, options.operation))
                : write_output_mesh(session, options.output, format, mesh);
    });
}

/// By triangles alone. The certificate, the bytes and the counts are made at the same time.
void deliver_mesh(Session& session, const BooleanOptions& options,
                  const std::vector<Operand>& operands, const Solid& solid, MeshFormat format,
                  BooleanResult& result) {
    ExactMesh exact;
    PolygonMesh mesh;
    session.stage("assemble", [&] {
        exact = solid.to_exact_mesh();
        mesh = to_polygon_mesh(exact);
    });
    FormattedMesh formatted;
    const auto format_mesh = [&] {
        return holds_models(format)
                   ? format_output_model(
                         options.output, format,
                         operand_model(mesh, exact.source, operands, options.operation))
                   : format_output_mesh(options.output, format, mesh);
    };
    session.stage("describe", [&] {
        for_each_in_parallel(3, session.limits(), [&](std::size_t i) {
            if (i == 0 && options.certificate)
                result.certificate = certify_output(exact, mesh, format);
            if (i == 1) formatted = format_mesh();
            if (i == 2)
                result.description = describe(
                    exact, [&] { return solid.to_brep(); }, description_options(session, options));
        });
        result.description.lattice = result.report.lattice;
        if (mend_contacts(mesh, exact.source, format, result)) formatted = format_mesh();
    });
    session.stage("write",
                  [&] { result.written = write_output_mesh(session, options.output, formatted); });
}

/// Without rounding: the solid with its tree, or its boundary in integers.
void deliver_lossless(Session& session, const BooleanOptions& options, const Solid& solid,
                      BooleanResult& result) {
    const ExactMesh exact = session.stage("assemble", [&] { return solid.to_exact_mesh(); });
    session.stage("describe", [&] {
        result.description = describe(
            exact, [&] { return solid.to_brep(); }, description_options(session, options));
        result.description.lattice = result.report.lattice;
    });
    session.stage("write", [&] { write_lossless_output(session, options.output, solid); });
}

/// Without rounding there is nothing to repair, and faces are as they are.
void require_mesh_output(const BooleanOptions& options) {
    if (needs_brep(options))
        throw UsageError(options.output +
                         ": --faces, --source-faces, --repair, --properties and --boundary are for "
                         "meshes");
}

Json document_of(const Session& session, const BooleanOptions& options,
                 const std::vector<Operand>& operands, const BooleanResult& result) {
    Json document;
    document["schema"] = "trisect.boolean/1";
    document["op"] = options.operation;
    document["inputs"] = Json::array();
    for (const Operand& operand : operands) document["inputs"].push_back(operand.facts);
    document["embedding"] = options.operands.assume_embedded ? "assumed" : "checked";
    document["output"]["file"] = options.output;
    if (!options.boundary.empty()) document["output"]["boundary"] = options.boundary;
    document["output"].update(to_json(result.description));
    if (options.operands.properties) {
        document["output"]["properties"] = result.properties;
        document["output"]["properties"]["left_out"] = result.written.left_out;
    }
    document["seconds"] = session.seconds();
    document["certificate"] = result.certificate ? to_json(*result.certificate) : Json();
    document["divided"] = result.mending ? result.mending->divided : 0;
    document["mended"] = to_json(result.mending);
    document["repair"] = result.rounding ? to_json(*result.rounding) : Json();
    document["cells"]["visited"] = result.counters.cells;
    document["cells"]["shared"] = result.counters.shared_cells;
    document["cells"]["resolved"] = result.counters.mixed_leaves;
    return document;
}

std::string remarks_of(const Session& session, const BooleanOptions& options,
                       const BooleanResult& result) {
    const Description& d = result.description;
    const std::string faces = needs_brep(options) ? fmt::format(" {} faces,", d.faces) : "";
    std::string out = fmt::format("{:<13}{} triangles,{} {} shells, volume {}\n", options.operation,
                                  d.triangles, faces, d.shells, number_text(d.volume.value_or(0)));
    if (d.volume_exact) out += fmt::format("{:<13}{}\n", "", d.volume_exact->to_string());
    out += fmt::format("{:<13}{}\n", "operands", embedding_text(options.operands));
    if (result.certificate) {
        out += fmt::format("{:<13}{}\n", "certified", to_text(*result.certificate));
        if (!options.repair && !result.certificate->holds())
            out += fmt::format("{:<13}--repair moves vertices until it is certified\n", "");
    }
    if (result.mending) out += fmt::format("{:<13}{}\n", "mended", to_text(*result.mending));
    if (result.rounding) out += fmt::format("{:<13}{}\n", "rounding", to_text(*result.rounding));
    double total = 0;
    for (const auto& seconds : session.seconds()) total += seconds.get<double>();
    return out + fmt::format("{:<13}{:.3f} s", "time", total);
}

void add_result_options(CLI::App* command, BooleanOptions& options) {
    command
        ->add_option(
            "-o,--output", options.output,
            "mesh, exact boundary (.exact) or native file (.trisect); '-' is the standard output")
        ->required();
    command
        ->add_option("--boundary", options.boundary,
                     "file for the boundary without loss, as integers; '-' is the standard output")
        ->type_name("FILE");
    command->add_flag("--exact", options.exact, "also the volume as a fraction");
    command->add_flag("--faces", options.faces,
                      "join coplanar triangles to faces, and count these; slower");
    command->add_flag("--source-faces", options.source_faces,
                      "faces, but no coplanar ones of different origin joined");
    command->add_flag("!--no-certificate", options.certificate,
                      "do not check the rounded result for self-intersection");
    command->add_flag(
        "--repair", options.repair,
        "move what rounding lets intersect until the result is certified; exit code 1 "
        "if that fails");
    add_properties_option(*command, options.operands.properties);
    add_operand_options(*command, options.operands);
}

void add_one(CLI::App& app, const char* name, const char* help, BooleanOptions& options) {
    CLI::App* command = app.add_subcommand(name, help);
    command
        ->add_option(
            "A B", options.inputs,
            "mesh files, exact boundaries (.exact) or native files (.trisect), two or more")
        ->required()
        ->expected(2, 1 << 20);
    add_result_options(command, options);
    add_slab_options(*command, options);
}

void add_resolve(CLI::App& app, BooleanOptions& options) {
    CLI::App* command = app.add_subcommand(
        "resolve", "the points that a mesh winds around, one that meets itself too");
    command
        ->add_option("A", options.inputs,
                     "mesh file, exact boundary (.exact) or native file (.trisect)")
        ->required()
        ->expected(1);
    add_result_options(command, options);
}

}  // namespace

void add_boolean_commands(CLI::App& app, BooleanOptions& options) {
    add_one(app, "union", "points in any of the inputs", options);
    add_one(app, "intersection", "points in all of the inputs", options);
    add_one(app, "difference", "points in the first input and in none of the others", options);
    add_one(app, "xor", "points in an odd number of the inputs", options);
    add_resolve(app, options);
}

Outcome run_boolean(Session& session, const BooleanOptions& options) {
    if (wants_slabs(session, options)) return run_in_slabs(session, options);
    const bool is_lossless = has_lossless_name(options.output);
    const MeshFormat format =
        is_lossless ? MeshFormat::Off : output_format(session, options.output);
    if (is_lossless) require_mesh_output(options);
    if (options.operands.properties) {
        check_holds_properties(options.output, format);
        if (options.repair)
            throw UsageError(
                "--properties: not with --repair, which moves corners off their faces");
        if (options.faces)
            throw UsageError("--properties: not with --faces, which joins faces of operands");
    }
    check_outputs(session, {options.output, options.boundary});
    const bool by_faces = needs_brep(options) || format == MeshFormat::Step;
    session.plan(by_faces && options.certificate ? 6 : 5);
    const std::vector<Operand> operands = session.stage(
        "read", [&] { return read_operands(session, options.inputs, options.operands); });
    BooleanResult result;
    const EvaluateOptions evaluation = session.evaluation_options(options.operands);
    const Solid solid = session.interruptible_stage("evaluate", [&] {
        const Diagnostics<EvaluateCounters> diagnostics;
        Solid evaluated =
            evaluate(formula(options.operation, operands), evaluation, &result.report);
        result.counters = diagnostics.counters();
        return evaluated;
    });
    note_rounding(session, result.report.lattice, "the operands");
    if (is_lossless) {
        deliver_lossless(session, options, solid, result);
    } else if (by_faces) {
        deliver_brep(session, options, operands, solid, format, result);
    } else {
        deliver_mesh(session, options, operands, solid, format, result);
    }
    Outcome out;
    if (result.rounding && !result.rounding->certificate.holds()) out.code = exit_findings;
    out.document = document_of(session, options, operands, result);
    out.remarks = remarks_of(session, options, result);
    return out;
}

}  // namespace trisect::app
