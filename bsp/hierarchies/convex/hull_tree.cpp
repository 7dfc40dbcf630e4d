// SPDX-License-Identifier: Apache-2.0
//
// Top down by medians: a set of items (parts, or triangles of one part) is halved along the axis of
// its largest extent until there are as many sets as a node may have children. Hulls come bottom
// up: that of a node is the hull of its children's vertices, which are far fewer than its
// triangles' corners.
//
// A face of a hull is real where triangles of the node fill it. Triangles of a boundary do not
// overlap, so it is enough to add up areas: twice those seen along an axis are integers.
//
// Sources: Ponamgi, Manocha, Lin, Incremental algorithms for collision detection between polygonal
// models (TVCG 3(1), 1997): hull features that bridge concavities; Ehmann and Lin (2001), sec. 4.

#include <trisect/bsp/hierarchies/convex/hull_tree.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <trisect/bsp/hierarchies/convex/convex_hull.h>
#include <trisect/bsp/hierarchies/convex/convex_parts.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>

namespace trisect::hierarchies {

using trisect::detail::InterferenceModelData;
using trisect::detail::ModelTriangle;

bool HullTree::Node::is_real(const PolytopeFeature& f) const {
    switch (f.kind) {
        case PolytopeFeature::Kind::Vertex:
            return !real_edge.empty() || !real_face.empty();
        case PolytopeFeature::Kind::Edge:
            return f.index < real_edge.size() && real_edge[f.index];
        case PolytopeFeature::Kind::Face:
            break;
    }
    return f.index < real_face.size() && real_face[f.index];
}

class HullTree::Builder {
public:
    Builder(HullTree& tree, const InterferenceModelData& m, const HullTreeOptions& options)
        : tree_(tree),
          m_(m),
          options_(options),
          is_whole_(std::ranges::all_of(m.brep.points(), [](const Point& p) {
              return !p.is_lattice() || p.lattice().is_whole();
          })) {}

    void run(const std::vector<ConvexPart>& parts) {
        std::vector<Item> items;
        for (const ConvexPart& p : parts) items.push_back(item_of(p.triangles, true));
        tree_.nodes_.emplace_back();
        divide(0, std::move(items), 1);
    }

private:
    using Area = WideInt<5>;

    struct Item {
        std::vector<std::uint32_t> triangles;
        std::array<double, 3> middle{};
        bool part = false;
    };

    [[nodiscard]] Item item_of(std::vector<std::uint32_t> triangles, bool part) const {
        std::array<double, 3> lo = m_.position(m_.triangles[triangles[0]].vertex[0]);
        std::array<double, 3> hi = lo;
        for (const std::uint32_t t : triangles)
            for (const VertexId v : m_.triangles[t].vertex)
                for (std::size_t k = 0; k < 3; ++k) {
                    lo[k] = std::min(lo[k], m_.position(v)[k]);
                    hi[k] = std::max(hi[k], m_.position(v)[k]);
                }
        Item r{std::move(triangles), {}, part};
        for (std::size_t k = 0; k < 3; ++k) r.middle[k] = 0.5 * lo[k] + 0.5 * hi[k];
        return r;
    }

    // Fills a node with what it stands for.
    void divide(std::uint32_t at, std::vector<Item> items, unsigned level) {
        tree_.depth_ = std::max(tree_.depth_, level);
        std::size_t count = 0;
        for (const Item& i : items) count += i.triangles.size();
        bool within = items.size() == 1 && items.front().part;
        if (within && count > options_.leaf_triangles) items = triangles_of(items.front());
        within = within || (!items.empty() && !items.front().part);
        const auto first = static_cast<std::uint32_t>(tree_.triangles_.size());
        if (items.size() == 1 || count <= options_.leaf_triangles) {
            for (const Item& i : items)
                tree_.triangles_.insert(tree_.triangles_.end(), i.triangles.begin(),
                                        i.triangles.end());
            Node& n = tree_.nodes_[at];
            n.first_triangle = first;
            n.triangle_count = static_cast<std::uint32_t>(count);
            n.within_part = within;
            n.hull = hull_of_triangles(n);
            find_real(n);
            return;
        }
        std::vector<std::vector<Item>> sets = sets_of(std::move(items));
        const auto child = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.resize(tree_.nodes_.size() + sets.size());
        std::vector<LatticePoint> points;
        for (std::uint32_t i = 0; i < sets.size(); ++i) {
            divide(child + i, std::move(sets[i]), level + 1);
            const auto v = tree_.nodes_[child + i].hull.vertices();
            points.insert(points.end(), v.begin(), v.end());
        }
        Node& n = tree_.nodes_[at];
        n.first_child = child;
        n.child_count = static_cast<std::uint32_t>(sets.size());
        n.first_triangle = first;
        n.triangle_count = static_cast<std::uint32_t>(tree_.triangles_.size()) - first;
        n.within_part = within;
        n.hull = convex_hull(points, m_.brep.lattice());
        find_real(n);
    }

