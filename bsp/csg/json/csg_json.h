// SPDX-License-Identifier: Apache-2.0
//
// Programs as JSON, for other programs to write.
// The trees are those of the evaluated form.
//
//     {"schema": "trisect.csg/1",
//      "nodes": [{"node": "difference", "children": [
//        {"node": "cube", "arguments": {"size": [4, 4, 4]}},
//        {"node": "import", "arguments": {"file": "part.stl"}, "modifiers": "#"}]}]}
//
// Members and their meaning are in docs/eval.md.
#pragma once

#include <string>
#include <string_view>

#include <trisect/bsp/csg/csg_tree.h>

namespace trisect {

/// Reads a program. Strict: a member that is not known, or comes twice, is refused by its name. O(n
/// log n). `file` is the name in errors, and relative names of files start in its folder. Where
/// the member "file" names the text that the program was made of, CsgTree::file is that name, from
/// the same folder on, and places are those of "place".
/// \throw CsgError (Input) where the text is malformed, (Unsupported) for members, schemas and
/// parameters that are not known, (Limit) beyond the limits
[[nodiscard]] CsgTree parse_csg_json(std::string_view text, std::string file,
                                     const CsgLimits& limits = {});

/// The text of a tree; parse_csg_json() makes the same tree of it, but that all values of a node
/// have its place, and that of two arguments with a name the last one, which counts, is left. A
/// node a line. O(n) and the length of the text; recursion is as deep as the tree.
/// \throw CsgError (Unsupported) for a text that is not UTF-8
[[nodiscard]] std::string csg_json_text(const CsgTree& tree);

}  // namespace trisect
