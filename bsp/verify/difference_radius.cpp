// SPDX-License-Identifier: Apache-2.0
//
// Branch and bound with convex hulls. The distance from a convex set is a convex function, so over
// a piece it is largest at a vertex of the piece: a piece all of whose vertices are near one
// triangle is near that triangle. A piece that turns around an edge of the surface is near no
// single triangle and is cut, preferably by the plane that halves the angle at that edge, where one
// cut is enough. Boxes, which most computations of Hausdorff distances use, would have to be as
// small as the radius along every such edge.
//
// All cuts are booleans with half-spaces, so pieces are exact and nothing is lost between them.
// Which plane cuts is a matter of taste and decided in doubles.
#include <trisect/bsp/verify/difference_radius.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/infinity.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail {

namespace {

/// How much larger than the lower bound the upper bound may be.
constexpr double looseness = 1.5;
/// And by how much beyond that: cuts are planes through lattice points, which miss an edge between
/// other points by up to a unit or two.
constexpr double cut_error = 3;
/// Boxes that one component is cut to, each of which costs a boolean of the whole difference.
constexpr std::size_t most_boxes = 64;
/// Triangles tried for one piece.
constexpr std::size_t candidate_limit = 48;

Vector3 to_vector(const GridPoint& p) {
    Vector3 out{};
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = std::ldexp(WideInt<2>(p[k]).to_double(), -grid_bits);
    return out;
}
Vector3 scaled_to(const Vector3& a, double length) {
    const double l = std::sqrt(dot(a, a));
    if (l == 0) return a;
    return {a[0] * length / l, a[1] * length / l, a[2] * length / l};
}

std::optional<LatticePoint> nearest_lattice_point(const Vector3& v) {
    std::array<std::int64_t, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::fabs(v[k]) < static_cast<double>(coordinate_limit) - 1)) return std::nullopt;
        c[k] = std::llround(v[k]);
    }
    return LatticePoint{c[0], c[1], c[2]};
}

/// A connected part of a piece: its vertices.
struct Component {
    std::vector<VertexId> ids;
    std::vector<GridPoint> points;

    [[nodiscard]] GridPoint middle() const {
        GridPoint sum{};
        for (const GridPoint& p : points)
            for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
        for (std::size_t k = 0; k < 3; ++k) sum[k] /= static_cast<std::int64_t>(points.size());
        return sum;
    }
};

/// How near a component is to one triangle of a surface.
struct Closeness {
    double radius = infinity;
    std::uint32_t triangle = 0;
    std::size_t worst = 0;  ///< which of the component's vertices is farthest from it
};

class DifferencePiece {
public:
    explicit DifferencePiece(Solid solid)
        : solid_(std::move(solid)), brep_(std::make_shared<Brep>(solid_.to_brep())) {
        grid_.reserve(brep_->counts().vertices);
        for (const VertexId v : brep_->vertices()) grid_.push_back(to_grid(brep_->point(v)));
    }

    [[nodiscard]] const Solid& solid() const { return solid_; }
    [[nodiscard]] const std::shared_ptr<const Brep>& brep() const { return brep_; }
    [[nodiscard]] const GridPoint& grid(VertexId v) const { return grid_[v.index]; }

    /// One for each outer shell: cavities lie in the hull of what is around them.
    [[nodiscard]] std::vector<Component> components() const {
        std::vector<Component> out;
        for (const ShellId s : brep_->shells()) {
            if (sign_of_volume(*brep_, s) < 0) continue;
            Component c;
            for (const FaceId f : brep_->faces(s))
                for (const HalfedgeId h : brep_->halfedges(brep_->outer_loop(f)))
                    c.ids.push_back(brep_->origin(h));
            std::sort(c.ids.begin(), c.ids.end());
            c.ids.erase(std::unique(c.ids.begin(), c.ids.end()), c.ids.end());
            for (const VertexId v : c.ids) c.points.push_back(grid(v));
            out.push_back(std::move(c));
        }
        return out;
    }

private:
    Solid solid_;
    std::shared_ptr<const Brep> brep_;
    std::vector<GridPoint> grid_;
};

