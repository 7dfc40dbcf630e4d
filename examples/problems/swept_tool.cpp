// SPDX-License-Identifier: Apache-2.0
//
// Cuts a groove with a ball-nosed tool that moves along a path, not at samples of it. What a convex
// tool sweeps over on a straight way is the hull of both ends, exactly. So is what the tool meets
// before it stands in the stock: contact times are exact numbers.

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

// Multiples of 1/65536: corners of all copies of the tool are exact sums.
double on_grid(double v) { return std::round(v * 65536) / 65536; }

// A shank of 12 sides with a round nose, its tip in the origin.
std::vector<Point3d> corners_of_tool() {
    std::vector<Point3d> corners{{0, 0, 0}};
    const auto ring = [&](double radius, double z) {
        for (int i = 0; i < 12; ++i) {
            const double a = i * std::numbers::pi / 6;
            corners.push_back(
                {on_grid(radius * std::cos(a)), on_grid(radius * std::sin(a)), on_grid(z)});
        }
    };
    for (const double t : {0.5, 1.0, std::numbers::pi / 2})
        ring(3 * std::sin(t), 3 - 3 * std::cos(t));
    ring(3, 25);
    return make_hull(corners).points;
}

std::vector<Point3d> path_of_tool() {
    std::vector<Point3d> path;
    for (int i = 0; i <= 48; ++i) {
        const double t = 2 * std::numbers::pi * i / 48;
        path.push_back({on_grid(40 + 28 * std::cos(t)), on_grid(25 + 14.4 * std::sin(2 * t)),
                        on_grid(14 + 2 * std::cos(3 * t))});
    }
    return path;
}

Solid swept(const std::vector<Point3d>& corners, const Point3d& from, const Point3d& to) {
    std::vector<Point3d> both;
    for (const auto& [x, y, z] : corners) {
        both.push_back({x + from[0], y + from[1], z + from[2]});
        both.push_back({x + to[0], y + to[1], z + to[2]});
    }
    return Solid::from_mesh(make_hull(both));
}

}  // namespace

int main() {
    const std::vector<Point3d> corners = corners_of_tool();
    const std::vector<Point3d> path = path_of_tool();
    const Solid tool = Solid::from_mesh(make_hull(corners));
    const Solid stock = Solid::from_mesh(make_box({80, 50, 20}));
    std::vector<Solid> sweeps;
    for (std::size_t i = 1; i < path.size(); ++i)
        sweeps.push_back(swept(corners, path[i - 1], path[i]));

    // All steps in one pass, and one after the other: the same set.
    const Solid at_once = evaluate(stock - Expression::any_of(sweeps));
    Solid part = stock;
    double chips = 0;
    for (const Solid& sweep : sweeps) {
        chips += volume(evaluate(part & sweep));
        part = evaluate(part - sweep);
    }
    expect(evaluate(part ^ at_once).is_empty(), "step by step and at once");
    expect(std::abs(chips + volume(part) - volume(stock)) < 1e-9 * volume(stock),
           "nothing is lost");

    // The tool fits in its groove wherever it stood: it touches and cuts nothing more.
    for (const Point3d& place : path)
        expect(interfere(part, Pose(), tool, Pose::from_translation(place)).relation ==
                   Relation::Touching,
               "the tool lies in its groove");

    // When does the tool, let down at the start, first touch the stock? In exact time.
    const Pose above = Pose::from_translation({path[0][0], path[0][1], path[0][2] + 20});
    const Motion down = Motion::translation(above, {0, 0, -20});
    const auto contact = first_contact(stock, Motion(), tool, down);
    const ExactRational depth = (ExactRational(1) - contact.time->lower()) * 20;
    expect(contact.time->is_rational() && depth == ExactRational::from_double(20 - path[0][2]),
           "the tip, a corner, meets the top face");
    // In the part, the tool arrives at the bottom of the groove at the end of the way, not earlier.
    expect(!first_contact(part, Motion(), tool, down, {.event = ContactEvent::Overlap}).exists(),
           "the way into the groove is free");

    write_mesh("swept_tool.stl", part.to_mesh());
    std::cout << sweeps.size() << " steps removed " << chips << " of " << volume(stock) << "; "
              << counts(part).triangles << " triangles\nthe tool meets the stock at "
              << contact.time->to_double() << " of its way down\n";
    return 0;
}
