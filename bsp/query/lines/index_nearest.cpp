// SPDX-License-Identifier: Apache-2.0
//
// Nearest points, by branch and bound in doubles and a decision among the few that are left in
// rationals.
//
// For a convex set C, the hull of corners c_i, and any point q of it, |p - q| bounds the distance
// of p from above, and with g = p - q the smallest g · (p - c_i) / |g| bounds it from below: all of
// C lies behind the plane through the nearest such corner. That holds however q was found, so q
// may come from plain floating-point arithmetic; a bad one only leaves more work to the rationals.
// The same serves polygons, edges (two corners) and corners (one).
//
// Rounding of bounds: q is a combination of the corners with weights that are not negative and sum
// to 1 up to 2^-50; differences and products err relative to the largest difference M of
// coordinates involved, 2^-44 M covers all of it amply.

#include <trisect/bsp/query/lines/index_nearest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <utility>

#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/bsp/query/lines/index_handles.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using Exact = IndexPoint::Rational;

ExactRational squared_distance(const Exact& a, const Exact& b) {
    const Exact d = minus(a, b);
    return dot(d, d);
}

// The nearest point to the origin of the triangle a, b, c, up to rounding: a combination of the
// corners with weights >= 0.
Vector3 nearest_on_segment(const Vector3& a, const Vector3& b) {
    const Vector3 e = minus(b, a);
    const double ee = dot(e, e);
    const double t = ee > 0 ? std::clamp(-dot(a, e) / ee, 0.0, 1.0) : 0.0;
    Vector3 q{};
    for (std::size_t k = 0; k < 3; ++k) q[k] = (1 - t) * a[k] + t * b[k];
    return q;
}

Vector3 between(const Vector3& a, const Vector3& b, double t) {
    return {(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1], (1 - t) * a[2] + t * b[2]};
}

// By the region of a corner, an edge or the middle that the origin is in (Ericson 2005, 5.1.5).
Vector3 nearest_on_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 u = minus(b, a);
    const Vector3 v = minus(c, a);
    const double ua = -dot(u, a);
    const double va = -dot(v, a);
    if (ua <= 0 && va <= 0) return a;
    const double ub = -dot(u, b);
    const double vb = -dot(v, b);
    if (ub >= 0 && vb <= ub) return b;
    const double uc = -dot(u, c);
    const double vc = -dot(v, c);
    if (vc >= 0 && uc <= vc) return c;
    const double of_c = ua * vb - ub * va;
    if (of_c <= 0 && ua > 0 && ub < 0) return between(a, b, ua / (ua - ub));
    const double of_b = uc * va - ua * vc;
    if (of_b <= 0 && va > 0 && vc < 0) return between(a, c, va / (va - vc));
    const double of_a = ub * vc - uc * vb;
    const double from_b = vb - ub;
    const double from_c = uc - vc;
    if (of_a <= 0 && from_b > 0 && from_c > 0) return between(b, c, from_b / (from_b + from_c));
    const double sum = of_a + of_b + of_c;
    if (of_a >= 0 && of_b >= 0 && of_c >= 0 && sum > 0) {
        Vector3 q{};
        for (std::size_t k = 0; k < 3; ++k)
            q[k] = (of_a / sum) * a[k] + (of_b / sum) * b[k] + (of_c / sum) * c[k];
        return q;
    }
    // Rounding made no region of it.
    Vector3 best = nearest_on_segment(a, b);
    for (const Vector3& q : {nearest_on_segment(b, c), nearest_on_segment(c, a)})
        if (dot(q, q) < dot(best, best)) best = q;
    return best;
}

struct Bounds {
    double lo = 0;
    double hi = HUGE_VAL;
};

// Of the distance from the origin to the hull of the corners, which are known within `error`. A
// point of the hull is within `slack` of `nearest`.
struct NearestInHull {
    Bounds bounds;
    Vector3 nearest{};
    double slack = HUGE_VAL;
};

