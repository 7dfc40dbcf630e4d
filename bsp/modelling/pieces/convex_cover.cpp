// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/modelling/pieces/convex_cover.h>

#include <utility>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/convex_sweep.h>
#include <trisect/bsp/modelling/pieces/convex_body.h>
#include <trisect/bsp/modelling/pieces/cover_boundary.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

// Of more bodies it is not found out whether they are all of the inside.
constexpr std::size_t most_bodies = 64;

bool are_apart(std::vector<ConvexBody>& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!bodies[i].is_kept_apart_from(bodies[j].corners()) &&
                !bodies[j].is_kept_apart_from(bodies[i].corners()))
                return false;
    return true;
}

ExactRational volume_of(const ConvexBody& body, const LatticeMesh& mesh) {
    std::vector<LatticePoint> points;
    for (const std::uint32_t v : body.corners()) points.push_back(mesh.points[v]);
    return exact_volume(hull_mesh(points, mesh.lattice));
}

// Bodies within a solid that have no interior in common are all of it if their volumes are.
bool do_fill(std::vector<ConvexBody>& bodies, const LatticeMesh& mesh) {
    std::erase_if(bodies, [](const ConvexBody& b) { return b.is_flat(); });
    if (bodies.empty() || bodies.size() > most_bodies || !are_apart(bodies)) return false;
    ExactRational sum = volume_of(bodies[0], mesh);
    for (std::size_t i = 1; i < bodies.size(); ++i) sum += volume_of(bodies[i], mesh);
    return sum == exact_volume(mesh);
}

}  // namespace

ConvexCover convex_cover(const LatticeMesh& mesh, CoverSide side) {
    CoverBoundary boundary(mesh, side);
    std::vector<std::uint8_t> covered(boundary.size(), 0);
    std::vector<ConvexBody> bodies;
    ConvexCover out;
    for (std::uint32_t t = 0; t < boundary.size(); ++t) {
        if (covered[t] != 0) continue;
        check_stop(boundary.size());
        ConvexBody body(boundary, covered, t);
        for (const std::uint32_t c : body.covered_triangles()) covered[c] = 1;
        out.bodies.push_back(body.corners());
        if (bodies.size() <= most_bodies && !body.is_flat()) bodies.push_back(std::move(body));
    }
    out.fills = side == CoverSide::Inside && do_fill(bodies, mesh);
    return out;
}

}  // namespace trisect::detail
