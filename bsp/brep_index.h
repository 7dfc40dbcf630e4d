// SPDX-License-Identifier: Apache-2.0
//
// BrepIndex: exact spatial queries for points, rays, nearest points, planes and boxes.
// Answers name the face, edge or vertex.
//
// Points and directions given as doubles are in the user's units and taken exactly as given;
// LatticePoint, Point and Plane are in lattice units (Solid::lattice).
//
// Source of the idea: G. Vanecek, Brep-Index: a multidimensional space partitioning tree (IJCGA
// 1(3), 1991): one partition of space whose cells of every dimension lead to the entity that
// carries them.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_point.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/plane_on_lattice.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/point3d.h>

namespace trisect {

namespace detail {
class IndexCore;
}

/// Where a point is with respect to a solid.
///
/// The three kinds of boundary points are a property of the set, not of a triangulation: where all
/// polygons of the boundary that contain the point lie in one plane it is on a face, where their
/// planes share a line it is on an edge, otherwise on a vertex. So a point on the line between two
/// coplanar triangles is on a face, and where a corner touches the middle of a face is a vertex.
/// Two edges that touch crosswise make a vertex, too.
enum class Location : std::uint8_t { Outside, OnFace, OnEdge, OnVertex, Inside };

/// "outside", "face", "edge", "vertex", "inside".
[[nodiscard]] const char* to_string(Location location);

/// A corner of an imported mesh: the operand (Solid::source_id) and the number of the point in its
/// LatticeMesh.
struct CornerSource {
    std::uint32_t operand = 0;
    std::uint32_t corner = EntityId<void>::none;
    [[nodiscard]] bool is_valid() const { return corner != EntityId<void>::none; }
    friend constexpr auto operator<=>(const CornerSource&, const CornerSource&) = default;
};

/// The entity that carries a point. Trivial type of 44 bytes.
///
/// On a face, edge or vertex the first 1, 2 or 3 of `faces` name faces of operands that meet there,
/// in different planes whose normals are linearly independent: of the polygons that contain the
/// point, ordered by operand and facet, the first ones that raise the rank. On a vertex that was a
/// corner of a facet of one of these polygons, `corner` is the smallest name of that corner.
///
/// With a B-rep at hand (BrepIndex::with_brep) exactly the handle that belongs to the location is
/// valid: `face`, `edge` or `vertex`; and where entities coincide (copies, see Brep) the one with
/// the smallest id. On a crossing of two touching edges, where the B-rep has no vertex, it is one
/// of the edges instead.
struct Place {
    Location location = Location::Outside;
    std::uint8_t face_count = 0;
    std::array<FaceSource, 3> faces{};
    CornerSource corner;
    FaceId face;
    EdgeId edge;
    VertexId vertex;

    [[nodiscard]] bool is_on_boundary() const {
        return location != Location::Outside && location != Location::Inside;
    }
    friend bool operator==(const Place&, const Place&) = default;
};

/// The points origin + t · direction, t >= 0, in the user's units. The direction need not have
/// length 1.
struct Ray {
    Point3d origin{};
    Point3d direction{};
};

/// The points from + t · (to - from), 0 <= t <= 1, in the user's units; from != to.
struct Segment {
    Point3d from{};
    Point3d to{};
};

/// The t of a point of a ray or segment: exact, comparable.
///
/// It is kept as the ray and a plane that the ray meets there; exact numbers are worked out on
/// demand. Value type of about 200 bytes; nothing is allocated unless `exact` is called.
class RayParameter {
public:
    /// 0.
    RayParameter() = default;
    /// The ends of a ray or segment: 0 or 1.
    explicit RayParameter(int end) : value_(end) {}
    /// Where a ray in an unbounded face ends. It has no exact value.
    [[nodiscard]] static RayParameter infinite();
    [[nodiscard]] bool is_infinite() const { return form_ == Form::Infinite; }
    /// Where a line meets a plane given in units of 2^exponent. \pre in one point.
    RayParameter(const Ray& ray, int exponent, const Plane& plane);
    RayParameter(const Segment& segment, int exponent, const Plane& plane);

    /// Within error() of the exact value.
    [[nodiscard]] double approximate() const { return value_; }
    [[nodiscard]] double error() const { return error_; }
    /// The double nearest to the exact value.
    [[nodiscard]] double nearest() const;
    /// \pre !is_infinite()
    [[nodiscard]] ExactRational exact() const;
    /// Of parameters of the same ray. Doubles first, rationals where these cannot decide.
    friend std::strong_ordering operator<=>(const RayParameter& a, const RayParameter& b);
    friend bool operator==(const RayParameter& a, const RayParameter& b) { return a <=> b == 0; }

private:
    enum class Form : std::uint8_t { Number, Ray, Segment, Infinite };

    void approximate_value();

