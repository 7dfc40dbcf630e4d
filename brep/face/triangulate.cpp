// SPDX-License-Identifier: Apache-2.0
//
// One sweep, safe for faces that touch themselves.
//
// Textbooks assume a simple outline. Faces of booleans are not: holes touch the outline or each
// other in vertices, outlines touch themselves, and straight runs carry vertices of the neighbours.
// Cutting ears is quadratic on combs and spirals, and tying holes to outlines by bridges that see
// each other costs a pass over the face for each of ten thousand holes. Here all tests are exact,
// the topology is brought into a form in which the textbook is right, and no bridge is ever built:
//
//  1. The plane is projected along its dominant axis; corners are sorted lexicographically in
//     the projection. Equal points get one *place*, whose number is also its rank.
//  2. Where several corners share a place, edges are linked anew so that the interior wedges of
//     its corners are disjoint (planar_loops.cpp). Now no wedge contains an edge, so every corner
//     can be treated as if it were alone.
//  3. A line sweeps over the places and meets the interior in regions, each between two edges
//     (sweep_line.h). A region carries the part of a polygon monotone along the sweep that has no
//     triangles yet: a chain of corners along one side that turns away from the inside, or runs
//     straight (Garey, Johnson, Preparata, Tarjan 1978). A corner that parts a region in two hangs
//     on to the region's last corner, which sees it; one that ends what lay between two regions
//     leaves a region with two such parts, and the next corner there, which it sees, closes one of
//     them. These are the diagonals of the decomposition into monotone polygons, drawn as they are
//     found: triangles come out at once and no polygon is stored.
//
// No triangle is flat: the chain turns away from the inside or runs straight, and what it is joined
// with is strictly inside of its first edge; a straight run is joined with a corner off its line.
// That holds for vertical runs too, since the order is that of a slightly slanted line. All corners
// are used, so no corner lies on a side. The number of triangles, n + 2·holes - 2·outlines, is
// checked at the end.
//
// Faces with a handful of corners, nearly all of them, go by small_polygon.h.

#include <trisect/brep/triangulate.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <trisect/brep/face/convex_cut.h>
#include <trisect/brep/face/small_polygon.h>
#include <trisect/brep/face/sweep_line.h>
#include <trisect/kernel/contract.h>

namespace trisect {

namespace {

using Index = std::uint32_t;

class SweepTriangulator {
public:
    SweepTriangulator(const PlaneProjection& projection, std::span<const IndexLoop> loops)
        : figure_(projection, loops),
          line_(figure_),
          region_of_(figure_.corner_count(), decltype(line_)::none) {}

    std::vector<IndexTriangle> run() {
        const std::size_t wanted =
            figure_.corner_count() + 2 * figure_.holes().size() - 2 * figure_.outlines().size();
        triangles_.reserve(wanted);
        const auto order = figure_.corners_in_order();
        for (std::size_t i = 0; i < order.size();) {
            std::size_t j = i + 1;
            while (j < order.size() && place_of(order[j]) == place_of(order[i])) ++j;
            pass(order.subspan(i, j - i));
            i = j;
        }
        TRISECT_EXPECTS(triangles_.size() == wanted,
                        "a triangulation with one triangle for each corner but two");
        return std::move(triangles_);
    }

private:
    enum class Side : std::uint8_t { Lower, Upper };
    enum class Kind : std::uint8_t { Start, Split, End, Merge, Lower, Upper };

    // The part of a monotone polygon without triangles. All corners but the first are on `side`;
    // the edge from the first one to what comes next is on the other.
    struct Part {
        std::vector<Index> chain;
        Side side = Side::Lower;
    };
    // Two parts after a merge, until the next corner: then the merge is the last corner of both,
    // at the upper end of the low one and at the lower end of the high one.
    struct Region {
        Index low = 0;
        Index high = 0;
    };

    [[nodiscard]] Index place_of(Index c) const { return figure_.place_of(c); }

