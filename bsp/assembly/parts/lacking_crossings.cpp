// SPDX-License-Identifier: Apache-2.0
//
// Where faces cross straight, one of them may have no edge: what touches it there was moved away
// by an infinitesimal. It is in special position, and so is what has an edge there. Two faces that
// cross are seen where one of them is divided on the segment, with a third facet beside it.
//
// A facet that has no edge on the segment, or as many one way as the other, goes straight across it
// if the segment is inside its outline; else it is not there, or it has no width there.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/assembly/parts/crossing_faces.h>
#include <trisect/bsp/assembly/parts/facet_boxes.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/filters.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/radix_sort.h>

namespace trisect::detail {

namespace {

// Sides of points and planes, all in one word each: there are many, and a map has three times as
// much for one.
class KnownSides {
public:
    [[nodiscard]] std::optional<int> find(PointId point, PlaneId plane) const {
        if (slots_.empty()) return std::nullopt;
        const std::uint64_t slot = slots_[place_of(key_of(point, plane))];
        if (slot == 0) return std::nullopt;
        return static_cast<int>(slot & 3U) - 2;
    }
    void insert(PointId point, PlaneId plane, int side) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        const std::uint64_t key = key_of(point, plane);
        slots_[place_of(key)] = key | static_cast<std::uint64_t>(side + 2);
        ++count_;
    }

private:
    [[nodiscard]] static std::uint64_t key_of(PointId point, PlaneId plane) {
        return static_cast<std::uint64_t>(point) << 33U | static_cast<std::uint64_t>(plane) << 2U;
    }
    // Of that key, or where it would be.
    [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = static_cast<std::size_t>(mix64(key)) & mask;
        while (slots_[i] != 0 && (slots_[i] >> 2U) << 2U != key) i = (i + 1) & mask;
        return i;
    }
    void grow() {
        PoolVector<std::uint64_t> old(std::max<std::size_t>(64, 2 * slots_.size()), 0);
        old.swap(slots_);
        for (const std::uint64_t slot : old)
            if (slot != 0) slots_[place_of((slot >> 2U) << 2U)] = slot;
    }

    PoolVector<std::uint64_t> slots_;  // 0: none; else the side and 2 in the last bits
    std::size_t count_ = 0;
};

// Whether doubles show that the planes differ, by their normals or by where they cross an axis.
bool differ(const Plane& a, const Plane& b) {
    const auto signed_minor = [](double p, double q, double r, double s) {
        return filter_cross(p, q, r, s).sign() != 0;
    };
    bool found = false;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        found = found ||
                signed_minor(a.approx_normal(i), a.approx_normal(j), b.approx_normal(i),
                             b.approx_normal(j)) ||
                signed_minor(a.approx_normal(i), a.approx_offset(), b.approx_normal(i),
                             b.approx_offset());
    }
    return found;
}

// Edges in special position, by segment; and facets that may have one of them inside.
class LackingCrossings {
public:
    explicit LackingCrossings(BoundaryParts& parts) : parts_(parts) {
        const auto is_special = [&](const BoundaryEdge& e) { return facet(e).is_special; };
        edges_.reserve(static_cast<std::size_t>(std::ranges::count_if(parts.edges, is_special)));
        std::ranges::copy_if(parts.edges, std::back_inserter(edges_), is_special);
        radix_sort(edges_, [](const BoundaryEdge& e) { return ends_of(e); });
    }
    [[nodiscard]] bool add() {
        for (std::size_t i = 0; i < edges_.size();) {
            std::size_t j = i + 1;
            while (j < edges_.size() && ends_of(edges_[j]) == ends_of(edges_[i])) ++j;
            const Edges edges = std::span(edges_).subspan(i, j - i);
            if (may_lack(edges) && !add_at(edges)) return false;
            i = j;
        }
        return true;
    }

private:
    using Edges = std::span<const BoundaryEdge>;
    struct OfPlane {
        PlaneId plane = 0;  // of the first facet
        bool up = false;
        bool down = false;
        bool back_up = false;  // of facets that face the other way
        bool back_down = false;
        [[nodiscard]] bool is_straight() const { return (up && down) || (back_up && back_down); }
    };
    enum class Place : std::uint8_t { Outside, Inside, Unknown };

