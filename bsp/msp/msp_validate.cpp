// SPDX-License-Identifier: Apache-2.0
//
// Checks of an MspTree, by means that the construction does not use: regions are made explicit as
// polygons, points are found on entities, and inside is decided by counting faces above a point.

#include <trisect/bsp/msp_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <trisect/brep/measure.h>
#include <trisect/bsp/msp/msp_soup.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect {

namespace {

using Leaf = MspTree::Leaf;
using Node = MspTree::Node;
using Ref = MspTree::Ref;

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorCode::Internal, "MSP tree: " + what);
}
[[noreturn]] void refuse_node(std::size_t i, const char* why) {
    refuse("node " + std::to_string(i) + " " + why);
}

std::string name_of(Ref leaf) {
    constexpr std::array<const char*, 5> kinds{"outside", "inside", "face ", "edge ", "vertex "};
    std::string name = kinds[static_cast<std::size_t>(leaf.kind())];
    if (leaf.kind() > Leaf::In) name += std::to_string(leaf.entity());
    return name;
}

Leaf most_special_leaf(int dimension) {
    return static_cast<Leaf>(static_cast<int>(Leaf::OnVertex) - dimension);
}

/// The part of a plane over a square that holds all lattice points.
ConvexPolygon wide_polygon(const Plane& plane) {
    const int k = plane.dominant_axis();
    std::array<int, 2> axes{(k + 1) % 3, (k + 2) % 3};
    if (plane.normal(k) < 0) std::swap(axes[0], axes[1]);
    constexpr std::int64_t reach = coordinate_limit + 1;
    const auto high = [](int axis) { return Plane::axis_aligned(axis, 1, reach); };
    const auto low = [](int axis) { return Plane::axis_aligned(axis, 1, -reach).flipped(); };
    return {plane, {low(axes[1]), high(axes[0]), high(axes[1]), low(axes[0])}};
}

/// Follows the regions of the nodes.
class RegionCheck {
public:
    explicit RegionCheck(const MspTree& tree) : tree_(tree), parents_(tree.node_count()) {}

    void run() {
        check_links();
        for (std::size_t i = 0; i < tree_.node_count(); ++i)
            if (tree_.dimension(Ref::node(i)) == 3) check_plane(i);
    }

private:
    using Child = Ref Node::*;
    struct Parent {
        std::size_t node = 0;
        Child child = nullptr;
    };

    void check_links() {
        if (tree_.node_count() == 0) {
            if (!tree_.root().is_leaf()) refuse("the root is missing");
            return;
        }
        if (tree_.root() != Ref::node(0)) refuse("the root is not the first node");
        if (tree_.dimension(tree_.root()) != 3) refuse_node(0, "is the root and not of space");
        for (std::size_t i = 0; i < tree_.node_count(); ++i) {
            if (i > 0 && parents_[i].child == nullptr) refuse_node(i, "has no parent before it");
            const Node& node = tree_.node(Ref::node(i));
            for (const Child child : {&Node::below, &Node::on, &Node::above})
                check_link(i, node.*child, child);
        }
    }
    void check_link(std::size_t i, Ref ref, Child child) {
        const int dimension = tree_.dimension(Ref::node(i)) - (child == &Node::on ? 1 : 0);
        if (ref.is_leaf()) {
            if (dimension > 0 && ref.kind() > std::max(Leaf::In, most_special_leaf(dimension)))
                refuse_node(i, "has a leaf of a dimension that is too high for it");
            return;
        }
        const std::size_t c = ref.index();
        if (c <= i || c >= tree_.node_count()) refuse_node(i, "has a child out of order");
        if (parents_[c].child != nullptr) refuse_node(c, "has two parents");
        if (tree_.dimension(ref) != dimension) refuse_node(c, "is of the wrong dimension");
        parents_[c] = {i, child};
    }

    [[nodiscard]] const Plane& plane(std::size_t i) const {
        return tree_.plane(tree_.node(Ref::node(i)));
    }

