// SPDX-License-Identifier: Apache-2.0
//
// Sections. The plane is moved up by an infinitely small step: then it meets no corner, every
// polygon with corners on both sides gives one directed segment, and the segments close because the
// boundary does. A corner on the plane counts as below. What the moved plane misses of the closed
// section are the regions where the solid lies below the plane and touches it: exactly the faces in
// the plane that look up. So the directed edges of these polygons are added. Opposite segments
// cancel, also where they overlap in part, and what is left is chained to loops.
//
// Points are where the plane meets an edge of a polygon, named by three planes: exact. Segments of
// neighbouring polygons are connected by comparing points, correctly rounded coordinates first.

#include <trisect/bsp/query/lines/index_section.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <trisect/brep/planar_loops.h>
#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

// Where a box lies to a plane: -1 and 1 when certainly all of it is on that side, else 0.
int side_of_box(const DoubleBox& box, const Plane& plane) {
    double value = plane.approx_offset();
    double terms = std::fabs(value);
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double n = plane.approx_normal(static_cast<int>(k));
        const double mid = 0.5 * (box.lo[k] + box.hi[k]);
        const double half = 0.5 * (box.hi[k] - box.lo[k]);
        value += n * mid;
        terms += std::fabs(n * mid);
        reach += std::fabs(n) * half;
    }
    const double slack = 0x1p-48 * (terms + reach);
    if (value > reach + slack) return 1;
    if (value < -reach - slack) return -1;
    return 0;
}

DoubleBox bounded(const DoubleBox& cell, const IndexBase& index) {
    DoubleBox b = cell;
    for (std::size_t k = 0; k < 3; ++k) {
        b.lo[k] = std::max(b.lo[k], index.lo()[k]);
        b.hi[k] = std::min(b.hi[k], index.hi()[k]);
    }
    return b;
}

bool is_parallel(const Plane& a, const Plane& b) {
    for (int k = 0; k < 3; ++k)
        if (sign_of_cross(a, b, k) != 0) return false;
    return true;
}

// Points by value, numbered.
class PointNumbers {
public:
    std::uint32_t number(Point p) {
        std::uint64_t h = 0;
        for (const double c : p.nearest()) {
            h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15ULL;
            h ^= h >> 29;
        }
        const auto [begin, end] = numbers_.equal_range(h);
        for (auto it = begin; it != end; ++it)
            if (points_[it->second] == p) return it->second;
        const auto n = static_cast<std::uint32_t>(points_.size());
        numbers_.emplace(h, n);
        points_.push_back(std::move(p));
        return n;
    }
    [[nodiscard]] const std::vector<Point>& points() const { return points_; }

private:
    std::vector<Point> points_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> numbers_;
};

struct Directed {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    friend auto operator<=>(const Directed&, const Directed&) = default;
};

class Sectioner {
public:
    Sectioner(const IndexBase& index, const Plane& plane) : index_(index), plane_(plane) {}

    [[nodiscard]] std::vector<SectionRegion> regions() {
        const auto is_near = [&](const DoubleBox& cell) {
            return side_of_box(bounded(cell, index_), plane_) == 0;
        };
        for (const PolygonId& id : polygons_in(index_, is_near)) add(id);
        cancel();
        if (split()) cancel();
        const std::vector<IndexLoop> loops = chain();
        std::vector<SectionRegion> out;
        if (loops.empty()) return out;
        const PlaneProjection projection(plane_, numbers_.points());
        for (const auto& region : connected_regions(plane_, numbers_.points(), loops)) {
            SectionRegion r;
            for (std::size_t i = 0; i < region.size(); ++i) {
                SectionLoop loop = finished(region[i], projection);
                if (i == 0) {
                    r.outer = std::move(loop);
                } else {
                    r.holes.push_back(std::move(loop));
                }
            }
            out.push_back(std::move(r));
        }
        return out;
    }

private:
    void add(const PolygonId& id) {
        if (id.is_unbounded() && !id.reaches_out()) {
            const Plane support = id.support();
            if (is_parallel(support, plane_) && !is_same_plane(support, plane_)) return;
            throw UnsupportedError("the section is unbounded");
        }
        if (id.is_triangle()) {
            std::array<Side, 3> sides{};
            for (int i = 0; i < 3; ++i)
                sides[static_cast<std::size_t>(i)] = trisect::side_of(id.corner(i), plane_);
            const auto is = [&](Side s) { return std::ranges::count(sides, s); };
            // What touches the plane from below is no part of the section.
            if (is(Side::Above) == 3 || (is(Side::Above) == 0 && is(Side::On) != 3)) return;
            if (!id.reaches_out()) {
                add(id, id.all().corners(id.number), sides, id.support(),
                    id.all().edges(id.number));
                return;
            }
        }
        // What of it is in its cell; the cuts cancel or run straight on.
        const ConvexPolygon part = id.part();
        const auto corners = part.vertices();
        std::vector<Side> sides;
        for (const Point& c : corners) {
            sides.push_back(trisect::side_of(c, plane_));
            for (const double x : c.nearest())
                if (std::fabs(x) > 0x1p53) throw UnsupportedError("the section is unbounded");
        }
        add(id, corners, sides, part.support(), part.edges());
    }

