// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_import.h>

#include <algorithm>
#include <cctype>
#include <string>

#include <trisect/brep/io/mesh_format.h>
#include <trisect/brep/io/read_mesh.h>

namespace trisect::detail {

std::string csg_extension(const std::filesystem::path& file) {
    std::string out = file.extension().string();
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

bool is_flat_import(const CsgArguments& arguments) {
    const CsgValue* value = arguments.find("file");
    if (value == nullptr || value->text() == nullptr) return false;
    const std::string extension = csg_extension(*value->text());
    return extension == ".dxf" || extension == ".svg";
}

std::filesystem::path csg_file(const CsgArguments& arguments, const std::filesystem::path& folder) {
    const std::filesystem::path name = arguments.text("file", "");
    return name.empty() || name.is_absolute() ? name : folder / name;
}

PolygonMesh csg_import(const CsgArguments& arguments, const std::filesystem::path& file) {
    if (!mesh_format_of_extension(file))
        arguments.fail(
            ErrorCode::Unsupported,
            "files of the kind '" + csg_extension(file).substr(0, 20) + "' are not read");
#ifdef TRISECT_WITHOUT_FILES
    // Readers would be a tenth of such a module.
    arguments.fail(ErrorCode::Unsupported, "this build reads no files");
#else
    return read_mesh(file);
#endif
}

}  // namespace trisect::detail
