// SPDX-License-Identifier: Apache-2.0
//
// split A B -o COMMON REST: what A has inside B, and the rest of it. split A --plane P... -o
// PART...: the parts of A between planes. All parts come from one evaluation, and all files are
// written or none.
#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/split.h>
#include <trisect/kernel/diagnostics.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "certificate.h"
#include "commands.h"
#include "description.h"
#include "import_notes.h"
#include "mesh_files.h"
#include "operand.h"
#include "operand_model.h"
#include "output_name.h"
#include "values.h"

namespace trisect::app {
namespace {

/// One part, and the bytes of its file.
struct SplitPart {
    Solid solid;
    Description description;
    std::optional<Certificate> certificate;
    std::optional<Mending> mending;
    std::string lossless;                    ///< bytes of an exact boundary or native file
    std::optional<FormattedMesh> formatted;  ///< of a mesh
};

void check_request(const Session& session, const SplitOptions& options) {
    if (options.planes.empty() != (options.inputs.size() == 2))
        throw UsageError("split: either two inputs, or one input and --plane");
    const std::size_t parts = options.planes.empty() ? 2 : options.planes.size() + 1;
    if (options.outputs.size() != parts)
        throw UsageError(
            fmt::format("-o: {} parts, {} names of files", parts, options.outputs.size()));
    for (const std::string& name : options.outputs) {
        if (!has_lossless_name(name)) {
            const MeshFormat format = output_format(session, name);
            if (options.operands.properties) check_holds_properties(name, format);
        } else if (options.operands.properties) {
            throw UsageError(name + ": --properties is for meshes");
        }
    }
    for (std::size_t i = 0; i < parts; ++i)
        for (std::size_t j = 0; j < i; ++j)
            check_outputs(session, {options.outputs[j], options.outputs[i]});
}

std::vector<Solid> parts_of(const SplitOptions& options, const std::vector<Operand>& operands,
                            const EvaluateOptions& evaluation) {
    if (options.planes.empty()) {
        SplitSolid parts = split(operands[0].solid, operands[1].solid, evaluation);
        return {std::move(parts.common), std::move(parts.rest)};
    }
    const Bounds box = bounds(operands[0].solid).value_or(Bounds());
    std::vector<std::array<double, 4>> planes;
    for (const PlaneRequest& plane : options.planes) planes.push_back(plane.coefficients(box));
    return split(operands[0].solid, planes, evaluation);
}

std::string lossless_bytes(const std::string& name, const Solid& solid) {
    return has_native_name(name) ? native_bytes(solid) : exact_text(solid.to_brep());
}

/// The triangles of a part, each of one face of an operand where properties are kept.
struct PartMesh {
    PolygonMesh mesh;
    std::vector<FaceSource> sources;
};

PartMesh mesh_of(const SplitOptions& options, const Solid& solid, const ExactMesh& exact,
                 MeshFormat format, std::optional<Certificate>& certificate) {
    if (!options.operands.properties) {
        PartMesh out{to_polygon_mesh(exact), exact.source};
        if (options.certificate) certificate = certify_output(exact, out.mesh, format);
        return out;
    }
    const Brep brep = solid.to_brep({.maximal_faces = false});
    MeshMap map;
    PartMesh out{to_polygon_mesh(brep, {}, &map), {}};
    out.sources = std::move(map.source);
    if (options.certificate) certificate = certify_output(brep, out.mesh, format);
    return out;
}

FormattedMesh format_part(const SplitOptions& options, const std::vector<Operand>& operands,
                          const std::string& file, const std::string& name, MeshFormat format,
                          PartMesh part) {
    if (options.operands.properties)
        return format_output_model(
            file, format,
            property_model(std::move(part.mesh), std::move(part.sources), operands, name, format),
            true);
    if (!holds_models(format)) return format_output_mesh(file, format, part.mesh);
    return format_output_model(file, format,
                               operand_model(std::move(part.mesh), part.sources, operands, name));
}

/// \param name of the part, in formats that have names
void finish(const Session& session, const SplitOptions& options,
            const std::vector<Operand>& operands, const std::string& file, const std::string& name,
            SplitPart& part) {
    const ExactMesh exact = part.solid.to_exact_mesh();
    part.description = describe(exact, [&] { return part.solid.to_brep(); },
                                {options.exact, session.options().json});
    part.description.lattice.lattice = part.solid.lattice();
    if (has_lossless_name(file)) {
        part.lossless = lossless_bytes(file, part.solid);
        return;
    }
    const MeshFormat format = output_format(session, file);
    PartMesh made = mesh_of(options, part.solid, exact, format, part.certificate);
    if (part.certificate)
        part.mending = mend_output(made.mesh, made.sources, *part.certificate, format);
    part.formatted = format_part(options, operands, file, name, format, std::move(made));
}

Json part_json(const std::string& file, const SplitPart& part) {
    Json out;
    out["file"] = file;
    out.update(to_json(part.description));
    out["certificate"] = part.certificate ? to_json(*part.certificate) : Json();
    out["mended"] = to_json(part.mending);
    return out;
}

std::string part_text(const std::string& file, const SplitPart& part) {
    const Description& d = part.description;
    std::string out = fmt::format("{}: {} triangles, {} shells, volume {}\n", file, d.triangles,
                                  d.shells, number_text(d.volume.value_or(0)));
    if (d.volume_exact) out += fmt::format("{:<13}{}\n", "", d.volume_exact->to_string());
    if (part.certificate) out += fmt::format("{:<13}{}\n", "certified", to_text(*part.certificate));
    if (part.mending) out += fmt::format("{:<13}{}\n", "mended", to_text(*part.mending));
    return out;
}

/// Material libraries and pictures, which several parts may share.
void add_side_files(const std::string& name, FormattedMesh& formatted,
                    std::vector<OutputBytes>& files) {
    if (name == "-" && !formatted.files.empty())
        throw UsageError("pictures are files beside the output: not on the standard output");
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    for (SideFile& file : formatted.files) {
        const std::string path = (folder / file.name).string();
        const auto known = std::find_if(files.begin(), files.end(), [&](const OutputBytes& other) {
            return other.path == path;
        });
        if (known == files.end())
            files.push_back({path, std::move(file.bytes), OutputSafety::Renamed});
        else if (known->bytes != file.bytes)
            throw UsageError(path +
                             ": two parts would have different pictures of this name beside them; "
                             "give their files other names");
    }
}

void write_all(Session& session, const SplitOptions& options, std::vector<SplitPart>& parts) {
    std::vector<OutputBytes> files;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string& name = options.outputs[i];
        if (!parts[i].formatted) {
            files.push_back(
                {name, std::move(parts[i].lossless),
                 has_native_name(name) ? OutputSafety::Flushed : OutputSafety::Renamed});
            continue;
        }
        add_side_files(name, *parts[i].formatted, files);
        files.push_back({name, std::move(parts[i].formatted->bytes), OutputSafety::Renamed});
    }
    session.write_outputs(files);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].formatted)
            note_written(session, options.outputs[i], parts[i].formatted->report);
}

}  // namespace