    void check_plane(std::size_t i) {
        ConvexPolygon region = wide_polygon(plane(i));
        for (std::size_t at = i; parents_[at].child != nullptr; at = parents_[at].node) {
            const Plane& wall = plane(parents_[at].node);
            region = parents_[at].child == &Node::below ? region.clip_below(wall)
                                                        : region.clip_above(wall);
            if (region.is_empty()) refuse_node(i, "has a plane that does not cut its region");
        }
        const Ref on = tree_.node(Ref::node(i)).on;
        if (!on.is_leaf()) check_lines(on, std::move(region));
    }

    void check_lines(Ref root, ConvexPolygon&& whole) {
        std::vector<std::pair<Ref, ConvexPolygon>> pending;
        pending.emplace_back(root, std::move(whole));
        while (!pending.empty()) {
            const auto [ref, region] = std::move(pending.back());
            pending.pop_back();
            const Node& node = tree_.node(ref);
            ConvexPolygon below;
            ConvexPolygon above;
            if (!region.split(tree_.plane(node), below, above).is_cut())
                refuse_node(ref.index(), "has a line that does not cut its region");
            // The new edge closes both parts.
            const std::size_t last = below.size() - 1;
            if (!node.on.is_leaf()) check_points(node.on, below.vertex(last), below.vertex(0));
            if (!node.below.is_leaf()) pending.emplace_back(node.below, std::move(below));
            if (!node.above.is_leaf()) pending.emplace_back(node.above, std::move(above));
        }
    }

    // Checks against the ends of the line's part, and points among each other.
    void check_points(Ref root, const Point& from, const Point& to) {
        struct Part {
            Ref ref;
            Point from;
            Point to;
        };
        std::vector<Part> pending{{root, from, to}};
        while (!pending.empty()) {
            const Part part = pending.back();
            pending.pop_back();
            const Node& node = tree_.node(part.ref);
            const Plane& cut = tree_.plane(node);
            const Side side = side_of(part.from, cut);
            if (side == Side::On || side_of(part.to, cut) != opposite(side))
                refuse_node(part.ref.index(), "has a point that does not cut its line");
            const Point at = stop(part.ref, cut);
            const Ref ahead = side == Side::Below ? node.above : node.below;
            const Ref behind = side == Side::Below ? node.below : node.above;
            if (!behind.is_leaf()) pending.push_back({behind, part.from, at});
            if (!ahead.is_leaf()) pending.push_back({ahead, at, part.to});
        }
    }
    [[nodiscard]] Point stop(Ref ref, const Plane& cut) const {
        std::size_t line = ref.index();
        while (tree_.dimension(Ref::node(line)) == 1) line = parents_[line].node;
        std::size_t plane_node = line;
        while (tree_.dimension(Ref::node(plane_node)) == 2) plane_node = parents_[plane_node].node;
        return {plane(plane_node), plane(line), cut};
    }

    const MspTree& tree_;
    std::vector<Parent> parents_;
};

/// Points on entities, and points anywhere.
class EntityCheck {
public:
    EntityCheck(const MspTree& tree, const Brep& brep)
        : tree_(tree),
          brep_(brep),
          soup_(detail::msp::soup_of(brep)),
          is_complement_(sign_of_volume(brep) < 0) {}

