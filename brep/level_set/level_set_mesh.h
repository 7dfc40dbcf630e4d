// SPDX-License-Identifier: Apache-2.0
//
// Level sets: boundaries of sets where a function is above a level.
//
// The set is taken within a box. The box is filled with tetrahedra of a body-centred cubic grid,
// and the surface within each of them is that of the linear function through the values at its
// corners (Doi, Koide 1991). Vertices are on edges of the grid. A corner of the grid that is nearer
// to one than a quarter of the edge moves there, where that leaves the surface a surface (Labelle,
// Shewchuk 2007): slivers are rare then.
//
// What is exact: the mesh is closed and does not touch itself, whatever the function is
// (level_set_mesh.cpp has the proof). Faces along the sides of the box lie in them. What is
// rounded: each vertex once, along and beside its edge, by at most two units in the last place of
// the box's largest coordinate on that axis. What is approximate: the surface between vertices, and
// what the function does between corners of the grid.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <trisect/brep/measure.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

using FunctionOfSpace = std::function<double(const Point3d&)>;
/// Many values at once: as many results as points, some thousand a call.
using BatchOfValues = std::function<void(std::span<const Point3d>, std::span<double>)>;

struct LevelSetOptions {
    double level = 0;
    /// How often the function is called on each edge that crosses the surface, to find where. With
    /// 0 a vertex is where the line between the values at both ends is at the level: exact for
    /// linear functions. Each call halves the interval at least, on average over two.
    std::uint32_t root_steps = 0;
    /// Threads that may call the function; 0 means one for every processor. The mesh does not
    /// depend on it, as long as values depend on points alone.
    std::uint32_t threads = 1;
    /// Most cells, of two samples and some 35 bytes each.
    std::uint64_t most_cells = std::uint64_t{1} << 24;
};

/// The boundary of the set of all points of the box where the function is above the level: outward
/// is where it is lower. Values at the level count as below, and so does all that is outside the
/// box. The grid's cells are as long as `edge_length` at most, a whole number of them on each axis.
/// No faces where no sample is above.
///
/// Where samples leave the surface no simple place (a value at the level in a corner where parts of
/// the set meet), vertices stay away from the corner by 1/256 of the edge, so that parts are apart.
/// O(cells), some tenths of a microsecond each, and two calls of the function for each.
/// \throw UsageError for a box without volume or with sides that are not finite, a length that is
/// not positive, values that are not finite (with the place); LimitError for more cells than
/// allowed, or coordinates of the box beyond 2^20 cells; what the function throws; CancelledError
[[nodiscard]] PolygonMesh make_level_set(const FunctionOfSpace& function, const Bounds& box,
                                         double edge_length, const LevelSetOptions& options = {});
[[nodiscard]] PolygonMesh make_level_set_by_batches(const BatchOfValues& function,
                                                    const Bounds& box, double edge_length,
                                                    const LevelSetOptions& options = {});

}  // namespace trisect
