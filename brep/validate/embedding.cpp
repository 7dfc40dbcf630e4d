// SPDX-License-Identifier: Apache-2.0
//
// Nearly every mesh that is embedded is plainly manifold by the names of its corners. Then the
// twins of its half-edges give its shells and sheets in one pass each, and triangles are compared
// only where sheets come together. What is not that plain is validated like any input.

#include <trisect/brep/validate/embedding.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/import/volume_sign.h>
#include <trisect/brep/validate/sheet_grid.h>
#include <trisect/brep/validate/sheets.h>
#include <trisect/brep/validate/shell_nesting.h>
#include <trisect/brep/validate/triangle_contact.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/brep/validate/twins.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {

namespace {

using detail::TriangleTree;
using Triangle = std::array<std::uint32_t, 3>;

// Meshes of needles may have a quadratic number of pairs of boxes; they are not worth the wait.
constexpr std::uint64_t pairs_of_a_triangle = 200;
constexpr std::uint64_t least_pairs = 1'000'000;

std::uint64_t pair_limit_of(const LatticeMesh& mesh) {
    return std::max(least_pairs, pairs_of_a_triangle * mesh.triangles.size());
}

// What concerns points alone: nothing that a boundary consists of.
constexpr std::array harmless{DefectKind::DuplicatePoint, DefectKind::UnusedPoint,
                              DefectKind::EmptyMesh};

bool is_valid(const LatticeMesh& mesh) {
    ValidateOptions options;
    options.list_limit = 0;
    options.pair_limit = pair_limit_of(mesh);
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

// A mesh whose twins are known. Answers are nothing where only validation can give them.
class ManifoldMesh {
public:
    ManifoldMesh(const LatticeMesh& mesh, const detail::Twins& twins,
                 std::span<const std::uint32_t> sheets)
        : mesh_(mesh), shells_(twins.shells()), sheets_(sheets) {}

    std::optional<bool> is_embedded() const {
        const std::optional<bool> nested = are_shells_nested();
        if (!nested || !*nested) return nested;
        return has_no_contact();
    }

private:
    // Winding numbers change between 0 and 1 across every shell.
    std::optional<bool> are_shells_nested() const {
        if (shells_.count == 1) return detail::volume_sign(mesh_.points, mesh_.triangles) > 0;
        std::vector<std::vector<Triangle>> triangles(shells_.count);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
            triangles[shells_.of_triangle[t]].push_back(mesh_.triangles[t]);
        const std::vector<bool> is_closed(shells_.count, true);
        TriangleTree tree(mesh_.points, mesh_.triangles, sheets_);
        detail::ShellNesting nesting(mesh_.points, mesh_.triangles, shells_.of_triangle, is_closed,
                                     tree);
        for (std::uint32_t s = 0; s < shells_.count; ++s) {
            const int sign = detail::volume_sign(mesh_.points, triangles[s]);
            const std::optional<int> winding = nesting.winding_outside(s, triangles[s]);
            if (sign == 0 || !winding) return std::nullopt;
            if (*winding != (sign > 0 ? 0 : 1)) return false;
        }
        return true;
    }

    enum class Found : std::uint8_t { Nothing, Contact, Unclear };

    std::optional<bool> has_no_contact() const {
        std::vector<Triangle> near;
        std::vector<std::uint32_t> sheets;
        for (const std::uint32_t t :
             detail::triangles_near_others(mesh_.points, mesh_.triangles, sheets_)) {
            near.push_back(mesh_.triangles[t]);
            sheets.push_back(sheets_[t]);
        }
        TriangleTree tree(mesh_.points, near, sheets);
        Found found = Found::Nothing;
        std::uint64_t pairs = 0;
        const std::uint64_t limit = pair_limit_of(mesh_);
        tree.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
            detail::check_stop();
            found = ++pairs > limit ? Found::Contact : relation_of(near[a], near[b]);
            return found == Found::Nothing;
        });
        if (found == Found::Unclear) return std::nullopt;
        return found == Found::Nothing;
    }

    [[nodiscard]] Found relation_of(const Triangle& first, const Triangle& second) const {
        if (has_equal_corners(first, second)) return Found::Unclear;
        const auto kind = detail::find_contact(mesh_.points, first, second).kind;
        return kind == detail::ContactKind::None ? Found::Nothing : Found::Contact;
    }

    // Corners of different names at one place.
    [[nodiscard]] bool has_equal_corners(const Triangle& a, const Triangle& b) const {
        for (const std::uint32_t v : a)
            for (const std::uint32_t w : b)
                if (v != w && mesh_.points[v] == mesh_.points[w]) return true;
        return false;
    }

    const LatticeMesh& mesh_;
    detail::Twins::Shells shells_;
    std::span<const std::uint32_t> sheets_;
};

std::optional<bool> is_embedded_manifold(const LatticeMesh& mesh) {
    if (mesh.triangles.empty()) return std::nullopt;
    detail::check_stop(mesh.triangles.size());
    const auto twins = detail::Twins::of(mesh.points.size(), mesh.triangles);
    if (!twins) return std::nullopt;
    const auto sheets = detail::find_sheets(mesh.points, mesh.triangles, *twins);
    if (!sheets) return std::nullopt;
    return ManifoldMesh(mesh, *twins, *sheets).is_embedded();
}

}  // namespace

bool is_embedded(const LatticeMesh& mesh) {
    const std::optional<bool> answer = is_embedded_manifold(mesh);
    return answer ? *answer : is_valid(mesh);
}

}  // namespace trisect
