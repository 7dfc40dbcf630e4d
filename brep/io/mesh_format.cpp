// SPDX-License-Identifier: Apache-2.0
//
// Recognising formats. Only the first statement of a text is looked at, and the arithmetic on sizes
// is done in 64 bits, so the cost does not depend on the file.
#include <trisect/brep/io/mesh_format.h>

#include <trisect/brep/io/formats/binary.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace trisect {
namespace {

constexpr std::array<std::pair<std::string_view, MeshFormat>, 11> names{{
    {"obj", MeshFormat::Obj},
    {"stl", MeshFormat::Stl},
    {"stl-ascii", MeshFormat::StlAscii},
    {"stl-binary", MeshFormat::StlBinary},
    {"off", MeshFormat::Off},
    {"ply", MeshFormat::Ply},
    {"3mf", MeshFormat::ThreeMf},
    {"glb", MeshFormat::Glb},
    {"amf", MeshFormat::Amf},
    {"step", MeshFormat::Step},
    {"dxf", MeshFormat::Dxf},
}};

constexpr char lower(char c) noexcept {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_word(std::string_view a, std::string_view b) noexcept {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                              [](char x, char y) { return lower(x) == lower(y); });
}

bool is_space(char c) noexcept { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The data without a byte order mark, leading blanks and, optionally, leading comment lines.
std::string_view skip_preamble(std::string_view data, bool comments) noexcept {
    if (data.starts_with("\xEF\xBB\xBF")) data.remove_prefix(3);
    for (;;) {
        std::size_t n = 0;
        while (n < data.size() && is_space(data[n])) ++n;
        data.remove_prefix(n);
        if (!comments || data.empty() || data.front() != '#') return data;
        const std::size_t eol = data.find_first_of("\r\n");
        data.remove_prefix(eol == std::string_view::npos ? data.size() : eol);
    }
}

std::string_view first_word(std::string_view data) noexcept {
    std::size_t n = 0;
    while (n < data.size() && n < 32 && !is_space(data[n])) ++n;
    return data.substr(0, n);
}

bool is_off_keyword(std::string_view word) noexcept {
    const std::size_t at = word.find("OFF");
    if (at == std::string_view::npos || at > 5) return false;
    return word.substr(0, at).find_first_not_of("STCN4n") == std::string_view::npos;
}

bool is_obj_keyword(std::string_view word) noexcept {
    constexpr std::array<std::string_view, 10> keywords{"v", "vt", "vn", "vp",     "f",
                                                        "g", "o",  "s",  "mtllib", "usemtl"};
    return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

/// The first pair of lines is 0 and SECTION, after comments, whose code is 999.
bool begins_like_dxf(std::string_view data) noexcept {
    data = skip_preamble(data, false);
    while (first_word(data) == "999") {
        for (int line = 0; line < 2; ++line) {
            const std::size_t eol = data.find_first_of("\r\n");
            if (eol == std::string_view::npos) return false;
            data = skip_preamble(data.substr(eol), false);
        }
    }
    if (first_word(data) != "0") return false;
    return first_word(skip_preamble(data.substr(1), false)) == "SECTION";
}

bool has_binary_stl_size(std::string_view data) noexcept {
    if (data.size() < detail::stl_header_size) return false;
    const auto count = detail::load<std::uint32_t, false>(data.data() + 80);
    return detail::stl_header_size + std::uint64_t{count} * detail::stl_record_size == data.size();
}

bool begins_like_ascii_stl(std::string_view data) noexcept {
    if (data.substr(0, detail::stl_header_size).find('\0') != std::string_view::npos) return false;
    return same_word(skip_preamble(data, false).substr(0, 5), "solid");
}

}  // namespace

std::string_view to_string(MeshFormat format) noexcept {
    for (const auto& [name, value] : names) {
        if (value == format) return name;
    }
    return "?";
}

std::optional<MeshFormat> mesh_format_from_name(std::string_view name) noexcept {
    for (const auto& [known, value] : names) {
        if (same_word(known, name)) return value;
    }
    return std::nullopt;
}

std::optional<MeshFormat> mesh_format_of_extension(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    const std::string_view word = std::string_view(extension).substr(extension.empty() ? 0 : 1);
    if (same_word(word, "stp")) return MeshFormat::Step;
    // The names of the two kinds of STL are no extensions.
    if (word.size() != 3 && !same_word(word, "step")) return std::nullopt;
    return mesh_format_from_name(word);
}

bool holds_triangles_only(MeshFormat format) noexcept {
    switch (format) {
        case MeshFormat::Obj:
        case MeshFormat::Off:
        case MeshFormat::Ply:
        case MeshFormat::Step:
        case MeshFormat::Dxf:
            return false;
        default:
            return true;
    }
}

bool holds_floats(MeshFormat format) noexcept {
    return format == MeshFormat::Stl || format == MeshFormat::StlBinary ||
           format == MeshFormat::Glb;
}

MeshFormat detect_stl_kind(std::string_view data) noexcept {
    if (has_binary_stl_size(data)) return MeshFormat::StlBinary;
    return begins_like_ascii_stl(data) ? MeshFormat::StlAscii : MeshFormat::StlBinary;
}

std::optional<MeshFormat> detect_mesh_format(std::string_view data) noexcept {
    if (data.starts_with("glTF")) return MeshFormat::Glb;
    if (data.starts_with(std::string_view("PK\3\4", 4))) return MeshFormat::ThreeMf;
    if (skip_preamble(data, false).starts_with('<') &&
        data.substr(0, 1024).find("<amf") != std::string_view::npos)
        return MeshFormat::Amf;
    if (skip_preamble(data, false).starts_with("ISO-10303-21")) return MeshFormat::Step;
    if (begins_like_dxf(data) || data.starts_with("AutoCAD Binary DXF")) return MeshFormat::Dxf;
    if (data.starts_with("ply\n") || data.starts_with("ply\r")) return MeshFormat::Ply;
    if (has_binary_stl_size(data)) return MeshFormat::StlBinary;
    if (begins_like_ascii_stl(data)) return MeshFormat::StlAscii;
    const std::string_view word = first_word(skip_preamble(data, true));
    if (is_off_keyword(word)) return MeshFormat::Off;
    if (is_obj_keyword(word)) return MeshFormat::Obj;
    return std::nullopt;
}

}  // namespace trisect
