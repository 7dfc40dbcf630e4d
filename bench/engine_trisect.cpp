// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <oneapi/tbb/global_control.h>

#include <trisect/brep/brep.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solids_of_meshes.h>
#include <trisect/kernel/diagnostics.h>

#include "engine.h"

namespace bench {

namespace {

using trisect::Expression;
using trisect::Solid;

class TrisectEngine final : public Engine {
public:
    explicit TrisectEngine(const EngineOptions& options) {
        // One thread is what the options below say, so the scheduler is not even loaded.
        if (options.threads > 1)
            threads_.emplace(oneapi::tbb::global_control::max_allowed_parallelism,
                             static_cast<std::size_t>(options.threads));
        if (options.leaf_polygons > 0)
            options_.leaf_polygons = static_cast<std::uint32_t>(options.leaf_polygons);
        options_.threads = static_cast<std::uint32_t>(options.threads);
        import_.import.threads = options_.threads;
    }

    std::string name() const override { return "trisect"; }
    std::string version() const override { return TRISECT_BENCH_VERSION; }

    Body import(const trisect::PolygonMesh& mesh) override {
        return Solid::from_mesh(mesh, import_);
    }

    std::vector<Body> import_all(std::span<const trisect::PolygonMesh> meshes) override {
        std::vector<Body> out;
        out.reserve(meshes.size());
        for (Solid& s : trisect::solids_of_meshes(meshes, import_)) out.emplace_back(std::move(s));
        return out;
    }

    void index(const Body& body) override { solid(body).refine(options_.threads); }

    Body evaluate(std::span<const Body> first, std::span<const Body> second,
                  Operation operation) override {
        const trisect::Diagnostics<trisect::EvaluateCounters> diagnostics;
        trisect::EvaluateReport report;
        Solid result = trisect::evaluate(expression(first, second, operation), options_, &report);
        counters_ = diagnostics.counters();
        depth_ = report.depth;
        return result;
    }

    Body trimmed(const Body& body, std::span<const std::array<double, 4>> planes) override {
        Expression all = solid(body);
        for (const auto& p : planes) all = all & Solid::half_space(p);
        const trisect::Diagnostics<trisect::EvaluateCounters> diagnostics;
        trisect::EvaluateReport report;
        Solid result = trisect::evaluate(all, options_, &report);
        counters_ = diagnostics.counters();
        depth_ = report.depth;
        return result;
    }

    trisect::PolygonMesh to_mesh(const Body& body) override {
        return solid(body).to_mesh(options_.threads);
    }

    bool assemble(const Body& body) override {
        const trisect::Brep brep = solid(body).to_brep();
        return true;
    }

    bool measure(const Body& body, Measure which) override {
        const Solid& s = solid(body);
        if (which == Measure::Volume) static_cast<void>(trisect::volume(s));
        if (which == Measure::Area) static_cast<void>(trisect::area(s));
        if (which == Measure::Bounds) static_cast<void>(trisect::bounds(s));
        return true;
    }

    nlohmann::json counters() const override {
        return {{"cells", counters_.cells},
                {"shared_cells", counters_.shared_cells},
                {"constant_cells", counters_.constant_cells},
                {"mixed_leaves", counters_.mixed_leaves},
                {"filtered_leaves", counters_.filtered_leaves},
                {"exact_leaves", counters_.exact_leaves},
                {"conforming_pairs", counters_.conforming_pairs},
                {"halved_cells", counters_.halved_cells},
                {"embedded_cells", counters_.embedded_cells},
                {"listed_polygons", counters_.listed_polygons},
                {"pairs_boxes", counters_.pairs_boxes},
                {"pairs_cutting", counters_.pairs_cutting},
                {"doubtful_pairs", counters_.doubtful_pairs},
                {"pieces", counters_.pieces},
                {"traces", counters_.traces},
                {"traces_retried", counters_.traces_retried},
                {"traces_near", counters_.traces_near},
                {"depth", depth_}};
    }

private:
    static const Solid& solid(const Body& body) { return *std::any_cast<Solid>(&body); }

    static std::vector<Expression> terms_of(std::span<const Body> bodies) {
        std::vector<Expression> terms;
        terms.reserve(bodies.size());
        for (const Body& b : bodies) terms.emplace_back(solid(b));
        return terms;
    }
    static Expression any_of(std::span<const Body> bodies) {
        return Expression::any_of(terms_of(bodies));
    }
    static Expression all_of(std::span<const Body> bodies) {
        return Expression::all_of(terms_of(bodies));
    }

    static Expression exclusive(std::span<const Body> bodies) {
        const std::vector<Expression> terms = terms_of(bodies);
        Expression all = terms[0];
        for (std::size_t i = 1; i < terms.size(); ++i) all = all ^ terms[i];
        return all;
    }

    static Expression expression(std::span<const Body> first, std::span<const Body> second,
                                 Operation operation) {
        if (second.empty()) {
            if (operation == Operation::ExclusiveOr) return exclusive(first);
            if (operation == Operation::Intersection) return all_of(first);
            if (operation == Operation::Union || first.size() == 1) return any_of(first);
            return any_of(first.first(1)) - any_of(first.subspan(1));
        }
        const Expression a = any_of(first);
        const Expression b = any_of(second);
        if (operation == Operation::Union) return a | b;
        if (operation == Operation::Intersection) return a & b;
        if (operation == Operation::ExclusiveOr) return a ^ b;
        return a - b;
    }

    std::optional<oneapi::tbb::global_control> threads_;
    trisect::SolidOptions import_;
    trisect::EvaluateOptions options_;
    trisect::EvaluateCounters counters_;
    int depth_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_engine(const EngineOptions& options) {
    return std::make_unique<TrisectEngine>(options);
}

}  // namespace bench