Closeness closeness_to(const GridTriangle& t, std::uint32_t number, const Component& c,
                       double enough) {
    Closeness out{0, number, 0};
    for (std::size_t i = 0; i < c.points.size(); ++i) {
        const double d = t.upper_distance(c.points[i], enough);
        if (d <= out.radius) continue;
        out.radius = d;
        out.worst = i;
        if (d > enough) break;
    }
    return out;
}

/// The best of the triangles that come into question; stops at the first that is within `target`.
Closeness closest(const GridTriangles& surface, const Component& c, double target) {
    std::vector<std::uint32_t> candidates{surface.nearest(c.middle()).triangle};
    const std::size_t step = std::max<std::size_t>(1, c.points.size() / 8);
    for (std::size_t i = 0; i < c.points.size(); i += step)
        surface.near(c.points[i], target, candidates.size() + 12, candidates);
    if (candidates.size() > candidate_limit) candidates.resize(candidate_limit);
    Closeness best;
    for (const std::uint32_t t : candidates) {
        const Closeness found = closeness_to(surface[t], t, c, best.radius);
        if (found.radius < best.radius) best = found;
        if (best.radius <= target) break;
    }
    return best;
}

/// Planes that may part a component, the most promising first.
class CuttingPlanes {
public:
    CuttingPlanes(const Component& component, const DifferencePiece& piece)
        : component_(component), piece_(piece) {}