    double value_ = 0;
    double error_ = 0;
    Form form_ = Form::Number;
    int exponent_ = 0;
    Point3d origin_{};
    Point3d towards_{};  // direction, or the segment's end
    Plane plane_;
};

/// A maximal part of the ray's intersection with the boundary that is on one entity: a point, or an
/// open interval where the ray runs along an edge or in a face.
///
/// The ends of an interval that belong to an edge or a vertex are hits of their own: a ray along an
/// edge of a cube hits vertex, edge, vertex.
struct RayHit {
    RayParameter enter;
    RayParameter leave;  ///< equal to enter for a point
    bool is_interval = false;
    Place place;
    /// The plane of the first face of `place`, in lattice units, its normal outward.
    Plane plane;
};

/// The first hit of a ray, light: 24 bytes, nothing is allocated.
struct FacetHit {
    FaceSource face;  ///< the first face of the place, see Place
    double lo = 0;    ///< the parameter is between these
    double hi = 0;
};

/// How the boundary of a solid lies to a plane. A half-space bounded by the plane itself touches it
/// from its own side.
enum class PlaneRelation : std::uint8_t {
    Empty,          ///< the solid has no boundary (nothing, or all of space)
    Below,          ///< the boundary lies strictly below the plane
    TouchingBelow,  ///< below, and touches it
    Straddling,     ///< the boundary has points strictly on both sides
    TouchingAbove,  ///< above, and touches it
    Above           ///< strictly above
};

/// A closed polygon in a plane, without repetition of its first corner.
struct SectionLoop {
    std::vector<Point> points;     ///< exact, in lattice units
    std::vector<Point3d> rounded;  ///< the nearest doubles, in the user's units
};

/// A connected piece of a section: its outline, counter-clockwise about the plane's normal, and its
/// holes, clockwise. Pieces may lie in holes of other pieces.
struct SectionRegion {
    SectionLoop outer;
    std::vector<SectionLoop> holes;
};

/// The nearest point of the boundary, or of its edges or vertices.
struct Nearest {
    Place place;                     ///< of that point
    ExactPoint point;                ///< in the user's units
    ExactRational squared_distance;  ///< in the user's units
    /// The double nearest to the squared distance, and the one nearest to the distance.
    double squared_rounded = 0;
    double distance = 0;
};

/// The distance to the boundary in doubles with a proved error, mostly of the thirteenth digit.
struct NearestBounds {
    FaceSource face;  ///< of a polygon that is nearest up to that error
    double lo = 0;    ///< the exact distance is between these, in the user's units
    double hi = 0;    ///< may be infinite for an unbounded boundary
};

/// Positive outside, negative inside, zero on the boundary.
struct SignedDistance {
    int sign = 0;
    Nearest nearest;
    [[nodiscard]] double distance() const {
        return sign < 0 ? -nearest.distance : nearest.distance;
    }
};

/// The entities of the boundary that meet a closed box. Sorted, without repetition. The handles are
/// there only with a B-rep.
struct BoxEntities {
    std::vector<FaceSource> faces;
    std::vector<FaceId> face_ids;
    std::vector<EdgeId> edge_ids;
    std::vector<VertexId> vertex_ids;
};

/// A leaf of the index.
struct IndexCell {
    Point3d lo{};  ///< lattice units; may be infinite
    Point3d hi{};
    std::uint32_t polygons = 0;  ///< 0: homogeneous
    bool inside = false;         ///< of a homogeneous cell
};

/// What an index is like. Which stage decided how many signs of queries is in PredicateCounters
/// (kernel/counters.h).
struct IndexStats {
    std::size_t polygons = 0;  ///< facets and fragments that the leaves of the cell tree list
    std::size_t nodes = 0;     ///< inner nodes and leaves
    std::size_t mixed_leaves = 0;
    std::size_t empty_leaves = 0;
    std::size_t pending_cells = 0;  ///< that no query has come to yet, see BrepIndex::refine
    std::size_t listed = 0;         ///< polygons of all leaves together
    std::size_t depth = 0;
    std::size_t bytes = 0;  ///< of the index, without the solid that it refers to
    double bytes_per_polygon = 0;
    double build_seconds = 0;
    double brep_seconds = 0;  ///< of with_brep
};

/// A view of a solid's cell tree for queries. No B-rep is built unless requested.
///
/// Immutable value; copying shares. Safe to use from many threads. It keeps the solid alive. An
/// index that was moved from is that of the empty set.
///
/// What queries prepare is kept with the solid's tree, and shared by all solids that share parts of
/// it: by a second index, and by results of evaluate(). So an index costs what is new in the tree
/// since the last one, after a small cut some microseconds; of a solid that no index has seen, the
/// bounds of all its leaves.
///
/// Cost of queries: one that comes to a part of the boundary where none was before prepares that
/// part (about 10 us for the next 30 triangles, 0.3 us a triangle altogether, see refine); `locate`
/// one descent and the polygons of one small cell; a ray the cells on its way up to its first hit.
///
/// Solids imported under Embedding::Resolve are resolved first. An import under Embedding::Assume
/// promises a boundary that does not touch itself in two coincident facets.
class BrepIndex {
public:
    /// \throw what evaluate() throws, for solids that must be resolved first.
    explicit BrepIndex(const Solid& solid);

    /// The same index with the B-rep of maximal faces beside it: places then carry handles.
    /// Costs Solid::to_brep and O(n log n). \throw what to_brep throws.
    [[nodiscard]] BrepIndex with_brep() const;

