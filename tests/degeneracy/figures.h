// SPDX-License-Identifier: Apache-2.0
//
// Figures: what the tables of touching configurations say about a boundary, and how they are taken
// from a result.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"

namespace degeneracy {

/// One row of a table. The default is the empty set.
struct Figures {
    std::size_t vertices = 0;
    std::size_t edges = 0;
    std::size_t faces = 0;
    std::size_t loops = 0;
    std::size_t shells = 0;
    std::string volume = "0";  ///< exact: "p" or "p/q"
    double area = 0;
    std::size_t vertex_contacts = 0;  ///< places where vertices were taken apart
    std::size_t edge_contacts = 0;
};

/// Equal in everything; areas to four units in the last place, because tables write their roots in
/// doubles.
bool operator==(const Figures& a, const Figures& b);
std::ostream& operator<<(std::ostream& out, const Figures& f);

Figures figures(const trisect::Brep& brep);

/// Evaluates the formula with the library and with the naive engine: the boundaries must be equal.
/// Reports a disagreement as a failure of the running test.
Figures checked_figures(const std::vector<reference::Operand>& operands,
                        const reference::Expression& expression,
                        const trisect::EvaluateOptions& options = {});

/// The handles of all shells; checks on the way that every shell is a closed surface (P15).
std::ptrdiff_t total_genus(const trisect::Brep& brep);

reference::Operand cube(std::int64_t low, std::int64_t high);
reference::Operand octahedron(const reference::LatticePoint& centre, std::int64_t radius);

}  // namespace degeneracy