NearestInHull nearest_in_hull(std::span<const Vector3> corners, double error) {
    double m = 0;
    for (const Vector3& c : corners) m = std::max(m, largest_component(c));
    if (!(m < 0x1p500)) return {};
    Vector3 q = corners[0];
    if (corners.size() == 2) q = nearest_on_segment(corners[0], corners[1]);
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const Vector3 r = nearest_on_triangle(corners[0], corners[i - 1], corners[i]);
        if (i == 2 || dot(r, r) < dot(q, q)) q = r;
    }
    const double length = std::sqrt(dot(q, q));
    const double slack = m * 0x1p-44 + 4 * error;
    Bounds b{0, length + slack};
    if (length > 4 * slack) {
        double least = HUGE_VAL;
        for (const Vector3& c : corners) least = std::min(least, dot(q, c));
        // |g| is within slack of exact; so is each g · c / |g| times a few.
        b.lo = std::max(0.0, least / length - 8 * slack * (1 + m / length));
    }
    return {b, q, slack};
}

Bounds bounds_of(std::span<const Vector3> corners, double error) {
    return nearest_in_hull(corners, error).bounds;
}

// A convex polygon with its corners.
struct ExactPolygon {
    Plane support;
    std::vector<Plane> edges;
    std::vector<Exact> corners;
};

ExactPolygon exact_polygon(const ConvexPolygon& part) {
    ExactPolygon out{part.support(), {part.edges().begin(), part.edges().end()}, {}};
    if (!part.is_empty())
        for (const Point& p : part.vertices()) out.corners.push_back(IndexPoint(p).rational());
    return out;
}

// Something that may hold the nearest point: a polygon, an edge or a corner.
struct Feature {
    PolygonId polygon;
    std::int32_t edge = -1;
    std::int32_t corner = -1;
    Bounds bounds;
};

// What of a triangle is nearest to the origin.
struct NearestPart {
    enum class Kind : std::uint8_t { Unsure, Corner, Edge, Face };
    Kind kind = Kind::Unsure;
    std::size_t number = 0;  // of the corner, or of the edge from there to the next one
};

// Corners are within 2^-52 M + error, M their largest coordinate. Ways along edges, products of two
// differences below 2 M and M, err by less than 2^-46 M^2 + 16 M error; the sides of edges,
// products of four such, by less than 2^-41 M^4 + 2^8 M^3 error.
NearestPart surely_nearest(const std::array<Vector3, 3>& c, double error) {
    double m = 0;
    for (const Vector3& v : c) m = std::max(m, largest_component(v));
    if (!(m < 0x1p200)) return {};
    const double way_bound = 0x1p-46 * m * m + 16 * m * error;
    const double side_bound = 0x1p-41 * m * m * m * m + 0x1p8 * m * m * m * error;
    std::array<Vector3, 3> edge{};
    for (std::size_t i = 0; i < 3; ++i) edge[i] = minus(c[(i + 1) % 3], c[i]);
    const Vector3& u = edge[0];
    const Vector3& v = edge[1];
    const Vector3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]};
    unsigned inside = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3& e = edge[i];
        const double from_start = -dot(e, c[i]);
        const double from_end = dot(e, c[(i + 1) % 3]);
        // Neither edge leads from the corner to what is nearer.
        if (from_start < -way_bound && dot(edge[(i + 2) % 3], c[i]) < -way_bound)
            return {NearestPart::Kind::Corner, i};
        const Vector3 out{e[1] * n[2] - e[2] * n[1], e[2] * n[0] - e[0] * n[2],
                          e[0] * n[1] - e[1] * n[0]};
        const double side = -dot(out, c[i]);
        if (side > side_bound && from_start > way_bound && from_end > way_bound)
            return {NearestPart::Kind::Edge, i};
        if (side < -side_bound) ++inside;
    }
    return inside == 3 ? NearestPart{NearestPart::Kind::Face, 0} : NearestPart{};
}

// Polygons count for what is of them in their leaf's cell. One that reaches out of it is taken
// whole as long as the nearest point of the whole is in the cell, and clipped exactly otherwise, if
// the nearest point of all can be a matter of that.
class NearestSearch {
public:
    NearestSearch(const IndexCore& core, const IndexPoint& point, NearestKind kind)
        : core_(core), index_(*core.base), p_(point), kind_(kind) {
        for (std::size_t k = 0; k < 3; ++k)
            reach_ = std::max({reach_, -index_.lo()[k], index_.hi()[k]});
    }

