// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/level_set.h>

namespace trisect {
namespace {

Solid solid_of(const PolygonMesh& mesh) {
    return mesh.face_count() == 0 ? Solid() : Solid::from_mesh(mesh);
}

}  // namespace

Solid level_set(const FunctionOfSpace& function, const Bounds& box, double edge_length,
                const LevelSetOptions& options) {
    return solid_of(make_level_set(function, box, edge_length, options));
}

Solid level_set_by_batches(const BatchOfValues& function, const Bounds& box, double edge_length,
                           const LevelSetOptions& options) {
    return solid_of(make_level_set_by_batches(function, box, edge_length, options));
}

}  // namespace trisect
