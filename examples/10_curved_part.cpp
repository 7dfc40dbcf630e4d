// SPDX-License-Identifier: Apache-2.0
//
// Curved surfaces as operands: a torus and a sphere made of rational Bézier patches become solids
// within a stated deviation; a groove for the ring is cut into the ball, exactly. Before that, the
// surfaces themselves say how far they are from each other.

#include <cstdio>

#include <trisect/brep/curved/curved_shapes.h>
#include <trisect/brep/curved/tessellate.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/hierarchies/curved/patch_distance.h>
#include <trisect/trisect.h>

int main() {
    using namespace trisect;
    const CurvedBoundary ball = make_curved_sphere(3);
    const CurvedBoundary ring = make_curved_torus(3, 0.5);

    hierarchies::PatchTree ball_tree(ball.patches());
    hierarchies::PatchTree ring_tree(ring.patches());
    const auto above = Pose::from_translation({0, 0, 4});
    const auto d =
        hierarchies::patch_distance(ball_tree, Pose(), ring_tree, above, {.tolerance = 1e-3});
    std::printf("the ring, lifted by 4, is between %.6f and %.6f from the ball\n", d.lower,
                d.upper);

    const Tessellation round = tessellate(ball, 0.005);
    const Tessellation groove = tessellate(ring, 0.005);
    std::printf("ball: %zu triangles within %.5f; ring: %zu within %.5f\n", round.mesh.face_count(),
                round.deviation, groove.mesh.face_count(), groove.deviation);

    const Solid part = evaluate(Expression(Solid::from_mesh(round.mesh)) -
                                Expression(Solid::from_mesh(groove.mesh)));
    std::printf("ball with a groove: volume %.4f\n", volume(part.to_brep()));
    write_mesh("curved_part.off", part.to_mesh());
    return 0;
}
