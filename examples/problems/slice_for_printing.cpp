// SPDX-License-Identifier: Apache-2.0
//
// Slices a part into layers for printing: outlines, areas, and a picture of all layers.
//
//     slice_for_printing [part.stl]

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <span>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

Solid moved(const PolygonMesh& mesh, const Point3d& by) {
    return transformed(Solid::from_mesh(mesh), AffineMap::translation(by));
}

// A base, a rib and a boss with a bore, all of whose heights are multiples of 4.
Solid bracket() {
    const Solid rib = transformed(
        Solid::from_mesh(make_extrusion({{0, 0}, {30, 0}, {0, 12}}, {}, 0, 5)),
        compose(AffineMap::translation({3, 22.5, 4}), AffineMap::rotation({1, 0, 0}, 90)));
    const Solid base = Solid::from_mesh(make_box({60, 40, 4}));
    const Solid boss = moved(make_cylinder(11, 16, 64), {46, 20, 0});
    const Solid bore = moved(make_cylinder(6, 18, 64), {46, 20, -1});
    return evaluate((base | rib | boss) - bore);
}

// The area of a section, whose corners were rounded once; holes count negative.
double area_of(const std::vector<SectionRegion>& regions) {
    ExactRational twice;
    const auto add = [&](const SectionLoop& loop) {
        const auto& p = loop.rounded;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Point3d& q = p[(i + 1) % p.size()];
            twice += ExactRational::from_double(p[i][0]) * ExactRational::from_double(q[1]) -
                     ExactRational::from_double(q[0]) * ExactRational::from_double(p[i][1]);
        }
    };
    for (const SectionRegion& r : regions) {
        add(r.outer);
        for (const SectionLoop& hole : r.holes) add(hole);
    }
    return twice.to_double() / 2;
}

void draw(std::ostream& svg, const std::vector<SectionRegion>& regions, double dx, double dy) {
    svg << "<path fill-rule=\"evenodd\" fill=\"#468\" d=\"";
    const auto add = [&](const SectionLoop& loop) {
        char command = 'M';
        for (const Point3d& p : loop.rounded) {
            svg << command << p[0] + dx << ',' << p[1] + dy;
            command = 'L';
        }
        svg << 'Z';
    };
    for (const SectionRegion& r : regions) {
        add(r.outer);
        for (const SectionLoop& hole : r.holes) add(hole);
    }
    svg << "\"/>\n";
}

}  // namespace

int main(int argc, char** argv) {
    const Solid part = argc > 1
                           ? Solid::from_mesh(read_mesh(argv[1]), {.embedding = Embedding::Check})
                           : bracket();
    const Bounds box = bounds(part).value();
    const int count = argc > 1 ? 40 : 100;
    const double step = (box.hi[2] - box.lo[2]) / count;
    const double width = 1.1 * (box.hi[0] - box.lo[0]);
    const double depth = 1.1 * (box.hi[1] - box.lo[1]);
    std::ofstream svg("slices.svg");
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << 10 * width << ' '
        << (count + 9) / 10 * depth << "\">\n";

    const BrepIndex index(part);
    double printed = 0;
    double largest = 0;
    for (int i = 0; i < count; ++i) {
        const auto layer = index.section({0, 0, 1, -(box.lo[2] + (i + 0.5) * step)});
        printed += step * area_of(layer);
        largest = std::max(largest, area_of(layer));
        draw(svg, layer, i % 10 * width - box.lo[0], i / 10 * depth - box.lo[1]);
    }
    svg << "</svg>\n";
    std::cout << count << " layers of " << step << ", at most " << largest << " of area\n"
              << "printed volume " << printed << ", the part's " << volume(part) << '\n';

    // The slabs between the layers' limits are the part, exactly; here they are cut as solids.
    Solid rest = part;
    ExactRational sum;
    for (int i = 1; i < 8; ++i) {
        const double z = box.lo[2] + i * (box.hi[2] - box.lo[2]) / 8;
        const Solid below = Solid::half_space({0, 0, 1, -z});
        sum += exact_volume(evaluate(rest & below));
        rest = evaluate(rest - below);
    }
    expect(sum + exact_volume(rest) == exact_volume(part), "the slabs are the part");
    // Areas change at layers' limits only, and linearly between: each middle stands for its layer.
    if (argc == 1)
        expect(std::abs(printed - volume(part)) < 1e-9 * printed, "all of it is printed");
    return 0;
}
