// SPDX-License-Identifier: Apache-2.0
//
// Manifold: solids under the names of the library Manifold.
//
// A program that was written for that library is compiled with these headers and linked with
// trisect::manifold in its place. docs/migration.md says what differs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <manifold/common.h>
#include <manifold/mesh.h>
#include <manifold/vec_view.h>

// NOLINTBEGIN(readability-identifier-naming): names are those of another library
namespace manifold {

ExecutionParams& ManifoldParams();

/// Thrown by functions of the library that are not there.
class NotSupported : public std::logic_error {
public:
    explicit NotSupported(const std::string& what) : std::logic_error("not supported: " + what) {}
};

/// What a Manifold holds. Immutable and shared.
class ManifoldNode;

/// An immutable solid, or an error; what is made of an error is that error. Booleans are exact and
/// computed at once, BatchBoolean in one pass. Limits and mistakes of ours are thrown.
class Manifold {
public:
    enum class Error : std::uint8_t {
        NoError,
        NonFiniteVertex,
        NotManifold,
        VertexOutOfBounds,
        PropertiesWrongLength,
        MissingPositionProperties,
        MergeVectorsDifferentLengths,
        MergeIndexOutOfBounds,
        TransformWrongLength,
        RunIndexWrongLength,
        FaceIDWrongLength,
        InvalidConstruction,
        ResultTooLarge,
        InvalidTangents,
        Cancelled
    };

    Manifold();
    Manifold(const MeshGL& mesh);    // NOLINT(google-explicit-constructor): as in their programs
    Manifold(const MeshGL64& mesh);  // NOLINT(google-explicit-constructor)
    explicit Manifold(std::shared_ptr<const ManifoldNode> node);
    [[nodiscard]] MeshGL GetMeshGL(int normalIdx = -1) const;
    [[nodiscard]] MeshGL64 GetMeshGL64(int normalIdx = -1) const;

    static Manifold Tetrahedron();
    static Manifold Cube(vec3 size = vec3(1.0), bool center = false);
    static Manifold Cylinder(double height, double radiusLow, double radiusHigh = -1,
                             int circularSegments = 0, bool center = false);
    static Manifold Sphere(double radius, int circularSegments = 0);
    static Manifold LevelSet(const std::function<double(vec3)>& sdf, Box bounds, double edgeLength,
                             double level = 0, double tolerance = -1, bool canParallel = true);
    static Manifold Extrude(const Polygons& crossSection, double height, int nDivisions = 0,
                            double twistDegrees = 0, vec2 scaleTop = vec2(1.0));
    static Manifold Revolve(const Polygons& crossSection, int circularSegments = 0,
                            double revolveDegrees = 360);
    [[nodiscard]] Polygons Slice(double height = 0) const;
    [[nodiscard]] Polygons Project() const;
    [[nodiscard]] std::vector<Manifold> Decompose() const;
    static Manifold Compose(const std::vector<Manifold>& manifolds);

    [[nodiscard]] Error Status() const;
    [[nodiscard]] Manifold WithContext(const ExecutionContext& context) const;
    [[nodiscard]] bool IsEmpty() const;
    [[nodiscard]] std::size_t NumVert() const;
    [[nodiscard]] std::size_t NumEdge() const;
    [[nodiscard]] std::size_t NumTri() const;
    [[nodiscard]] std::size_t NumProp() const;
    [[nodiscard]] std::size_t NumPropVert() const;
    [[nodiscard]] Box BoundingBox() const;
    [[nodiscard]] int Genus() const;
    /// What theirs would merge within. Nothing here depends on it.
    [[nodiscard]] double GetTolerance() const;
    [[nodiscard]] double GetEpsilon() const;

    [[nodiscard]] double SurfaceArea() const;
    [[nodiscard]] double Volume() const;
    [[nodiscard]] double MinGap(const Manifold& other, double searchLength) const;
    [[nodiscard]] std::vector<RayHit> RayCast(vec3 origin, vec3 endpoint) const;
    [[nodiscard]] std::vector<int> WindingNumber(const std::vector<vec3>& points) const;

