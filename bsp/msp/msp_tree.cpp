// SPDX-License-Identifier: Apache-2.0
//
// The index as a value: descents and statistics. How it comes about is in bsp/msp/msp_build.cpp.
//
// Because a line is named by a plane that crosses its plane, and a point on a line likewise, the
// side of a point at a node of any dimension is the side of a plane. The descent does not even look
// at dimensions: below, on, above, until there is a leaf.
//
// On is taken where the sign is exactly zero, and only there. In floating point that branch would
// be a fiction: a rounded point is hardly ever on anything.

#include <trisect/bsp/msp_tree.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/msp/msp_build.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/predicates.h>

namespace trisect {

namespace {

using Ref = MspTree::Ref;
using Node = MspTree::Node;

template <class SideOf>
Ref descend(const MspTree& tree, SideOf&& side_of_plane) {
    Ref at = tree.root();
    while (!at.is_leaf()) {
        const Node& node = tree.node(at);
        const Side side = side_of_plane(tree.plane(node));
        at = side == Side::Below ? node.below : (side == Side::Above ? node.above : node.on);
    }
    return at;
}

/// A point anywhere, in lattice units.
class FreePoint {
public:
    FreePoint(const Point3d& p, Lattice lattice) : p_(p), exponent_(lattice.exponent) {
        for (std::size_t k = 0; k < 3; ++k) {
            near_.c[k] = std::ldexp(p[k], -exponent_);
            // Below the normal range scaling may round, and so may products with coefficients far
            // above it.
            if (std::fabs(near_.c[k]) < least_normal && p[k] != 0) near_.error = least_normal;
        }
    }
    [[nodiscard]] std::optional<LatticePoint> lattice_point() const {
        if (near_.error != 0) return std::nullopt;
        for (const double c : near_.c)
            if (!(std::fabs(c) < static_cast<double>(coordinate_limit)) ||
                detail::dyadic(c).exponent < -fraction_limit)
                return std::nullopt;
        return LatticePoint{Coordinate(near_.c[0]), Coordinate(near_.c[1]), Coordinate(near_.c[2])};
    }
    [[nodiscard]] Side side(const Plane& plane) const {
        // Out of range a coordinate is infinite and the filter, comparing with NaN, does not
        // decide.
        if (const auto s = filtered_side(near_, plane)) {
            if (std::isfinite(near_.c[0] + near_.c[1] + near_.c[2])) {
                ++detail::counters_of_thread<PredicateCounters>.filtered;
                return *s;
            }
        }
        ++detail::counters_of_thread<PredicateCounters>.exact_wide;
        ExactRational sum(plane.offset());
        for (int i = 0; i < 3; ++i)
            sum += ExactRational(plane.normal(i)) *
                   ExactRational::from_double(p_[static_cast<std::size_t>(i)]).scaled(-exponent_);
        return side_from_sign(sum.sign());
    }

private:
    static constexpr double least_normal = 0x1p-500;

    Point3d p_;
    int exponent_;
    Approximation near_;
};

}  // namespace

MspTree MspTree::from_brep(const Brep& brep, const MspOptions& options) {
    return MspTreeBuilder::run(detail::msp::soup_of(brep), {}, Leaf::Out, options, brep.lattice());
}

MspTree MspTree::from_polygons(std::span<const MspPolygon> polygons, std::span<const Plane> walls,
                               Leaf empty, const MspOptions& options, Lattice lattice) {
    return MspTreeBuilder::run(detail::msp::soup_of(polygons), walls, empty, options, lattice);
}

Ref MspTree::locate(const LatticePoint& p) const {
    return descend(*this, [&p](const Plane& plane) { return side_of(p, plane); });
}

Ref MspTree::locate(const Point& p) const {
    return descend(*this, [&p](const Plane& plane) { return side_of(p, plane); });
}

Ref MspTree::locate(const Point3d& p) const {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        throw UsageError("point location: a coordinate is not finite");
    const FreePoint point(p, lattice_);
    if (const auto on_lattice = point.lattice_point()) return locate(*on_lattice);
    return descend(*this, [&point](const Plane& plane) { return point.side(plane); });
}

MspStats MspTree::stats() const {
    MspStats s;
    s.planes = planes_.size();
    s.faces = faces_;
    s.polygons = polygons_;
    s.fragments = fragments_;
    s.build_seconds = build_seconds_;
    s.bytes = nodes_.size() * (sizeof(Node) + 1) + planes_.size() * sizeof(Plane);
    const auto count_leaf = [&s](Ref leaf, std::size_t dimension) {
        ++s.leaves[dimension];
        ++s.leaves_of_kind[static_cast<std::size_t>(leaf.kind())];
    };
    if (root_.is_leaf()) {
        count_leaf(root_, 3);
        return s;
    }
    struct Level {
        std::size_t all = 0;
        std::size_t in_space = 0;
    };
    std::vector<Level> level(nodes_.size());
    level[root_.index()] = {1, 1};
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const std::size_t dimension = dimension_[i];
        ++s.nodes[dimension];
        s.depth = std::max(s.depth, level[i].all);
        s.space_depth = std::max(s.space_depth, level[i].in_space);
        for (Ref Node::*child : {&Node::below, &Node::on, &Node::above}) {
            const Ref c = nodes_[i].*child;
            const bool is_on = child == &Node::on;
            if (c.is_leaf()) {
                count_leaf(c, is_on ? dimension - 1 : dimension);
            } else {
                level[c.index()] = {level[i].all + 1,
                                    level[i].in_space + (dimension == 3 && !is_on ? 1 : 0)};
            }
        }
    }
    return s;
}

}  // namespace trisect