    void check_vertices() const {
        for (const VertexId v : brep_.vertices())
            expect(brep_.point(v), Ref::leaf(Leaf::OnVertex, name(v)));
    }
    void check_edges_and_faces() const {
        std::vector<bool> edge_is_done(brep_.edges().size(), false);
        std::vector<bool> face_is_done(brep_.faces().size(), false);
        for (const auto& f : soup_.fragments) {
            const auto corners = soup_.geometry.corners(f);
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const auto& from = corners[i];
                if (from.edge.kind() != Leaf::OnEdge || edge_is_done[from.edge.entity()]) continue;
                const auto& to = corners[i + 1 < corners.size() ? i + 1 : 0];
                if (const auto p = point_between(f, from, to)) {
                    expect(*p, from.edge);
                    edge_is_done[from.edge.entity()] = true;
                }
            }
            if (face_is_done[f.face.entity()]) continue;
            if (const auto p = interior_point(f)) {
                expect(*p, f.face);
                face_is_done[f.face.entity()] = true;
            }
        }
    }
    void check_parity(std::size_t samples) const {
        if (brep_.is_empty()) return;
        std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        std::array<double, 3> hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (const Point& p : brep_.points()) {
            for (std::size_t k = 0; k < 3; ++k) {
                lo[k] = std::min(lo[k], p.approximation().c[k]);
                hi[k] = std::max(hi[k], p.approximation().c[k]);
            }
        }
        std::uint64_t state = 0;
        const auto fraction = [&state] {  // of the golden ratio: spread evenly
            state += 0x9e3779b97f4a7c15U;
            std::uint64_t z = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9U;
            z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
            return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
        };
        // A solid within a unit needs finer ones.
        const double extent = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
        const int bits = 10 + std::max(0, -std::ilogb(extent));
        for (std::size_t i = 0; i < samples; ++i) {
            std::array<Plane, 3> name;
            for (std::size_t k = 0; k < 3; ++k)
                name[k] =
                    plane_near(static_cast<int>(k), lo[k] + (hi[k] - lo[k]) * fraction(), bits);
            const Point p(name[0], name[1], name[2]);
            const auto winding = winding_number(p, name[0], name[1]);
            if (!winding) continue;
            const Ref leaf = tree_.locate(p);
            if (leaf.kind() <= Leaf::In && (leaf.kind() == Leaf::In) != (*winding > 0))
                refuse("a point is located " + name_of(leaf) + " with winding number " +
                       std::to_string(*winding));
        }
    }