    void add(const PolygonId& id, std::span<const Point> corners, std::span<const Side> sides,
             const Plane& support, std::span<const Plane> edges) {
        const auto count = [&](Side s) { return std::ranges::count(sides, s); };
        if (count(Side::On) == std::ssize(sides)) {
            add_outline(id, corners);
        } else if (count(Side::Above) != 0 && count(Side::Above) != std::ssize(sides)) {
            add_crossing(id, corners, sides, support, edges);
        }
    }

    // From where the polygon's outline goes down through the plane to where it comes up.
    void add_crossing(const PolygonId& id, std::span<const Point> corners,
                      std::span<const Side> sides, const Plane& support,
                      std::span<const Plane> edges) {
        Directed d;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::size_t j = (i + 1) % corners.size();
            const bool up = sides[j] == Side::Above;
            if ((sides[i] == Side::Above) == up) continue;
            const std::size_t low = up ? i : j;
            const std::uint32_t n = numbers_.number(
                sides[low] == Side::On ? corners[low] : Point(support, edges[i], plane_));
            (up ? d.to : d.from) = n;
        }
        if (id.is_flipped()) std::swap(d.from, d.to);
        if (d.from != d.to) segments_.push_back(d);
    }

    // A polygon in the plane that looks up.
    void add_outline(const PolygonId& id, std::span<const Point> corners) {
        if (!same_orientation(id.outward(), plane_)) return;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            Directed d{numbers_.number(corners[i]),
                       numbers_.number(corners[(i + 1) % corners.size()])};
            if (id.is_flipped()) std::swap(d.from, d.to);
            segments_.push_back(d);
        }
    }

    // Removes pairs of opposite segments.
    void cancel() {
        const auto low = [](const Directed& d) {
            return Directed{std::min(d.from, d.to), std::max(d.from, d.to)};
        };
        std::sort(segments_.begin(), segments_.end(), [&](const Directed& a, const Directed& b) {
            return std::pair(low(a), a) < std::pair(low(b), b);
        });
        std::vector<Directed> kept;
        for (std::size_t i = 0; i < segments_.size();) {
            const Directed key = low(segments_[i]);
            std::ptrdiff_t net = 0;
            for (; i < segments_.size() && low(segments_[i]) == key; ++i)
                net += segments_[i].from == key.from ? 1 : -1;
            for (; net > 0; --net) kept.push_back(key);
            for (; net < 0; ++net) kept.push_back({key.to, key.from});
        }
        segments_ = std::move(kept);
    }

    // Cuts segments at ends of others that lie on them. True when there was something to cut.
    bool split() {
        const std::vector<Point>& points = numbers_.points();
        const PlaneProjection projection(plane_, points);
        std::vector<std::uint32_t> order;
        for (const Directed& d : segments_) {
            order.push_back(d.from);
            order.push_back(d.to);
        }
        std::sort(order.begin(), order.end());
        order.erase(std::unique(order.begin(), order.end()), order.end());
        const auto before = [&](std::uint32_t a, std::uint32_t b) {
            return projection.compare(a, b) < 0;
        };
        std::sort(order.begin(), order.end(), before);
        std::vector<Directed> out;
        bool any = false;
        std::vector<std::uint32_t> inner;
        for (const Directed& d : segments_) {
            const bool forward = before(d.from, d.to);
            const std::uint32_t lo = forward ? d.from : d.to;
            const std::uint32_t hi = forward ? d.to : d.from;
            inner.clear();
            const double v_lo = std::min(projection.v(lo), projection.v(hi));
            const double v_hi = std::max(projection.v(lo), projection.v(hi));
            for (auto it = std::upper_bound(order.begin(), order.end(), lo, before);
                 it != order.end() && before(*it, hi); ++it) {
                const double v = projection.v(*it);
                if (v < v_lo || v > v_hi) continue;  // rounding keeps the order
                if (projection.orientation(lo, hi, *it) == 0) inner.push_back(*it);
            }
            if (!forward) std::reverse(inner.begin(), inner.end());
            any = any || !inner.empty();
            std::uint32_t at = d.from;
            for (const std::uint32_t p : inner) {
                out.push_back({at, p});
                at = p;
            }
            out.push_back({at, d.to});
        }
        segments_ = std::move(out);
        return any;
    }

    // Closed walks that use every segment once; which way they go at a point that several pass is
    // left to connected_regions.
    [[nodiscard]] std::vector<IndexLoop> chain() {
        std::sort(segments_.begin(), segments_.end());
        std::vector<std::uint32_t> next(numbers_.points().size() + 1, 0);
        for (const Directed& d : segments_) ++next[d.from + 1];
        for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
        const std::vector<std::uint32_t> begin = next;
        std::vector<IndexLoop> loops;
        for (std::uint32_t p = 0; p + 1 < begin.size(); ++p) {
            while (next[p] < begin[p + 1]) {
                IndexLoop loop;
                std::uint32_t at = p;
                do {
                    TRISECT_EXPECTS(next[at] < begin[at + 1], "a section that does not close");
                    loop.push_back(at);
                    at = segments_[next[at]++].to;
                } while (at != p);
                loops.push_back(std::move(loop));
            }
        }
        return loops;
    }

    [[nodiscard]] SectionLoop finished(const IndexLoop& loop,
                                       const PlaneProjection& projection) const {
        SectionLoop out;
        const Lattice lattice = index_.lattice();
        const std::size_t n = loop.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (projection.orientation(loop[(i + n - 1) % n], loop[i], loop[(i + 1) % n]) == 0)
                continue;
            const Point& p = numbers_.points()[loop[i]];
            out.points.push_back(p);
            std::array<double, 3> c = p.nearest();
            for (double& x : c) x = lattice.to_double(x);
            out.rounded.push_back(c);
        }
        return out;
    }

    const IndexBase& index_;
    const Plane& plane_;
    PointNumbers numbers_;
    std::vector<Directed> segments_;
};

}  // namespace

