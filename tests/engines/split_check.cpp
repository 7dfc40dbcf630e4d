// SPDX-License-Identifier: Apache-2.0
#include "split_check.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/split.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

namespace engines {

namespace {

using trisect::EvaluateAllCounters;
using trisect::EvaluateOptions;
using trisect::Expression;
using trisect::Solid;

struct NamedMesh {
    trisect::PolygonMesh mesh;
    std::vector<trisect::FaceSource> sources;
};

// Nothing where the set is unbounded.
std::optional<NamedMesh> mesh_of(const Solid& solid) {
    try {
        trisect::MeshMap map;
        NamedMesh out;
        out.mesh = solid.to_mesh(map, 1);
        out.sources = std::move(map.source);
        return out;
    } catch (const trisect::UnsupportedError&) {
        return std::nullopt;
    }
}

// Likewise where its boundary is.
std::optional<std::string> volume_of(const Solid& solid) {
    try {
        return exact_volume(solid).to_string();
    } catch (const trisect::UnsupportedError&) {
        return std::nullopt;
    }
}

std::optional<trisect::ExactRational> bounded_volume(const Solid& solid) {
    if (!mesh_of(solid)) return std::nullopt;
    return exact_volume(solid);
}

// But for the numbers of operands: each half-space that is made has one of its own.
bool are_named_otherwise(std::span<const trisect::FaceSource> a,
                         std::span<const trisect::FaceSource> b) {
    std::map<std::uint32_t, std::uint32_t> names;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (names.emplace(a[i].operand, b[i].operand).first->second != b[i].operand ||
            a[i].face != b[i].face)
            return true;
    return false;
}

// Whether parts have the volume of the whole together, if that is bounded.
std::string sum_difference(std::span<const Solid> parts, const Solid& whole) {
    const auto volume = bounded_volume(whole);
    if (!volume) return {};
    trisect::ExactRational sum;
    for (const Solid& part : parts) {
        const auto of_part = bounded_volume(part);
        if (!of_part) return "a part of a bounded set is unbounded";
        sum = sum + *of_part;
    }
    return sum == *volume ? "" : "the volumes of the parts are not that of the whole";
}

// With one normal, each further along it.
bool are_ascending_planes(std::span<const std::array<double, 4>> planes) {
    for (std::size_t i = 1; i < planes.size(); ++i)
        if (!std::equal(planes[i].begin(), planes[i].begin() + 3, planes[i - 1].begin()) ||
            planes[i][3] >= planes[i - 1][3])
            return false;
    return true;
}

constexpr std::array<std::uint32_t, 3> thread_counts{1, 2, 4};

EvaluateOptions with_threads(EvaluateOptions options, std::uint32_t threads) {
    options.threads = threads;
    return options;
}

}  // namespace

std::string solids_difference(const Solid& solid, const Solid& expected, bool with_same_planes) {
    if (solid.is_empty() != expected.is_empty()) return "empty, or not";
    if (solid.is_whole_space() != expected.is_whole_space()) return "whole space, or not";
    const bool is_constant = solid.is_empty() || solid.is_whole_space();
    if (with_same_planes && !is_constant && !(solid.lattice() == expected.lattice()))
        return "another lattice";
    const auto mesh = mesh_of(solid);
    const auto wanted = mesh_of(expected);
    if (mesh.has_value() != wanted.has_value()) return "unbounded, or not";
    if (mesh && mesh->mesh.points != wanted->mesh.points) return "other vertices";
    if (mesh && mesh->mesh.corners != wanted->mesh.corners) return "other triangles";
    if (mesh && with_same_planes && mesh->sources != wanted->sources) return "other names of faces";
    if (mesh && are_named_otherwise(mesh->sources, wanted->sources)) return "faces named otherwise";
    if (volume_of(solid) != volume_of(expected)) return "another volume";
    return {};
}

std::string split_difference(const Solid& a, const Solid& b, const EvaluateOptions& options,
                             std::uint64_t& shared) {
    std::optional<trisect::SplitSolid> first;
    for (const std::uint32_t threads : thread_counts) {
        const trisect::Diagnostics<EvaluateAllCounters> diagnostics;
        trisect::SplitSolid parts = split(a, b, with_threads(options, threads));
        const auto counters = diagnostics.counters();
        if (counters.results != 2 || counters.evaluations == 0 || counters.evaluations > 2)
            return "wrong counters";
        if (!first) {
            shared += counters.evaluations == 1 ? 1 : 0;
            first = std::move(parts);
            continue;
        }
        if (auto why = solids_difference(parts.common, first->common); !why.empty())
            return "common part by several threads: " + why;
        if (auto why = solids_difference(parts.rest, first->rest); !why.empty())
            return "rest by several threads: " + why;
    }
    const EvaluateOptions one = with_threads(options, 1);
    if (auto why = solids_difference(first->common, evaluate(a & b, one)); !why.empty())
        return "common part: " + why;
    if (auto why = solids_difference(first->rest, evaluate(a - b, one)); !why.empty())
        return "rest: " + why;
    return sum_difference(std::array{first->common, first->rest}, a);
}

std::string planes_difference(const Solid& solid, std::span<const std::array<double, 4>> planes,
                              const EvaluateOptions& options, std::uint64_t& shared) {
    const EvaluateOptions one = with_threads(options, 1);
    const trisect::Diagnostics<EvaluateAllCounters> diagnostics;
    const std::vector<Solid> parts = split(solid, planes, one);
    shared +=
        parts.size() - std::min<std::size_t>(parts.size(), diagnostics.counters().evaluations);
    if (parts.size() != planes.size() + 1) return "wrong number of parts";
    const std::vector<Solid> again = split(solid, planes, with_threads(options, 2));
    std::vector<Solid> half_spaces;
    for (const auto& plane : planes) half_spaces.push_back(Solid::half_space(plane));
    std::vector<Expression> below;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (auto why = solids_difference(again[i], parts[i], false); !why.empty())
            return "part " + std::to_string(i) + " by two threads: " + why;
        Expression wanted = solid;
        if (i < planes.size()) wanted = wanted & half_spaces[i];
        if (!below.empty()) wanted = wanted - Expression::any_of(below);
        if (i < planes.size()) below.emplace_back(half_spaces[i]);
        Solid alone = evaluate(wanted, one);
        if (!evaluate(alone ^ parts[i], one).is_empty())
            return "part " + std::to_string(i) + " is another set";
        if (i > 0 && i < planes.size())
            alone = evaluate((solid & half_spaces[i]) - half_spaces[i - 1], one);
        if (i > 0 && i == planes.size()) alone = evaluate(solid - half_spaces[i - 1], one);
        if (planes.size() > 1 && !are_ascending_planes(planes)) continue;
        if (auto why = solids_difference(parts[i], alone, false); !why.empty())
            return "part " + std::to_string(i) + ": " + why;
    }
    return sum_difference(parts, solid);
}

