// SPDX-License-Identifier: Apache-2.0
//
// Facets that meet no others in a way that neighbours do not, and that hang together over edges,
// have equal winding numbers on either side: a change along the surface is where another facet
// crosses it. So one facet of each such part is looked at. Its winding numbers are counted along a
// ray across the facet, from a point of it that is infinitesimally near its first corner: that
// corner, moved by e along one side and by e² along another one. The projected point is on no edge
// then, and all signs are those of the first of the facet's corners that has one.

#include <trisect/brep/kinds/facet_kinds.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/import/edge_table.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/validate/manifold_mesh.h>
#include <trisect/brep/validate/sheet_grid.h>
#include <trisect/brep/validate/sheets.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/disjoint_sets.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Corners = std::array<LatticePoint, 3>;

constexpr std::size_t worthy_part = 2;  // 1 of so many facets may meet others
constexpr std::size_t rays_without_tree = 4;

// Corners of equal value have one name, and every triangle is a face.
PreparedMesh prepared(const LatticeMesh& mesh) {
    PolygonMesh indices;
    indices.points.resize(mesh.points.size());
    indices.corners.reserve(3 * mesh.triangles.size());
    indices.face_begin.reserve(mesh.triangles.size() + 1);
    for (const auto& t : mesh.triangles) indices.add_face(t);
    PreparedMesh out = weld_mesh(indices, mesh.points);
    out.report.lattice = mesh.lattice;
    triangulate_faces(out);
    return out;
}

// A point of a triangle, infinitesimally near its first corner, and the ray from it along an axis.
class RayAcross {
public:
    explicit RayAcross(const Corners& from)
        : from_(from), axis_(Plane::through(from[0], from[1], from[2]).dominant_axis()) {}

    [[nodiscard]] LatticeBox box() const {
        LatticeBox ray;
        ray.add(from_[0]);
        (axis_ == 0 ? ray.high.x : axis_ == 1 ? ray.high.y : ray.high.z) = coordinate_limit;
        return ray;
    }
    // What it adds to the winding number where it begins: 1 where it leaves through the triangle,
    // -1 where it enters. \pre they do not overlap
    [[nodiscard]] int crossing(const Corners& t) const {
        std::array<int, 3> turns{};
        for (std::size_t i = 0; i < 3; ++i) turns[i] = turn_at(t[i], t[(i + 1) % 3]);
        const int s = turns[0];
        if (s == 0 || turns[1] != s || turns[2] != s) return 0;
        const int side = side_of_start(Plane::through(t[0], t[1], t[2]));
        return side == -s ? s : 0;
    }
    // The same for the triangle where it begins, right above that.
    [[nodiscard]] int crossing_itself() const {
        return turn(flat(from_[0]), flat(from_[1]), flat(from_[2])) > 0 ? 0 : -1;
    }

private:
    [[nodiscard]] FlatCorner flat(const LatticePoint& p) const {
        return flat_corner(p, (axis_ + 1) % 3, (axis_ + 2) % 3);
    }
    // Of a, b and the start, seen along the ray: 0 where a and b are one. Where the first corners
    // are on the line, the turn to the next one is that to the step towards it.
    [[nodiscard]] int turn_at(const LatticePoint& a, const LatticePoint& b) const {
        for (const LatticePoint& p : from_)
            if (const int sign = turn(flat(a), flat(b), flat(p)); sign != 0) return sign;
        return 0;
    }
    [[nodiscard]] int side_of_start(const Plane& plane) const {
        for (const LatticePoint& p : from_)
            if (const auto side = side_of(p, plane); side != Side::On)
                return side == Side::Above ? 1 : -1;
        return 0;
    }

    Corners from_;
    int axis_;
};

class KindFinder {
public:
    explicit KindFinder(const PreparedMesh& mesh)
        : mesh_(mesh), kinds_(mesh.triangles.size(), FacetKind::Plain) {}

    [[nodiscard]] std::optional<std::vector<FacetKind>> find() {
        connect();
        mark_fans();
        if (!mark_contacts()) return std::nullopt;
        mark_hidden();
        return std::move(kinds_);
    }

private:
    void meets(std::uint32_t t) {
        if (kinds_[t] != FacetKind::Meets) ++meeting_;
        kinds_[t] = FacetKind::Meets;
    }
    [[nodiscard]] bool is_worthwhile() const { return meeting_ * worthy_part <= kinds_.size(); }
    [[nodiscard]] Corners corners(std::uint32_t t) const {
        const Triangle& names = mesh_.triangles[t];
        return {mesh_.points[names[0]], mesh_.points[names[1]], mesh_.points[names[2]]};
    }
    [[nodiscard]] bool have_equal_corners(std::uint32_t t, std::uint32_t other) const {
        const Triangle& names = mesh_.triangles[t];
        return std::is_permutation(names.begin(), names.end(), mesh_.triangles[other].begin());
    }
    [[nodiscard]] std::uint32_t corner_at(std::uint32_t t, std::uint32_t vertex) const {
        const Triangle& names = mesh_.triangles[t];
        return 3 * t + (names[0] == vertex ? 0U : names[1] == vertex ? 1U : 2U);
    }
    void connect();
    void mark_fans();
    [[nodiscard]] bool mark_contacts();
    void mark_hidden();
    [[nodiscard]] int winding_above(std::uint32_t t);