std::vector<SectionRegion> section(const IndexCore& core, const Plane& plane) {
    if (!plane.is_valid()) throw UsageError("the section of a plane without normal");
    return Sectioner(*core.base, plane).regions();
}

PlaneRelation relation_to(const IndexCore& core, const Plane& plane) {
    if (!plane.is_valid()) throw UsageError("a plane without normal");
    const IndexBase& index = *core.base;
    bool below = false;
    bool on = false;
    bool above = false;
    bool solid_below = false;  // of a half-space bounded by the plane
    const auto note = [&](Side s) {
        (s == Side::Above ? above : s == Side::Below ? below : on) = true;
    };
    const auto note_whole_plane = [&](const PolygonId& id) {
        const Plane support = id.support();
        if (is_same_plane(support, plane)) {
            on = true;
            solid_below = same_orientation(id.outward(), plane);
        } else if (!is_parallel(support, plane)) {
            above = below = true;
        } else {
            // Some point of the support, by its foot below the origin.
            IndexPoint::Rational p;
            ExactRational nn;
            for (int k = 0; k < 3; ++k) {
                const ExactRational x(support.normal(k));
                nn += x * x;
                p[static_cast<std::size_t>(k)] = -x * ExactRational(support.offset());
            }
            for (ExactRational& x : p) x /= nn;
            note(side_from_sign(value_at(p, plane).sign()));
        }
    };
    const auto note_polygon = [&](const PolygonId& id) {
        if (id.is_unbounded() && !id.reaches_out()) {
            note_whole_plane(id);
        } else if (id.reaches_out() || !id.is_triangle()) {
            for (const ConvexPolygon part = id.part(); const Point& c : part.vertices())
                note(trisect::side_of(c, plane));
        } else {
            for (int i = 0; i < 3; ++i) note(trisect::side_of(id.corner(i), plane));
        }
    };
    for_mixed_cells(
        index,
        [&](const DoubleBox& cell) {
            if (above && below) return false;
            const int s = side_of_box(bounded(cell, index), plane);
            return !(s > 0 && above) && !(s < 0 && below);
        },
        [&](const LeafInTree& leaf, const IndexedLeaf::Cell& c, const DoubleBox&) {
            const IndexedLeaf& here = leaf.index();
            for (const IndexedLeaf::Id id : here.listed(here.leaf(c.leaf))) {
                if (above && below) return;
                note_polygon({&here, id, leaf.turned});
            }
        });
    if (above && below) return PlaneRelation::Straddling;
    if (above) return on ? PlaneRelation::TouchingAbove : PlaneRelation::Above;
    if (below) return on ? PlaneRelation::TouchingBelow : PlaneRelation::Below;
    if (!on) return PlaneRelation::Empty;
    return solid_below ? PlaneRelation::TouchingBelow : PlaneRelation::TouchingAbove;
}

}  // namespace trisect::detail
