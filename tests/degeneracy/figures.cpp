// SPDX-License-Identifier: Apache-2.0

#include "figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <trisect/brep/measure.h>

namespace degeneracy {

using reference::LatticePoint;
using reference::Operand;

bool operator==(const Figures& a, const Figures& b) {
    const double slack = 4 * std::numeric_limits<double>::epsilon() * std::abs(a.area);
    return a.vertices == b.vertices && a.edges == b.edges && a.faces == b.faces &&
           a.loops == b.loops && a.shells == b.shells && a.volume == b.volume &&
           std::abs(a.area - b.area) <= slack && a.vertex_contacts == b.vertex_contacts &&
           a.edge_contacts == b.edge_contacts;
}

std::ostream& operator<<(std::ostream& out, const Figures& f) {
    return out << "{" << f.vertices << ", " << f.edges << ", " << f.faces << ", " << f.loops << ", "
               << f.shells << ", \"" << f.volume << "\", " << f.area << ", " << f.vertex_contacts
               << ", " << f.edge_contacts << "}";
}

Figures figures(const trisect::Brep& brep) {
    const trisect::BrepCounts counts = brep.counts();
    return {counts.vertices,
            counts.edges,
            counts.faces,
            counts.loops,
            counts.shells,
            trisect::exact_volume(brep).to_string(),
            trisect::area(brep).value,
            brep.vertex_contact_count(),
            brep.edge_contact_count()};
}

Figures checked_figures(const std::vector<Operand>& operands,
                        const reference::Expression& expression,
                        const trisect::EvaluateOptions& options) {
    std::vector<trisect::Solid> solids;
    for (const Operand& o : operands) solids.push_back(engines::solid(o));
    const trisect::Brep brep =
        trisect::evaluate(engines::formula(expression, solids), options).to_brep();
    const auto expected = reference::evaluate(operands, expression);
    EXPECT_EQ(engines::difference(brep, reference::canonical_boundary(expected.cells)), "")
        << reference::to_string(expression);
    EXPECT_GE(total_genus(brep), 0);
    return figures(brep);
}

std::ptrdiff_t total_genus(const trisect::Brep& brep) {
    std::ptrdiff_t handles = 0;
    for (const trisect::ShellId s : brep.shells()) {
        EXPECT_EQ(brep.counts(s).euler_characteristic() % 2, 0);
        EXPECT_GE(brep.genus(s), 0);
        handles += brep.genus(s);
    }
    return handles;
}

Operand cube(std::int64_t low, std::int64_t high) {
    return reference::box({low, low, low}, {high, high, high});
}

Operand octahedron(const LatticePoint& c, std::int64_t r) {
    const LatticePoint east{c[0] + r, c[1], c[2]};
    const LatticePoint west{c[0] - r, c[1], c[2]};
    const LatticePoint north{c[0], c[1] + r, c[2]};
    const LatticePoint south{c[0], c[1] - r, c[2]};
    const LatticePoint top{c[0], c[1], c[2] + r};
    const LatticePoint bottom{c[0], c[1], c[2] - r};
    return {{east, north, top},    {north, west, top},    {west, south, top},
            {south, east, top},    {north, east, bottom}, {west, north, bottom},
            {south, west, bottom}, {east, south, bottom}};
}

}  // namespace degeneracy
