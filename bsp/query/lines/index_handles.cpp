// SPDX-License-Identifier: Apache-2.0
//
// Which face does a polygon belong to? Only faces with its oriented plane can be it. Planes are
// compared by their coefficients in lowest terms; most planes of a curved model carry one face, and
// nothing more is to do. Where a plane carries several, the face that contains the middle of the
// polygon is looked for among those whose boxes do, by the winding number of its loops in the
// plane: the middle is in the open polygon, so on no loop.

#include <trisect/bsp/query/lines/index_handles.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

// Planes with equal ones are parallel and oriented alike.
using NormalKey = std::array<Plane::Coefficient, 3>;

// And the offset along the unit normal, which up to rounding is the same for equal planes.
double height_of(const Plane& p) {
    const double l = std::sqrt(p.approx_normal(0) * p.approx_normal(0) +
                               p.approx_normal(1) * p.approx_normal(1) +
                               p.approx_normal(2) * p.approx_normal(2));
    return p.approx_offset() / l;
}

struct NormalHash {
    std::size_t operator()(const NormalKey& k) const {
        std::uint64_t h = 0;
        for (const Plane::Coefficient& v : k) {
            h = (h ^ v.limb(0)) * 0x9e3779b97f4a7c15ULL;
            h ^= h >> 32;
        }
        return h;
    }
};

struct PlaneFace {
    double height = 0;
    FaceId face;
};

// A point of the interior of what a polygon has in its cell.
IndexPoint middle_of(const ConvexPolygon& part) {
    IndexPoint::Rational sum;
    const auto corners = part.vertices();
    for (const Point& c : corners) {
        const IndexPoint p(c);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += p.rational()[k];
    }
    const ExactRational n(static_cast<std::int64_t>(corners.size()));
    for (ExactRational& x : sum) x /= n;
    return IndexPoint(std::move(sum));
}

// Twice the winding number of a face's loops about a point of its plane that is on none of them,
// seen along an axis: the crossings with the ray in direction +u, exact.
bool is_in_face(const Brep& brep, FaceId face, const IndexPoint& p) {
    const auto axis = static_cast<std::size_t>(brep.plane(face).dominant_axis());
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    int winding = 0;
    for (const HalfedgeId h : brep.halfedges(face)) {
        const IndexPoint a(brep.point(brep.origin(h)));
        const IndexPoint b(brep.point(brep.target(h)));
        const bool a_below = compare_coordinate(a, p, v) <= 0;
        const bool b_below = compare_coordinate(b, p, v) <= 0;
        if (a_below == b_below) continue;
        // Both ends on one side of p along u decide without arithmetic.
        const int au = compare_coordinate(a, p, u);
        const int bu = compare_coordinate(b, p, u);
        bool right = au > 0;
        if (au != bu || au == 0) {
            const auto& x = p.rational();
            const auto& s = a.rational();
            const auto& t = b.rational();
            const int turn = ((t[u] - s[u]) * (x[v] - s[v]) - (t[v] - s[v]) * (x[u] - s[u])).sign();
            right = a_below ? turn > 0 : turn < 0;  // p to the left of an upward edge
        }
        if (right) winding += a_below ? 1 : -1;
    }
    return winding != 0;
}

}  // namespace

int compare_coordinate(const IndexPoint& a, const IndexPoint& b, std::size_t k) {
    const double d = a[k] - b[k];
    const double slack = 2 * (a.error() + b.error());
    if (d > slack) return 1;
    if (d < -slack) return -1;
    if (slack == 0) return 0;
    const auto order = a.rational()[k] <=> b.rational()[k];
    return order < 0 ? -1 : (order > 0 ? 1 : 0);
}

bool is_same(const IndexPoint& a, const IndexPoint& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::fabs(a[k] - b[k]) > 2 * (a.error() + b.error())) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (compare_coordinate(a, b, k) != 0) return false;
    return true;
}