    // Planes through a line, the face of one of which goes on behind it.
    [[nodiscard]] bool may_lack(Edges edges) {
        if (edges.size() < 3) return false;
        list_planes(edges);
        return planes_.size() > 1 && std::ranges::any_of(planes_, &OfPlane::is_straight);
    }
    void list_planes(Edges edges) {
        planes_.clear();
        for (const BoundaryEdge& e : edges) {
            const BoundaryFacet& f = facet(e);
            const Plane& p = parts_.bench.plane_at(f.support);
            auto known = std::ranges::find_if(
                planes_, [&](const OfPlane& o) { return are_one(o.plane, f.support); });
            if (known == planes_.end()) known = planes_.insert(known, {f.support});
            const bool same = same_orientation(parts_.bench.plane_at(known->plane), p) != f.flipped;
            const bool is_up = e.from < e.to;
            if (same) (is_up ? known->up : known->down) = true;
            if (!same) (is_up ? known->back_up : known->back_down) = true;
        }
    }
    // Where faces cross in the segment: twice to each facet that has it inside.
    [[nodiscard]] bool add_at(Edges edges) {
        if (!boxes_) list_boxes();
        const BoundaryEdge& e = edges[0];
        here_.clear();
        inside_.clear();
        ending_.clear();
        others_.clear();
        const auto look_at = [&](std::int32_t number) {
            note_facet(number, edges);
            return true;
        };
        (void)boxes_->all_around(parts_.bench.approximation(e.from),
                                 parts_.bench.approximation(e.to), look_at);
        std::erase_if(others_, [&](std::int32_t number) {
            return std::ranges::any_of(
                ending_, [&](std::int32_t other) { return are_of_one_face(number, other); });
        });
        if (!may_cross()) return true;
        for (const std::int32_t number : others_)
            if (!note_inside(number, e)) return false;
        if (!inside_.empty() && cross_straight(here_))
            parts_.crossings.insert(parts_.crossings.end(), inside_.begin(), inside_.end());
        return true;
    }
    // What a facet has of a segment, by its edges on that. Else it may have it inside, unless
    // another one of its face ends there.
    void note_facet(std::int32_t number, Edges edges) {
        const BoundaryFacet& f = parts_.facets[as_index(number)];
        int up = 0;
        bool has_edge = false;
        for (const BoundaryEdge& e : edges) {
            if (e.facet != number) continue;
            has_edge = true;
            up += e.from < e.to ? 1 : -1;
        }
        if (up != 0) {
            here_.push_back({f.source, f.facet, f.flipped, up > 0});
            ending_.push_back(number);
        } else if (has_edge || is_in_plane_of(edges[0], f.support)) {
            others_.push_back(number);
        }
    }
    // Doubles leave it open for all planes through the segment.
    [[nodiscard]] bool is_in_plane_of(const BoundaryEdge& e, PlaneId support) {
        const Workbench& bench = parts_.bench;
        const Plane& plane = bench.plane_at(support);
        if (filtered_side(bench.approximation(e.from), plane) ||
            filtered_side(bench.approximation(e.to), plane))
            return false;
        return std::ranges::any_of(planes_,
                                   [&](const OfPlane& o) { return are_one(o.plane, support); }) ||
               (side_at(e.from, support) == 0 && side_at(e.to, support) == 0);
    }
    // Whether two faces may go straight across: such as are divided there, and others.
    [[nodiscard]] bool may_cross() const {
        std::size_t faces = 0;
        for (std::size_t i = 0; i < ending_.size(); ++i) {
            bool is_first = true;
            bool is_divided = false;
            for (std::size_t j = 0; j < ending_.size(); ++j) {
                if (i == j || !are_of_one_face(ending_[i], ending_[j])) continue;
                is_first = is_first && j > i;
                is_divided = is_divided || here_[i].up != here_[j].up;
            }
            faces += is_first && is_divided ? 1 : 0;
        }
        for (std::size_t i = 0; i < others_.size() && faces < 2; ++i)
            faces += std::ranges::none_of(std::span(others_).first(i), [&](std::int32_t other) {
                return are_of_one_face(others_[i], other);
            });
        return faces > 1;
    }
    // Whether two facets are parts of one plane and face the same way.
    [[nodiscard]] bool are_of_one_face(std::int32_t number, std::int32_t other) const {
        const Workbench& bench = parts_.bench;
        const BoundaryFacet& f = parts_.facets[as_index(number)];
        const BoundaryFacet& g = parts_.facets[as_index(other)];
        return are_one(f.support, g.support) &&
               same_orientation(bench.plane_at(f.support), bench.plane_at(g.support)) ==
                   (f.flipped == g.flipped);
    }
    // False where that is not known.
    [[nodiscard]] bool note_inside(std::int32_t number, const BoundaryEdge& e) {
        const BoundaryFacet& f = parts_.facets[as_index(number)];
        const auto across = plane_across(f.support);
        if (!across) return false;
        const Place place = place_in(number, e, *across);
        if (place != Place::Inside) return place == Place::Outside;
        const auto above = is_left_above(e, f, *across);
        if (!above) return false;
        for (const bool is_up : {true, false})
            here_.push_back({f.source, f.facet, f.flipped, is_up});
        inside_.push_back({e.from, e.to, number, {*across, *above}});
        inside_.push_back({e.to, e.from, number, {*across, !*above}});
        return true;
    }
    // Whether what lies above a plane through an edge is on its left, seen from outside. With the
    // plane's normal m and the facet's N, that is where the edge runs along m×N (vertex_turn.cpp).
    [[nodiscard]] std::optional<bool> is_left_above(const BoundaryEdge& e, const BoundaryFacet& f,
                                                    PlaneId across) const {
        const Workbench& bench = parts_.bench;
        const Approximation& a = bench.approximation(e.from);
        const Approximation& b = bench.approximation(e.to);
        int axis = 0;
        for (int k = 1; k < 3; ++k)
            if (std::fabs(b.c[as_index(k)] - a.c[as_index(k)]) >
                std::fabs(b.c[as_index(axis)] - a.c[as_index(axis)]))
                axis = k;
        const double way = b.c[as_index(axis)] - a.c[as_index(axis)];
        if (std::fabs(way) <= error_slack * (a.error + b.error)) return std::nullopt;
        const int turn = sign_of_det(bench.plane_at(across), bench.plane_at(f.support),
                                     Plane::axis_aligned(axis, 1, 0));
        if (turn == 0) return std::nullopt;
        return ((turn > 0) == (way > 0)) != f.flipped;
    }
    // Many segments lie in one line, and around each the same planes are compared, and the same
    // points, which mostly are on them: what takes integers is kept.
    [[nodiscard]] bool are_one(PlaneId a, PlaneId b) const {
        const Workbench& bench = parts_.bench;
        const PlaneId p = bench.plane_class(a);
        const PlaneId q = bench.plane_class(b);
        if (p == q) return true;
        if (differ(bench.plane_at(a), bench.plane_at(b))) return false;
        const Key128 key{static_cast<std::uint64_t>(std::min(p, q)),
                         static_cast<std::uint64_t>(std::max(p, q))};
        if (const std::int32_t known = same_planes_.find(key); known >= 0) return known != 0;
        const bool same = is_same_plane(bench.plane_at(a), bench.plane_at(b));
        same_planes_.insert(key, same ? 1 : 0);
        return same;
    }
    [[nodiscard]] int side_at(PointId point, PlaneId plane) const {
        const Workbench& bench = parts_.bench;
        if (const auto s = filtered_side(bench.approximation(point), bench.plane_at(plane)))
            return sign_of(*s);
        if (const auto known = sides_.find(point, plane)) return *known;
        const int exact = bench.side(point, plane);
        sides_.insert(point, plane, exact);
        return exact;
    }
    // Through the segment, another plane than this one.
    [[nodiscard]] std::optional<PlaneId> plane_across(PlaneId support) const {
        for (const OfPlane& o : planes_)
            if (!are_one(o.plane, support)) return o.plane;
        return std::nullopt;
    }
    // Of a segment in the plane of a facet. It is inside if its line, beyond one of its ends, meets
    // an odd number of edges of the outline.
    [[nodiscard]] Place place_in(std::int32_t number, const BoundaryEdge& segment,
                                 PlaneId across) const {
        bool inside = false;
        for (const std::uint32_t place : edges_of(number)) {
            const BoundaryEdge& e = edges_[place];
            if (ends_of(e) == ends_of(segment)) continue;
            const int from = side_at(e.from, across);
            const int to = side_at(e.to, across);
            if (from == to && from != 0) continue;
            if (from == 0 && to == 0) {
                if (!are_apart(segment, e)) return Place::Unknown;
                continue;
            }
            const int a = side_at(segment.from, e.line.plane);
            const int b = side_at(segment.to, e.line.plane);
            if (a == -b) return Place::Unknown;
            if ((from > 0) == (to > 0)) continue;
            const bool is_up = to > from;
            const bool is_in_half_plane = (a + b > 0) == e.line.above;
            if (is_up == is_in_half_plane) inside = !inside;
        }
        return inside ? Place::Inside : Place::Outside;
    }
    // Of two segments on one line: whether one ends where the other one begins, or before.
    [[nodiscard]] bool are_apart(const BoundaryEdge& a, const BoundaryEdge& b) const {
        return lie_beyond(a.from, a.to, b) || lie_beyond(a.to, a.from, b) ||
               lie_beyond(b.from, b.to, a) || lie_beyond(b.to, b.from, a);
    }
    // Behind the first point of a segment, seen from the other one, as far as that is known.
    [[nodiscard]] bool lie_beyond(PointId end, PointId other, const BoundaryEdge& e) const {
        const Workbench& bench = parts_.bench;
        const Approximation& p = bench.approximation(end);
        const Approximation& q = bench.approximation(other);
        for (std::size_t k = 0; k < 3; ++k) {
            const double way = q.c[k] > p.c[k] ? 1 : -1;
            const auto is_behind = [&](PointId v) {
                const Approximation& a = bench.approximation(v);
                return way * (p.c[k] - a.c[k]) > error_slack * (p.error + a.error);
            };
            if (std::fabs(q.c[k] - p.c[k]) > error_slack * (p.error + q.error) &&
                (e.from == end || is_behind(e.from)) && (e.to == end || is_behind(e.to)))
                return true;
        }
        if (bench.is_corner(end)) return are_about(end, other, e);
        for (const PlaneId plane : bench.planes_of(end)) {
            const int side = side_at(other, plane);
            if (side == 0) continue;
            return side * side_at(e.from, plane) <= 0 && side * side_at(e.to, plane) <= 0;
        }
        return false;
    }
    // Around a common end, if the edge is much shorter: then the common end is between the two
    // others where these are on different sides of it, seen from the end of the edge.
    [[nodiscard]] bool are_about(PointId end, PointId other, const BoundaryEdge& e) const {
        const Workbench& bench = parts_.bench;
        if (e.from != end && e.to != end) return false;
        const PointId near = e.from == end ? e.to : e.from;
        if (bench.is_corner(near)) return false;
        const Approximation& p = bench.approximation(end);
        const auto way = [&](PointId v, std::size_t k) {
            return std::fabs(bench.approximation(v).c[k] - p.c[k]);
        };
        double longest = 0;
        double longest_near = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            longest = std::max(longest, way(other, k));
            longest_near = std::max(longest_near, way(near, k));
        }
        const double error = bench.approximation(other).error + bench.approximation(near).error;
        if (longest <= 2 * (longest_near + error_slack * (p.error + error))) return false;
        for (const PlaneId plane : bench.planes_of(near)) {
            const int side = side_at(end, plane);
            if (side != 0) return side == side_at(other, plane);
        }
        return false;
    }
    [[nodiscard]] std::span<const std::uint32_t> edges_of(std::int32_t number) const {
        const std::size_t first = first_[as_index(number)];
        return std::span(by_facet_).subspan(first, first_[as_index(number) + 1] - first);
    }
    void list_boxes() {
        // A facet's end moves on to where it ends, which is where the next one begins.
        first_.assign(parts_.facets.size() + 2, 0);
        for (const BoundaryEdge& e : edges_) ++first_[as_index(e.facet) + 2];
        for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
        by_facet_.resize(edges_.size());
        for (std::uint32_t i = 0; i < edges_.size(); ++i)
            by_facet_[first_[as_index(edges_[i].facet) + 1]++] = i;
        PoolVector<FacetBox> boxes;
        for (std::size_t f = 0; f < parts_.facets.size(); ++f) {
            const auto edges = edges_of(static_cast<std::int32_t>(f));
            if (edges.empty()) continue;
            FacetBox& box = boxes.emplace_back();
            box.facet = static_cast<std::int32_t>(f);
            for (const std::uint32_t e : edges) box.add(parts_.bench.approximation(edges_[e].from));
        }
        boxes_.emplace(std::move(boxes));
    }

    [[nodiscard]] const BoundaryFacet& facet(const BoundaryEdge& e) const {
        return parts_.facets[as_index(e.facet)];
    }

    BoundaryParts& parts_;
    BoundaryEdges edges_;
    PoolVector<std::uint32_t> by_facet_;  // their places, once they are needed
    PoolVector<std::uint32_t> first_;     // of these
    std::optional<FacetBoxes> boxes_;     // of facets that have some
    PoolVector<OfPlane> planes_;          // of a segment
    PoolVector<FacetEdge> here_;          // of a segment
    BoundaryEdges inside_;
    PoolVector<std::int32_t> ending_;  // facets that end there
    PoolVector<std::int32_t> others_;
    mutable FlatMap same_planes_;  // of two classes
    mutable KnownSides sides_;
};

}  // namespace

bool find_lacking_crossings(BoundaryParts& parts) { return LackingCrossings(parts).add(); }

}  // namespace trisect::detail
