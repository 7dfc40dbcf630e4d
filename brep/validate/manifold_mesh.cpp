// SPDX-License-Identifier: Apache-2.0
//
// The twins of half-edges give shells and sheets in one pass each, and triangles are compared only
// where sheets come together. Not those around a corner where they are a graph over a plane, which
// is one pass, too. A turned part is looked at along its own axes, where boxes of its flat faces
// are flat.

#include <trisect/brep/validate/manifold_mesh.h>

#include <algorithm>
#include <array>

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

// Of so few the boxes are compared with those of all triangles, one by one.
constexpr std::size_t few_triangles = 128;

// Doubles are exact.
struct CornerBox {
    std::array<double, 3> lo{}, hi{};

    CornerBox(std::span<const LatticePoint> points, const ManifoldMesh::Triangle& t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = [&](std::size_t i) {
                return points[t[i]][static_cast<int>(k)].to_double();
            };
            lo[k] = std::min({at(0), at(1), at(2)});
            hi[k] = std::max({at(0), at(1), at(2)});
        }
    }
    [[nodiscard]] bool meets(const CornerBox& o) const {
        return lo[0] <= o.hi[0] && o.lo[0] <= hi[0] && lo[1] <= o.hi[1] && o.lo[1] <= hi[1] &&
               lo[2] <= o.hi[2] && o.lo[2] <= hi[2];
    }
    void add(const CornerBox& o) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], o.lo[k]);
            hi[k] = std::max(hi[k], o.hi[k]);
        }
    }
};

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
    if (triangles.size() <= few_triangles) return have_few_no_contact(triangles);
    std::vector<std::uint8_t> marks(triangles_.size(), 0);
    for (const std::uint32_t t : triangles) marks[t] = 1;
    return has_no_contact_of(marks);
}

// Sheets and a tree over all triangles would cost far more.
std::optional<bool> ManifoldMesh::have_few_no_contact(
    std::span<const std::uint32_t> triangles) const {
    if (triangles.empty()) return true;
    ++embedding_counters().compared;
    check_stop(triangles_.size());
    std::vector<CornerBox> boxes;
    for (const std::uint32_t t : triangles) boxes.emplace_back(points_, triangles_[t]);
    CornerBox all = boxes[0];
    for (const CornerBox& box : boxes) all.add(box);
    std::uint64_t pairs = 0;
    const std::uint64_t limit = pair_limit_of(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        const CornerBox box(points_, triangles_[t]);
        if (!box.meets(all)) continue;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (triangles[i] == t || !box.meets(boxes[i])) continue;
            check_stop();
            const Triangle& other = triangles_[triangles[i]];
            if (has_equal_corners(other, triangles_[t])) return std::nullopt;
            if (++pairs > limit ||
                find_contact(points_, other, triangles_[t]).kind != ContactKind::None)
                return false;
        }
    }
    return true;
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
