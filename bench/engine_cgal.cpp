// SPDX-License-Identifier: Apache-2.0
//
// CGAL's corefinement with exact points. Unions of many solids go pairwise up a balanced tree.

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "corefinement.h"
#include "engine.h"

namespace bench {

namespace {

using Handle = std::shared_ptr<corefinement::Polyhedron>;

class CgalEngine final : public Engine {
public:
    std::string name() const override { return "cgal"; }
    std::string version() const override { return corefinement::version(); }

    Body import(const trisect::PolygonMesh& mesh) override { return corefinement::import(mesh); }

    Body evaluate(std::span<const Body> first, std::span<const Body> second,
                  Operation operation) override {
        if (operation == Operation::ExclusiveOr) throw std::runtime_error("no exclusive or");
        if (second.empty()) {
            const auto type = type_of(operation);
            if (operation != Operation::Difference || first.size() == 1)
                return combined(first, type);
            return corefinement::combine(*united(first.first(1)), *united(first.subspan(1)), type);
        }
        const Handle a = united(first);
        return corefinement::combine(*a, *united(second), type_of(operation));
    }

    trisect::PolygonMesh to_mesh(const Body& body) override {
        return corefinement::to_mesh(*std::any_cast<const Handle&>(body));
    }

private:
    static corefinement::Operation type_of(Operation operation) {
        if (operation == Operation::Union) return corefinement::Operation::Union;
        return operation == Operation::Intersection ? corefinement::Operation::Intersection
                                                    : corefinement::Operation::Difference;
    }

    static Handle united(std::span<const Body> bodies) {
        return combined(bodies, corefinement::Operation::Union);
    }
    static Handle combined(std::span<const Body> bodies, corefinement::Operation type) {
        if (bodies.size() == 1) return std::any_cast<const Handle&>(bodies[0]);
        const std::size_t half = bodies.size() / 2;
        const Handle a = combined(bodies.first(half), type);
        const Handle b = combined(bodies.subspan(half), type);
        return corefinement::combine(*a, *b, type);
    }
};

}  // namespace

std::unique_ptr<Engine> make_engine(const EngineOptions& options) {
    if (options.threads != 1) throw std::runtime_error("corefinement runs on one thread");
    return std::make_unique<CgalEngine>();
}

}  // namespace bench
