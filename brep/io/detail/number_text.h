// SPDX-License-Identifier: Apache-2.0
//
// Numbers as text: the shortest digits that read back as the same double (std::to_chars).
#pragma once

#include <trisect/brep/polygon_mesh.h>

#include <charconv>
#include <cstdint>
#include <string>

namespace trisect::detail {

/// At most 24 characters, for instance -2.2250738585072014e-308.
template <class Real>
inline void append_real(std::string& out, Real value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    out.append(text, end);
}

inline void append_integer(std::string& out, std::uint64_t value) {
    char text[24];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    out.append(text, end);
}

/// `x y z`
inline void append_point(std::string& out, const Point3d& p) {
    append_real(out, p[0]);
    out += ' ';
    append_real(out, p[1]);
    out += ' ';
    append_real(out, p[2]);
}

}  // namespace trisect::detail
