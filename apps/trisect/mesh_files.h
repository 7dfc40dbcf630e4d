// SPDX-License-Identifier: Apache-2.0
//
// Mesh files as operands and results of commands.
// They are read, imported and written under the common options, with the name of the file in
// every error.
#pragma once

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/file_remarks.h>
#include <trisect/brep/io/read_model.h>
#include <trisect/brep/io/write_model.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include <span>
#include <string>
#include <vector>

#include "session.h"

namespace trisect::app {

/// What is wrong with one input, after it was read.
class OperandError : public Error {
public:
    OperandError(ErrorCode code, std::string file, const std::string& message,
                 ValidationReport report = ValidationReport(), std::string hint = {})
        : Error(code, file + ": " + message),
          file_(std::move(file)),
          report_(std::move(report)),
          hint_(std::move(hint)) {}
    [[nodiscard]] const std::string& file() const noexcept { return file_; }
    [[nodiscard]] const ValidationReport& report() const noexcept { return report_; }
    /// What may help.
    [[nodiscard]] const std::string& hint() const noexcept { return hint_; }

private:
    std::string file_;
    ValidationReport report_;
    std::string hint_;
};

/// Whether a file holds an exact boundary (brep/io/exact_boundary.h): by the extension, as for
/// meshes.
[[nodiscard]] bool has_exact_boundary(const std::string& name);

/// Whether a file holds a solid with its tree (bsp/native_file.h), by the extension.
[[nodiscard]] bool has_native_name(const std::string& name);
/// Either: what is written there is not rounded.
[[nodiscard]] bool has_lossless_name(const std::string& name);
void write_lossless_output(Session& session, const std::string& name, const Solid& solid);

/// A file with its parts, which formats that hold no models have one of.
struct InputModel {
    Model model;
    MeshFormat format = MeshFormat::Off;
    ModelReport report;
};

/// "-" is the standard input, whose format is that of --format or else shown by its content.
/// `properties`: also materials, textures and properties of corners, as far as there are any.
[[nodiscard]] InputModel read_input_model(const Session& session, const std::string& name,
                                          bool properties = false);

/// The same as one mesh of all parts, which meets itself where they do.
[[nodiscard]] PolygonMesh read_input(const Session& session, const std::string& name);
[[nodiscard]] PolygonMesh one_mesh(Model&& model);
/// The same with materials and properties, in a model of one part.
[[nodiscard]] Model one_part(Model&& model);

/// The same with what there is to say about the file; costs another pass over it.
struct RemarkedMesh {
    PolygonMesh mesh;
    std::vector<FileRemark> remarks;
};
[[nodiscard]] RemarkedMesh read_input_with_remarks(const Session& session, const std::string& name);

/// At most one of the names may be "-". \throw UsageError
void check_standard_input(std::span<const std::string> names);

/// Import under --lattice and --nonplanar, open boundaries allowed. What it changed is in the
/// report (import_notes.h). For any thread.
[[nodiscard]] ImportedMesh import_input(const Session& session, const PolygonMesh& mesh,
                                        const std::string& name);

/// validate() with the name of the file in its errors.
[[nodiscard]] ValidationReport validate_input(const PolygonMesh& mesh, const std::string& name,
                                              const ValidateOptions& options);

/// --properties.
void add_properties_option(CLI::App& command, bool& properties);

/// That `name` can hold properties in this format; checked before the work begins.
/// \throw UnsupportedError, UsageError
void check_holds_properties(const std::string& name, MeshFormat format);

/// The format in which `name` will be written; checked before the work begins.
/// \throw UsageError when nothing tells it, or when a mesh and --json want the standard output.
[[nodiscard]] MeshFormat output_format(const Session& session, const std::string& name);

/// The bytes of a result. STL, 3MF, GLB and AMF get triangles only, STEP where faces are not
/// planar. For any thread.
[[nodiscard]] FormattedMesh format_output_mesh(const std::string& name, MeshFormat format,
                                               const PolygonMesh& mesh);
/// The same. Faces that must be cut lose the materials of their part; with properties they keep
/// all that they have.
[[nodiscard]] FormattedMesh format_output_model(const std::string& name, MeshFormat format,
                                                Model model, bool properties = false);
/// Remarks what a format changed.
void note_written(Session& session, const std::string& name, const WriteReport& report);
/// Writes them, and remarks what the format changed.
WriteReport write_output_mesh(Session& session, const std::string& name,
                              const FormattedMesh& formatted);
/// Both.
WriteReport write_output_model(Session& session, const std::string& name, MeshFormat format,
                               Model model, bool properties = false);
WriteReport write_output_mesh(Session& session, const std::string& name, MeshFormat format,
                              const PolygonMesh& mesh);

/// The boundary in the polygons that the format holds: in STEP whole faces, holes joined by
/// bridges.
[[nodiscard]] PolygonMesh output_polygons(const Brep& brep, MeshFormat format, MeshMap* map);

/// The triangles of an imported mesh in the user's units.
[[nodiscard]] PolygonMesh plain_mesh(const LatticeMesh& mesh);

}  // namespace trisect::app