    [[nodiscard]] std::vector<Item> triangles_of(const Item& part) const {
        std::vector<Item> r;
        for (const std::uint32_t t : part.triangles) r.push_back(item_of({t}, false));
        return r;
    }

    [[nodiscard]] std::vector<std::vector<Item>> sets_of(std::vector<Item> items) const {
        std::vector<std::vector<Item>> sets;
        sets.push_back(std::move(items));
        while (2 * sets.size() <= options_.branching) {
            std::vector<std::vector<Item>> halves;
            for (auto& s : sets) {
                if (s.size() < 2) {
                    halves.push_back(std::move(s));
                    continue;
                }
                const std::size_t axis = widest(s);
                const auto middle = s.begin() + static_cast<std::ptrdiff_t>(s.size() / 2);
                std::nth_element(s.begin(), middle, s.end(), [&](const Item& a, const Item& b) {
                    return std::pair(a.middle[axis], a.triangles[0]) <
                           std::pair(b.middle[axis], b.triangles[0]);
                });
                halves.emplace_back(std::make_move_iterator(s.begin()),
                                    std::make_move_iterator(middle));
                halves.emplace_back(std::make_move_iterator(middle),
                                    std::make_move_iterator(s.end()));
            }
            const bool same = halves.size() == sets.size();
            sets = std::move(halves);
            if (same) break;
        }
        return sets;
    }

