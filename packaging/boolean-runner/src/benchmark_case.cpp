// SPDX-License-Identifier: Apache-2.0
#include "benchmark_case.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace runner {
namespace {

using nlohmann::json;
using trisect::Expression;
using trisect::Solid;

class Timer {
public:
    [[nodiscard]] double milliseconds() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
};

/// The words of the protocol.
const char* status_of(const trisect::Error& error) {
    switch (error.code()) {
        case trisect::ErrorCode::InvalidSolid:
            return "invalid_input";
        case trisect::ErrorCode::Unsupported:
            return "unsupported";
        default:
            return "crash";
    }
}

class Case {
public:
    Case(const json& request, const Settings& settings)
        : folder_(request.at("out_dir").get<std::string>()), settings_(settings) {}

    /// The result of one operation. \throw std::exception where it fails.
    json run(const json& operation) {
        const auto name = operation.at("op").get<std::string>();
        return name == "load-mesh" ? load(operation.at("path").get<std::string>())
                                   : combine(name, operation.at("args"));
    }

private:
    json load(const std::string& path) {
        json result;
        const Timer reading;
        const trisect::PolygonMesh mesh = trisect::read_mesh(path);
        result["io_ms"] = reading.milliseconds();
        const Timer importing;
        solids_.push_back(Solid::from_mesh(mesh, settings_.import));
        result["import_ms"] = importing.milliseconds();
        result["file"] = write(mesh);
        return result;
    }

    json combine(const std::string& name, const json& args) {
        json result;
        const Expression wanted = expression(name, operands(args));
        const Timer evaluating;
        solids_.push_back(trisect::evaluate(wanted, settings_.evaluate));
        result["operation_ms"] = evaluating.milliseconds();
        const Timer exporting;
        const trisect::PolygonMesh mesh = solids_.back().to_mesh(settings_.evaluate.threads);
        result["export_ms"] = exporting.milliseconds();
        result["file"] = write(mesh);
        return result;
    }

    [[nodiscard]] std::vector<Expression> operands(const json& args) const {
        std::vector<Expression> terms;
        for (const json& arg : args) terms.emplace_back(solids_.at(arg.get<std::size_t>()));
        if (terms.empty()) throw std::invalid_argument("an operation without operands");
        return terms;
    }

    static Expression expression(const std::string& name, const std::vector<Expression>& terms) {
        if (name == "boolean-union") return Expression::any_of(terms);
        if (name == "boolean-intersection") return Expression::all_of(terms);
        if (name != "boolean-difference") {
            throw trisect::UnsupportedError("an operation of an unknown name: " + name);
        }
        if (terms.size() == 1) return terms[0];
        return terms[0] - Expression::any_of(std::span(terms).subspan(1));
    }

    [[nodiscard]] std::string write(const trisect::PolygonMesh& mesh) const {
        const auto number = solids_.size() - 1;
        const auto path = (folder_ / ("op_" + std::to_string(number) + ".obj")).string();
        trisect::write_mesh(path, mesh);
        return path;
    }

    std::filesystem::path folder_;
    const Settings& settings_;
    std::vector<Solid> solids_;  // that of each operation so far
};

template <typename Work>
json guarded(const Work& work) {
    json result;
    const Timer all;
    try {
        result = work();
        result["status"] = "success";
    } catch (const trisect::Error& error) {
        result = {{"status", status_of(error)}, {"error", error.what()}};
    } catch (const std::exception& error) {
        result = {{"status", "crash"}, {"error", error.what()}};
    }
    result["debug_total_ms"] = all.milliseconds();
    return result;
}

}  // namespace

json run_case(const json& request, const Settings& settings) {
    const Timer all;
    json done = json::array();
    json result = guarded([&] {
        Case one(request, settings);
        for (const json& operation : request.at("operations")) {
            done.push_back(guarded([&] { return one.run(operation); }));
            if (done.back()["status"] != "success") break;
        }
        return json::object();
    });
    if (!done.empty() && done.back()["status"] != "success")
        result["status"] = done.back()["status"];
    result.erase("debug_total_ms");
    result["duration_ms"] = all.milliseconds();
    result["ops"] = std::move(done);
    return result;
}

}  // namespace runner
