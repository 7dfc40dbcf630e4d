// SPDX-License-Identifier: Apache-2.0
//
// From faces to convex polygons.
//
// The tree cuts polygons by planes and names new points by three planes. So every edge needs a
// plane that crosses the face there, and every corner three planes that meet in it; and none of
// them may be a plane through computed points, whose coefficients would have no bound.
//
// For an edge that is the plane of the face on its other side. Only where that face is coplanar
// something else is due: a plane parallel to an axis between lattice points, or a plane that both
// ends are named by. For a corner three of the faces around it do, or the planes of its own name,
// or planes parallel to the axes through a lattice point.
//
// Faces that are not convex are divided. Between lattice points any diagonal has a plane, so they
// are triangulated. Where corners are computed points, diagonals are not to be had; then the face
// is cut by the lines of its own edges (msp_face_parts.cpp).

#include <trisect/bsp/msp/msp_soup.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include <trisect/brep/planar_loops.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/msp/msp_face_parts.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail::msp {

namespace {

using Leaf = MspTree::Leaf;

constexpr std::uint32_t unknown = ~std::uint32_t{0};

bool are_parallel_cuts(const Plane& a, const Plane& b) {
    return sign_of_cross(a, b, 0) == 0 && sign_of_cross(a, b, 1) == 0 &&
           sign_of_cross(a, b, 2) == 0;
}

// The plane x_axis = position.
Plane plane_at(int axis, Coordinate position) {
    const int bits = fraction_bits(position);
    std::array<Plane::Coefficient, 3> n{};
    n[as_index(axis)] = Plane::Coefficient(1).shifted_left(bits);
    return {n[0], n[1], n[2], -Plane::Coefficient(scaled_integer(position, bits))};
}

// Where a point is, if its coordinates are those of a lattice point. One that planes name is at
// fractions only: Point finds whole coordinates itself.
std::optional<LatticePoint> lattice_place(const Point& p) {
    if (p.is_lattice()) return p.lattice();
    const Point3d at = p.nearest();
    std::array<Coordinate, 3> c;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::fabs(at[k]) < static_cast<double>(coordinate_limit)) ||
            dyadic(at[k]).exponent < -fraction_limit)
            return std::nullopt;
        c[k] = Coordinate(at[k]);
    }
    const LatticePoint place{c[0], c[1], c[2]};
    if (!(p == Point(place))) return std::nullopt;
    return place;
}

void require_handle(std::size_t handle) {
    if (handle > MspTree::Ref::limit) throw LimitError("MSP tree: more than 2^29 entities");
}

class BrepSoup {
public:
    explicit BrepSoup(const Brep& brep) : brep_(brep), edge_planes_(brep.edges().size(), unknown) {}

    MspSoup run() {
        require_handle(
            std::max({brep_.faces().size(), brep_.edges().size(), brep_.vertices().size()}));
        for (const FaceId f : brep_.faces()) geometry().add_plane(brep_.plane(f));
        for (const VertexId v : brep_.vertices()) add_vertex(v);
        for (const FaceId f : brep_.faces()) add_face(f);
        soup_.face_count = brep_.faces().size();
        return std::move(soup_);
    }

private:
    [[nodiscard]] MspGeometry& geometry() { return soup_.geometry; }

    // The plane of face f has number f, the point of vertex v number v.
    void add_vertex(VertexId v) {
        const Point& at = brep_.point(v);
        std::array<PlaneIndex, 3> named{};
        int count = 0;
        const auto take = [&](PlaneIndex p) {
            const Plane& plane = geometry().plane(p);
            if (count == 1 && are_parallel_cuts(geometry().plane(named[0]), plane)) return false;
            if (count == 2 &&
                !meet_in_a_point(geometry().plane(named[0]), geometry().plane(named[1]), plane))
                return false;
            if (count < 3) named[static_cast<std::size_t>(count++)] = p;
            return true;
        };
        HalfedgeId h = brep_.outgoing(v);
        do {
            take(brep_.face(h).index);
            h = brep_.twin(brep_.prev(h));
        } while (count < 3 && h != brep_.outgoing(v));
        for (int axis = 0; count < 3 && axis < 3; ++axis) {
            const PlaneIndex p =
                at.is_lattice() ? plane_of_coordinate(axis, at.lattice()[axis])
                                : geometry().add_plane(at.plane_point()->planes[as_index(axis)]);
            take(p);
        }
        TRISECT_EXPECTS(count == 3, "MSP tree: a vertex without three planes");
        geometry().add_point(named, at);
    }

