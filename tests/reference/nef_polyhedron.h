// SPDX-License-Identifier: Apache-2.0
//
// Operands of the naive engine as CGAL's Nef polyhedra with rational coordinates, and their
// boundaries in the form in which engines are compared.
#pragma once

#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Nef_polyhedron_3.h>

#include "canonical_boundary.h"
#include "operand.h"

namespace reference {

using NefKernel = CGAL::Cartesian<CGAL::Gmpq>;
using Nef = CGAL::Nef_polyhedron_3<NefKernel>;

// Of an operand that is a closed manifold with outward normals.
Nef to_nef(const Operand& operand);

// The regularised boundary: faces between a volume in the set and one outside of it, seen from
// outside.
CanonicalBoundary boundary_of(const Nef& nef);

}  // namespace reference
