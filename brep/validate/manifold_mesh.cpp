// SPDX-License-Identifier: Apache-2.0
//
// The twins of half-edges give shells and sheets in one pass each, and triangles are compared only
// where sheets come together. Not those around a corner where they are a graph over a plane, which
// is one pass, too. A turned part is looked at along its own axes, where boxes of its flat faces
// are flat.

#include <trisect/brep/validate/manifold_mesh.h>

#include <algorithm>

#include <trisect/brep/contact/embedding_counters.h>
#include <trisect/brep/contact/graph_corners.h>
#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/contact/turned_points.h>
#include <trisect/brep/import/volume_sign.h>
#include <trisect/brep/validate/sheet_grid.h>
#include <trisect/brep/validate/sheets.h>
#include <trisect/brep/validate/shell_nesting.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr std::uint64_t pairs_of_a_triangle = 200;
constexpr std::uint64_t least_pairs = 1'000'000;

enum class Found : std::uint8_t { Nothing, Contact, Unclear };

bool share_one_of(std::span<const std::uint8_t> corners, const ManifoldMesh::Triangle& a,
                  const ManifoldMesh::Triangle& b) {
    return std::ranges::any_of(a, [&](std::uint32_t c) {
        return corners[c] != 0 && (c == b[0] || c == b[1] || c == b[2]);
    });
}

}  // namespace

std::uint64_t pair_limit_of(std::size_t triangles) {
    return std::max(least_pairs, pairs_of_a_triangle * triangles);
}

std::optional<ManifoldMesh> ManifoldMesh::of(std::span<const LatticePoint> points,
                                             std::span<const Triangle> triangles) {
    if (triangles.empty()) return std::nullopt;
    check_stop(triangles.size());
    auto twins = Twins::of(points.size(), triangles);
    end_step();
    if (!twins) return std::nullopt;
    return ManifoldMesh(points, triangles, std::move(*twins));
}

std::optional<bool> ManifoldMesh::are_shells_nested() const {
    const Twins::Shells shells = twins_.shells();
    if (shells.count == 1) return volume_sign(points_, triangles_) > 0;
    std::vector<std::vector<Triangle>> own(shells.count);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        own[shells.of_triangle[t]].push_back(triangles_[t]);
    end_step();
    const std::vector<bool> is_closed(shells.count, true);
    TriangleTree tree(points_, triangles_, shells.of_triangle);
    ShellNesting nesting(points_, triangles_, shells.of_triangle, is_closed, tree);
    for (std::uint32_t s = 0; s < shells.count; ++s) {
        const int sign = volume_sign(points_, own[s]);
        const std::optional<int> winding = nesting.winding_outside(s, own[s]);
        if (sign == 0 || !winding) return std::nullopt;
        if (*winding != (sign > 0 ? 0 : 1)) return false;
    }
    return true;
}

std::optional<bool> ManifoldMesh::has_no_contact() const { return has_no_contact_of({}); }

std::optional<bool> ManifoldMesh::has_no_contact(std::span<const std::uint32_t> triangles) const {
    std::vector<std::uint8_t> marks(triangles_.size(), 0);
    for (const std::uint32_t t : triangles) marks[t] = 1;
    return has_no_contact_of(marks);
}

std::optional<bool> ManifoldMesh::has_no_contact_of(std::span<const std::uint8_t> marks) const {
    if (is_convex()) {
        ++embedding_counters().convex;
        return true;
    }
    ++embedding_counters().compared;
    const auto sheets = find_sheets(points_, triangles_, twins_);
    if (!sheets) return std::nullopt;
    end_step();
    std::vector<Triangle> near;
    std::vector<std::uint32_t> sheet_of;
    std::vector<std::uint8_t> is_wanted;
    const auto turned = TurnedPoints::of(points_, triangles_);
    const auto seen = turned ? std::span<const LatticePoint>(turned->points) : points_;
    const double error = turned ? turned->error : 0;
    for (const std::uint32_t t : triangles_near_others(seen, triangles_, *sheets, error)) {
        near.push_back(triangles_[t]);
        sheet_of.push_back((*sheets)[t]);
        is_wanted.push_back(marks.empty() ? 1 : marks[t]);
    }
    const std::vector<std::uint8_t> is_graph = find_graph_corners(points_, triangles_, near);
    const auto relation_of = [&](const Triangle& a, const Triangle& b) {
        if (share_one_of(is_graph, a, b)) {
            ++embedding_counters().graph_corners;
            return Found::Nothing;
        }
        if (turned && turned->are_apart(a, b)) {
            ++embedding_counters().turned_lines;
            return Found::Nothing;
        }
        if (has_equal_corners(a, b)) return Found::Unclear;
        return find_contact(points_, a, b).kind == ContactKind::None ? Found::Nothing
                                                                     : Found::Contact;
    };
    end_step();
    TriangleTree tree(seen, near, sheet_of, error);
    Found found = Found::Nothing;
    std::uint64_t pairs = 0;
    const std::uint64_t limit = pair_limit_of(triangles_.size());
    tree.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
        if ((is_wanted[a] | is_wanted[b]) == 0) return true;
        check_stop();
        found = ++pairs > limit ? Found::Contact : relation_of(near[a], near[b]);
        return found == Found::Nothing;
    });
    if (found == Found::Unclear) return std::nullopt;
    return found == Found::Nothing;
}

// Corners of different names at one place.
bool ManifoldMesh::has_equal_corners(const Triangle& a, const Triangle& b) const {
    for (const std::uint32_t v : a)
        for (const std::uint32_t w : b)
            if (v != w && points_[v] == points_[w]) return true;
    return false;
}

}  // namespace trisect::detail