    PlaneIndex plane_of_coordinate(int axis, Coordinate position) {
        const auto [at, is_new] = by_coordinate_[as_index(axis)].try_emplace(position.bits(), 0U);
        if (is_new) at->second = geometry().add_plane(plane_at(axis, position));
        return at->second;
    }

    void add_face(FaceId f) {
        std::vector<Corner> corners;
        for (const HalfedgeId h : brep_.halfedges(f)) corners.push_back(corner(h));
        const auto label = Label::leaf(Leaf::OnFace, f.index);
        if (is_convex(f)) {
            add_polygon(f, label, corners);
        } else if (is_lattice(corners)) {
            add_triangles(f, label, corners);
        } else {
            add_parts(f, label, corners);
        }
    }

    Corner corner(HalfedgeId h) {
        Corner c;
        c.point = brep_.origin(h).index;
        c.vertex = Label::leaf(Leaf::OnVertex, name(brep_.origin(h)));
        c.edge = Label::leaf(Leaf::OnEdge, name(brep_.edge(h)));
        c.edge_plane = plane_of_edge(h);
        return c;
    }

    // Of copies the smallest.
    template <class Id>
    [[nodiscard]] std::uint32_t name(Id id) const {
        const auto copies = brep_.copies(id);
        return copies.empty() ? id.index : std::min_element(copies.begin(), copies.end())->index;
    }

    PlaneIndex plane_of_edge(HalfedgeId h) {
        const EdgeId e = brep_.edge(h);
        const FaceId f = brep_.face(h);
        const auto crosses = [&](FaceId other) {
            return other != f && !are_parallel_cuts(brep_.plane(f), brep_.plane(other));
        };
        if (const FaceId other = brep_.face(brep_.twin(h)); crosses(other)) return other.index;
        for (const EdgeId copy : brep_.copies(e)) {
            const HalfedgeId there = brep_.halfedge(copy);
            for (const FaceId other : {brep_.face(there), brep_.face(brep_.twin(there))})
                if (crosses(other)) return other.index;
        }
        PlaneIndex& known = edge_planes_[e.index];
        if (known == unknown) known = geometry().add_plane(plane_between_coplanar(h));
        return known;
    }

    [[nodiscard]] Plane plane_between_coplanar(HalfedgeId h) const {
        const Plane& support = brep_.plane(brep_.face(h));
        const Point& a = brep_.point(brep_.origin(h));
        const Point& b = brep_.point(brep_.target(h));
        if (const auto from = lattice_place(a), to = lattice_place(b); from && to)
            return Plane::along_axis(*from, *to, support.dominant_axis());
        for (const Point* end : {&a, &b}) {
            if (end->is_lattice()) continue;
            for (const Plane& p : end->plane_point()->planes)
                if (!are_parallel_cuts(p, support) && side_of(a, p) == Side::On &&
                    side_of(b, p) == Side::On)
                    return p;
        }
        throw UnsupportedError(
            "MSP tree: no plane is known through edge " + std::to_string(brep_.edge(h).index) +
            ", which lies between two faces of one plane; assemble with maximal faces");
    }

    /// One loop, simple by the invariants of Brep, that never turns right.
    [[nodiscard]] bool is_convex(FaceId f) const {
        if (brep_.loops(f).size() > 1) return false;
        const auto loop = brep_.halfedges(f);
        if (loop.size() == 3) return true;
        const PlaneProjection seen(brep_.plane(f), brep_.points());
        std::uint32_t before = brep_.origin(loop[loop.size() - 2]).index;
        std::uint32_t at = brep_.origin(loop[loop.size() - 1]).index;
        for (const HalfedgeId h : loop) {
            const std::uint32_t next = brep_.origin(h).index;
            if (seen.orientation(before, at, next) < 0) return false;
            before = std::exchange(at, next);
        }
        return !touches_itself(loop);
    }
    // A loop that never turns right but meets itself would go around twice.
    [[nodiscard]] bool touches_itself(IdRange<HalfedgeId> loop) const {
        std::vector<std::uint32_t> corners;
        for (const HalfedgeId h : loop) corners.push_back(name(brep_.origin(h)));
        std::sort(corners.begin(), corners.end());
        return std::adjacent_find(corners.begin(), corners.end()) != corners.end();
    }
    [[nodiscard]] bool is_lattice(std::span<const Corner> corners) const {
        return std::all_of(corners.begin(), corners.end(), [this](const Corner& c) {
            return brep_.points()[c.point].is_lattice();
        });
    }

    void add_polygon(FaceId f, Label label, std::span<const Corner> corners) {
        soup_.fragments.push_back({f.index, label, geometry().add_corners(corners),
                                   static_cast<std::uint32_t>(corners.size())});
    }