    [[nodiscard]] std::optional<Nearest> run() {
        walk();
        // Of equal ones those first that are sure.
        std::sort(features_.begin(), features_.end(), [](const Feature& a, const Feature& b) {
            return a.bounds.lo != b.bounds.lo ? a.bounds.lo < b.bounds.lo
                                              : a.bounds.hi < b.bounds.hi;
        });
        for (const Feature& f : features_) {
            if (f.bounds.lo > limit_) break;
            decide(f);
        }
        for (const Feature& f : doubtful_)
            if (f.bounds.lo <= limit_) decide_border(f.polygon);
        if (!found_) return std::nullopt;
        return finished();
    }

    // The distance in doubles only.
    [[nodiscard]] std::optional<NearestBounds> run_in_doubles() {
        only_bounds_ = true;
        walk();
        for (const Feature& f : doubtful_)
            if (f.bounds.lo < least_ && f.bounds.lo <= limit_) offer_part(f.polygon);
        if (!best_.is_valid()) return std::nullopt;
        const int e = index_.lattice().exponent;
        return NearestBounds{best_.face_source(), std::ldexp(std::min(least_, limit_), e),
                             std::ldexp(limit_, e)};
    }

private:
    struct Pending {
        const CellNode* node = nullptr;
        bool turned = false;
        Cell cell;
        double distance = 0;
    };

