// SPDX-License-Identifier: Apache-2.0
//
// Header of a PLY file: its elements and their typed properties.
// It is a small schema language: which elements follow, how many of each, and which properties,
// of which type, each entry has.
#pragma once

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/write_mesh.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

enum class PlyType : std::uint8_t {
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Int64,   ///< not in the specification, but unambiguous
    UInt64,  ///< likewise
    Float32,
    Float64
};

[[nodiscard]] constexpr std::uint64_t size_of(PlyType type) noexcept {
    switch (type) {
        case PlyType::Int8:
        case PlyType::UInt8:
            return 1;
        case PlyType::Int16:
        case PlyType::UInt16:
            return 2;
        case PlyType::Int32:
        case PlyType::UInt32:
        case PlyType::Float32:
            return 4;
        case PlyType::Int64:
        case PlyType::UInt64:
        case PlyType::Float64:
            break;
    }
    return 8;
}

[[nodiscard]] constexpr bool is_integer(PlyType type) noexcept {
    return type != PlyType::Float32 && type != PlyType::Float64;
}

struct PlyProperty {
    std::string name;
    PlyType type{};        ///< of the value, or of the items of a list
    bool is_list = false;  ///< a count and then so many items
    PlyType count_type{};  ///< of the count of a list; an integer type
    const char* at = nullptr;
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;  ///< as stated: a hint until so many entries were read
    std::vector<PlyProperty> properties;
    const char* at = nullptr;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::Ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string_view> comments;  ///< without the keyword; in the bytes of the file
    const char* body = nullptr;              ///< the first byte after the header
};

/// Reads and checks the syntax; what the elements mean is not looked at.
[[nodiscard]] PlyHeader read_ply_header(const InputText& source);

}  // namespace trisect::detail
