// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_import.h>

#include <algorithm>
#include <cctype>
#include <string>

#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/io/read_mesh.h>

namespace trisect::detail {
namespace {

std::string extension_of(const std::filesystem::path& file) {
    std::string out = file.extension().string();
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

std::string name_of(const CsgArguments& arguments) {
    const CsgValue* value = arguments.find("file");
    if (value == nullptr) return {};
    if (value->text() == nullptr)
        arguments.fail(ErrorCode::Input, value->place, "file must be a text");
    return *value->text();
}

}  // namespace

bool is_flat_import(const CsgArguments& arguments) {
    const CsgValue* value = arguments.find("file");
    if (value == nullptr || value->text() == nullptr) return false;
    const std::string extension = extension_of(*value->text());
    return extension == ".dxf" || extension == ".svg";
}

std::filesystem::path csg_file(const CsgArguments& arguments, const std::filesystem::path& folder) {
    const std::filesystem::path name = name_of(arguments);
    return name.empty() || name.is_absolute() ? name : folder / name;
}

PolygonMesh csg_import(const CsgArguments& arguments, const std::filesystem::path& file) {
    if (!mesh_format_of_extension(file))
        arguments.fail(ErrorCode::Unsupported,
                       "files of the kind '" + extension_of(file).substr(0, 20) + "' are not read");
    return read_mesh(file);
}

}  // namespace trisect::detail