    /// Divides all cells now instead of when queries first come to them: then the first query is as
    /// fast as all others. with_brep() does so, too.
    void refine() const;

    [[nodiscard]] const Solid& solid() const;
    [[nodiscard]] bool has_brep() const;
    /// \pre has_brep()
    [[nodiscard]] const Brep& brep() const;
    [[nodiscard]] IndexStats stats() const;

    // Points -------------------------------------------------------------------------------------
    /// \throw UsageError when a coordinate is not finite.
    ///
    /// Vertices of a file that import rounded are not at their places in the file any more: see
    /// nearest_vertex(), or round points like them (to_lattice()) and ask with a LatticePoint.
    [[nodiscard]] Place locate(const Point3d& point) const;
    /// The same for `locate({0, 0, 1})`, which must have three numbers.
    [[nodiscard]] Place locate(std::initializer_list<double> point) const;
    [[nodiscard]] Place locate(const LatticePoint& point) const;
    [[nodiscard]] Place locate(const Point& point) const;
    /// Rationals in the user's units.
    [[nodiscard]] Place locate(const ExactPoint& point) const;
    /// Many points at once, visited in an order that is kind to the caches. `threads`: how many may
    /// take part, 0 means one for every processor.
    [[nodiscard]] std::vector<Place> locate(std::span<const Point3d> points,
                                            std::uint32_t threads = 0) const;
    /// The same without names, which saves the memory of places. \pre as many results as points.
    void classify(std::span<const Point3d> points, std::span<Location> results,
                  std::uint32_t threads = 0) const;

    // Rays and segments --------------------------------------------------------------------------
    /// \throw UsageError for coordinates that are not finite and directions of length 0.
    [[nodiscard]] std::optional<RayHit> first_hit(const Ray& ray) const;
    [[nodiscard]] std::optional<RayHit> first_hit(const Segment& segment) const;
    /// The same, decided as exactly, without further data.
    [[nodiscard]] std::optional<FacetHit> first_facet(const Ray& ray) const;
    [[nodiscard]] std::optional<FacetHit> first_facet(const Segment& segment) const;
    /// In order along the ray.
    [[nodiscard]] std::vector<RayHit> all_hits(const Ray& ray) const;
    [[nodiscard]] std::vector<RayHit> all_hits(const Segment& segment) const;

    // Distances ----------------------------------------------------------------------------------
    /// Of several nearest points the lexicographically smallest; nothing when there is no boundary.
    [[nodiscard]] std::optional<Nearest> nearest(const Point3d& point) const;
    /// The nearest point that is on an edge or vertex; the nearest that is a vertex.
    [[nodiscard]] std::optional<Nearest> nearest_edge(const Point3d& point) const;
    [[nodiscard]] std::optional<Nearest> nearest_vertex(const Point3d& point) const;
    /// Without the exact point: no rational number is made.
    [[nodiscard]] std::optional<NearestBounds> distance(const Point3d& point) const;
    [[nodiscard]] std::optional<SignedDistance> signed_distance(const Point3d& point) const;

    // Planes and boxes ---------------------------------------------------------------------------
    /// The solid's points in a plane, up to loose edges and points: the closure of what is interior
    /// in the plane. A face in the plane belongs to it, on whichever side of it the solid is.
    /// \throw UnsupportedError when the section is unbounded.
    ///
    /// The plane a x + b y + c z + d = 0 in the user's units, exactly; its normal is (a, b, c).
    /// \throw as plane_on_lattice
    [[nodiscard]] std::vector<SectionRegion> section(const std::array<double, 4>& plane) const;
    [[nodiscard]] PlaneRelation relation_to(const std::array<double, 4>& plane) const;
    /// The same for a plane in units of a lattice. \throw UsageError unless it is the solid's.
    [[nodiscard]] std::vector<SectionRegion> section(const Plane& plane, Lattice lattice) const;
    [[nodiscard]] PlaneRelation relation_to(const Plane& plane, Lattice lattice) const;
    /// Closed box in the user's units, lo <= hi.
    [[nodiscard]] BoxEntities in_box(const Point3d& lo, const Point3d& hi) const;

    // Entities and cells -------------------------------------------------------------------------
    /// The leaves that an entity reaches into. \pre has_brep()
    [[nodiscard]] std::vector<IndexCell> cells(FaceId face) const;
    [[nodiscard]] std::vector<IndexCell> cells(EdgeId edge) const;
    [[nodiscard]] std::vector<IndexCell> cells(VertexId vertex) const;
    /// The leaf that a point is in (one of them, when it is on a splitting plane).
    [[nodiscard]] IndexCell cell_at(const Point3d& point) const;

private:
    explicit BrepIndex(std::shared_ptr<const detail::IndexCore> core) : core_(std::move(core)) {}
    [[nodiscard]] const detail::IndexCore& core() const {
        return core_ != nullptr ? *core_ : empty_core();
    }
    [[nodiscard]] static const detail::IndexCore& empty_core();

    std::shared_ptr<const detail::IndexCore> core_;
};

}  // namespace trisect
