// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/properties/picture_files.h>

#include <filesystem>

namespace trisect::detail {

std::string media_type_of(std::string_view bytes, std::string_view file) {
    if (bytes.starts_with("\x89PNG")) return "image/png";
    if (bytes.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
    const std::size_t dot = file.rfind('.');
    std::string extension(dot == std::string_view::npos ? std::string_view() : file.substr(dot));
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (extension == ".png") return "image/png";
    if (extension == ".jpg" || extension == ".jpeg") return "image/jpeg";
    return extension == ".webp" ? "image/webp" : "";
}

std::string extension_of_media(std::string_view media_type) {
    if (media_type == "image/png") return ".png";
    if (media_type == "image/jpeg") return ".jpg";
    return media_type == "image/webp" ? ".webp" : ".picture";
}

std::string stem_of(const std::string& path) {
    const std::string stem = std::filesystem::path(path).stem().string();
    return stem.empty() || stem == "-" ? "model" : stem;
}

}  // namespace trisect::detail
