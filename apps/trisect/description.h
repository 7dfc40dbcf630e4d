// SPDX-License-Identifier: Apache-2.0
//
// Description: counts and measures of a boundary.
// `info` shows them, and booleans report those of their results.
#pragma once

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "outcome.h"

namespace trisect::app {

/// What cannot be told of a boundary (the volume of an open one) has no value.
struct Description {
    std::size_t vertices = 0;
    std::size_t edges = 0;
    std::size_t faces = 0;                ///< polygons with area
    std::size_t triangles = 0;            ///< that fill them
    std::size_t shells = 0;               ///< connected by edges
    std::optional<std::ptrdiff_t> genus;  ///< sum over the shells; of a closed boundary
    bool closed = false;
    std::optional<double> volume;  ///< correctly rounded
    std::optional<ExactRational> volume_exact;
    double area = 0;
    std::optional<Bounds> bounds;
    LatticeReport lattice;
};

struct DescriptionOptions {
    bool exact = false;    ///< fill volume_exact
    bool measures = true;  ///< fill area and bounds
};

/// Of a mesh as it was read: points of equal value are one vertex. Vertices and edges where the
/// boundary touches itself count as often as they do in a Brep.
[[nodiscard]] Description describe(const ImportedMesh& imported, DescriptionOptions options = {});
[[nodiscard]] Description describe(const Brep& brep, DescriptionOptions options = {});
/// Of a result before it is rounded: its faces are its triangles. `boundary` is called where the
/// result touches itself, for the shells and the genus.
[[nodiscard]] Description describe(const ExactMesh& mesh, const std::function<Brep()>& boundary,
                                   DescriptionOptions options = {});

[[nodiscard]] Json to_json(const Description& description);
/// Aligned lines.
[[nodiscard]] std::string to_text(const Description& description);

}  // namespace trisect::app
