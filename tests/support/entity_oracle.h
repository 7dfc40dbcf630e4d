// SPDX-License-Identifier: Apache-2.0
//
// Which vertex, edge or face contains a point, by looking at all of them in rationals.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/msp_tree.h>

#include "reference/rational.h"

namespace trisect::test {

[[nodiscard]] reference::Point3 rational(const Point& p);
[[nodiscard]] reference::Point3 rational(const LatticePoint& p);

/// The vertex, edge or face of the smallest handle, in this order; otherwise inside or outside by
/// counting crossings along a line that meets no edge. A boundary that is inside out bounds the
/// complement. Uses no predicate of the library.
class EntityOracle {
public:
    explicit EntityOracle(const Brep& brep);
    [[nodiscard]] MspTree::Ref locate(const reference::Point3& p) const;

private:
    struct Side {
        reference::Point3 from;
        reference::Point3 to;
    };
    struct Face {
        reference::Point3 normal;
        reference::Rational offset;
        std::size_t u = 0;  // coordinates of a projection that does not degenerate
        std::size_t v = 1;
        std::vector<Side> sides;
    };
    [[nodiscard]] static bool covers(const Face& f, const reference::Point3& p);

    std::vector<reference::Point3> vertices_;
    std::vector<Side> edges_;
    std::vector<Face> faces_;
    bool is_complement_ = false;
};

}  // namespace trisect::test
