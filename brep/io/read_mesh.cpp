// SPDX-License-Identifier: Apache-2.0
//
// From a path or bytes to the reader of the right format. The extension decides, because a
// user of a file `.off` expects an error about OFF rather than a guess; the content decides where
// the extension says nothing, and between the two kinds of STL.
#include <trisect/brep/io/read_mesh.h>

#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/formats/formats.h>
#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/read_model.h>
#include <trisect/kernel/error.h>

namespace trisect {

MeshFormat mesh_format_of(const std::filesystem::path& path, std::string_view data,
                          const ReadOptions& options) {
    if (options.format) return *options.format;
    if (const auto by_name = mesh_format_of_extension(path)) return *by_name;
    if (const auto by_content = detect_mesh_format(data)) return *by_content;
    throw InputError(FilePlace{path.string(), 0, 0, 0},
                     "neither the extension nor the content tells the format; known are obj, stl, "
                     "off, ply, 3mf, glb, amf, step and dxf");
}

namespace {

PolygonMesh read_one_mesh(std::string_view data, MeshFormat format, const std::string& name,
                          const ReadOptions& options, MeshSink* sink) {
    if (format == MeshFormat::Stl) format = detect_stl_kind(data);
    const bool binary = format == MeshFormat::StlBinary;
    detail::InputText source(data, name, options.limits, binary);
    source.give_pieces_to(sink);
    if (data.size() > options.limits.bytes) {
        throw LimitError(name + ": more than " + std::to_string(options.limits.bytes) +
                         " bytes, the limit for a file");
    }
    if (data.empty()) source.fail(source.begin(), "the file is empty");
    switch (format) {
        case MeshFormat::Obj:
            return detail::read_obj(source);
        case MeshFormat::Off:
            return detail::read_off(source);
        case MeshFormat::Ply:
            return detail::read_ply(source);
        case MeshFormat::StlBinary:
            return detail::read_stl_binary(source);
        default:
            break;
    }
    return detail::read_stl_ascii(source);
}

}  // namespace

PolygonMesh read_mesh(std::string_view data, MeshFormat format, const std::string& name,
                      const ReadOptions& options) {
    if (!holds_models(format)) return read_one_mesh(data, format, name, options, nullptr);
    const Model model = read_model(data, format, name, options);
    return model.parts.size() == 1 ? model.parts.front().mesh : merged(model);
}

bool is_read_in_pieces(MeshFormat format) noexcept { return !holds_models(format); }

void read_mesh_in_pieces(std::string_view data, MeshFormat format, const std::string& name,
                         MeshSink& sink, const ReadOptions& options) {
    if (!is_read_in_pieces(format))
        throw UnsupportedError(name + ": " + std::string(to_string(format)) +
                               " is not read in pieces");
    (void)read_one_mesh(data, format, name, options, &sink);
}

PolygonMesh read_mesh(std::span<const std::byte> data, MeshFormat format, const std::string& name,
                      const ReadOptions& options) {
    // Looking at objects through char is always allowed.
    return read_mesh(std::string_view(reinterpret_cast<const char*>(data.data()), data.size()),
                     format, name, options);
}

PolygonMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    const FileBytes bytes = read_file(path, options.limits.bytes);
    return read_mesh(bytes.view(), mesh_format_of(path, bytes.view(), options), path.string(),
                     options);
}

}  // namespace trisect
