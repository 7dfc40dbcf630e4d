// SPDX-License-Identifier: Apache-2.0
//
// Boxes cannot distinguish the triangles of a large flat face: in a fan of needles every box meets
// a fixed share of all others, so a search for pairs is quadratic. But they need not be compared.
//
// A sheet is a set of triangles, hung together over edges, whose normals are positive along one
// axis (or negative along it). Projected along that axis it covers a point as often as its boundary
// winds around it. If the projected boundary bounds a region, no point is covered twice, and two
// triangles can meet in their boundaries only. Where both meet inside the sheet the neighbours
// of one would overlap the other; so they meet on the sheet's boundary, and there in a common
// vertex [Volino, Magnenat-Thalmann 1994, for curved sheets and with sampled directions]. Nothing
// depends on the sheet being flat: rounded faces are nearly so, and smooth meshes fall into few
// sheets, of which only the boundaries take part in a sweep (region_outline.h).
//
// The axis is the one in which a triangle is largest, except around vertices of many triangles: a
// cone, seen from above, is one sheet, while its four sides would have to be compared with each
// other around the tip.

#include <trisect/brep/validate/sheets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <trisect/brep/face/region_outline.h>
#include <trisect/brep/import/edge_table.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/brep/validate/fans.h>
#include <trisect/brep/validate/twins.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Signs = std::array<int, 3>;

// Smaller ones are compared faster than proved.
constexpr std::uint32_t least_sheet = 16;
// A vertex of so many triangles needs one axis around it.
constexpr std::uint32_t hub_degree = 64;

struct RoughNormal {
    Signs sign;        // of each coordinate, exact
    std::size_t most;  // the axis in which it is largest, nearly
};

// Differences round once, so a coordinate is within 4·2^-53 of the sum of the
// magnitudes of its products.
RoughNormal normal_of(std::span<const LatticePoint> points, const Triangle& t) {
    const LatticePoint& a = points[t[0]];
    const Vector3 p = minus(points[t[1]].doubles(), a.doubles());
    const Vector3 q = minus(points[t[2]].doubles(), a.doubles());
    RoughNormal out{};
    std::array<double, 3> n{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        const double left = p[u] * q[v];
        const double right = p[v] * q[u];
        n[k] = left - right;
        if (std::fabs(n[k]) > minor_rounding * (std::fabs(left) + std::fabs(right))) {
            out.sign[k] = n[k] > 0 ? 1 : -1;
        } else {
            const auto flat = [&](std::uint32_t c) {
                return flat_corner(points[c], static_cast<int>(u), static_cast<int>(v));
            };
            out.sign[k] = exact_turn(flat(t[0]), flat(t[1]), flat(t[2]));
        }
    }
    const auto size = [&](std::size_t k) { return out.sign[k] == 0 ? -1 : std::fabs(n[k]); };
    for (std::size_t k = 1; k < 3; ++k)
        if (size(k) > size(out.most)) out.most = k;
    return out;
}

// Where a triangle is seen from: 2·axis, or 2·axis + 1 from the negative side.
using View = std::uint8_t;

View view_along(const RoughNormal& n, std::size_t axis) {
    return static_cast<View>(2 * axis + (n.sign[axis] > 0 ? 0 : 1));
}
FlatAxes axes_of(View view) {
    const int axis = view / 2;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    return view % 2 == 0 ? FlatAxes{u, v} : FlatAxes{v, u};
}

// Around each hub one view for all triangles, if they can all be seen from it: the one that most of
// them have.
class Hubs {
public:
    Hubs(std::size_t point_count, std::span<const Triangle> triangles) : hub_(point_count, none) {
        std::vector<std::uint32_t> degree(point_count, 0);
        for (const Triangle& t : triangles)
            for (const std::uint32_t c : t) ++degree[c];
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < point_count; ++i)
            if (degree[i] >= hub_degree) hub_[i] = count++;
        around_.resize(count);
    }

    /// Their points, ascending.
    [[nodiscard]] std::vector<std::uint32_t> points() const {
        std::vector<std::uint32_t> out;
        if (around_.empty()) return out;
        for (std::size_t i = 0; i < hub_.size(); ++i)
            if (hub_[i] != none) out.push_back(static_cast<std::uint32_t>(i));
        return out;
    }

    void turn(std::span<const Triangle> triangles, std::span<const RoughNormal> normals,
              std::vector<View>& views) {
        if (around_.empty()) return;
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (const std::uint32_t c : triangles[t])
                if (hub_[c] != none) around_[hub_[c]].add(normals[t], views[t]);
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (const std::uint32_t c : triangles[t])
                if (hub_[c] != none && around_[hub_[c]].best() != no_view)
                    views[t] = around_[hub_[c]].best();
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    static constexpr View no_view = 6;

    struct Around {
        std::array<std::uint32_t, 6> chosen{};
        std::array<bool, 6> hidden{};

        void add(const RoughNormal& n, View view) {
            ++chosen[view];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (n.sign[axis] <= 0) hidden[2 * axis] = true;
                if (n.sign[axis] >= 0) hidden[2 * axis + 1] = true;
            }
        }
        [[nodiscard]] View best() const {
            View out = no_view;
            for (View v = 0; v < no_view; ++v)
                if (!hidden[v] && (out == no_view || chosen[v] > chosen[out])) out = v;
            return out;
        }
    };

    std::vector<std::uint32_t> hub_;  // by point
    std::vector<Around> around_;
};

