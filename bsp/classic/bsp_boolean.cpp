// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/bsp_boolean.h>

#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/bsp_merge.h>
#include <trisect/bsp/classic/bsp_boundary.h>
#include <trisect/kernel/error.h>

namespace trisect {

std::vector<ConvexPolygon> bsp_boolean(BooleanRule rule, const LatticeMesh& a,
                                       const LatticeMesh& b) {
    if (a.lattice != b.lattice) throw UsageError("the operands are on different lattices");
    return boundary_of(merge(build_bsp(a), build_bsp(b), rule));
}

}  // namespace trisect