    /// Along an edge of the surface: the one beyond which the component goes on if it is known, or
    /// of all edges between two triangles that vertices of the component are nearest to, the one
    /// that separates it best; or else beside the triangle that the component is nearest to.
    /// Nothing when no such plane leaves more than `margin` on both sides.
    [[nodiscard]] std::optional<Plane> along(const GridTriangles& surface, const Closeness& close,
                                             double margin) const {
        const std::vector<std::uint32_t> triangles = triangles_at(surface, close);
        // The nearest triangle, and the one that is nearest to where it is farthest.
        const auto first = between(surface[triangles[0]], surface[triangles[1]]);
        if (first && first->depth > margin) return first->plane;
        std::optional<Plane> best;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t k = i + 1; k < triangles.size(); ++k) {
                const auto cut = between(surface[triangles[i]], surface[triangles[k]]);
                if (!cut || cut->depth <= margin) continue;
                margin = cut->depth;
                best = cut->plane;
            }
        }
        if (best) return best;
        return beside(surface[close.triangle], component_.points[close.worst], margin);
    }

    /// Across the longest extent.
    [[nodiscard]] std::optional<Plane> across() const {
        GridPoint low = component_.points.front();
        GridPoint high = low;
        for (const GridPoint& p : component_.points) {
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
        // Multiples of 1/128: the position fits 64 bits, and splitting planes are at thirds.
        constexpr int fine_bits = 7;
        const Int128 middle = (low[axis] + high[axis]) / 2;
        const auto position = static_cast<std::int64_t>(middle >> (grid_bits - fine_bits));
        const Plane plane =
            Plane::axis_aligned(static_cast<int>(axis), std::int64_t{1} << fine_bits, position);
        if (parts(plane)) return plane;
        return std::nullopt;
    }

private:
    /// A plane and how far the component reaches to both sides of it, the lesser of the two.
    struct Cut {
        Plane plane;
        double depth = 0;
    };

    [[nodiscard]] std::vector<std::uint32_t> triangles_at(const GridTriangles& surface,
                                                          const Closeness& close) const {
        constexpr std::size_t most = 16;
        std::vector<std::uint32_t> out{close.triangle,
                                       surface.nearest(component_.points[close.worst]).triangle};
        for (const GridPoint& p : component_.points) {
            if (out.size() >= most) break;
            const std::uint32_t t = surface.nearest(p).triangle;
            if (std::find(out.begin(), out.end(), t) == out.end()) out.push_back(t);
        }
        return out;
    }

    /// Through the edge that two triangles share, if they do.
    [[nodiscard]] std::optional<Cut> between(const GridTriangle& s, const GridTriangle& t) const {
        const auto& c = s.corners();
        for (std::size_t i = 0; i < 3; ++i) {
            const GridPoint& a = c[i];
            const GridPoint& b = c[(i + 1) % 3];
            if (!has_corner(t, a) || !has_corner(t, b) || has_corner(t, c[(i + 2) % 3])) continue;
            const auto plane = halving(s, t, a, b);
            if (!plane || !parts(*plane)) return std::nullopt;
            return Cut{*plane, depth(*plane, to_vector(a))};
        }
        return std::nullopt;
    }

    /// \pre the point is on the plane
    [[nodiscard]] double depth(const Plane& plane, const Vector3& on) const {
        const Vector3 n =
            scaled_to({plane.approx_normal(0), plane.approx_normal(1), plane.approx_normal(2)}, 1);
        double above = 0;
        double below = 0;
        for (const GridPoint& p : component_.points) {
            const double height = dot(minus(to_vector(p), on), n);
            above = std::max(above, height);
            below = std::max(below, -height);
        }
        return std::min(above, below);
    }

    static bool has_corner(const GridTriangle& t, const GridPoint& p) {
        return std::find(t.corners().begin(), t.corners().end(), p) != t.corners().end();
    }
    static Vector3 normal_of(const GridTriangle& t) {
        const Vector3 a = to_vector(t.corners()[0]);
        return cross(minus(to_vector(t.corners()[1]), a), minus(to_vector(t.corners()[2]), a));
    }

    /// Through the common edge, between the two triangles.
    static std::optional<Plane> halving(const GridTriangle& s, const GridTriangle& t,
                                        const GridPoint& a, const GridPoint& b) {
        const Vector3 from = to_vector(a);
        const Vector3 edge = minus(to_vector(b), from);
        const double length = std::sqrt(dot(edge, edge));
        const Vector3 n = scaled_to(normal_of(s), 1);
        const Vector3 m = scaled_to(normal_of(t), 1);
        const Vector3 up = scaled_to({n[0] + m[0], n[1] + m[1], n[2] + m[2]}, length);
        const auto p = nearest_lattice_point(from);
        const auto q = nearest_lattice_point(to_vector(b));
        const auto r = nearest_lattice_point({from[0] + up[0], from[1] + up[1], from[2] + up[2]});
        if (!p || !q || !r || are_collinear(*p, *q, *r)) return std::nullopt;
        return Plane::through(*p, *q, *r);
    }

    /// Through the edge beyond which the point is farthest, steep to the triangle.
    [[nodiscard]] std::optional<Plane> beside(const GridTriangle& t, const GridPoint& point,
                                              double margin) const {
        const Vector3 n = normal_of(t);
        const Vector3 at = to_vector(point);
        int axis = 0;
        for (int k = 1; k < 3; ++k)
            if (std::fabs(n[static_cast<std::size_t>(k)]) >
                std::fabs(n[static_cast<std::size_t>(axis)]))
                axis = k;
        std::optional<Plane> best;
        double most = -infinity;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3 a = to_vector(t.corners()[i]);
            const Vector3 b = to_vector(t.corners()[(i + 1) % 3]);
            const Vector3 outward = cross(minus(b, a), n);
            const double beyond = dot(minus(at, a), scaled_to(outward, 1));
            const auto p = nearest_lattice_point(a);
            const auto q = nearest_lattice_point(b);
            if (!p || !q || beyond <= most) continue;
            const int j = (axis + 1) % 3;
            const int l = (axis + 2) % 3;
            if ((*p)[j] == (*q)[j] && (*p)[l] == (*q)[l]) continue;
            const Plane plane = Plane::along_axis(*p, *q, axis);
            if (!parts(plane) || depth(plane, a) <= margin) continue;
            most = beyond;
            best = plane;
        }
        return best;
    }

    [[nodiscard]] bool parts(const Plane& plane) const {
        bool below = false;
        bool above = false;
        for (const VertexId v : component_.ids) {
            const Side side = side_of(piece_.brep()->point(v), plane);
            below = below || side == Side::Below;
            above = above || side == Side::Above;
            if (below && above) return true;
        }
        return false;
    }

    const Component& component_;
    const DifferencePiece& piece_;
};