    [[nodiscard]] Kind kind_of(Index c) const {
        const bool from_left = place_of(figure_.prev(c)) < place_of(c);
        const bool to_left = place_of(figure_.next(c)) < place_of(c);
        if (from_left != to_left) return from_left ? Kind::Lower : Kind::Upper;
        // Both ways along one line: the tip of a slit, with the interior all around.
        const bool convex = figure_.turn(c) > 0;
        if (from_left) return convex ? Kind::End : Kind::Merge;
        return convex ? Kind::Start : Kind::Split;
    }

    // All corners at a place. Edges that end there go first, then come those that begin.
    void pass(std::span<const Index> corners) {
        for (const Index c : corners) {
            const Kind kind = kind_of(c);
            if (kind == Kind::Lower) run_on(c);
            if (kind == Kind::End) end(c);
            if (kind == Kind::Merge) merge(c);
        }
        for (const Index c : corners) {
            const Kind kind = kind_of(c);
            if (kind == Kind::Upper) (void)reach(region_below(c), c, Side::Upper);
            if (kind == Kind::Split) split(c);
            if (kind == Kind::Start) start(c);
        }
    }

    Region& region_below(Index c) {
        const Index r = line_.below(place_of(c));
        TRISECT_EXPECTS(r != decltype(line_)::none, "a corner of a face has an edge below");
        return regions_[r];
    }
    [[nodiscard]] Index region_above_edge_to(Index c) const {
        const Index r = region_of_[figure_.prev(c)];
        TRISECT_EXPECTS(r < regions_.size(), "an edge that began before it ends");
        return r;
    }

    void run_on(Index c) {
        const Index r = region_above_edge_to(c);
        (void)reach(regions_[r], c, Side::Lower);
        region_of_[c] = r;
        line_.advance(r, c);
    }

    void end(Index c) {
        const Index r = region_above_edge_to(c);
        const Region region = regions_[r];
        close(region.low, c);
        if (region.high != region.low) close(region.high, c);
        line_.close(r);
    }

    void merge(Index c) {
        const Index above = region_above_edge_to(c);
        const Index high = reach(regions_[above], c, Side::Lower);
        line_.close(above);
        Region& below = region_below(c);
        below = {reach(below, c, Side::Upper), high};
    }

    void start(Index c) { open({new_part(c), 0}, c, true); }

    void split(Index c) {
        Region& region = region_below(c);
        if (region.low != region.high) {
            const Region both = region;
            extend(both.low, c, Side::Upper);
            extend(both.high, c, Side::Lower);
            region = {both.low, both.low};
            open({both.high, both.high}, c, false);
            return;
        }
        // The chain stays on its side of the diagonal to its last corner.
        const Index old = region.low;
        const Index last = parts_[old].chain.back();
        const Side side = parts_[old].side;
        const Index other = new_part(last);
        extend(old, c, side);
        extend(other, c, side == Side::Lower ? Side::Upper : Side::Lower);
        const Index low = side == Side::Lower ? other : old;
        const Index high = side == Side::Lower ? old : other;
        region = {low, low};
        open({high, high}, c, false);
    }

    void open(Region region, Index c, bool single) {
        if (single) region.high = region.low;
        region_of_[c] = line_.open(c);
        regions_.push_back(region);
    }

    // The region gets a corner on one side. Returns its part, one from now on.
    Index reach(Region& region, Index c, Side side) {
        if (region.low != region.high) {
            close(side == Side::Upper ? region.high : region.low, c);
            if (side == Side::Upper) {
                region.high = region.low;
            } else {
                region.low = region.high;
            }
        }
        extend(region.low, c, side);
        return region.low;
    }

    Index new_part(Index first) {
        Index p = 0;
        if (free_.empty()) {
            p = static_cast<Index>(parts_.size());
            parts_.emplace_back();
        } else {
            p = free_.back();
            free_.pop_back();
        }
        parts_[p].chain.assign(1, first);
        parts_[p].side = Side::Lower;
        return p;
    }

    void extend(Index part, Index c, Side side) {
        auto& chain = parts_[part].chain;
        if (chain.size() > 1 && parts_[part].side != side) {
            const Index last = chain.back();
            join_all(part, c);
            chain.assign(1, last);
        }
        parts_[part].side = side;
        while (chain.size() > 1) {
            const Index a = chain[chain.size() - 2];
            const Index b = chain.back();
            const int turn = figure_.orientation(place_of(a), place_of(b), place_of(c));
            if (side == Side::Lower ? turn <= 0 : turn >= 0) break;
            emit(a, b, c, side);
            chain.pop_back();
        }
        chain.push_back(c);
    }

