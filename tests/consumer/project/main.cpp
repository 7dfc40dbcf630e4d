// SPDX-License-Identifier: Apache-2.0
//
// The smallest program that needs the installed headers and libraries.
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/error.h>

int main() {
    trisect::PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.add_triangle(0, 1, 2);
    return mesh.face_count() == 1 ? 0 : 1;
}