    // The distance from the point to what is listed in a cell, rounded down a little.
    [[nodiscard]] double distance_to(const DoubleBox& cell, const CellNode& node) const {
        const Box& box = bounds_of(node);
        if (box.is_empty()) return HUGE_VAL;
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double lo = std::max(cell.lo[k], static_cast<double>(box.lo[k] - 1));
            const double hi = std::min(cell.hi[k], static_cast<double>(box.hi[k] + 1));
            const double d = std::max({0.0, lo - p_[k], p_[k] - hi});
            sum += d * d;
        }
        const double d = std::sqrt(sum) * (1 - 0x1p-48) - 2 * p_.error();
        return d > 0 ? d : 0;  // also for what is no number
    }

    struct NearCell {
        double squared = 0;
        std::array<std::uint32_t, 3> at{};
    };

    // Squared distances from the point to the slabs of a block along an axis.
    void slab_distances(const DoubleBox& whole, const IndexBlock& block, std::size_t k,
                        std::span<double> out) const {
        for (std::uint32_t i = 0; i < block.n[k]; ++i) {
            const double lo = i == 0 ? whole.lo[k] : block.splitter(k, i);
            const double hi = i + 1 == block.n[k] ? whole.hi[k] : block.splitter(k, i + 1);
            const double d = std::max(
                {0.0, std::max(lo, index_.lo()[k]) - p_[k], p_[k] - std::min(hi, index_.hi()[k])});
            out[i] = d * d;
        }
    }
    // Whether what is so far away, squared and up to rounding, cannot be the nearest.
    [[nodiscard]] bool is_beyond(double squared) const {
        const double limit = (limit_ + 2 * p_.error()) * (1 + 0x1p-44);
        return squared > limit * limit;
    }

    void walk() {
        std::vector<Pending> pending{
            {index_.root().node.get(), index_.root().complemented, Cell{}, 0}};
        while (!pending.empty()) {
            const Pending at = pending.back();
            pending.pop_back();
            if (at.distance > limit_) continue;
            const CellNode& n = refined(*at.node);
            if (n.is_leaf()) {
                if (n.size() != 0) visit_tree_leaf(listed_leaf(n, at.cell), at.turned, at.cell);
                continue;
            }
            const auto child = [&](int i) {
                const CellRef& c = n.child(i);
                Pending out{c.node.get(), at.turned != c.complemented,
                            i == 0 ? at.cell.below(n.axis(), n.splitter())
                                   : at.cell.above(n.axis(), n.splitter()),
                            0};
                out.distance = distance_to(box_of(out.cell), *out.node);
                return out;
            };
            Pending near = child(0);
            Pending far = child(1);
            if (far.distance < near.distance ||
                (far.distance == near.distance &&
                 p_[static_cast<std::size_t>(n.axis())] > rounded_position(n.splitter())))
                std::swap(near, far);
            pending.push_back(far);
            pending.push_back(near);
        }
    }

    void visit_tree_leaf(const IndexedLeaf& leaf, bool turned, const Cell& cell) {
        leaf_ = &leaf;
        turned_ = turned;
        box_ = box_of(cell);
        recent_.fill(IndexPolygons::none);
        // Few polygons are looked at faster than they are divided.
        constexpr std::uint32_t few = 1024;
        if (!leaf.is_divided() && leaf.polygons().size() <= few) {
            for (IndexedLeaf::Id id = 0; id < leaf.polygons().size(); ++id) visit(id);
        } else if (leaf.divided().grid() != nullptr) {
            walk_grid(*leaf.grid(), box_);
        } else if (leaf.polygons().size() != 0) {
            visit_leaf(0);
        }
    }

    void visit_leaf(std::uint32_t leaf) {
        const auto listed = leaf_->listed(leaf_->leaf(leaf));
        if (const Source* source = leaf_->polygons().only_source()) {
            for (const IndexedLeaf::Id id : listed)
                for (int i = 0; i < 3; ++i) __builtin_prefetch(&source->corner(id, i));
        }
        for (const IndexedLeaf::Id id : listed) visit(id);
    }

    // What is in a cell of a grid: of a brick the near cells first.
    void walk_slot(const IndexGrid& g, std::uint32_t slot, const std::array<std::uint32_t, 3>& low,
                   int level, const DoubleBox& whole) {
        if (IndexSlot::is_empty(slot)) return;
        if (!IndexSlot::is_brick(slot)) {
            visit_leaf(slot);
            return;
        }
        const IndexBrick& brick = leaf_->brick(slot);
        const IndexBlock block = g.brick(low, level);
        struct Near {
            double squared = 0;
            unsigned bit = 0;
        };
        std::array<std::array<double, 4>, 3> slab{};
        for (std::size_t k = 0; k < 3; ++k) slab_distances(whole, block, k, slab[k]);
        std::array<Near, 64> near;
        std::size_t count = 0;
        for (std::uint64_t left = brick.mixed; left != 0; left &= left - 1) {
            const auto bit = static_cast<unsigned>(std::countr_zero(left));
            const double d = slab[0][bit & 3U] + slab[1][bit >> 2U & 3U] + slab[2][bit >> 4U];
            if (!is_beyond(d)) near[count++] = {d, bit};
        }
        std::sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count),
                  [](const Near& a, const Near& b) { return a.squared < b.squared; });
        const unsigned shift = 2U * static_cast<unsigned>(level - 1);
        for (std::size_t i = 0; i < count && !is_beyond(near[i].squared); ++i) {
            const unsigned bit = near[i].bit;
            const std::array at{bit & 3U, bit >> 2U & 3U, bit >> 4U};
            walk_slot(
                g, leaf_->slot(brick.slot(bit)),
                {low[0] + (at[0] << shift), low[1] + (at[1] << shift), low[2] + (at[2] << shift)},
                level - 1, block_cell(whole, block, at[0], at[1], at[2]));
        }
    }

    // Shell by shell around the cell that the point is in or next to. A shell of number r is at
    // least r - 2 cells away (one for rounding).
    void walk_grid(const IndexGrid& g, const DoubleBox& whole) {
        const IndexBlock block = g.block();
        const double least = std::min({block.size[0], block.size[1], block.size[2]});
        std::array<std::int64_t, 3> middle{};
        std::int64_t last = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = block.clamped(k, p_[k]);
            last = std::max<std::int64_t>(
                {last, middle[k], static_cast<std::int64_t>(g.n[k]) - 1 - middle[k]});
        }
        const auto range = [&](std::size_t k, std::int64_t r) {
            return std::pair{std::max<std::int64_t>(0, middle[k] - r),
                             std::min<std::int64_t>(g.n[k] - 1, middle[k] + r)};
        };
        std::array<std::vector<double>, 3>& slab = slabs_;
        for (std::size_t k = 0; k < 3; ++k) {
            slab[k].resize(g.n[k]);
            slab_distances(whole, block, k, slab[k]);
        }
        const auto number = [](std::int64_t i) { return static_cast<std::uint32_t>(i); };
        const auto squared = [&](std::size_t k, std::int64_t i) {
            return slab[k][static_cast<std::size_t>(i)];
        };
        // Of a shell the near cells first. Most are empty, and that is one look.
        std::vector<NearCell>& shell = shell_;
        const auto note = [&](std::int64_t x, std::int64_t y, std::int64_t z, double row) {
            if (leaf_->is_empty(g.cell(number(x), number(y), number(z)))) return;
            const double d = row + squared(0, x);
            if (!is_beyond(d)) shell.push_back({d, {number(x), number(y), number(z)}});
        };
        const auto walk_cell = [&](const std::array<std::uint32_t, 3>& at) {
            const unsigned shift = g.shift();
            walk_slot(g, leaf_->grid_slot(g.cell(at[0], at[1], at[2])),
                      {at[0] << shift, at[1] << shift, at[2] << shift}, g.levels,
                      block_cell(whole, block, at[0], at[1], at[2]));
        };
        for (std::int64_t r = 0; r <= last; ++r) {
            if (static_cast<double>(r - 2) * least > limit_) return;
            shell.clear();
            const auto [z0, z1] = range(2, r);
            const auto [y0, y1] = range(1, r);
            const auto [x0, x1] = range(0, r);
            for (std::int64_t z = z0; z <= z1; ++z) {
                if (is_beyond(squared(2, z))) continue;
                for (std::int64_t y = y0; y <= y1; ++y) {
                    const double row = squared(2, z) + squared(1, y);
                    if (is_beyond(row)) continue;
                    const bool face = std::abs(z - middle[2]) == r || std::abs(y - middle[1]) == r;
                    if (face) {
                        for (std::int64_t x = x0; x <= x1; ++x) note(x, y, z, row);
                        continue;
                    }
                    if (middle[0] - r >= 0) note(middle[0] - r, y, z, row);
                    if (r != 0 && middle[0] + r < static_cast<std::int64_t>(g.n[0]))
                        note(middle[0] + r, y, z, row);
                }
            }
            std::sort(shell.begin(), shell.end(),
                      [](const NearCell& a, const NearCell& b) { return a.squared < b.squared; });
            for (const NearCell& near : shell) {
                if (is_beyond(near.squared)) break;
                walk_cell(near.at);
            }
        }
    }

    [[nodiscard]] std::array<Vector3, 3> relative_triangle(const PolygonId& id) const {
        std::array<Vector3, 3> out{};
        for (int i = 0; i < 3; ++i)
            out[static_cast<std::size_t>(i)] = minus(id.corner(i).doubles(), p_.approximate());
        return out;
    }

    [[nodiscard]] std::vector<Vector3> relative(std::span<const Point> corners,
                                                double& error) const {
        std::vector<Vector3> out;
        error = p_.error();
        for (const Point& c : corners) {
            out.push_back(minus(c.approximation().c, p_.approximate()));
            error = std::max(error, p_.error() + c.approximation().error);
        }
        return out;
    }

    [[nodiscard]] std::vector<Vector3> relative_corners(const PolygonId& id, double& error) const {
        error = p_.error();
        if (id.is_triangle()) {
            const auto c = relative_triangle(id);
            return {c.begin(), c.end()};
        }
        std::vector<Vector3> out;
        for (const Approximation& a : id.all().approximate_corners(id.number)) {
            // Nearly parallel planes: with more effort they are known better.
            if (a.error > 0x1p-42 * reach_) return relative(id.all().corners(id.number), error);
            out.push_back(minus(a.c, p_.approximate()));
            error = std::max(error, p_.error() + a.error);
        }
        return out;
    }

    // Whether a point is surely in the leaf's cell, with all that is within `slack` of it.
    [[nodiscard]] bool is_in_cell(const Vector3& relative, double slack) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = p_[k] + relative[k];
            const double e = slack + p_.error() + (std::fabs(p_[k]) + std::fabs(x)) * 0x1p-50;
            if (!(x - e > box_.lo[k] * (box_.lo[k] > 0 ? slightly_more : slightly_less)) ||
                !(x + e < box_.hi[k] * (box_.hi[k] > 0 ? slightly_less : slightly_more)))
                return false;
        }
        return true;
    }

    // Whether the box of corners is surely farther than what is known.
    [[nodiscard]] bool is_box_beyond(std::span<const Vector3> corners, double error) const {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            double lo = HUGE_VAL;
            double hi = -HUGE_VAL;
            for (const Vector3& c : corners) {
                lo = std::min(lo, c[k]);
                hi = std::max(hi, c[k]);
            }
            const double d = std::max(std::max(lo, -hi) - error, 0.0);
            sum += d * d;
        }
        return is_beyond(sum);
    }

    void visit(IndexedLeaf::Id number) {
        const PolygonId id{leaf_, number, turned_};
        if (id.is_unbounded()) {
            if (kind_ == NearestKind::Boundary) offer({id, -1, -1, {}});
            return;
        }
        if (kind_ == NearestKind::Boundary) {
            // Neighbouring cells list the same polygons.
            IndexedLeaf::Id& recent = recent_[number % recent_.size()];
            if (recent == number) return;
            recent = number;
            if (id.is_triangle()) {
                const std::array<Vector3, 3> c = relative_triangle(id);
                if (!is_box_beyond(c, 0)) offer_polygon(id, c, p_.error());
                return;
            }
        }
        double error = 0;
        const std::vector<Vector3> c = relative_corners(id, error);
        if (kind_ == NearestKind::Boundary) {
            if (!is_box_beyond(c, error)) offer_polygon(id, c, error);
            return;
        }
        // What of these is no edge or vertex of the set is found out when it is decided.
        for (std::size_t i = 0; i < c.size(); ++i) {
            const auto corner = static_cast<std::int32_t>(i);
            offer({id, -1, corner, bounds_of(std::span(c).subspan(i, 1), error)});
            if (kind_ != NearestKind::Edge) continue;
            const std::array<Vector3, 2> ends{c[i], c[(i + 1) % c.size()]};
            offer({id, corner, -1, bounds_of(ends, error)});
        }
        if (kind_ == NearestKind::Edge && id.reaches_out())
            doubtful_.push_back({id, -1, -1, bounds_of(c, error)});
    }

    void offer_polygon(const PolygonId& id, std::span<const Vector3> corners, double error) {
        const NearestInHull n = nearest_in_hull(corners, error);
        if (!id.reaches_out() || is_in_cell(n.nearest, n.slack)) {
            offer({id, -1, -1, n.bounds});
        } else if (n.bounds.lo <= limit_) {
            // Its nearest point may be one that something has cut away beyond the cell.
            (only_bounds_ ? doubtful_ : features_).push_back({id, -1, -1, {n.bounds.lo, HUGE_VAL}});
        }
    }

    // What of a polygon is in its cell.
    void offer_part(const PolygonId& id) {
        const ConvexPolygon part = id.part();
        if (part.is_empty()) return;
        double error = 0;
        const std::vector<Vector3> c = relative(part.vertices(), error);
        offer({id, -1, -1, bounds_of(c, error)});
    }

    void offer(const Feature& f) {
        if (f.bounds.lo > limit_) return;
        if (only_bounds_) {
            least_ = std::min(least_, f.bounds.lo);
            // Of equal ones the first by name, in whatever order they come.
            if (f.bounds.hi < limit_ || !best_.is_valid() ||
                (f.bounds.hi == limit_ && f.polygon.name() < best_.name()))
                best_ = f.polygon;
        }
        if (kind_ == NearestKind::Boundary) {
            limit_ = std::min(limit_, f.bounds.hi);
        } else if (f.bounds.hi < limit_) {
            // Only what is an edge or vertex of the set limits the search.
            decide(f);
            return;
        }
        if (!only_bounds_) features_.push_back(f);
    }

    // The exact point of a feature, and whether it is the best so far.
    void decide(const Feature& f) {
        const PolygonId& id = f.polygon;
        Exact q = nearest_of(f);
        ExactRational d = squared_distance(q, p_.rational());
        if (kind_ == NearestKind::Boundary && id.reaches_out() && !is_of_cell(id, q)) {
            // All else of it is farther.
            if (found_ && (d <=> squared_) >= 0) return;
            const ExactPolygon part = exact_polygon(id.part());
            if (part.corners.empty()) return;
            q = nearest_on(part);
            d = squared_distance(q, p_.rational());
        }
        consider(std::move(q), std::move(d), id);
    }

    // Of a polygon that counts to the border of its cell: the edges there.
    void decide_border(const PolygonId& id) {
        const ExactPolygon part = exact_polygon(id.part());
        for (std::size_t i = 0; i < part.corners.size(); ++i) {
            Exact q = nearest_on_edge(part.corners, i);
            ExactRational d = squared_distance(q, p_.rational());
            consider(std::move(q), std::move(d), id);
        }
    }

    void consider(Exact q, ExactRational d, const PolygonId& id) {
        if (found_) {
            const auto order = d <=> squared_;
            if (order > 0) return;
            if (order == 0 && !(q < q_) && !(q == q_)) return;
            if (order == 0 && q == q_) {
                on_.push_back(id);
                return;
            }
        }
        if (kind_ != NearestKind::Boundary) {
            std::vector<PolygonId> on;
            const IndexPoint at{Exact(q)};
            Location l = locate_polygons(index_, at, on);
            if (l == Location::OnFace) l = place_on(on).location;
            if (l != Location::OnVertex && (kind_ != NearestKind::Edge || l != Location::OnEdge))
                return;
        }
        found_ = true;
        q_ = std::move(q);
        squared_ = std::move(d);
        on_.assign(1, id);
        const double root = std::sqrt(squared_.to_double());
        limit_ = std::min(limit_, root * slightly_more + 0x1p-500);
    }

    // Whether a point of a polygon is one of its part in its leaf's cell.
    [[nodiscard]] static bool is_of_cell(const PolygonId& id, const Exact& q) {
        const IndexPoint p{Exact(q)};
        const Cell& cell = id.all().cell();
        bool on_wall = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const int above = cell.lo[k] > -universe_limit ? p.compare_fine(k, cell.lo[k]) : 1;
            const int below = cell.hi[k] < universe_limit ? p.compare_fine(k, cell.hi[k]) : -1;
            if (above < 0 || below > 0) return false;
            on_wall = on_wall || above == 0 || below == 0;
        }
        return !on_wall || id.enters();
    }

    [[nodiscard]] Exact nearest_on_edge(const std::vector<Exact>& c, std::size_t i) const {
        const Exact& a = c[i];
        const Exact e = minus(c[(i + 1) % c.size()], a);
        ExactRational t = dot(minus(p_.rational(), a), e) / dot(e, e);
        if (t.sign() < 0) t = ExactRational();
        if (t > ExactRational(1)) t = ExactRational(1);
        return {a[0] + t * e[0], a[1] + t * e[1], a[2] + t * e[2]};
    }

    // The foot of the perpendicular to a plane.
    [[nodiscard]] Exact foot_on(const Plane& plane) const {
        Exact n;
        for (int k = 0; k < 3; ++k) n[static_cast<std::size_t>(k)] = ExactRational(plane.normal(k));
        const ExactRational t = value_at(p_.rational(), plane) / dot(n, n);
        Exact foot = p_.rational();
        for (std::size_t k = 0; k < 3; ++k) foot[k] -= t * n[k];
        return foot;
    }

    // The foot if it is in the polygon; else some edge has the nearest point.
    [[nodiscard]] Exact nearest_on(const ExactPolygon& polygon) const {
        Exact foot = foot_on(polygon.support);
        if (std::all_of(polygon.edges.begin(), polygon.edges.end(),
                        [&](const Plane& e) { return value_at(foot, e).sign() <= 0; }))
            return foot;
        Exact best = nearest_on_edge(polygon.corners, 0);
        ExactRational least = squared_distance(best, p_.rational());
        for (std::size_t i = 1; i < polygon.corners.size(); ++i) {
            Exact q = nearest_on_edge(polygon.corners, i);
            ExactRational d = squared_distance(q, p_.rational());
            if (d < least) {
                least = std::move(d);
                best = std::move(q);
            }
        }
        return best;
    }

    [[nodiscard]] Exact nearest_of(const Feature& f) const {
        const PolygonId& id = f.polygon;
        std::vector<Point> corners;
        if (!id.is_unbounded()) corners = id.all().corners(id.number);
        if (f.corner >= 0)
            return IndexPoint(corners[static_cast<std::size_t>(f.corner)]).rational();
        ExactPolygon polygon;
        for (const Point& p : corners) polygon.corners.push_back(IndexPoint(p).rational());
        if (f.edge >= 0) return nearest_on_edge(polygon.corners, static_cast<std::size_t>(f.edge));
        const NearestPart part =
            id.is_triangle() ? surely_nearest(relative_triangle(id), p_.error()) : NearestPart{};
        if (part.kind == NearestPart::Kind::Corner) return polygon.corners[part.number];
        if (part.kind == NearestPart::Kind::Edge)
            return nearest_on_edge(polygon.corners, part.number);
        polygon.support = id.support();
        if (part.kind == NearestPart::Kind::Face) return foot_on(polygon.support);
        polygon.edges = id.all().edges(id.number);
        return nearest_on(polygon);
    }

    [[nodiscard]] Nearest finished() {
        const IndexPoint at{Exact(q_)};
        if (kind_ != NearestKind::Boundary) (void)locate_polygons(index_, at, on_);
        sort_unique(on_);
        Nearest out;
        out.place = place_on(on_, at);
        if (core_.handles) core_.handles->name(core_, out.place, on_, at);
        const int e = index_.lattice().exponent;
        for (std::size_t k = 0; k < 3; ++k) out.point[k] = q_[k].scaled(e);
        out.squared_distance = squared_.scaled(2 * e);
        out.squared_rounded = out.squared_distance.to_double();
        out.distance = nearest_root(out.squared_distance);
        return out;
    }

    const IndexCore& core_;
    const IndexBase& index_;
    const IndexPoint& p_;
    NearestKind kind_;
    double reach_ = 0;         // the largest coordinate
    double limit_ = HUGE_VAL;  // nothing beyond can be the nearest
    std::vector<Feature> features_;
    std::vector<Feature> doubtful_;  // that what is of them in their cells may be needed of
    std::array<std::vector<double>, 3> slabs_;
    std::vector<NearCell> shell_;
    bool only_bounds_ = false;
    double least_ = HUGE_VAL;
    PolygonId best_;
    // The leaf of the cell tree that is visited.
    const IndexedLeaf* leaf_ = nullptr;
    bool turned_ = false;
    DoubleBox box_;
    std::array<IndexedLeaf::Id, 256> recent_{};
    bool found_ = false;
    Exact q_;
    ExactRational squared_;
    std::vector<PolygonId> on_;
};

}  // namespace

