// SPDX-License-Identifier: Apache-2.0
#include "operand.h"

#include <filesystem>
#include <optional>
#include <utility>

#include <trisect/brep/embedding_findings.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/solid_of_findings.h>

#include "choice.h"
#include "commands.h"
#include "import_notes.h"
#include "mesh_files.h"
#include "parallel_each.h"
#include "report_json.h"
#include "way_out.h"

namespace trisect::app {
namespace {

void require_solid(const ImportedMesh& imported, const std::string& name,
                   const OperandOptions& options) {
    const ImportReport& report = imported.report;
    if (!report.closed) {
        const InvalidSolid reason(report.defects, "the boundary is not closed");
        throw OperandError(reason.code(), name, reason.what(), report.defects,
                           way_out_hint(report.defects));
    }
    // With the non-zero rule a boundary that is turned over bounds the same set.
    if (report.inside_out && options.winding == EvaluateOptions::Winding::Positive) {
        throw OperandError(ErrorCode::InvalidSolid, name,
                           "the boundary is inside out (--winding nonzero accepts it)",
                           report.defects,
                           "'trisect mend --shells' turns it over, 'trisect resolve --winding "
                           "nonzero' takes it as it is");
    }
}

Json facts_of(const ImportedMesh& imported, const std::string& name, std::size_t faces) {
    const ImportReport& report = imported.report;
    Json facts;
    facts["file"] = name;
    facts["faces"] = faces;
    facts["triangles"] = imported.mesh.triangles.size();
    facts["lattice"] = lattice_json(report.lattice);
    facts["nonplanar_faces"] = report.nonplanar_faces;
    facts["refitted_faces"] = report.refitted_faces;
    facts["degenerate_faces"] = report.degenerate_faces_dropped;
    return facts;
}

/// An input before it is a solid. Solids are made one after the other, because their numbers, which
/// outputs name, are given in that order.
struct ReadOperand {
    Json facts;
    ImportNote note;
    LatticeMesh mesh;  ///< of a mesh file
    EmbeddingFindings findings;
    std::optional<Brep> brep;  ///< of an exact boundary
    std::optional<NativeFile> native;
    std::shared_ptr<Model> model;  ///< with properties
};

ReadOperand read_native_operand(const Session& session, const std::string& name) {
    if (session.options().lattice)
        throw UsageError("--lattice is for meshes: " + name + " has a lattice of its own");
    ReadOperand out;
    out.note.name = name;
    out.native = NativeFile::open(name);
    out.facts["file"] = name;
    out.facts["triangles"] = out.native->info().triangles;
    out.facts["lattice"] = lattice_json(LatticeReport{out.native->info().lattice});
    out.facts["cells"] = out.native->info().cells;
    return out;
}

ReadOperand read_exact_operand(const Session& session, const std::string& name,
                               const OperandOptions& options) {
    if (session.options().lattice)
        throw UsageError("--lattice is for meshes: " + name +
                         " has planes on a lattice of its own");
    ReadOperand out;
    out.note.name = name;
    out.brep = read_exact(std::filesystem::path(name));
    if (!out.brep->is_empty() && sign_of_volume(*out.brep) <= 0 &&
        options.winding == EvaluateOptions::Winding::Positive)
        throw OperandError(ErrorCode::InvalidSolid, name,
                           "the boundary is inside out (--winding nonzero accepts it)");
    out.facts["file"] = name;
    out.facts["faces"] = out.brep->faces().size();
    out.facts["lattice"] = lattice_json(LatticeReport{out.brep->lattice()});
    return out;
}

ReadOperand read_mesh_operand(const Session& session, const std::string& name,
                              const OperandOptions& options) {
    InputModel input = read_input_model(session, name, options.properties);
    const std::string unit = input.model.unit;
    const std::size_t parts = input.model.parts.size();
    std::shared_ptr<Model> model;
    if (options.properties) model = std::make_shared<Model>(one_part(std::move(input.model)));
    const PolygonMesh own = model == nullptr ? one_mesh(std::move(input.model)) : PolygonMesh();
    const PolygonMesh& mesh = model == nullptr ? own : model->parts.front().mesh;
    ImportedMesh imported = import_input(session, mesh, name);
    require_solid(imported, name, options);
    ReadOperand out;
    out.facts = facts_of(imported, name, mesh.face_count());
    if (holds_models(input.format)) {
        out.facts["unit"] = unit.empty() ? Json() : Json(unit);
        out.facts["parts"] = parts;
    }
    out.model = std::move(model);
    out.note = {name, std::move(imported.report), unit, input.report};
    out.findings.is_embedded = options.assume_embedded;
    if (!options.assume_embedded) out.findings = find_embedding(imported.mesh);
    out.mesh = std::move(imported.mesh);
    return out;
}

ReadOperand read_operand(const Session& session, const std::string& name,
                         const OperandOptions& options) {
    if (has_native_name(name)) return read_native_operand(session, name);
    return has_exact_boundary(name) ? read_exact_operand(session, name, options)
                                    : read_mesh_operand(session, name, options);
}

Solid solid_of(ReadOperand& read, const OperandOptions& options) {
    if (read.native) return read.native->solid({.names = NativeNames::Fresh});
    if (!read.brep) return solid_of_findings(std::move(read.mesh), std::move(read.findings));
    const Embedding embedding = options.assume_embedded ? Embedding::Assume : Embedding::Check;
    const InsideOut inside_out = options.winding == EvaluateOptions::Winding::NonZero
                                     ? InsideOut::Accept
                                     : InsideOut::Refuse;
    try {
        return Solid::from_brep(*read.brep, embedding, inside_out);
    } catch (const Error& e) {
        throw OperandError(e.code(), read.note.name, e.what());
    }
}

}  // namespace

void add_operand_options(CLI::App& command, OperandOptions& options) {
    command.add_flag("--assume-embedded", options.assume_embedded,
                     "take inputs to be free of self-intersection: faster, wrong if they are not");
    using Winding = EvaluateOptions::Winding;
    add_choice_option<Winding>(command, "--winding", options.winding,
                               {{"positive", Winding::Positive}, {"nonzero", Winding::NonZero}},
                               "which winding numbers are inside");
    using Lattices = EvaluateOptions::Lattices;
    add_choice_option<Lattices>(
        command, "--mixed-lattices", options.lattices,
        {{"round", Lattices::Round}, {"refuse", Lattices::Refuse}},
        "inputs too large and too fine for one lattice: round the fine ones, or stop");
}

std::vector<Operand> read_operands(Session& session, std::span<const std::string> names,
                                   const OperandOptions& options) {
    check_standard_input(names);
    std::vector<ReadOperand> read(names.size());
    for_each_in_parallel(names.size(), session.limits(), [&](std::size_t i) {
        read[i] = read_operand(session, names[i], options);
    });
    std::vector<Operand> operands;
    std::vector<ImportNote> notes;
    operands.reserve(read.size());
    notes.reserve(read.size());
    for (ReadOperand& r : read) {
        Solid solid = solid_of(r, options);
        operands.push_back({std::move(solid), std::move(r.facts), std::move(r.model)});
        notes.push_back(std::move(r.note));
    }
    note_imports(session, notes);
    return operands;
}

Solid resolved(const Session& session, const Solid& solid, const OperandOptions& options) {
    if (options.assume_embedded) return solid;
    return evaluate(Expression(solid), session.evaluation_options(options));
}

std::string embedding_text(const OperandOptions& options) {
    return options.assume_embedded ? "assumed free of self-intersection"
                                   : "checked; where they meet themselves, resolved";
}

}  // namespace trisect::app