class RadiusSearch {
public:
    RadiusSearch(const GridTriangles& first, const GridTriangles& second,
                 const RadiusOptions& options)
        : first_(first), second_(second), options_(options) {}

    DifferenceRadius run(const Solid& difference) {
        const DifferencePiece whole(difference);
        look_at_vertices(whole);
        const std::vector<Component> components = whole.components();
        out_.components = components.size();
        match_corners();
        for (const Component& c : components) {
            if (is_refuted()) break;
            if (!settle(c) && !push(parts_around(difference, c))) accept(c);
        }
        while (!stack_.empty() && !is_refuted()) {
            const DifferencePiece piece = std::move(stack_.back());
            stack_.pop_back();
            divide(piece);
        }
        if (is_refuted()) out_.upper = std::numeric_limits<double>::quiet_NaN();
        return std::move(out_);
    }

private:
    [[nodiscard]] bool is_refuted() const {
        return options_.within && out_.lower > *options_.within;
    }
    [[nodiscard]] double target() const {
        return options_.within ? *options_.within : looseness * reach_ + cut_error;
    }

    /// Nothing where corners would move farther than what is looked for. Corners that slide along
    /// faces move farther than vertices of the difference are from the surfaces.
    void match_corners() {
        if (is_refuted() || !options_.match_corners) return;
        const double least = std::max(reach_, cut_error);
        double least_open = infinity;
        for (const double factor : {1.0, 32.0, 1024.0}) {
            CornerBound found = options_.match_corners(factor * least);
            const double open = length_of(found.boxes);
            if (found.move > target() || open >= least_open) continue;
            match_ = std::move(found);
            least_open = open;
            if (match_->boxes.empty()) return;
        }
    }
    /// The sum of the boxes' longest sides: with a large reach there may be one box around all.
    [[nodiscard]] static double length_of(const std::vector<GridBox>& boxes) {
        double sum = 0;
        for (const GridBox& box : boxes) {
            Int128 longest = 0;
            for (std::size_t k = 0; k < 3; ++k)
                longest = std::max(longest, box.high[k] - box.low[k]);
            sum += WideInt<2>(longest).to_double();
        }
        return sum;
    }
    [[nodiscard]] static GridBox box_of(const Component& c) {
        GridBox out{c.points.front(), c.points.front()};
        for (const GridPoint& p : c.points) {
            for (std::size_t k = 0; k < 3; ++k) {
                out.low[k] = std::min(out.low[k], p[k]);
                out.high[k] = std::max(out.high[k], p[k]);
            }
        }
        return out;
    }
    /// The parts of it where corners do not match, or all of it.
    [[nodiscard]] std::vector<GridBox> open_boxes(const Component& c) const {
        const GridBox around = box_of(c);
        if (!match_) return {around};
        std::vector<GridBox> out;
        for (const GridBox& box : match_->boxes) {
            GridBox common;
            bool meet = true;
            for (std::size_t k = 0; k < 3; ++k) {
                common.low[k] = std::max(box.low[k], around.low[k]);
                common.high[k] = std::min(box.high[k], around.high[k]);
                meet = meet && common.low[k] <= common.high[k];
            }
            if (meet) out.push_back(common);
        }
        return out;
    }

    void look_at_vertices(const DifferencePiece& piece) {
        for (const VertexId v : piece.brep()->vertices()) {
            for (const GridTriangles* surface : {&first_, &second_}) {
                const GridTriangles::Nearest n = surface->nearest(piece.grid(v));
                reach_ = std::max(reach_, n.upper);
                if (out_.piece && n.lower <= out_.lower) continue;
                out_.lower = n.lower;
                out_.piece = piece.brep();
                out_.vertex = v;
            }
        }
    }

