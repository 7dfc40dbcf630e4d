// SPDX-License-Identifier: Apache-2.0
//
// Engine: what a boolean library must offer to be measured. Each is linked with run_engine.cpp into
// a program of its own, so that peak memory is its own and a crash stops nobody else.
#pragma once

#include <any>
#include <array>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <trisect/brep/polygon_mesh.h>

#include "scene.h"

namespace bench {

enum class Measure { Volume, Area, Bounds };

class Engine {
public:
    /// A solid in the library's own form; cheap to copy.
    using Body = std::any;

    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual std::string version() const = 0;

    [[nodiscard]] virtual Body import(const trisect::PolygonMesh& mesh) = 0;
    /// The same of many at once.
    [[nodiscard]] virtual std::vector<Body> import_all(
        std::span<const trisect::PolygonMesh> meshes) {
        std::vector<Body> out;
        out.reserve(meshes.size());
        for (const trisect::PolygonMesh& m : meshes) out.push_back(import(m));
        return out;
    }
    /// Does for a solid, once, what would otherwise be left to the first operations with it.
    virtual void index(const Body& /*body*/) {}
    /// The union of `first`, combined with the union of `second`; all of `first` combined where
    /// that is empty, in a difference the first one with the union of the others. Computed when
    /// this returns. May use its operands up. \pre `first` is not empty.
    [[nodiscard]] virtual Body evaluate(std::span<const Body> first, std::span<const Body> second,
                                        Operation operation) = 0;
    /// What of a solid lies below all planes, a x + b y + c z + d <= 0; computed when this returns.
    [[nodiscard]] virtual Body trimmed(const Body& /*body*/,
                                       std::span<const std::array<double, 4>> /*planes*/) {
        throw std::runtime_error("cuts by no half-spaces");
    }
    /// Triangles with rounded coordinates.
    [[nodiscard]] virtual trisect::PolygonMesh to_mesh(const Body& body) = 0;
    /// Makes the boundary representation and drops it; false when the engine has none to make.
    virtual bool assemble(const Body& /*body*/) { return false; }
    /// Measures a solid, one value; false when the engine does not.
    virtual bool measure(const Body& /*body*/, Measure /*which*/) { return false; }
    /// What the last evaluate() counted.
    [[nodiscard]] virtual nlohmann::json counters() const { return nlohmann::json::object(); }
};

struct EngineOptions {
    int threads = 1;        ///< that it may use
    int leaf_polygons = 0;  ///< Trisect's EvaluateOptions::leaf_polygons, 0 for the default
};

/// \throw std::exception when the engine cannot do that.
[[nodiscard]] std::unique_ptr<Engine> make_engine(const EngineOptions& options);

}  // namespace bench
