// SPDX-License-Identifier: Apache-2.0
#include "models.h"

#include "solids.h"

namespace models {

using trisect::InterferenceModel;
using trisect::Point3d;

InterferenceModel box(const Point3d& low, const Point3d& high) {
    return InterferenceModel(solids::box(low, high));
}

InterferenceModel box(double x0, double y0, double z0, double x1, double y1, double z1) {
    return InterferenceModel(solids::box(x0, y0, z0, x1, y1, z1));
}

InterferenceModel box(double low, double high) { return InterferenceModel(solids::box(low, high)); }

InterferenceModel of_mesh(const trisect::PolygonMesh& mesh) {
    return InterferenceModel(trisect::Solid::from_mesh(mesh));
}

}  // namespace models