IndexHandles::IndexHandles(const IndexBase& base) {
    const auto start = std::chrono::steady_clock::now();
    number_leaves(base);
    brep_ = base.solid().to_brep();
    find_faces();
    list_edges(base);
    list_vertices(base);
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void IndexHandles::number_leaves(const IndexBase& base) {
    std::uint32_t leaves = 0;
    for_tree_leaves(
        base, [](const DoubleBox&) { return true; },
        [&](const LeafInTree& leaf) {
            if (leaf.node.size() == 0) return;
            const IndexedLeaf& index = leaf.index();
            index.divide_all();
            numbers_[&index] = {static_cast<std::uint32_t>(all_polygons_.size()), leaves};
            leaves += index.leaf_count();
            for (IndexedLeaf::Id id = 0; id < index.polygons().size(); ++id)
                all_polygons_.push_back({&index, id, leaf.turned});
        });
    edges_begin_.assign(leaves + 1, 0);
    vertices_begin_.assign(leaves + 1, 0);
}

void IndexHandles::find_faces() {
    std::unordered_map<NormalKey, std::vector<PlaneFace>, NormalHash> by_normal;
    by_normal.reserve(brep_.faces().size());
    for (const FaceId f : brep_.faces())
        by_normal[brep_.plane(f).direction()].push_back({height_of(brep_.plane(f)), f});
    for (auto& [key, faces] : by_normal)
        std::sort(faces.begin(), faces.end(),
                  [](const PlaneFace& a, const PlaneFace& b) { return a.height < b.height; });
    struct Bounds {
        std::array<double, 3> lo{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        std::array<double, 3> hi{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    };
    std::vector<Bounds> bounds(brep_.faces().size());
    for (const FaceId f : brep_.faces())
        for (const HalfedgeId h : brep_.halfedges(brep_.outer_loop(f))) {
            const Approximation& a = brep_.point(brep_.origin(h)).approximation();
            for (std::size_t k = 0; k < 3; ++k) {
                bounds[f.index].lo[k] = std::min(bounds[f.index].lo[k], a.c[k] - 2 * a.error);
                bounds[f.index].hi[k] = std::max(bounds[f.index].hi[k], a.c[k] + 2 * a.error);
            }
        }
    faces_.resize(all_polygons_.size());
    std::vector<FaceId> near;
    for (std::size_t number = 0; number < all_polygons_.size(); ++number) {
        const PolygonId& id = all_polygons_[number];
        const Plane plane = id.outward();
        const auto it = by_normal.find(plane.direction());
        if (it == by_normal.end() && !id.enters()) continue;
        TRISECT_EXPECTS(it != by_normal.end(), "a polygon in the plane of no face");
        const double height = height_of(plane);
        const double slack = (std::fabs(height) + 1) * 0x1p-40;
        near.clear();
        const auto& faces = it->second;
        for (auto f = std::lower_bound(faces.begin(), faces.end(), height - slack,
                                       [](const PlaneFace&a, double h) { return a.height < h; });
             f != faces.end() && f->height <= height + slack; ++f)
            near.push_back(f->face);
        if (near.size() != 1) {
            const ConvexPolygon part = id.part();
            if (part.is_empty() && id.reaches_out()) continue;
            const IndexPoint p = middle_of(part);
            std::erase_if(near, [&](FaceId f) {
                for (std::size_t k = 0; k < 3; ++k)
                    if (p[k] + p.error() < bounds[f.index].lo[k] ||
                        p[k] - p.error() > bounds[f.index].hi[k])
                        return true;
                return !is_same_plane(brep_.plane(f), plane) || !is_in_face(brep_, f, p);
            });
        }
        TRISECT_EXPECTS(!near.empty(), "a polygon in no face");
        faces_[number] = *std::min_element(near.begin(), near.end());
    }
    polygons_begin_.assign(brep_.faces().size() + 1, 0);
    for (const FaceId f : faces_)
        if (f.is_valid()) ++polygons_begin_[f.index + 1];
    std::partial_sum(polygons_begin_.begin(), polygons_begin_.end(), polygons_begin_.begin());
    polygons_.resize(polygons_begin_.back());
    std::vector<std::uint32_t> at(polygons_begin_.begin(), polygons_begin_.end() - 1);
    for (std::size_t i = 0; i < faces_.size(); ++i)
        if (faces_[i].is_valid()) polygons_[at[faces_[i].index]++] = all_polygons_[i];
}

// Leaves whose cells a segment may meet, with a margin for rounding: a walk with the part of the
// segment that is in the cell.
void IndexHandles::list_edges(const IndexBase& base) {
    std::vector<std::pair<std::uint32_t, EdgeId>> found;  // mixed cell, edge
    struct Pending {
        const CellNode* node = nullptr;
        double lo = 0;
        double hi = 1;
    };
    std::vector<Pending> pending;
    for (const EdgeId e : brep_.edges()) {
        const HalfedgeId h = brep_.halfedge(e);
        const Approximation a = brep_.point(brep_.origin(h)).approximation();
        const Approximation b = brep_.point(brep_.target(h)).approximation();
        pending.push_back({base.root().node.get()});
        while (!pending.empty()) {
            const Pending p = pending.back();
            pending.pop_back();
            const CellNode& n = refined(*p.node);
            if (n.is_leaf()) {
                if (n.size() == 0) continue;
                // Its index is there already.
                const IndexedLeaf& index = indexed_leaf(n, Cell{});
                const std::uint32_t first = numbers_of(index).leaf;
                if (index.grid() == nullptr) {
                    if (index.leaf_count() != 0) found.emplace_back(first, e);
                    continue;
                }
                ApproximateLine line{a.c, {}, a.error, 2 * (a.error + b.error)};
                for (std::size_t k = 0; k < 3; ++k) {
                    line.direction[k] = b.c[k] - a.c[k];
                    line.direction_error += std::fabs(line.direction[k]) * last_place;
                }
                for_grid_leaves_along(
                    index, line, p.lo, p.hi, [](double) { return true; },
                    [&](std::uint32_t leaf, double, double) {
                        found.emplace_back(first + leaf, e);
                    });
                continue;
            }
            const auto k = static_cast<std::size_t>(n.axis());
            const double splitter = rounded_position(n.splitter());
            const double size =
                std::max({std::fabs(splitter), std::fabs(a.c[k]), std::fabs(b.c[k])});
            const double slack = 2 * (a.error + b.error) + size * 0x1p-45;
            const double step = b.c[k] - a.c[k];
            const double at_lo = a.c[k] + p.lo * step;
            const double at_hi = a.c[k] + p.hi * step;
            const bool below = std::min(at_lo, at_hi) <= splitter + slack;
            const bool above = std::max(at_lo, at_hi) >= splitter - slack;
            if (below && above && std::fabs(step) > 4 * slack) {
                const double t = (splitter - a.c[k]) / step;
                const double margin = slack / std::fabs(step) * 1.01 + 0x1p-45;
                Pending first = p;
                Pending second = p;
                first.hi = std::min(p.hi, t + margin);
                second.lo = std::max(p.lo, t - margin);
                first.node = n.child(step > 0 ? 0 : 1).node.get();
                second.node = n.child(step > 0 ? 1 : 0).node.get();
                pending.push_back(first);
                pending.push_back(second);
                continue;
            }
            if (below) pending.push_back({n.child(0).node.get(), p.lo, p.hi});
            if (above) pending.push_back({n.child(1).node.get(), p.lo, p.hi});
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    edges_.reserve(found.size());
    for (const auto& [leaf, e] : found) {
        ++edges_begin_[leaf + 1];
        edges_.push_back(e);
    }
    std::partial_sum(edges_begin_.begin(), edges_begin_.end(), edges_begin_.begin());
}

void IndexHandles::list_vertices(const IndexBase& base) {
    std::vector<std::pair<std::uint32_t, VertexId>> found;
    for (const VertexId v : brep_.vertices())
        for_mixed_cells_at(base, IndexPoint(brep_.point(v)),
                           [&](const IndexedLeaf& index, const IndexedLeaf::Cell& c) {
                               found.emplace_back(numbers_of(index).leaf + c.leaf, v);
                           });
    std::sort(found.begin(), found.end());
    vertices_.reserve(found.size());
    for (const auto& [leaf, v] : found) {
        ++vertices_begin_[leaf + 1];
        vertices_.push_back(v);
    }
    std::partial_sum(vertices_begin_.begin(), vertices_begin_.end(), vertices_begin_.begin());
}

bool IndexHandles::is_on(EdgeId edge, const IndexPoint& point) const {
    const HalfedgeId h = brep_.halfedge(edge);
    if (point.side_of(brep_.plane(brep_.face(h))) != 0) return false;
    if (point.side_of(brep_.plane(brep_.face(brep_.twin(h)))) != 0) return false;
    const IndexPoint a(brep_.point(brep_.origin(h)));
    const IndexPoint b(brep_.point(brep_.target(h)));
    for (std::size_t k = 0; k < 3; ++k) {
        const int first = compare_coordinate(a, point, k);
        if (first * compare_coordinate(b, point, k) > 0) return false;
    }
    return true;
}

EdgeId IndexHandles::edge_at(const IndexBase& base, const IndexPoint& point) const {
    EdgeId best;
    for_mixed_cells_at(base, point, [&](const IndexedLeaf& index, const IndexedLeaf::Cell& c) {
        for (const EdgeId e : edges_in(index, c))
            if (e < best && is_on(e, point)) best = e;
    });
    return best;
}

VertexId IndexHandles::vertex_at(const IndexBase& base, const IndexPoint& point) const {
    VertexId best;
    for_mixed_cells_at(base, point, [&](const IndexedLeaf& index, const IndexedLeaf::Cell& c) {
        for (const VertexId v : vertices_in(index, c))
            if (v < best && is_same(IndexPoint(brep_.point(v)), point)) best = v;
    });
    return best;
}

void IndexHandles::name(const IndexCore& core, Place& place, std::span<const PolygonId> on,
                        const IndexPoint& point) const {
    if (place.location == Location::OnFace) {
        for (const PolygonId& id : on) place.face = std::min(place.face, face_of(id));
    } else if (place.location == Location::OnEdge) {
        place.edge = edge_at(*core.base, point);
        TRISECT_EXPECTS(place.edge.is_valid(), "a point of an edge that the B-rep lacks");
    } else if (place.location == Location::OnVertex) {
        place.vertex = vertex_at(*core.base, point);
        // Two edges that touch crosswise: no vertex.
        if (!place.vertex.is_valid()) place.edge = edge_at(*core.base, point);
        TRISECT_EXPECTS(place.vertex.is_valid() || place.edge.is_valid(),
                        "a point of a vertex that the B-rep lacks");
    }
}

std::size_t IndexHandles::bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return of(faces_) + of(polygons_) + of(all_polygons_) + of(polygons_begin_) + of(edges_) +
           of(edges_begin_) + of(vertices_) + of(vertices_begin_);
}

}  // namespace trisect::detail