bool is_flat(const RoughNormal& n) { return n.sign == Signs{}; }

struct Views {
    std::vector<View> of_triangle;
    std::vector<std::uint32_t> hubs;
    bool are_all = true;  // false: there is a triangle without area
};

Views choose_views(std::span<const LatticePoint> points, std::span<const Triangle> triangles) {
    std::vector<RoughNormal> normals;
    Views views;
    normals.reserve(triangles.size());
    views.of_triangle.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        normals.push_back(normal_of(points, t));
        views.of_triangle.push_back(view_along(normals.back(), normals.back().most));
        views.are_all = views.are_all && !is_flat(normals.back());
    }
    check_stop(triangles.size());
    Hubs hubs(points.size(), triangles);
    hubs.turn(triangles, normals, views.of_triangle);
    views.hubs = hubs.points();
    end_step();
    return views;
}

// The edges of triangles that need not be manifold.
class TriangleEdges {
public:
    TriangleEdges(std::size_t point_count, std::span<const Triangle> triangles)
        : edges_(point_count, every_third(triangles.size()), flattened(triangles)) {}

    template <class Visit>
    void for_each(Visit&& visit) const {
        edges_.for_each_edge(visit);
    }

private:
    static std::vector<std::uint32_t> every_third(std::size_t n) {
        std::vector<std::uint32_t> out(n + 1);
        for (std::size_t i = 0; i <= n; ++i) out[i] = static_cast<std::uint32_t>(3 * i);
        return out;
    }
    static std::vector<std::uint32_t> flattened(std::span<const Triangle> triangles) {
        std::vector<std::uint32_t> out;
        out.reserve(3 * triangles.size());
        for (const Triangle& t : triangles) out.insert(out.end(), t.begin(), t.end());
        return out;
    }

    EdgeTable edges_;
};

// Those of a manifold.
struct TwinEdges {
    const Twins& twins;
    std::span<const Triangle> triangles;

    template <class Visit>
    void for_each(Visit&& visit) const {
        twins.for_each_edge(triangles, visit);
    }
};

template <class Edges>
class SheetFinder {
public:
    SheetFinder(std::span<const LatticePoint> points, std::vector<View> views, Edges edges)
        : points_(points),
          views_(std::move(views)),
          edges_(std::move(edges)),
          root_(views_.size()) {
        std::iota(root_.begin(), root_.end(), 0U);
        check_stop(root_.size());
    }

    std::vector<std::uint32_t> run() {
        hang_together();
        end_step();
        number_sheets();
        collect_outlines();
        prove();
        std::vector<std::uint32_t> sheets(root_.size(), no_sheet);
        for (std::uint32_t t = 0; t < sheets.size(); ++t)
            if (const std::uint32_t s = number_[find(t)]; s != no_sheet && is_proved_[s])
                sheets[t] = s;
        return sheets;
    }
    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(view_of_sheet_.size());
    }

