// SPDX-License-Identifier: Apache-2.0
//
// The commonest calls of the library Manifold, under their names.
// A program that was written for it changes its include and its namespace:
//
//     #include <trisect/manifold.h>
//     namespace manifold = trisect::manifold;
//
// Names and meaning are theirs, down to `^`, which is the intersection, and so is the style of the
// names; all of the work is done by Solid. docs/migration.md says what is left out and what
// differs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cone.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/extrusion.h>
#include <trisect/bsp/modelling/level_set.h>
#include <trisect/bsp/modelling/mirrored.h>
#include <trisect/bsp/modelling/plane_region.h>
#include <trisect/bsp/modelling/revolution.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/bsp/split.h>
#include <trisect/kernel/error.h>

// NOLINTBEGIN(readability-identifier-naming): names are those of another library
namespace trisect::manifold {

struct vec3 {
    double x = 0;
    double y = 0;
    double z = 0;
    friend bool operator==(const vec3&, const vec3&) = default;
};

struct vec2 {
    double x = 0;
    double y = 0;
    friend bool operator==(const vec2&, const vec2&) = default;
};
using SimplePolygon = std::vector<vec2>;
/// Counter-clockwise, holes clockwise.
using Polygons = std::vector<SimplePolygon>;

/// Four columns: where the axes go, and the translation.
struct mat3x4 {
    vec3 x{1, 0, 0};
    vec3 y{0, 1, 0};
    vec3 z{0, 0, 1};
    vec3 w{0, 0, 0};
};

struct Box {
    vec3 min;
    vec3 max;
    [[nodiscard]] vec3 Size() const { return {max.x - min.x, max.y - min.y, max.z - min.z}; }
};

enum class OpType : char { Add, Subtract, Intersect };

/// Triangles with `numProp` numbers a vertex, of which the first three are its place. Others are
/// read over, and never come out.
template <class Number, class Index>
struct MeshGLP {
    Index numProp = 3;
    std::vector<Number> vertProperties;
    std::vector<Index> triVerts;
    /// Of meshes that GetMeshGL made: where in `triVerts` the triangles of each operand begin, and
    /// their end; the OriginalID() of each; and for each triangle the face of its operand.
    std::vector<Index> runIndex;
    std::vector<std::uint32_t> runOriginalID;
    std::vector<Index> faceID;

    [[nodiscard]] Index NumVert() const {
        return static_cast<Index>(vertProperties.size() / static_cast<std::size_t>(numProp));
    }
    [[nodiscard]] Index NumTri() const { return static_cast<Index>(triVerts.size() / 3); }
};
using MeshGL = MeshGLP<float, std::uint32_t>;
using MeshGL64 = MeshGLP<double, std::uint64_t>;

/// An immutable solid, or an error. What is made of an error is that error. Booleans are computed
/// at once, BatchBoolean in one pass; limits and mistakes of ours are thrown.
class Manifold {
public:
    enum class Error {
        NoError,
        NonFiniteVertex,
        NotManifold,
        VertexOutOfBounds,
        PropertiesWrongLength,
        MissingPositionProperties,
        InvalidConstruction
    };

    Manifold() = default;
    Manifold(Solid solid) : solid_(std::move(solid)) {}  // NOLINT(google-explicit-constructor)
    /// Vertices of equal coordinates are one: nothing needs to be merged before.
    template <class Number, class Index>
    explicit Manifold(const MeshGLP<Number, Index>& mesh);

    static Manifold Cube(vec3 size = {1, 1, 1}, bool center = false);
    static Manifold Cylinder(double height, double radiusLow, double radiusHigh = -1,
                             int circularSegments = 0, bool center = false);
    static Manifold Sphere(double radius, int circularSegments = 0);
    /// `nDivisions` more layers than one; counter-clockwise; 0, 0 makes a point of the top.
    static Manifold Extrude(const Polygons& crossSection, double height, int nDivisions = 0,
                            double twistDegrees = 0, vec2 scaleTop = {1, 1});
    /// What is right of the y axis, turned about it, which becomes the z axis.
    static Manifold Revolve(const Polygons& crossSection, int circularSegments = 0,
                            double revolveDegrees = 360);
    /// Where the function is above the level; cut off at the bounds, in their planes.
    static Manifold LevelSet(const std::function<double(vec3)>& sdf, Box bounds, double edgeLength,
                             double level = 0, double tolerance = -1, bool canParallel = true);

