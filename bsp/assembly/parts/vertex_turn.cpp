// SPDX-License-Identifier: Apache-2.0
//
// Let N be the outward normal of the region, and l, m the normals of the planes through two of its
// edges, turned towards the region. Seen from outside the region is to the left of its edges, so
// they run along l×N and m×N. Their turn is the sign of N·((l×N)×(m×N)), and since
//     (l×N)×(m×N) = det(l, m, N) N,
// it is that of det(l, m, N). Coefficients of planes are far narrower than points: 171 bits for
// narrow planes (predicates.cpp), in place of more than 500 for an orientation of three vertices.

#include <trisect/bsp/assembly/parts/vertex_turn.h>

namespace trisect::detail {

int turn_at_vertex(const Workbench& bench, PlaneId support, bool flipped, const WorkEdge& in,
                   const WorkEdge& out) {
    if (in.plane == out.plane) return 0;
    // Each `above`, and `flipped`, turns one of the normals round.
    const int sign =
        sign_of_det(bench.plane_at(in.plane), bench.plane_at(out.plane), bench.plane_at(support));
    const bool turned = (in.above != out.above) != flipped;
    return turned ? -sign : sign;
}

}  // namespace trisect::detail
