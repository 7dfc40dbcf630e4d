// SPDX-License-Identifier: Apache-2.0
//
// The obvious convex parts of a solid are the inner cells of its BSP tree. But the planes of a tree
// go through everything below their node: cells cut triangles into pieces whose corners are no
// lattice points, and a solid of n faces easily has 2 n cells. So a cell only says where a part is
// begun and grown first. What makes a part is that its whole triangles bound their own hull, which
// is all that tracking and boxes of hulls need.

#include <trisect/bsp/hierarchies/convex/convex_parts.h>

#include <algorithm>
#include <array>
#include <deque>
#include <limits>

#include <trisect/bsp/bsp_build.h>
#include <trisect/bsp/bsp_tree.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>

namespace trisect::hierarchies {

namespace {

using trisect::detail::InterferenceModelData;
using trisect::detail::ModelTriangle;

constexpr std::uint32_t no_part = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t most_triangles_for_a_tree = 20'000;
constexpr std::size_t most_planes = 512;

// The cell under the middle of each triangle, by the node and side of its leaf.
std::vector<std::uint64_t> cells_below(const InterferenceModelData& m) {
    std::vector<std::uint64_t> cell(m.triangles.size(), 0);
    if (!m.all_lattice || m.triangles.size() > most_triangles_for_a_tree) return cell;
    std::vector<ConvexPolygon> polygons;
    const auto corner = [&](const ModelTriangle& t, std::size_t i) {
        return m.brep.point(t.vertex[i]).lattice();
    };
    for (const ModelTriangle& t : m.triangles)
        polygons.push_back(ConvexPolygon::from_triangle(corner(t, 0), corner(t, 1), corner(t, 2)));
    const BspTree tree = build_bsp(polygons);
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
        const ModelTriangle& t = m.triangles[i];
        using trisect::detail::fraction_bits;
        const int bits = std::max({fraction_bits(corner(t, 0)), fraction_bits(corner(t, 1)),
                                   fraction_bits(corner(t, 2))});
        HomogeneousPoint middle;
        for (std::size_t k = 0; k < 3; ++k) {
            middle.xyz[k] = 0;
            for (std::size_t j = 0; j < 3; ++j)
                middle.xyz[k] += HomogeneousPoint::Coordinate(trisect::detail::scaled_integer(
                    trisect::detail::coordinate(corner(t, j), k), bits));
        }
        middle.w = HomogeneousPoint::Weight(3).shifted_left(bits);
        const Plane& own = m.brep.plane(t.face);
        BspTree::NodeId at = tree.root();
        while (!at.is_leaf()) {
            const BspTree::Node& node = tree.node(at);
            const Side side = side_of(middle, node.plane);
            // In the plane of the triangle itself: to the side of the inside.
            const bool above = side == Side::On ? is_same_plane(own, node.plane) &&
                                                      !same_orientation(own, node.plane)
                                                : side == Side::Above;
            cell[i] = 2 * std::uint64_t{at.index()} + (above ? 1 : 0);
            at = above ? node.above : node.below;
        }
    }
    return cell;
}

class Grower {
public:
    explicit Grower(const InterferenceModelData& m)
        : m_(m),
          cell_(cells_below(m)),
          part_of_(m.triangles.size(), no_part),
          vertex_mark_(m.positions.size(), no_part),
          plane_mark_(m.brep.counts().faces, no_part) {
        find_neighbours();
    }

    std::vector<ConvexPart> run() {
        for (std::uint32_t t = 0; t < m_.triangles.size(); ++t)
            if (part_of_[t] == no_part) grow_from(t);
        return std::move(parts_);
    }

private:
    // Over each side of a triangle: by the edge of the B-rep, or the diagonal's ends in its face.
    void find_neighbours() {
        struct Side3 {
            std::array<std::uint32_t, 3> key;  // edge and 0, or the ends of a diagonal
            std::uint32_t triangle;
        };
        std::vector<Side3> sides;
        for (std::uint32_t t = 0; t < m_.triangles.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const ModelTriangle& x = m_.triangles[t];
                const auto [lo, hi] = std::minmax(x.vertex[i].index, x.vertex[(i + 1) % 3].index);
                sides.push_back({x.edge[i].is_valid() ? std::array{no_part, x.edge[i].index, 0U}
                                                      : std::array{x.face.index, lo, hi},
                                 t});
            }
        std::sort(sides.begin(), sides.end(),
                  [](const Side3& a, const Side3& b) { return a.key < b.key; });
        neighbours_.resize(m_.triangles.size());
        for (std::size_t i = 1; i < sides.size(); ++i)
            if (sides[i - 1].key == sides[i].key) {
                neighbours_[sides[i - 1].triangle].push_back(sides[i].triangle);
                neighbours_[sides[i].triangle].push_back(sides[i - 1].triangle);
            }
    }

    void grow_from(std::uint32_t seed) {
        number_ = static_cast<std::uint32_t>(parts_.size());
        parts_.emplace_back();
        planes_.clear();
        vertices_.clear();
        std::deque<std::uint32_t> front{seed};
        while (!front.empty()) {
            const std::uint32_t t = front.front();
            front.pop_front();
            if (part_of_[t] != no_part || !fits(m_.triangles[t])) continue;
            take(t);
            for (const std::uint32_t n : neighbours_[t]) {
                if (part_of_[n] != no_part) continue;
                // The cell first.
                if (cell_[n] == cell_[seed])
                    front.push_front(n);
                else
                    front.push_back(n);
            }
        }
    }

    [[nodiscard]] bool fits(const ModelTriangle& t) const {
        if (plane_mark_[t.face.index] != number_) {
            if (planes_.size() >= most_planes) return false;
            const Plane& plane = m_.brep.plane(t.face);
            for (const VertexId v : vertices_)
                if (side_of(m_.brep.point(v), plane) == Side::Above) return false;
        }
        for (const VertexId v : t.vertex) {
            if (vertex_mark_[v.index] == number_) continue;
            for (const FaceId f : planes_)
                if (side_of(m_.brep.point(v), m_.brep.plane(f)) == Side::Above) return false;
        }
        return true;
    }

    void take(std::uint32_t t) {
        part_of_[t] = number_;
        parts_.back().triangles.push_back(t);
        const ModelTriangle& x = m_.triangles[t];
        if (plane_mark_[x.face.index] != number_) {
            plane_mark_[x.face.index] = number_;
            planes_.push_back(x.face);
        }
        for (const VertexId v : x.vertex) {
            if (vertex_mark_[v.index] == number_) continue;
            vertex_mark_[v.index] = number_;
            vertices_.push_back(v);
        }
    }

    const InterferenceModelData& m_;
    std::vector<std::uint64_t> cell_;
    std::vector<std::uint32_t> part_of_;
    std::vector<std::uint32_t> vertex_mark_;
    std::vector<std::uint32_t> plane_mark_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    std::vector<ConvexPart> parts_;
    std::vector<FaceId> planes_;
    std::vector<VertexId> vertices_;
    std::uint32_t number_ = 0;
};

}  // namespace

std::vector<ConvexPart> convex_parts(const InterferenceModel& model) {
    return Grower(trisect::detail::data_of(model)).run();
}

}  // namespace trisect::hierarchies
