// SPDX-License-Identifier: Apache-2.0
//
// Manifold (https://github.com/elalish/manifold) through its public interface.

#include <manifold/manifold.h>
#include <manifold/version.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef TRISECT_BENCH_MANIFOLD_PARALLEL
#include <oneapi/tbb/global_control.h>
#endif

#include "engine.h"

namespace bench {

namespace {

using manifold::Manifold;
using manifold::MeshGL64;
using manifold::OpType;

/// Forces the evaluation, which is lazy.
Manifold evaluated(Manifold m) {
    if (m.Status() != Manifold::Error::NoError)
        throw std::runtime_error("status " + std::to_string(static_cast<int>(m.Status())));
    static_cast<void>(m.NumTri());
    return m;
}

class ManifoldEngine final : public Engine {
public:
#ifdef TRISECT_BENCH_MANIFOLD_PARALLEL
    explicit ManifoldEngine(int threads)
        : threads_(oneapi::tbb::global_control::max_allowed_parallelism,
                   static_cast<std::size_t>(threads)) {}
    std::string name() const override { return "manifold-parallel"; }
#else
    explicit ManifoldEngine(int threads) {
        if (threads != 1) throw std::runtime_error("this Manifold was built serial");
    }
    std::string name() const override { return "manifold"; }
#endif
    std::string version() const override {
        return std::to_string(MANIFOLD_VERSION_MAJOR) + "." +
               std::to_string(MANIFOLD_VERSION_MINOR) + "." +
               std::to_string(MANIFOLD_VERSION_PATCH);
    }

    Body import(const trisect::PolygonMesh& mesh) override {
        MeshGL64 arrays;
        arrays.numProp = 3;
        arrays.vertProperties.reserve(3 * mesh.points.size());
        for (const trisect::Point3d& p : mesh.points)
            arrays.vertProperties.insert(arrays.vertProperties.end(), p.begin(), p.end());
        arrays.triVerts.assign(mesh.corners.begin(), mesh.corners.end());
        return evaluated(Manifold(arrays));
    }

    Body evaluate(std::span<const Body> first, std::span<const Body> second,
                  Operation operation) override {
        if (operation == Operation::ExclusiveOr)
            return evaluated(second.empty() ? exclusive(first)
                                            : exclusive(united(first), united(second)));
        if (second.empty()) return evaluated(combined(first, type_of(operation)));
        const Manifold a = united(first);
        return evaluated(a.Boolean(united(second), type_of(operation)));
    }

    /// What is kept lies on the side that the normal points to, so it is turned.
    Body trimmed(const Body& body, std::span<const std::array<double, 4>> planes) override {
        Manifold m = std::any_cast<const Manifold&>(body);
        for (const auto& p : planes) {
            const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            m = m.TrimByPlane({-p[0], -p[1], -p[2]}, p[3] / length);
        }
        return evaluated(m);
    }

    bool measure(const Body& body, Measure which) override {
        const auto& m = std::any_cast<const Manifold&>(body);
        if (which == Measure::Volume) static_cast<void>(m.Volume());
        if (which == Measure::Area) static_cast<void>(m.SurfaceArea());
        if (which == Measure::Bounds) static_cast<void>(m.BoundingBox());
        return true;
    }

    /// The merge vectors join vertices that are there several times for the sake of properties.
    trisect::PolygonMesh to_mesh(const Body& body) override {
        const MeshGL64 arrays = std::any_cast<const Manifold&>(body).GetMeshGL64();
        trisect::PolygonMesh mesh;
        const std::size_t n = arrays.vertProperties.size() / arrays.numProp;
        mesh.points.resize(n);
        std::vector<std::uint32_t> vertex(n);
        for (std::size_t i = 0; i < n; ++i) {
            vertex[i] = static_cast<std::uint32_t>(i);
            for (std::size_t k = 0; k < 3; ++k)
                mesh.points[i][k] = arrays.vertProperties[i * arrays.numProp + k];
        }
        for (std::size_t i = 0; i < arrays.mergeFromVert.size(); ++i)
            vertex[arrays.mergeFromVert[i]] = static_cast<std::uint32_t>(arrays.mergeToVert[i]);
        const std::size_t triangles = arrays.triVerts.size() / 3;
        mesh.corners.resize(3 * triangles);
        mesh.face_begin.resize(triangles + 1);
        for (std::size_t i = 0; i < mesh.corners.size(); ++i)
            mesh.corners[i] = vertex[arrays.triVerts[i]];
        for (std::size_t i = 0; i <= triangles; ++i)
            mesh.face_begin[i] = static_cast<std::uint32_t>(3 * i);
        return mesh;
    }

private:
    static OpType type_of(Operation operation) {
        if (operation == Operation::Union) return OpType::Add;
        return operation == Operation::Intersection ? OpType::Intersect : OpType::Subtract;
    }

    // There is no such operation; halves are balanced, which takes least.
    static Manifold exclusive(const Manifold& a, const Manifold& b) { return (a - b) + (b - a); }
    static Manifold exclusive(std::span<const Body> bodies) {
        if (bodies.size() == 1) return std::any_cast<const Manifold&>(bodies[0]);
        const std::size_t half = bodies.size() / 2;
        return exclusive(exclusive(bodies.first(half)), exclusive(bodies.subspan(half)));
    }
    static Manifold united(std::span<const Body> bodies) { return combined(bodies, OpType::Add); }
    static Manifold combined(std::span<const Body> bodies, OpType type) {
        if (bodies.size() == 1) return std::any_cast<const Manifold&>(bodies[0]);
        std::vector<Manifold> all;
        all.reserve(bodies.size());
        for (const Body& b : bodies) all.push_back(std::any_cast<const Manifold&>(b));
        return Manifold::BatchBoolean(all, type);
    }

#ifdef TRISECT_BENCH_MANIFOLD_PARALLEL
    oneapi::tbb::global_control threads_;
#endif
};

}  // namespace

std::unique_ptr<Engine> make_engine(const EngineOptions& options) {
    return std::make_unique<ManifoldEngine>(options.threads);
}

}  // namespace bench
