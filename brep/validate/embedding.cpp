// SPDX-License-Identifier: Apache-2.0
//
// Nearly every mesh that is embedded is plainly manifold by the names of its corners
// (manifold_mesh.h). Others are validated like any input.

#include <trisect/brep/validate/embedding.h>

#include <algorithm>
#include <array>
#include <optional>

#include <trisect/brep/contact/embedding_counters.h>
#include <trisect/brep/validate/manifold_mesh.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {

namespace {

// What concerns points alone: nothing that a boundary consists of.
constexpr std::array harmless{DefectKind::DuplicatePoint, DefectKind::UnusedPoint,
                              DefectKind::EmptyMesh};

bool is_valid(const LatticeMesh& mesh) {
    ValidateOptions options;
    options.list_limit = 0;
    options.until_first = true;
    options.pair_limit = detail::pair_limit_of(mesh.triangles.size());
    try {
        const ValidationReport report = validate(mesh, options);
        for (std::size_t k = 0; k < defect_kind_count; ++k) {
            const auto kind = static_cast<DefectKind>(k);
            if (report.count(kind) != 0 && std::ranges::find(harmless, kind) == harmless.end())
                return false;
        }
        return true;
    } catch (const LimitError&) {
        detail::check_stop(0);  // a limit of the caller's is no answer
        return false;
    }
}

// By a glance at each triangle.
bool is_simple(const detail::ManifoldMesh& mesh) {
    if (mesh.is_starlike()) {
        ++detail::embedding_counters().starlike;
        return true;
    }
    if (mesh.is_height_field()) {
        ++detail::embedding_counters().height_fields;
        return true;
    }
    return false;
}

std::optional<bool> is_embedded_manifold(const LatticeMesh& mesh) {
    const auto manifold = detail::ManifoldMesh::of(mesh.points, mesh.triangles);
    if (!manifold) return std::nullopt;
    if (is_simple(*manifold)) return true;
    const std::optional<bool> nested = manifold->are_shells_nested();
    if (!nested || !*nested) return nested;
    return manifold->has_no_contact();
}

}  // namespace

bool is_embedded(const LatticeMesh& mesh) {
    const std::optional<bool> answer = is_embedded_manifold(mesh);
    return answer ? *answer : is_valid(mesh);
}

bool are_embedded(const LatticeMesh& mesh, std::span<const std::uint32_t> triangles) {
    const auto manifold = detail::ManifoldMesh::of(mesh.points, mesh.triangles);
    if (manifold && is_simple(*manifold)) return true;
    const std::optional<bool> answer =
        manifold ? manifold->has_no_contact(triangles) : std::nullopt;
    return answer ? *answer : is_valid(mesh);
}

}  // namespace trisect