    void close(Index part, Index c) {
        join_all(part, c);
        free_.push_back(part);
    }

    void join_all(Index part, Index c) {
        const auto& chain = parts_[part].chain;
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            emit(chain[i], chain[i + 1], c, parts_[part].side);
    }

    // a and b in the order of the sweep along one side.
    void emit(Index a, Index b, Index c, Side side) {
        if (side == Side::Upper) std::swap(a, b);
        triangles_.push_back(
            {figure_.corner(a).point, figure_.corner(b).point, figure_.corner(c).point});
    }

    PlanarLoops figure_;
    detail::SweepLine<PlanarLoops> line_;
    std::vector<Region> regions_;   // by number on the line
    std::vector<Index> region_of_;  // by corner: above the edge that leaves it
    std::vector<Part> parts_;
    std::vector<Index> free_;
    std::vector<IndexTriangle> triangles_;
};

// A single loop with few corners, all at different places: ears. Nothing when it is not one.
std::optional<std::vector<IndexTriangle>> cut_small(const PlaneProjection& projection,
                                                    std::span<const Index> loop) {
    const std::size_t n = loop.size();
    if (n > detail::small_polygon_limit) return {};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (projection.compare(loop[i], loop[j]) == 0) return {};
    std::vector<IndexTriangle> triangles;
    const bool done = detail::cut_small_polygon(
        n,
        [&](Index a, Index b, Index c) {
            return projection.orientation(loop[a], loop[b], loop[c]);
        },
        [&] {
            Index first = 0;
            for (Index i = 1; i < n; ++i)
                if (projection.compare(loop[i], loop[first]) < 0) first = i;
            return first;
        },
        [&](Index a, Index b, Index c) {
            triangles.push_back({loop[a], loop[b], loop[c]});
        });
    TRISECT_EXPECTS(done, "a simple outline has an ear");
    return triangles;
}

// A simple loop that turns left at every corner is convex. (A loop that touches itself has a
// corner that does not.)
bool is_strictly_convex(const PlaneProjection& projection, std::span<const Index> loop) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i)
        if (projection.orientation(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]) <= 0)
            return false;
    return true;
}

std::vector<IndexTriangle> cut_convex(std::span<const Index> loop) {
    std::vector<IndexTriangle> triangles;
    triangles.reserve(loop.size() - 2);
    detail::cut_convex_or_fan(static_cast<Index>(loop.size()), [&](Index a, Index b, Index c) {
        triangles.push_back({loop[a], loop[b], loop[c]});
    });
    return triangles;
}

}  // namespace

std::vector<IndexTriangle> triangulate(const Plane& plane, std::span<const Point> points,
                                       std::span<const IndexLoop> loops) {
    return triangulate(PlaneProjection(plane, points), loops);
}

std::vector<IndexTriangle> triangulate(const PlaneProjection& projection,
                                       std::span<const IndexLoop> loops) {
    TRISECT_EXPECTS(!loops.empty(), "a face has an outer loop");
    for (const auto& loop : loops)
        TRISECT_EXPECTS(loop.size() >= (&loop == loops.data() ? 3U : 2U),
                        "a loop has at least three corners, a slit two");
    if (loops.size() == 1) {
        const IndexLoop& loop = loops[0];
        if (loop.size() == 3) return cut_convex(loop);
        if (auto triangles = cut_small(projection, loop)) return *std::move(triangles);
        if (is_strictly_convex(projection, loop)) return cut_convex(loop);
    }
    return SweepTriangulator(projection, loops).run();
}

std::vector<IndexTriangle> triangulate(const Brep& brep, FaceId face) {
    std::vector<IndexLoop> loops;
    for (const LoopId l : brep.loops(face)) {
        loops.emplace_back();
        for (const HalfedgeId h : brep.halfedges(l)) loops.back().push_back(brep.origin(h).index);
    }
    return triangulate(brep.plane(face), brep.points(), loops);
}

}  // namespace trisect
