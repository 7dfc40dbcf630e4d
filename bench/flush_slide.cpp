// SPDX-License-Identifier: Apache-2.0
//
// Times of a peg that slides flush down to the end of its hole.
// flush_slide SIDES RINGS: a prism of so many sides, in so many rings, in a block less the prism.
// Prints faces, seconds of one relation in the middle of the way, and of the first overlap,
// which is at three quarters of the motion.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/bsp/trisect.h>

namespace {

using trisect::Expression;
using trisect::Motion;
using trisect::Pose;
using trisect::Solid;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Pose lifted(double by) { return Pose::from_translation({0, 0, by}); }

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: flush_slide SIDES RINGS\n", stderr);
        return 2;
    }
    const auto sides = static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10));
    const int rings = std::atoi(argv[2]);
    const double height = 4.0 / rings;
    const Solid ring = Solid::from_mesh(trisect::make_cylinder(2, height, sides));
    Solid peg = ring;
    for (int i = 1; i < rings; ++i)
        peg = evaluate(Expression(peg) | Expression(transformed(ring, lifted(height * i))));
    const Solid box = Solid::from_mesh(trisect::make_box({-4, -4, -2}, {4, 4, 5}));
    const Solid block =
        evaluate(Expression(box) - Expression(peg) - Expression(transformed(peg, lifted(2))));
    std::printf("%zu and %zu faces\n", peg.to_mesh().face_count(), block.to_mesh().face_count());

    auto start = std::chrono::steady_clock::now();
    const auto at = interfere(peg, lifted(0.3), block, Pose());
    std::printf("relation %d, %.3f s\n", static_cast<int>(at.relation), seconds_since(start));

    start = std::chrono::steady_clock::now();
    const auto overlap = first_contact(peg, Motion::translation(lifted(3), {0, 0, -4}), block,
                                       Motion(), {trisect::ContactEvent::Overlap});
    const double seconds = seconds_since(start);
    std::printf("first overlap at %g, %.3f s\n", overlap.time ? overlap.time->to_double() : -1,
                seconds);
    return 0;
}