double nearest_root(const ExactRational& square) {
    const double s = square.to_double();
    double r = std::sqrt(s);
    if (!std::isfinite(r) || s < 0x1p-900) return r;
    // Compare with the middles between r and its neighbours; sqrt of the rounded square is at most
    // one step off.
    const auto middle = [](double a, double b) {
        return (ExactRational::from_double(a) + ExactRational::from_double(b)) / ExactRational(2);
    };
    const auto even = [](double v) {
        int e = 0;
        return std::fmod(std::ldexp(std::frexp(v, &e), 53), 2.0) == 0;
    };
    const double up = std::nextafter(r, HUGE_VAL);
    const ExactRational high = middle(r, up);
    const auto above = square <=> high * high;
    if (above > 0 || (above == 0 && even(up))) return up;
    const double down = std::nextafter(r, 0.0);
    const ExactRational low = middle(down, r);
    const auto below = square <=> low * low;
    if (below < 0 || (below == 0 && even(down))) return down;
    return r;
}

std::optional<NearestBounds> distance(const IndexCore& core, const IndexPoint& point) {
    return NearestSearch(core, point, NearestKind::Boundary).run_in_doubles();
}

std::optional<Nearest> nearest(const IndexCore& core, const IndexPoint& point, NearestKind kind) {
    return NearestSearch(core, point, kind).run();
}

}  // namespace trisect::detail