private:
    using Fragment = detail::msp::Fragment;
    using Corner = detail::msp::Corner;

    template <class Id>
    [[nodiscard]] std::uint32_t name(Id id) const {
        const auto copies = brep_.copies(id);
        return copies.empty() ? id.index : std::min_element(copies.begin(), copies.end())->index;
    }

    // Another entity of lower dimension, or of a smaller handle, may contain the point too.
    void expect(const Point& p, Ref expected) const {
        const Ref found = tree_.locate(p);
        if (found == expected) return;
        const bool may_represent =
            found.kind() > expected.kind() ||
            (found.kind() == expected.kind() && found.entity() < expected.entity());
        if (may_represent && found.kind() == Leaf::OnVertex && brep_.point(found.vertex()) == p)
            return;
        if (may_represent && found.kind() == Leaf::OnEdge && is_on_edge(p, found.edge())) return;
        refuse(name_of(expected) + " is located as " + name_of(found));
    }
    [[nodiscard]] bool is_on_edge(const Point& p, EdgeId e) const {
        const HalfedgeId h = brep_.halfedge(e);
        if (side_of(p, brep_.plane(brep_.face(h))) != Side::On) return false;
        if (side_of(p, brep_.plane(brep_.face(brep_.twin(h)))) != Side::On) return false;
        const Point& a = brep_.point(brep_.origin(h));
        const Point& b = brep_.point(brep_.target(h));
        for (int axis = 0; axis < 3; ++axis) {
            const auto order = compare_coordinate(a, b, axis);
            if (compare_coordinate(a, p, axis) != order || compare_coordinate(p, b, axis) != order)
                return false;
        }
        return true;
    }

    /// An axis-perpendicular plane, within 2^-bits (or less, far out) of a coordinate.
    static Plane plane_near(int axis, double coordinate, int bits) {
        const int room = 61 - std::ilogb(std::fabs(coordinate) + 0x1p-100);
        const int used = std::min(bits, room);
        std::array<Plane::Coefficient, 3> n{};
        n[detail::as_index(axis)] = Plane::Coefficient(1).shifted_left(used);
        const std::int64_t position = std::llrint(std::ldexp(coordinate, used)) | 1;
        return {n[0], n[1], n[2], -Plane::Coefficient(position)};
    }
    static constexpr std::array<int, 6> precisions{10, 20, 40, 60, 80, 130};

    [[nodiscard]] std::optional<Point> point_between(const Fragment& f, const Corner& from,
                                                     const Corner& to) const {
        const auto& g = soup_.geometry;
        for (int axis = 0; axis < 3; ++axis) {
            if (g.compare(from.point, to.point, axis) == 0) continue;
            const auto k = static_cast<std::size_t>(axis);
            const double middle =
                0.5 * (g.approximation(from.point).c[k] + g.approximation(to.point).c[k]);
            for (const int bits : precisions) {
                const Plane cut = plane_near(axis, middle, bits);
                const Point p(g.plane(f.support), g.plane(from.edge_plane), cut);
                const Side side = side_of(point(from), cut);
                if (side != Side::On && side_of(point(to), cut) == opposite(side)) return p;
            }
        }
        return std::nullopt;
    }
    [[nodiscard]] Point point(const Corner& c) const {
        const auto& names = soup_.geometry.planes_of(c.point);
        return {soup_.geometry.plane(names[0]), soup_.geometry.plane(names[1]),
                soup_.geometry.plane(names[2])};
    }

    [[nodiscard]] std::optional<Point> interior_point(const Fragment& f) const {
        const auto& g = soup_.geometry;
        const auto corners = g.corners(f);
        const Plane& support = g.plane(f.support);
        const int dominant = support.dominant_axis();
        const auto middle = [&](int axis) {
            double sum = 0;
            for (const Corner& c : corners)
                sum += g.approximation(c.point).c[static_cast<std::size_t>(axis)];
            return sum / static_cast<double>(corners.size());
        };
        for (const int bits : precisions) {
            const int u = (dominant + 1) % 3;
            const int v = (dominant + 2) % 3;
            const Point p(support, plane_near(u, middle(u), bits), plane_near(v, middle(v), bits));
            if (is_inside(f, p).value_or(false)) return p;
        }
        return std::nullopt;
    }
    /// Whether a point of its plane is inside a convex polygon; nothing for one on its border.
    [[nodiscard]] std::optional<bool> is_inside(const Fragment& f, const Point& p) const {
        const auto& g = soup_.geometry;
        const auto corners = g.corners(f);
        bool is_on_border = false;
        for (const Corner& c : corners) {
            Side inner = Side::On;
            for (std::size_t i = 0; inner == Side::On && i < corners.size(); ++i)
                inner = g.side(corners[i].point, c.edge_plane);
            const Side side = side_of(p, g.plane(c.edge_plane));
            if (side == opposite(inner)) return false;
            is_on_border = is_on_border || side == Side::On;
        }
        if (is_on_border) return std::nullopt;
        return true;
    }

    /// Counts the faces above a point, p on the vertical line of x and y.
    [[nodiscard]] std::optional<int> winding_number(const Point& p, const Plane& x,
                                                    const Plane& y) const {
        int winding = is_complement_ ? 1 : 0;
        for (const Fragment& f : soup_.fragments) {
            const Plane& support = soup_.geometry.plane(f.support);
            const int up = support.normal(2) > 0 ? 1 : (support.normal(2) < 0 ? -1 : 0);
            if (up == 0) continue;
            const auto hit = is_inside(f, Point(x, y, support));
            if (!hit) return std::nullopt;
            if (!*hit) continue;
            const Side side = side_of(p, support);
            if (side == Side::On) return std::nullopt;
            if ((side == Side::Below) == (up > 0)) winding += up;
        }
        return winding;
    }

    const MspTree& tree_;
    const Brep& brep_;
    detail::msp::MspSoup soup_;
    bool is_complement_;
};

}  // namespace

void MspTree::validate() const { RegionCheck(*this).run(); }

void MspTree::validate(const Brep& brep, std::size_t parity_samples) const {
    validate();
    const EntityCheck check(*this, brep);
    check.check_vertices();
    check.check_edges_and_faces();
    check.check_parity(parity_samples);
}

}  // namespace trisect
