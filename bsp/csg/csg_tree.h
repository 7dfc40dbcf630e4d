// SPDX-License-Identifier: Apache-2.0
//
// CsgTree: a program in OpenSCAD's evaluated form (.csg), as it was written.
//
// That form has calls alone: a name, arguments that are constants, and children in braces. OpenSCAD
// writes it with `openscad -o FILE.csg FILE.scad`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <trisect/bsp/csg/csg_error.h>

namespace trisect {

/// Both count from 1.
struct CsgPlace {
    std::uint32_t line = 0;
    std::uint32_t column = 0;
};

/// undef, a truth value, a number (inf and nan as well), a text or a list of values.
struct CsgValue {
    using List = std::vector<CsgValue>;
    std::variant<std::monostate, bool, double, std::string, List> data;
    CsgPlace place;

    [[nodiscard]] bool is_undefined() const { return data.index() == 0; }
    [[nodiscard]] const bool* truth() const { return std::get_if<bool>(&data); }
    [[nodiscard]] const double* number() const { return std::get_if<double>(&data); }
    [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&data); }
    [[nodiscard]] const List* list() const { return std::get_if<List>(&data); }
};

struct CsgArgument {
    std::string name;  ///< of a known node never empty, by OpenSCAD's parameter lists
    CsgValue value;
};

struct CsgModifiers {
    bool disabled = false;    ///< *
    bool root = false;        ///< !
    bool highlight = false;   ///< #
    bool background = false;  ///< %
};

struct CsgNode {
    std::string name;
    CsgModifiers modifiers;
    CsgPlace place;
    std::vector<CsgArgument> arguments;
    std::vector<std::uint32_t> children;  ///< indices of nodes
};

/// Invariant: children have larger indices than their parents, and one parent each.
struct CsgTree {
    std::string file;
    std::vector<CsgNode> nodes;
    std::vector<std::uint32_t> roots;

    [[nodiscard]] FilePlace place(CsgPlace p) const { return {file, p.line, p.column, 0}; }
};

struct CsgLimits {
    std::uint32_t depth = 400;  ///< of nested nodes and lists together
    std::size_t nodes = 1'000'000;
    std::size_t values = 10'000'000;  ///< numbers, texts and lists
};

/// Reads a program. O(n). `file` is the name in errors.
/// \throw CsgError (Input) where the text is malformed, (Unsupported) where a known node has no
/// such parameter, (Limit) beyond the limits
[[nodiscard]] CsgTree parse_csg(std::string_view text, std::string file,
                                const CsgLimits& limits = {});

}  // namespace trisect
