// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/embedding.h>

#include <algorithm>
#include <array>

#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {

namespace {

// Meshes of needles may have a quadratic number of pairs of boxes; they are not worth the wait.
constexpr std::uint64_t pairs_of_a_triangle = 200;
constexpr std::uint64_t least_pairs = 1'000'000;

// What concerns points alone: nothing that a boundary consists of.
constexpr std::array harmless{DefectKind::DuplicatePoint, DefectKind::UnusedPoint,
                              DefectKind::EmptyMesh};

}  // namespace

bool is_embedded(const LatticeMesh& mesh) {
    ValidateOptions options;
    options.list_limit = 0;
    options.pair_limit = std::max(least_pairs, pairs_of_a_triangle * mesh.triangles.size());
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

}  // namespace trisect