    /// Whether its corners match, or the component is near one triangle of each surface.
    bool settle(const Component& c) {
        if (match_ && open_boxes(c).empty()) {
            out_.upper = std::max(out_.upper, match_->move);
            return true;
        }
        ++out_.pieces;
        a_ = closest(first_, c, target());
        b_ = a_.radius <= target() ? closest(second_, c, target()) : Closeness{};
        if (a_.radius > target() || b_.radius > target()) return false;
        out_.upper = std::max({out_.upper, a_.radius, b_.radius});
        return true;
    }

    /// No more cuts: one triangle must do.
    void accept(const Component& c) {
        for (const GridTriangles* surface : {&first_, &second_})
            out_.upper = std::max(out_.upper, closest(*surface, c, 0).radius);
    }

    [[nodiscard]] std::vector<Solid> parts_around(const Solid& solid, const Component& c) {
        if (match_) out_.upper = std::max(out_.upper, match_->move);
        std::vector<GridBox> boxes = open_boxes(c);
        if (boxes.size() > most_boxes) boxes = {box_of(c)};
        std::vector<Solid> out;
        for (const GridBox& box : boxes) out.push_back(part_within(solid, box));
        return out;
    }
    [[nodiscard]] Solid part_within(const Solid& solid, const GridBox& around) const {
        Expression box = solid;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<int>(k);
            const auto below = static_cast<std::int64_t>(around.low[k] >> grid_bits) - 1;
            const auto above = static_cast<std::int64_t>(around.high[k] >> grid_bits) + 2;
            box = box & Solid::half_space(Plane::axis_aligned(axis, 1, above), solid.lattice());
            box = box &
                  Solid::half_space(Plane::axis_aligned(axis, 1, below).flipped(), solid.lattice());
        }
        return evaluate(box, options_.evaluate);
    }

    /// Notes the parts as pieces, all of them or none: where the boundary of a part could not be
    /// assembled, what they are parts of has to be judged as a whole.
    bool push(std::vector<Solid> parts) {
        std::vector<DifferencePiece> pieces;
        try {
            for (Solid& part : parts)
                if (!part.is_empty()) pieces.emplace_back(std::move(part));
        } catch (const Error& e) {
            if (e.code() != ErrorCode::InvalidSolid && e.code() != ErrorCode::Internal) throw;
            ++out_.failed_cuts;
            return false;
        }
        for (DifferencePiece& p : pieces) {
            look_at_vertices(p);
            stack_.push_back(std::move(p));
        }
        return true;
    }

    bool cut(const Solid& solid, const std::optional<Plane>& plane) {
        if (!plane) return false;
        const Solid half = Solid::half_space(*plane, solid.lattice());
        return push(
            {evaluate(solid & half, options_.evaluate), evaluate(solid - half, options_.evaluate)});
    }

    /// Ends with the first component that has to be cut: what follows is in the parts.
    void divide(const DifferencePiece& piece) {
        for (const Component& c : piece.components()) {
            if (settle(c)) continue;
            if (out_.pieces < options_.piece_limit) {
                const bool near_first = a_.radius <= target();
                const CuttingPlanes planes(c, piece);
                const auto along =
                    planes.along(near_first ? second_ : first_, near_first ? b_ : a_, cut_error);
                if (cut(piece.solid(), along) || cut(piece.solid(), planes.across())) return;
            }
            accept(c);
        }
    }

    const GridTriangles& first_;
    const GridTriangles& second_;
    const RadiusOptions& options_;
    std::vector<DifferencePiece> stack_;
    std::optional<CornerBound> match_;
    double reach_ = 0;  ///< upper bound of what `lower` is a lower bound of
    Closeness a_, b_;   ///< of the component that settle() saw last
    DifferenceRadius out_;
};

}  // namespace

DifferenceRadius difference_radius(const Solid& difference, const GridTriangles& first,
                                   const GridTriangles& second, const RadiusOptions& options) {
    return RadiusSearch(first, second, options).run(difference);
}

}  // namespace trisect::detail
