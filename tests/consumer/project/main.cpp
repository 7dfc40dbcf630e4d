// SPDX-License-Identifier: Apache-2.0
//
// The smallest program that needs the installed headers and libraries.
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/plane.h>

int main() {
    trisect::PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.add_triangle(0, 1, 2);

    const auto floor = trisect::Plane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return mesh.face_count() == 1 && floor.dominant_axis() == 2 ? 0 : 1;
}
