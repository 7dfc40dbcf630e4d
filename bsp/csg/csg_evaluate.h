// SPDX-License-Identifier: Apache-2.0
//
// Evaluation of programs in OpenSCAD's evaluated form, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <trisect/bsp/csg/csg_tree.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// Red, green, blue and opacity, 0 to 1.
using CsgColor = std::array<double, 4>;

/// Of an evaluation that goes on.
struct CsgProgress {
    const CsgNode* node = nullptr;  ///< being evaluated; null: the formula of the whole program
    std::size_t done = 0;           ///< nodes, with those that are a part of the formula
    std::size_t count = 0;          ///< nodes that count
};

struct CsgOptions {
    EvaluateOptions evaluate = {};
    /// Where relative names of import() and surface() start; nothing: that of CsgTree::file.
    std::optional<std::filesystem::path> folder = std::nullopt;
    bool reads_files = true;  ///< otherwise import() and surface() are refused
    /// A file that is not there is an empty set, with a remark, as in OpenSCAD; otherwise an error.
    bool missing_files_are_empty = false;
    /// A node that is refused (Input, InvalidSolid, Unsupported) is an empty set, with a remark; so
    /// is all below a matrix that is refused. Names of nodes that are not known, and limits, end
    /// the evaluation all the same.
    bool leaves_out_refused = false;
    /// Whether the report has colours of faces; shapes of two colours are two operands then.
    bool keeps_colors = false;
    /// Called by the evaluating thread when it comes to a node, and when it comes back to it.
    std::function<void(const CsgProgress&)> on_progress = nullptr;
};

/// Nodes of one name.
struct CsgNodeCount {
    std::size_t nodes = 0;        ///< that count
    std::size_t found_again = 0;  ///< of them, those whose set was made before for equal content
    friend bool operator==(const CsgNodeCount&, const CsgNodeCount&) = default;
};

struct CsgReport {
    std::size_t nodes = 0;        ///< of the program
    std::size_t leaves = 0;       ///< shapes that were used
    std::size_t meshes = 0;       ///< of them, different ones: equal shapes are made once
    std::size_t evaluations = 0;  ///< formulas; one, but for turned groups, hulls and extrusions
    std::size_t found_again = 0;  ///< subtrees whose set was made before, by their content
    std::map<std::string, CsgNodeCount> by_name;
    bool is_flat = false;  ///< the program describes a region of the plane
    /// Colours of faces by FaceSource::operand, as numbers of `colors`, where they are kept. As in
    /// OpenSCAD an outer color() counts for all that is in it. What was made of children as a
    /// whole (a hull, an extrusion) has the colour that it stands in.
    std::vector<CsgColor> colors;
    std::map<std::uint32_t, std::uint32_t> color_of_source;
    std::vector<std::string> remarks;  ///< what was left out, with its place; the first hundred
};

/// The set that a program describes. A region of the plane is returned as the prism over it
/// between z = 0 and z = 1.
///
/// Corners of shapes are doubles, and formulas over them are exact. Rounded once are: corners of
/// round shapes; corners under a matrix that turns by more than a change of axes; corners that a
/// boolean has made, where a turned group, hull(), a twisted or tapered linear_extrude() or
/// rotate_extrude() takes them.
/// \throw CsgError: (Unsupported) for nodes that are not known, (Input) for arguments that make no
/// sense, (InvalidSolid) for a polyhedron that bounds no solid; what evaluate() throws
[[nodiscard]] Solid evaluate_csg(const CsgTree& tree, const CsgOptions& options = {},
                                 CsgReport* report = nullptr);

}  // namespace trisect
