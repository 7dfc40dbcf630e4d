// SPDX-License-Identifier: Apache-2.0
//
// Measures of a file with one of CGAL's Nef polyhedra, such as OpenSCAD writes.
//
//     nef_measures FILE.nef3
//
// Prints volume and area of the regularised set, the number of its parts and its extent on each
// axis, as one line of JSON. Coordinates are rationals, and the volume is summed with 512 bits.
// scripts/compare-openscad runs it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <vector>

#include <CGAL/IO/Nef_polyhedron_iostream_3.h>
#include <gmpxx.h>

#include "reference/nef_polyhedron.h"

namespace {

using reference::Nef;
using reference::NefKernel;
using Point = NefKernel::Point_3;

constexpr mp_bitcnt_t digits = 512;

struct Measures {
    mpf_class six_volumes{0, digits};
    double area = 0;
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    bool is_empty = true;

    void add(const Point& p) {
        for (int k = 0; k < 3; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const double c = CGAL::to_double(p[k]);
            low[i] = is_empty ? c : std::min(low[i], c);
            high[i] = is_empty ? c : std::max(high[i], c);
        }
        is_empty = false;
    }
};

std::vector<Point> loop_of(const Nef::SHalfedge_const_handle& first) {
    std::vector<Point> loop;
    Nef::SHalfedge_around_facet_const_circulator step(first);
    const auto last = step;
    do {
        loop.push_back(step->source()->center_vertex()->point());
    } while (++step != last);
    return loop;
}

// A fan about the first corner; with all loops of a face the signs make up for holes.
void add_loop(Measures& out, std::array<double, 3>& normal, const std::vector<Point>& loop) {
    for (const Point& p : loop) out.add(p);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const auto a = loop[0] - CGAL::ORIGIN;
        const auto b = loop[i] - CGAL::ORIGIN;
        const auto c = loop[i + 1] - CGAL::ORIGIN;
        const CGAL::Gmpq determinant = CGAL::cross_product(a, b) * c;
        out.six_volumes += mpf_class(mpq_class(determinant.mpq()), digits);
        const auto cross = CGAL::cross_product(b - a, c - a);
        for (int k = 0; k < 3; ++k)
            normal[static_cast<std::size_t>(k)] += CGAL::to_double(cross[k]);
    }
}

Measures measure(const Nef& nef) {
    Measures out;
    for (auto face = nef.halffacets_begin(); face != nef.halffacets_end(); ++face) {
        if (face->incident_volume()->mark() || !face->twin()->incident_volume()->mark()) continue;
        std::array<double, 3> normal{};
        for (auto cycle = face->facet_cycles_begin(); cycle != face->facet_cycles_end(); ++cycle)
            if (cycle.is_shalfedge())
                add_loop(out, normal, loop_of(Nef::SHalfedge_const_handle(cycle)));
        out.area += std::hypot(normal[0], normal[1], normal[2]) / 2;
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    std::ifstream in(argc == 2 ? argv[1] : "");
    Nef nef;
    if (!in || !(in >> nef)) {
        std::fprintf(stderr, "usage: nef_measures FILE.nef3\n");
        return 2;
    }
    const Measures out = measure(nef);
    std::size_t parts = 0;
    for (auto volume = nef.volumes_begin(); volume != nef.volumes_end(); ++volume)
        parts += volume->mark() ? 1 : 0;
    std::printf("{\"volume\": %.17g, \"area\": %.17g, \"parts\": %zu, ",
                mpf_class(out.six_volumes / 6).get_d(), out.area, parts);
    std::printf("\"low\": [%.17g, %.17g, %.17g], \"high\": [%.17g, %.17g, %.17g]}\n", out.low[0],
                out.low[1], out.low[2], out.high[0], out.high[1], out.high[2]);
    return 0;
}