    void add_triangles(FaceId f, Label label, std::span<const Corner> corners) {
        const auto key = [](std::uint32_t a, std::uint32_t b) {
            return std::uint64_t{a} << 32U | b;
        };
        std::unordered_map<std::uint64_t, Corner> by_ends;  // edges of the face, then diagonals
        std::unordered_map<std::uint32_t, Label> vertices;
        for (const HalfedgeId h : brep_.halfedges(f)) {
            const std::size_t i = h.index - brep_.halfedges(f)[0].index;
            by_ends.emplace(key(corners[i].point, brep_.target(h).index), corners[i]);
            vertices.emplace(corners[i].point, corners[i].vertex);
        }
        for (const IndexTriangle& t : triangulate(brep_, f)) {
            std::array<Corner, 3> triangle;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = t[i];
                const std::uint32_t b = t[(i + 1) % 3];
                const auto [at, is_new] = by_ends.try_emplace(key(a, b));
                if (is_new) {
                    const auto twin = by_ends.find(key(b, a));
                    at->second = {a,
                                  twin != by_ends.end() && twin->second.edge == label
                                      ? twin->second.edge_plane
                                      : geometry().add_plane(diagonal(f, a, b)),
                                  vertices.at(a), label};
                }
                triangle[i] = at->second;
            }
            add_polygon(f, label, triangle);
        }
    }
    [[nodiscard]] Plane diagonal(FaceId f, std::uint32_t a, std::uint32_t b) const {
        return Plane::along_axis(brep_.points()[a].lattice(), brep_.points()[b].lattice(),
                                 brep_.plane(f).dominant_axis());
    }

    void add_parts(FaceId f, Label label, std::span<const Corner> corners) {
        std::vector<FaceEdge> edges;
        for (const LoopId l : brep_.loops(f)) {
            const auto loop = brep_.halfedges(l);
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const auto corner = [&](std::size_t k) {
                    return corners[loop[k].index - brep_.halfedges(f)[0].index];
                };
                const Corner from = corner(i);
                const Corner to = corner((i + 1) % loop.size());
                edges.push_back(
                    {from.edge_plane, from.edge, from.point, to.point, from.vertex, to.vertex});
            }
        }
        convex_parts(geometry(), f.index, label, std::move(edges), soup_.fragments);
    }

    const Brep& brep_;
    MspSoup soup_;
    std::vector<PlaneIndex> edge_planes_;  // of edges between coplanar faces, on demand
    std::array<std::unordered_map<std::uint64_t, PlaneIndex>, 3> by_coordinate_;
};

}  // namespace

MspSoup soup_of(const Brep& brep) { return BrepSoup(brep).run(); }

MspSoup soup_of(std::span<const MspPolygon> polygons) {
    MspSoup soup;
    std::vector<std::uint32_t> faces;
    for (const MspPolygon& p : polygons) {
        const std::size_t n = p.shape.size();
        TRISECT_EXPECTS(p.edges.size() == n && p.vertices.size() == n,
                        "MSP tree: a polygon needs a handle for each edge and vertex");
        if (n == 0) continue;
        const auto label = [&p](Leaf kind, std::uint32_t handle) {
            if (handle != MspPolygon::none) require_handle(handle);
            return handle == MspPolygon::none ? Label::leaf(Leaf::OnFace, p.face)
                                              : Label::leaf(kind, handle);
        };
        require_handle(p.face);
        faces.push_back(p.face);
        const PlaneIndex support = soup.geometry.add_plane(p.shape.support());
        std::vector<Corner> corners(n);
        for (std::size_t i = 0; i < n; ++i)
            corners[i].edge_plane = soup.geometry.add_plane(p.shape.edge(i));
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t before = i == 0 ? n - 1 : i - 1;
            corners[i].edge = label(Leaf::OnEdge, p.edges[i]);
            corners[i].vertex = label(Leaf::OnVertex, p.vertices[i]);
            // A corner that is no vertex lies within an edge, when one of its edges is one.
            if (p.vertices[i] == MspPolygon::none)
                corners[i].vertex = more_specific(label(Leaf::OnEdge, p.edges[i]),
                                                  label(Leaf::OnEdge, p.edges[before]));
            corners[i].point = soup.geometry.add_point(
                {support, corners[before].edge_plane, corners[i].edge_plane}, p.shape.vertex(i));
        }
        soup.fragments.push_back({support, Label::leaf(Leaf::OnFace, p.face),
                                  soup.geometry.add_corners(corners),
                                  static_cast<std::uint32_t>(n)});
    }
    std::sort(faces.begin(), faces.end());
    soup.face_count =
        static_cast<std::size_t>(std::unique(faces.begin(), faces.end()) - faces.begin());
    return soup;
}

}  // namespace trisect::detail::msp