std::string all_difference(const Solid& a, const Solid& b, const EvaluateOptions& options,
                           std::uint64_t& shared) {
    const EvaluateOptions one = with_threads(options, 1);
    const Expression p = a;
    const Expression q = b;
    const std::vector<Expression> formulas{p - q, p | q, p & q,  ~p & q,
                                           p ^ q, q - p, ~p | q, q & p};
    const trisect::Diagnostics<EvaluateAllCounters> diagnostics;
    std::vector<trisect::EvaluateReport> reports;
    const std::vector<Solid> solids = evaluate_all(formulas, one, &reports);
    if (reports.size() != formulas.size()) return "wrong number of reports";
    shared += formulas.size() - diagnostics.counters().evaluations;
    for (std::size_t i = 0; i < formulas.size(); ++i)
        if (auto why = solids_difference(solids[i], evaluate(formulas[i], one)); !why.empty())
            return "formula " + std::to_string(i) + ": " + why;
    return {};
}

reference::Operand divided(const reference::Operand& operand) {
    reference::Operand out;
    const auto sum = [](const reference::LatticePoint& p, const reference::LatticePoint& q) {
        return reference::LatticePoint{p[0] + q[0], p[1] + q[1], p[2] + q[2]};
    };
    for (const reference::Triangle& t : operand) {
        std::array<reference::LatticePoint, 3> middle;
        for (std::size_t i = 0; i < 3; ++i) middle[i] = sum(t[i], t[(i + 1) % 3]);
        for (std::size_t i = 0; i < 3; ++i)
            out.push_back({sum(t[i], t[i]), middle[i], middle[(i + 2) % 3]});
        out.push_back(middle);
    }
    return out;
}

}  // namespace engines