    static std::size_t widest(const std::vector<Item>& items) {
        std::array<double, 3> extent{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [lo, hi] = std::minmax_element(
                items.begin(), items.end(),
                [k](const Item& a, const Item& b) { return a.middle[k] < b.middle[k]; });
            extent[k] = hi->middle[k] - lo->middle[k];
        }
        return static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) -
                                        extent.begin());
    }

    [[nodiscard]] ConvexPolytope hull_of_triangles(const Node& n) const {
        std::vector<Point> points;
        for (const std::uint32_t t : tree_.triangles(n))
            for (const VertexId v : m_.triangles[t].vertex) points.push_back(m_.brep.point(v));
        return enclosing_hull(points, m_.brep.lattice());
    }

    // Twice the area of a loop seen along an axis, in units of the lattice or, where coordinates
    // have fractions, of 2^(-2 fraction_limit) of them.
    template <class Corner>
    [[nodiscard]] Area area(std::size_t count, int axis, const Corner& corner) const {
        const auto j = static_cast<std::size_t>((axis + 1) % 3);
        const auto k = static_cast<std::size_t>((axis + 2) % 3);
        return is_whole_ ? area_of_whole(count, j, k, corner)
                         : area_of_fractions(count, j, k, corner);
    }
    template <class Corner>
    static Area area_of_whole(std::size_t count, std::size_t j, std::size_t k,
                              const Corner& corner) {
        Area sum = 0;
        const LatticePoint o = corner(0);
        for (std::size_t i = 1; i + 1 < count; ++i) {
            const auto a = detail::difference(corner(i), o);
            const auto b = detail::difference(corner(i + 1), o);
            sum += Area(Int128{a[j]} * b[k] - Int128{a[k]} * b[j]);
        }
        return sum;
    }
    // Differences have 127 bits.
    template <class Corner>
    static Area area_of_fractions(std::size_t count, std::size_t j, std::size_t k,
                                  const Corner& corner) {
        Area sum = 0;
        const LatticePoint o = corner(0);
        const auto way = [&](std::size_t i, std::size_t axis) {
            const auto fine = [axis](const LatticePoint& p) {
                return WideInt<2>(
                    detail::scaled_integer(detail::coordinate(p, axis), fraction_limit));
            };
            return fine(corner(i)) - fine(o);
        };
        for (std::size_t i = 1; i + 1 < count; ++i)
            sum += multiply<5>(way(i, j), way(i + 1, k)) - multiply<5>(way(i, k), way(i + 1, j));
        return sum;
    }

    void find_real(Node& n) const {
        if (!m_.all_lattice) return;
        n.real_face.assign(n.hull.face_count(), false);
        n.real_edge.assign(n.hull.edges().size(), false);
        std::map<LatticePoint, std::uint32_t> name;
        for (std::uint32_t v = 0; v < n.hull.vertices().size(); ++v)
            name.emplace(n.hull.vertices()[v], v);
        std::vector<Area> filled(n.hull.face_count());
        const auto corner = [&](const ModelTriangle& t, std::size_t i) {
            return m_.brep.point(t.vertex[i]).lattice();
        };
        for (const std::uint32_t number : tree_.triangles(n)) {
            const ModelTriangle& t = m_.triangles[number];
            std::array<std::uint32_t, 3> v{};
            for (std::size_t i = 0; i < 3; ++i) {
                const auto found = name.find(corner(t, i));
                v[i] = found == name.end() ? ConvexPolytope::none : found->second;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                if (v[i] == ConvexPolytope::none) continue;
                for (const auto& spoke : n.hull.spokes(v[i]))
                    if (spoke.vertex == v[(i + 1) % 3]) n.real_edge[spoke.edge] = true;
            }
            // A triangle in a face has its normal; all corners must be on the plane.
            const auto f = face_with(n.hull, t, v);
            if (f)
                filled[*f] += area(3, n.hull.plane(*f).dominant_axis(),
                                   [&](std::size_t i) { return corner(t, i); });
        }
        for (std::size_t f = 0; f < n.hull.face_count(); ++f) {
            const auto loop = n.hull.corners(f);
            n.real_face[f] =
                filled[f] == area(loop.size(), n.hull.plane(f).dominant_axis(),
                                  [&](std::size_t i) { return n.hull.vertices()[loop[i]]; });
            if (!n.real_face[f]) continue;
            for (const std::uint32_t e : n.hull.sides(f)) n.real_edge[e] = true;
        }
    }

    // The face of the hull that a triangle lies in with the same normal, if any. `corners` are
    // those that are vertices of the hull.
    [[nodiscard]] std::optional<std::size_t> face_with(
        const ConvexPolytope& hull, const ModelTriangle& t,
        const std::array<std::uint32_t, 3>& corners) const {
        const Plane& plane = m_.brep.plane(t.face);
        const auto fits = [&](std::uint32_t f) {
            return is_same_plane(hull.plane(f), plane) && same_orientation(hull.plane(f), plane);
        };
        for (const std::uint32_t v : corners) {
            if (v == ConvexPolytope::none) continue;
            for (const auto& spoke : hull.spokes(v))
                for (const std::uint32_t f : hull.edges()[spoke.edge].face)
                    if (f != ConvexPolytope::none && fits(f)) return f;
            return std::nullopt;
        }
        // A face in the triangle's plane means that the whole hull is below it.
        std::size_t on = 0;
        for (const LatticePoint& p : hull.vertices()) {
            const Side s = side_of(p, plane);
            if (s == Side::Above) return std::nullopt;
            if (s == Side::On) ++on;
        }
        if (on < 3) return std::nullopt;
        for (std::uint32_t f = 0; f < hull.face_count(); ++f)
            if (fits(f)) return f;
        return std::nullopt;
    }

    HullTree& tree_;
    const InterferenceModelData& m_;
    HullTreeOptions options_;
    bool is_whole_;
};

HullTree::HullTree(const InterferenceModel& model, const HullTreeOptions& options) {
    if (options.branching < 2) throw UsageError("a tree of hulls needs at least two branches");
    if (options.leaf_triangles < 1) throw UsageError("a leaf of a tree of hulls has no triangle");
    const std::vector<ConvexPart> parts = convex_parts(model);
    part_count_ = parts.size();
    Builder(*this, trisect::detail::data_of(model), options).run(parts);
}

std::size_t HullTree::bytes() const {
    std::size_t r = triangles_.size() * sizeof(std::uint32_t);
    for (const Node& n : nodes_)
        r += sizeof n - sizeof n.hull + n.hull.bytes() + n.real_edge.size() / 8 +
             n.real_face.size() / 8;
    return r;
}

}  // namespace trisect::hierarchies