private:
    struct Border {
        std::uint32_t sheet;
        OutlineEdge edge;
    };

    std::uint32_t find(std::uint32_t i) {
        while (root_[i] != i) i = root_[i] = root_[root_[i]];
        return i;
    }

    void hang_together() {
        edges_.for_each([this](std::uint32_t, std::uint32_t, std::span<const EdgeUse> uses) {
            if (uses.size() != 2 || uses[0].is_forward() == uses[1].is_forward()) return;
            std::uint32_t a = uses[0].face();
            std::uint32_t b = uses[1].face();
            if (views_[a] != views_[b]) return;
            a = find(a);
            b = find(b);
            root_[std::max(a, b)] = std::min(a, b);
        });
    }

    // By root: the number of its sheet, if it is large enough.
    void number_sheets() {
        std::vector<std::uint32_t> size(root_.size(), 0);
        for (std::uint32_t t = 0; t < root_.size(); ++t) ++size[find(t)];
        number_.assign(root_.size(), no_sheet);
        for (std::uint32_t t = 0; t < root_.size(); ++t) {
            if (size[t] < least_sheet) continue;
            number_[t] = static_cast<std::uint32_t>(view_of_sheet_.size());
            view_of_sheet_.push_back(views_[t]);
        }
        is_doubtful_.assign(view_of_sheet_.size(), false);
        is_proved_.assign(view_of_sheet_.size(), false);
        check_stop(root_.size());
    }

    // Of two uses by one sheet in opposite directions the edge is inside it; of one use it is on
    // its boundary. Sheets with anything else are left to comparisons.
    void collect_outlines() {
        edges_.for_each(
            [this](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
                used_by_.clear();
                for (const EdgeUse& use : uses)
                    if (const std::uint32_t s = number_[find(use.face())]; s != no_sheet)
                        used_by_.push_back({s, use.is_forward()});
                add_borders(low, high);
            });
        std::stable_sort(borders_.begin(), borders_.end(),
                         [](const Border& a, const Border& b) { return a.sheet < b.sheet; });
        check_stop(root_.size());
    }

    // Of the edge that used_by_ is about.
    void add_borders(std::uint32_t low, std::uint32_t high) {
        if (used_by_.size() == 2 && used_by_[0].sheet == used_by_[1].sheet &&
            used_by_[0].forward != used_by_[1].forward)
            return;  // nearly every edge
        std::sort(used_by_.begin(), used_by_.end());
        for (std::size_t i = 0; i < used_by_.size();) {
            const auto [sheet, forward] = used_by_[i];
            std::size_t end = i + 1;
            while (end < used_by_.size() && used_by_[end].sheet == sheet) ++end;
            if (end - i == 1) {
                borders_.push_back(
                    {sheet, forward ? OutlineEdge{low, high} : OutlineEdge{high, low}});
            } else if (end - i > 2 || used_by_[i + 1].forward == forward) {
                is_doubtful_[sheet] = true;
            }
            i = end;
        }
    }

    void prove() {
        std::vector<OutlineEdge> outline;
        for (std::size_t i = 0; i < borders_.size();) {
            const std::uint32_t sheet = borders_[i].sheet;
            outline.clear();
            for (; i < borders_.size() && borders_[i].sheet == sheet; ++i)
                outline.push_back(borders_[i].edge);
            is_proved_[sheet] = !is_doubtful_[sheet] &&
                                is_region_outline(points_, axes_of(view_of_sheet_[sheet]), outline);
        }
    }

    struct SheetUse {
        std::uint32_t sheet;
        bool forward;
        friend auto operator<=>(const SheetUse&, const SheetUse&) = default;
    };

    std::span<const LatticePoint> points_;
    std::vector<View> views_;
    Edges edges_;
    std::vector<std::uint32_t> root_;
    std::vector<std::uint32_t> number_;
    std::vector<View> view_of_sheet_;
    std::vector<bool> is_doubtful_;  // by sheet, as is the next
    std::vector<bool> is_proved_;
    std::vector<Border> borders_;
    std::vector<SheetUse> used_by_;
};

// What else is not compared: planar faces with themselves, as sheets from `next` on. If they fold
// that is found when they are triangulated.
void add_faces(const PreparedMesh& mesh, std::uint32_t next, std::vector<std::uint32_t>& sheets) {
    const auto& face = mesh.face_of_triangle;
    for (std::size_t i = 0; i < face.size();) {
        std::size_t end = i + 1;
        while (end < face.size() && face[end] == face[i]) ++end;
        if (end - i >= least_sheet && sheets[i] == no_sheet &&
            !std::binary_search(mesh.nonplanar_faces.begin(), mesh.nonplanar_faces.end(),
                                face[i])) {
            std::fill(sheets.begin() + static_cast<std::ptrdiff_t>(i),
                      sheets.begin() + static_cast<std::ptrdiff_t>(end), next);
            ++next;
        }
        i = end;
    }
}

}  // namespace

std::vector<std::uint32_t> find_sheets(const PreparedMesh& mesh) {
    Views views = choose_views(mesh.points, mesh.triangles);
    SheetFinder finder(mesh.points, std::move(views.of_triangle),
                       TriangleEdges(mesh.points.size(), mesh.triangles));
    std::vector<std::uint32_t> sheets = finder.run();
    const std::uint32_t next =
        add_fans(mesh.points, mesh.triangles, views.hubs, finder.count(), sheets);
    add_faces(mesh, next, sheets);
    return sheets;
}

std::optional<std::vector<std::uint32_t>> find_sheets(std::span<const LatticePoint> points,
                                                      std::span<const Triangle> triangles,
                                                      const Twins& twins) {
    Views views = choose_views(points, triangles);
    if (!views.are_all) return std::nullopt;
    SheetFinder finder(points, std::move(views.of_triangle), TwinEdges{twins, triangles});
    std::vector<std::uint32_t> sheets = finder.run();
    add_fans(points, triangles, views.hubs, finder.count(), sheets);
    return sheets;
}

}  // namespace trisect::detail