    [[nodiscard]] Manifold Boolean(const Manifold& second, OpType op) const {
        return BatchBoolean({*this, second}, op);
    }
    static Manifold BatchBoolean(const std::vector<Manifold>& manifolds, OpType op);
    Manifold operator+(const Manifold& other) const { return Boolean(other, OpType::Add); }
    Manifold operator-(const Manifold& other) const { return Boolean(other, OpType::Subtract); }
    Manifold operator^(const Manifold& other) const { return Boolean(other, OpType::Intersect); }
    Manifold& operator+=(const Manifold& other) { return *this = *this + other; }
    Manifold& operator-=(const Manifold& other) { return *this = *this - other; }
    Manifold& operator^=(const Manifold& other) { return *this = *this ^ other; }
    /// The common part, and the rest, from one evaluation.
    [[nodiscard]] std::pair<Manifold, Manifold> Split(const Manifold& cutter) const {
        for (const Manifold* m : {this, &cutter})
            if (m->status_ != Error::NoError) return {failed(m->status_), failed(m->status_)};
        SplitSolid parts = split(solid_, cutter.solid_);
        return {std::move(parts.common), std::move(parts.rest)};
    }
    /// What is on the side of the plane to which its normal points.
    [[nodiscard]] Manifold TrimByPlane(vec3 normal, double originOffset) const {
        return *this - Manifold(below(normal, originOffset));
    }
    [[nodiscard]] std::pair<Manifold, Manifold> SplitByPlane(vec3 normal,
                                                             double originOffset) const {
        auto [below_it, above_it] = Split(Manifold(below(normal, originOffset)));
        return {std::move(above_it), std::move(below_it)};
    }
    [[nodiscard]] std::vector<Manifold> Decompose() const;
    static Manifold Compose(const std::vector<Manifold>& manifolds) {
        return BatchBoolean(manifolds, OpType::Add);
    }
    [[nodiscard]] Manifold Hull() const;

    [[nodiscard]] Manifold Translate(vec3 by) const {
        return moved(AffineMap::translation(array(by)));
    }
    [[nodiscard]] Manifold Scale(vec3 by) const { return moved(AffineMap::scaling(array(by))); }
    /// About the axes x, y and z, in this order. Quarter turns are exact, other turns are rounded.
    [[nodiscard]] Manifold Rotate(double xDegrees, double yDegrees = 0, double zDegrees = 0) const;
    /// In the plane through the origin across the normal. Of a normal of length 0 the empty solid.
    [[nodiscard]] Manifold Mirror(vec3 normal) const;
    [[nodiscard]] Manifold Transform(const mat3x4& m) const {
        return moved({{{{m.x.x, m.y.x, m.z.x, m.w.x},
                        {m.x.y, m.y.y, m.z.y, m.w.y},
                        {m.x.z, m.y.z, m.z.z, m.w.z}}}});
    }

    [[nodiscard]] Error Status() const { return status_; }
    [[nodiscard]] bool IsEmpty() const { return solid_.is_empty(); }
    [[nodiscard]] std::size_t NumVert() const { return counts(solid_).vertices; }
    [[nodiscard]] std::size_t NumTri() const { return counts(solid_).triangles; }
    [[nodiscard]] std::size_t NumEdge() const { return NumTri() / 2 * 3; }
    /// Each correctly rounded from the exact value.
    [[nodiscard]] double Volume() const { return volume(solid_); }
    [[nodiscard]] double SurfaceArea() const { return area(solid_).value; }
    /// From infinity to minus infinity for the empty solid.
    [[nodiscard]] Box BoundingBox() const;
    /// Of a primitive, or a solid made from a mesh; -1 for results.
    [[nodiscard]] int OriginalID() const { return original_id_; }
    [[nodiscard]] MeshGL GetMeshGL() const { return mesh<float, std::uint32_t>(); }
    [[nodiscard]] MeshGL64 GetMeshGL64() const { return mesh<double, std::uint64_t>(); }

    /// The way on to all that this header leaves out.
    [[nodiscard]] const Solid& solid() const { return solid_; }

private:
    static Point3d array(vec3 v) { return {v.x, v.y, v.z}; }
    static vec3 vector(const Point3d& p) { return {p[0], p[1], p[2]}; }
    static Manifold failed(Error error);
    static Manifold original(const PolygonMesh& mesh, Embedding embedding = Embedding::Assume);
    static Manifold standing(PolygonMesh mesh, double height, bool center);
    static Solid below(vec3 normal, double offset);
    static PlaneRegion region(const Polygons& polygons, bool right_half);
    [[nodiscard]] Manifold moved(const AffineMap& map) const;
    template <class Number, class Index>
    [[nodiscard]] MeshGLP<Number, Index> mesh() const;

