// SPDX-License-Identifier: Apache-2.0
//
// The library's results in the form in which the reference engine compares boundaries.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/bsp/evaluate/translate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "evaluate_stats.h"
#include "reference/naive_boolean.h"
#include "reference/random_solids.h"

namespace engines {

/// A lattice mesh with one point per distinct corner; of unit 2^bits, where coordinates have so
/// many bits behind the point. \pre coordinates are doubles.
trisect::LatticeMesh lattice_mesh(const reference::Operand& operand, int bits = 0);

/// The operand as a solid whose boundary may meet itself.
trisect::Solid solid(const reference::Operand& operand,
                     trisect::Embedding embedding = trisect::Embedding::Resolve, int bits = 0);

/// A solid under a random map with integer coefficients: out of the grid of all others.
reference::Operand mapped(const reference::Operand& operand, reference::Random& random);

/// The same formula over solids.
trisect::Expression formula(const reference::Expression& expression,
                            const std::vector<trisect::Solid>& solids);

/// Faces with exact rational corners, in the user's units.
std::vector<reference::Polygon> polygons(const trisect::Brep& brep);

/// Why a B-rep is not what the canonical boundary says; empty when it is. Checks the set, and that
/// the faces are maximal and the vertices are the real ones: nothing of the tree may show.
std::string difference(const trisect::Brep& brep, const reference::CanonicalBoundary& expected);

/// The boundary of any set in triangles; Solid::to_mesh() refuses sets that are unbounded.
trisect::PolygonMesh boundary_mesh(const trisect::Solid& solid);

/// Why the triangles of a result do not close, corner index by corner index; empty when they do.
std::string open_edge(const trisect::PolygonMesh& mesh);

/// The formula by a tree of cells, whatever else the library has for it.
[[nodiscard]] trisect::Solid evaluate_by_cells(const trisect::Expression& expression,
                                               const trisect::EvaluateOptions& options = {},
                                               trisect::test::EvaluateStats* stats = nullptr);

/// What is different where two meshes are evaluated without being divided
/// (two_meshes_without_tree.h), empty when the mesh is the same corner by corner; nothing where
/// they are divided. Meshes of any size are tried, pieces as well. `conforming`: whether the meshes
/// were not cut (conforming_meshes.h).
[[nodiscard]] std::optional<std::string> undivided_difference(
    const trisect::Expression& expression, const trisect::EvaluateOptions& options,
    bool* conforming = nullptr);

/// With copies of operands that are named again, where these can be made (named_slots.h).
[[nodiscard]] trisect::detail::Translation each_once(const trisect::Expression& expression);

/// What is wrong where a formula over many meshes is evaluated pair by pair, without a tree
/// (many_meshes_without_tree.h), wherever they lie and by one, two or four threads: another
/// boundary than expected, an open edge, other bytes. Empty when nothing is; nothing where it is
/// not evaluated so. `doubtful`: the pairs that doubles left open.
[[nodiscard]] std::optional<std::string> pairwise_difference(
    const trisect::Expression& expression, const trisect::EvaluateOptions& options,
    const reference::CanonicalBoundary& expected, std::uint64_t& doubtful);

}  // namespace engines