void add_split_command(CLI::App& app, SplitOptions& options) {
    CLI::App* command =
        app.add_subcommand("split",
                           "the parts of a solid inside and outside another one, or "
                           "between planes");
    command
        ->add_option("A B", options.inputs,
                     "mesh files, exact boundaries (.exact) or native files (.trisect): the solid, "
                     "and what it is split by where there is no plane")
        ->required()
        ->expected(1, 2);
    command
        ->add_option_function<std::vector<std::string>>(
            "--plane",
            [&options](const auto& all) {
                for (const std::string& s : all)
                    options.planes.push_back(PlaneRequest::from_text(s, "--plane"));
            },
            "a x + b y + c z + d = 0, or an axis it is perpendicular to, by default in the middle; "
            "several times for several planes, upwards")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("A,B,C,D|z=NUMBER|z");
    command
        ->add_option("-o,--output", options.outputs,
                     "one mesh, exact boundary (.exact) or native file (.trisect) for each part: "
                     "inside and outside of B, or below each plane and above all; '-' is the "
                     "standard output")
        ->required()
        ->type_name("FILE")
        ->expected(2, 1 << 16);
    command->add_flag("--exact", options.exact, "also the volumes as fractions");
    command->add_flag("!--no-certificate", options.certificate,
                      "do not check the rounded results for self-intersection");
    add_properties_option(*command, options.operands.properties);
    add_operand_options(*command, options.operands);
}

Outcome run_split(Session& session, const SplitOptions& options) {
    check_request(session, options);
    session.plan(4);
    const std::vector<Operand> operands = session.stage(
        "read", [&] { return read_operands(session, options.inputs, options.operands); });
    const EvaluateOptions evaluation = session.evaluation_options(options.operands);
    EvaluateAllCounters counters;
    std::vector<SplitPart> parts;
    session.interruptible_stage("evaluate", [&] {
        const Diagnostics<EvaluateAllCounters> diagnostics;
        for (Solid& solid : parts_of(options, operands, evaluation))
            parts.emplace_back().solid = std::move(solid);
        counters = diagnostics.counters();
        return 0;
    });
    session.stage("describe", [&] {
        for (std::size_t i = 0; i < parts.size(); ++i)
            finish(session, options, operands, options.outputs[i], fmt::format("part {}", i + 1),
                   parts[i]);
    });
    Outcome out;
    out.document["schema"] = "trisect.split/1";
    out.document["inputs"] = Json::array();
    for (const Operand& operand : operands) out.document["inputs"].push_back(operand.facts);
    out.document["embedding"] = options.operands.assume_embedded ? "assumed" : "checked";
    out.document["parts"] = Json::array();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        out.document["parts"].push_back(part_json(options.outputs[i], parts[i]));
        out.remarks += part_text(options.outputs[i], parts[i]);
    }
    out.document["evaluations"] = counters.evaluations;
    session.stage("write", [&] { write_all(session, options, parts); });
    out.document["seconds"] = session.seconds();
    out.remarks += fmt::format("{:<13}{}", "operands", embedding_text(options.operands));
    return out;
}

}  // namespace trisect::app