    Solid solid_;
    Error status_ = Error::NoError;
    int original_id_ = -1;
};

// Meshes ------------------------------------------------------------------------------------------

template <class Number, class Index>
Manifold::Manifold(const MeshGLP<Number, Index>& mesh) {
    const auto width = static_cast<std::size_t>(mesh.numProp);
    if (width < 3) {
        status_ = Error::MissingPositionProperties;
        return;
    }
    if (mesh.vertProperties.size() % width != 0 || mesh.triVerts.size() % 3 != 0) {
        status_ = Error::PropertiesWrongLength;
        return;
    }
    PolygonMesh polygons;
    for (std::size_t i = 0; i < mesh.vertProperties.size(); i += width) {
        const Number* v = mesh.vertProperties.data() + i;
        polygons.points.push_back(
            {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
    }
    for (const Index corner : mesh.triVerts) {
        if (corner >= polygons.points.size()) {
            status_ = Error::VertexOutOfBounds;
            return;
        }
        polygons.corners.push_back(static_cast<std::uint32_t>(corner));
        if (polygons.corners.size() % 3 == 0)
            polygons.face_begin.push_back(static_cast<std::uint32_t>(polygons.corners.size()));
    }
    // Theirs takes boundaries that meet themselves.
    if (polygons.face_count() > 0) *this = original(polygons, Embedding::Check);
}

inline Manifold Manifold::original(const PolygonMesh& mesh, Embedding embedding) {
    const auto is_finite = [](const Point3d& p) {
        return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    };
    if (!std::all_of(mesh.points.begin(), mesh.points.end(), is_finite))
        return failed(Error::NonFiniteVertex);
    try {
        Manifold made(Solid::from_mesh(mesh, {.embedding = embedding}));
        made.original_id_ = static_cast<int>(made.solid_.source_id());
        return made;
    } catch (const trisect::Error& error) {
        if (error.code() != ErrorCode::InvalidSolid) throw;
        return failed(Error::NotManifold);
    }
}

inline Manifold Manifold::failed(Error error) {
    Manifold none;
    none.status_ = error;
    return none;
}

template <class Number, class Index>
MeshGLP<Number, Index> Manifold::mesh() const {
    MeshMap map;
    const PolygonMesh polygons = solid_.to_mesh(map);
    MeshGLP<Number, Index> out;
    for (const Point3d& p : polygons.points)
        for (const double x : p) out.vertProperties.push_back(static_cast<Number>(x));
    // Triangles of one operand after the other, as runs want them.
    std::vector<std::size_t> order(polygons.face_count());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return map.source[a].operand < map.source[b].operand;
    });
    for (const std::size_t f : order) {
        const FaceSource source = map.source[f];
        if (out.runOriginalID.empty() || out.runOriginalID.back() != source.operand) {
            out.runIndex.push_back(static_cast<Index>(out.triVerts.size()));
            out.runOriginalID.push_back(source.operand);
        }
        for (const std::uint32_t corner : polygons.face(f)) out.triVerts.push_back(corner);
        out.faceID.push_back(source.face);
    }
    out.runIndex.push_back(static_cast<Index>(out.triVerts.size()));
    return out;
}

// Primitives --------------------------------------------------------------------------------------

inline Manifold Manifold::Cube(vec3 size, bool center) {
    if (!(size.x > 0 && size.y > 0 && size.z > 0)) return failed(Error::InvalidConstruction);
    const Point3d low = center ? Point3d{-size.x / 2, -size.y / 2, -size.z / 2} : Point3d{};
    return original(make_box(low, {low[0] + size.x, low[1] + size.y, low[2] + size.z}));
}

inline Manifold Manifold::standing(PolygonMesh mesh, double height, bool center) {
    if (center)
        for (Point3d& p : mesh.points) p[2] -= height / 2;
    return original(mesh);
}

inline constexpr int default_segments = 32;

inline Manifold Manifold::Cylinder(double height, double radiusLow, double radiusHigh,
                                   int circularSegments, bool center) {
    const double top = radiusHigh < 0 ? radiusLow : radiusHigh;
    if (!(height > 0 && radiusLow >= 0 && radiusLow + top > 0))
        return failed(Error::InvalidConstruction);
    const auto n =
        static_cast<std::uint32_t>(circularSegments > 2 ? circularSegments : default_segments);
    return standing(radiusLow == top ? make_cylinder(radiusLow, height, n)
                                     : make_cone(radiusLow, top, height, n),
                    height, center);
}

inline Manifold Manifold::Sphere(double radius, int circularSegments) {
    if (!(radius > 0)) return failed(Error::InvalidConstruction);
    const int n = circularSegments > 3 ? circularSegments : default_segments;
    return original(
        make_uv_sphere(radius, static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(n / 2)));
}

inline PlaneRegion Manifold::region(const Polygons& polygons, bool right_half) {
    std::vector<FlatOutline> outlines;
    double most = 0;
    for (const SimplePolygon& polygon : polygons) {
        FlatOutline& outline = outlines.emplace_back();
        for (const vec2& p : polygon) {
            outline.push_back({p.x, p.y});
            most = std::max({most, std::fabs(p.x), std::fabs(p.y)});
        }
    }
    const Solid prism = flat_prism(outlines, OutlineRule::Positive, 0, 1);
    if (!right_half || !(most > 0)) return region_of_prism(prism);
    const std::array<FlatOutline, 1> right{
        {{{0, -2 * most}, {2 * most, -2 * most}, {2 * most, 2 * most}, {0, 2 * most}}}};
    return region_of_prism(evaluate(prism & flat_prism(right, OutlineRule::Odd, 0, 1)));
}

inline Manifold Manifold::Extrude(const Polygons& crossSection, double height, int nDivisions,
                                  double twistDegrees, vec2 scaleTop) {
    const PlaneRegion section = region(crossSection, false);
    if (section.loops.empty() || !(height > 0)) return failed(Error::InvalidConstruction);
    ExtrusionOptions options;
    options.twist = twistDegrees;
    options.scale = {std::max(scaleTop.x, 0.0), std::max(scaleTop.y, 0.0)};
    options.divisions = static_cast<std::uint32_t>(std::max(nDivisions, 0)) + 1;
    return original(extrusion_mesh(section, 0, height, options), Embedding::Check);
}

inline Manifold Manifold::Revolve(const Polygons& crossSection, int circularSegments,
                                  double revolveDegrees) {
    const PlaneRegion section = region(crossSection, true);
    if (section.loops.empty() || !(revolveDegrees > 0)) return failed(Error::InvalidConstruction);
    RevolutionOptions options;
    options.angle = std::min(revolveDegrees, 360.0);
    options.segments = default_segments;
    // Theirs are of the angle, ours of the circle.
    if (circularSegments > 2)
        options.segments =
            static_cast<std::uint32_t>(std::ceil(circularSegments * 360 / options.angle - 1e-9));
    return original(revolution_mesh(section, options), Embedding::Check);
}

inline Manifold Manifold::LevelSet(const std::function<double(vec3)>& sdf, Box bounds,
                                   double edgeLength, double level, double tolerance,
                                   bool canParallel) {
    LevelSetOptions options;
    options.level = level;
    options.threads = canParallel ? 0 : 1;
    // The middle is tried every other time.
    if (tolerance > 0 && tolerance < edgeLength)
        options.root_steps =
            2 * static_cast<std::uint32_t>(std::ceil(std::log2(edgeLength / tolerance)));
    const auto value = [&](const Point3d& p) { return sdf({p[0], p[1], p[2]}); };
    const PolygonMesh surface =
        make_level_set(value, {array(bounds.min), array(bounds.max)}, edgeLength, options);
    return surface.face_count() == 0 ? Manifold() : original(surface);
}

// Booleans ----------------------------------------------------------------------------------------

inline Manifold Manifold::BatchBoolean(const std::vector<Manifold>& manifolds, OpType op) {
    std::vector<Solid> solids;
    for (const Manifold& m : manifolds) {
        if (m.status_ != Error::NoError) return failed(m.status_);
        solids.push_back(m.solid_);
    }
    if (solids.empty()) return {};
    if (op == OpType::Add) return evaluate(Expression::any_of(solids));
    if (op == OpType::Intersect) return evaluate(Expression::all_of(solids));
    return evaluate(solids[0] - Expression::any_of(std::span<const Solid>(solids).subspan(1)));
}

inline Solid Manifold::below(vec3 normal, double offset) {
    const double length = std::hypot(normal.x, normal.y, normal.z);
    return Solid::half_space({normal.x, normal.y, normal.z, -offset * length});
}

inline std::vector<Manifold> Manifold::Decompose() const {
    std::vector<Manifold> parts;
    for (Solid& part : components(solid_)) parts.emplace_back(std::move(part));
    return parts;
}

inline Manifold Manifold::Hull() const {
    if (status_ != Error::NoError || IsEmpty()) return *this;
    return original(make_hull(solid_.to_mesh().points));
}

// Moves and measures ------------------------------------------------------------------------------

inline Manifold Manifold::moved(const AffineMap& map) const {
    if (status_ != Error::NoError || IsEmpty()) return *this;
    return transformed(solid_, map);
}

inline Manifold Manifold::Mirror(vec3 normal) const {
    if (normal == vec3{}) return status_ == Error::NoError ? Manifold() : *this;
    return moved(mirror_map({normal.x, normal.y, normal.z, 0}));
}

inline Manifold Manifold::Rotate(double xDegrees, double yDegrees, double zDegrees) const {
    const AffineMap x = AffineMap::rotation({1, 0, 0}, xDegrees);
    const AffineMap y = AffineMap::rotation({0, 1, 0}, yDegrees);
    return moved(compose(AffineMap::rotation({0, 0, 1}, zDegrees), compose(y, x)));
}

inline Box Manifold::BoundingBox() const {
    if (const auto box = bounds(solid_)) return {vector(box->lo), vector(box->hi)};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

}  // namespace trisect::manifold
// NOLINTEND(readability-identifier-naming)
