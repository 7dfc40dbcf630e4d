// SPDX-License-Identifier: Apache-2.0
//
// What the library does not have. Errors are passed on before anything is refused.

#include <manifold/manifold.h>

#include "node.h"

namespace manifold {

namespace {

Manifold refuse(const Manifold& m, const char* what) {
    if (m.Status() == Manifold::Error::NoError) throw NotSupported(what);
    return m;
}

}  // namespace

Manifold Manifold::LevelSet(const std::function<double(vec3)>& /*sdf*/, Box /*bounds*/,
                            double /*edgeLength*/, double /*level*/, double /*tolerance*/,
                            bool /*canParallel*/) {
    throw NotSupported("LevelSet");
}
Manifold Manifold::CalculateCurvature(int /*gaussianIdx*/, int /*meanIdx*/) const {
    return refuse(*this, "CalculateCurvature");
}
Manifold Manifold::RefineToLength(double /*length*/) const {
    return refuse(*this, "RefineToLength");
}
Manifold Manifold::RefineToTolerance(double /*tolerance*/) const {
    return refuse(*this, "RefineToTolerance");
}
Manifold Manifold::SmoothByNormals(int /*normalIdx*/) const {
    return refuse(*this, "SmoothByNormals");
}
Manifold Manifold::SmoothOut(double /*minSharpAngle*/, double /*minSmoothness*/) const {
    return refuse(*this, "SmoothOut");
}
Manifold Manifold::Smooth(const MeshGL& mesh, const std::vector<Smoothness>& /*sharpened*/) {
    return refuse(Manifold(mesh), "Smooth");
}
Manifold Manifold::Smooth(const MeshGL64& mesh, const std::vector<Smoothness>& /*sharpened*/) {
    return refuse(Manifold(mesh), "Smooth");
}

}  // namespace manifold