    [[nodiscard]] int OriginalID() const;
    [[nodiscard]] Manifold AsOriginal() const;
    static std::uint32_t ReserveIDs(std::uint32_t n);

    [[nodiscard]] Manifold Translate(vec3 by) const;
    [[nodiscard]] Manifold Scale(vec3 by) const;
    [[nodiscard]] Manifold Rotate(double xDegrees, double yDegrees = 0, double zDegrees = 0) const;
    [[nodiscard]] Manifold Mirror(vec3 normal) const;
    [[nodiscard]] Manifold Transform(const mat3x4& m) const;
    [[nodiscard]] Manifold Warp(const std::function<void(vec3&)>& warp) const;
    [[nodiscard]] Manifold WarpBatch(const std::function<void(VecView<vec3>)>& warp) const;
    [[nodiscard]] Manifold SetTolerance(double tolerance) const;
    /// Joins coplanar triangles of one face of an original. \throw NotSupported for a tolerance
    [[nodiscard]] Manifold Simplify(double tolerance = 0) const;

    [[nodiscard]] Manifold Boolean(const Manifold& second, OpType op) const;
    static Manifold BatchBoolean(const std::vector<Manifold>& manifolds, OpType op);
    Manifold operator+(const Manifold& o) const { return Boolean(o, OpType::Add); }
    Manifold operator-(const Manifold& o) const { return Boolean(o, OpType::Subtract); }
    Manifold operator^(const Manifold& o) const { return Boolean(o, OpType::Intersect); }
    Manifold& operator+=(const Manifold& o) { return *this = *this + o; }
    Manifold& operator-=(const Manifold& o) { return *this = *this - o; }
    Manifold& operator^=(const Manifold& o) { return *this = *this ^ o; }
    /// The common part, and the rest.
    [[nodiscard]] std::pair<Manifold, Manifold> Split(const Manifold& cutter) const;
    /// What the normal points to, and the rest.
    [[nodiscard]] std::pair<Manifold, Manifold> SplitByPlane(vec3 normal,
                                                             double originOffset) const;
    [[nodiscard]] Manifold TrimByPlane(vec3 normal, double originOffset) const;
    [[nodiscard]] Manifold MinkowskiSum(const Manifold& o) const;
    [[nodiscard]] Manifold MinkowskiDifference(const Manifold& o) const;

    [[nodiscard]] Manifold SetProperties(
        int numProp,
        const std::function<void(double* to, vec3 position, const double* from)>& property) const;
    [[nodiscard]] Manifold CalculateCurvature(int gaussianIdx, int meanIdx) const;
    [[nodiscard]] Manifold CalculateNormals(int normalIdx = 0, double minSharpAngle = 52.5) const;

    [[nodiscard]] Manifold Refine(int pieces) const;
    [[nodiscard]] Manifold RefineToLength(double length) const;
    [[nodiscard]] Manifold RefineToTolerance(double tolerance) const;
    [[nodiscard]] Manifold SmoothByNormals(int normalIdx = 0) const;
    [[nodiscard]] Manifold SmoothOut(double minSharpAngle = 52.5, double minSmoothness = 0) const;
    static Manifold Smooth(const MeshGL& mesh, const std::vector<Smoothness>& sharpened = {});
    static Manifold Smooth(const MeshGL64& mesh, const std::vector<Smoothness>& sharpened = {});

    [[nodiscard]] Manifold Hull() const;
    static Manifold Hull(const std::vector<Manifold>& manifolds);
    static Manifold Hull(const std::vector<vec3>& points);

    static Manifold ReadOBJ(std::istream& stream);
    bool WriteOBJ(std::ostream& stream) const;

    /// Whether rounding turned no triangle over.
    [[nodiscard]] bool MatchesTriNormals() const;
    [[nodiscard]] bool HasSimpleProps() const;
    [[nodiscard]] std::size_t NumDegenerateTris() const;

    /// The way on to the rest of Trisect: the node has a Solid.
    [[nodiscard]] const std::shared_ptr<const ManifoldNode>& node() const { return node_; }

private:
    std::shared_ptr<const ManifoldNode> node_;
};

}  // namespace manifold
// NOLINTEND(readability-identifier-naming)
