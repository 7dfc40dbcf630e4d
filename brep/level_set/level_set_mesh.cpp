// SPDX-License-Identifier: Apache-2.0
//
// Why the mesh does not touch itself. Let lengths be in cells, axis by axis.
//
// Cells are convex and their centres inside, and segments between centres pass through faces. So
// the tetrahedra fill the box, and after nodes moved they still do: a map that is linear on each
// tetrahedron, preserves all orientations and is one to one on the boundary is one to one. The six-
// fold volume of each is 1/2 without moves, 1/4 beside a side of the box, and never below 1/16
// (level_snap.cpp).
//
// Within a tetrahedron the surface has its corners on edges between nodes of different signs, and
// on nodes of sign 0. Cut it there: both parts are tetrahedra or fall apart into some, with
// diagonals of faces that begin at the node of the smallest number, alike on both sides. The six-
// fold volume of a part is 1/16 times at most three distances of crossings from ends of edges, in
// edges, so 2^-28 at least. With exact crossings the surface would be made of faces of these parts.
//
// Crossings are rounded. An axis has coordinates below 2^20 cells, so rounding moves them by 2^-33
// and a bit, and changes sixfold volumes by less than 16 times that, 2^-29. All parts keep their
// orientation, those of faces in sides of the box, too; sides stay in their planes, since both ends
// of an edge in them have the same coordinate. So the parts fill the box as before, and the mesh is
// the boundary of some of them.
//
// Around a crossing the surface goes once, as the tetrahedra do around its edge; around a node of
// sign 0 it does since else the node had not moved. So no edge has four faces, no vertex two fans.
#include <trisect/brep/level_set/level_set_mesh.h>

#include <trisect/brep/level_set/level_crossings.h>
#include <trisect/brep/level_set/level_faces.h>
#include <trisect/brep/level_set/level_grid.h>
#include <trisect/brep/level_set/level_snap.h>
#include <trisect/brep/level_set/level_values.h>

namespace trisect {

PolygonMesh make_level_set_by_batches(const BatchOfValues& function, const Bounds& box,
                                      double edge_length, const LevelSetOptions& options) {
    const detail::LevelGrid grid(box, edge_length, options.most_cells);
    std::vector<std::int8_t> signs;
    std::vector<detail::LevelCrossing> crossings;
    {
        const detail::LevelValues values(grid, function, options);
        signs = values.signs();
        crossings = detail::level_crossings(grid, values, function, options);
    }
    const auto moved = detail::move_nodes_to_surface(grid, crossings, signs);
    return detail::level_faces(grid, crossings, signs, moved);
}

PolygonMesh make_level_set(const FunctionOfSpace& function, const Bounds& box, double edge_length,
                           const LevelSetOptions& options) {
    const auto each = [&](std::span<const Point3d> places, std::span<double> values) {
        for (std::size_t i = 0; i < places.size(); ++i) values[i] = function(places[i]);
    };
    return make_level_set_by_batches(each, box, edge_length, options);
}

}  // namespace trisect
