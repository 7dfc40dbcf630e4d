// SPDX-License-Identifier: Apache-2.0
//
// Eigen matrices in and out: a tetrahedron is checked, rotated and written back to matrices.

#include <iostream>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/interop/eigen.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/validate.h>

int main() {
    Eigen::MatrixXd vertices(4, 3);
    vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    Eigen::MatrixXi faces(4, 3);
    faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;

    const trisect::PolygonMesh mesh = trisect::from_eigen(vertices, faces);
    const trisect::ValidationReport report = trisect::validate(mesh);
    if (!report.is_solid()) {
        std::cout << report.to_string();
        return 1;
    }
    const auto turned = trisect::transformed(mesh, trisect::AffineMap::rotation({0, 0, 1}, 90));
    const trisect::EigenMesh out = trisect::to_eigen(trisect::import_mesh(turned).mesh);
    std::cout << out.vertices << "\n\n" << out.faces << '\n';
    return out.faces.rows() == 4 ? 0 : 1;
}