    const PreparedMesh& mesh_;
    std::vector<FacetKind> kinds_;
    std::size_t meeting_ = 0;
    std::size_t rays_ = 0;
    std::optional<TriangleTree> tree_;
    std::vector<std::array<std::uint32_t, 2>> neighbours_;  // over edges of two triangles
    DisjointSets fans_;                                     // of corners
};

void KindFinder::connect() {
    const std::size_t n = mesh_.triangles.size();
    fans_.start(3 * n);
    neighbours_.reserve(3 * n / 2);
    const EdgeTable edges(mesh_.points.size(), mesh_.loop_begin, mesh_.corners);
    edges.for_each_edge([&](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
        if (uses.size() != 2 || uses[0].is_forward() == uses[1].is_forward()) {
            for (const EdgeUse& use : uses) meets(use.face());
            return;
        }
        const std::uint32_t a = uses[0].face();
        const std::uint32_t b = uses[1].face();
        if (have_equal_corners(a, b)) {  // one lies on the other
            meets(a);
            meets(b);
            return;
        }
        neighbours_.push_back({a, b});
        for (const std::uint32_t v : {low, high}) fans_.join(corner_at(a, v), corner_at(b, v));
    });
}

void KindFinder::mark_fans() {
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> fan(mesh_.points.size(), none);
    std::vector<bool> has_several(mesh_.points.size(), false);
    for (std::uint32_t c = 0; c < 3 * mesh_.triangles.size(); ++c) {
        const std::uint32_t v = mesh_.triangles[c / 3][c % 3];
        if (fan[v] == none) fan[v] = fans_.root(c);
        if (fan[v] != fans_.root(c)) has_several[v] = true;
    }
    for (std::uint32_t c = 0; c < 3 * mesh_.triangles.size(); ++c)
        if (has_several[mesh_.triangles[c / 3][c % 3]]) meets(c / 3);
}

// Only triangles where sheets come together can meet others.
bool KindFinder::mark_contacts() {
    const std::vector<std::uint32_t> sheets = find_sheets(mesh_);
    const auto near = triangles_near_others(mesh_.points, mesh_.triangles, sheets);
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> sheet_of;
    for (const std::uint32_t t : near) {
        triangles.push_back(mesh_.triangles[t]);
        sheet_of.push_back(sheets[t]);
    }
    end_step();
    TriangleTree tree(mesh_.points, triangles, sheet_of);
    const std::uint64_t limit = pair_limit_of(mesh_.triangles.size());
    std::uint64_t pairs = 0;
    tree.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
        check_stop();
        if (++pairs > limit || !is_worthwhile()) return false;
        if (kinds_[near[a]] == FacetKind::Meets && kinds_[near[b]] == FacetKind::Meets) return true;
        if (find_contact(mesh_.points, triangles[a], triangles[b]).kind != ContactKind::None) {
            meets(near[a]);
            meets(near[b]);
        }
        return true;
    });
    return pairs <= limit && is_worthwhile();
}

void KindFinder::mark_hidden() {
    DisjointSets parts;
    parts.start(mesh_.triangles.size());
    for (const auto& [a, b] : neighbours_)
        if (kinds_[a] != FacetKind::Meets && kinds_[b] != FacetKind::Meets) parts.join(a, b);
    for (std::uint32_t t = 0; t < kinds_.size(); ++t) {
        if (kinds_[t] == FacetKind::Meets) continue;
        const std::uint32_t first = parts.root(t);  // the least one: its kind is found already
        if (first != t) {
            kinds_[t] = kinds_[first];
            continue;
        }
        check_stop();
        if (winding_above(t) != 0) kinds_[t] = FacetKind::Hidden;
    }
}

int KindFinder::winding_above(std::uint32_t t) {
    const RayAcross ray(corners(t));
    int winding = ray.crossing_itself();
    const auto add = [&](std::uint32_t other) {
        if (other != t) winding += ray.crossing(corners(other));
    };
    if (++rays_ > rays_without_tree && !tree_) tree_.emplace(mesh_.points, mesh_.triangles);
    if (tree_) {
        tree_->for_each_in(ray.box(), add);
        return winding;
    }
    for (std::uint32_t other = 0; other < mesh_.triangles.size(); ++other) {
        LatticeBox box;
        for (const std::uint32_t c : mesh_.triangles[other]) box.add(mesh_.points[c]);
        if (box.overlaps(ray.box())) add(other);
    }
    return winding;
}

}  // namespace

std::optional<std::vector<FacetKind>> facet_kinds(const LatticeMesh& mesh) {
    check_stop(mesh.triangles.size());
    const PreparedMesh welded = prepared(mesh);
    if (welded.triangles.size() != mesh.triangles.size() || !welded.nonsimple_faces.empty())
        return std::nullopt;
    end_step();
    return KindFinder(welded).find();
}

}  // namespace trisect::detail
