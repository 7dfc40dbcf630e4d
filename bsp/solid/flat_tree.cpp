// SPDX-License-Identifier: Apache-2.0
//
// The tree of a prism over a region. Where all vertices are corners of the lattice it is a mesh, as
// an import is. Else it is an exact boundary, whose faces are divided along its own planes.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <trisect/brep/brep_builder.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/evaluate/named_boundary.h>
#include <trisect/bsp/flat/flat_figure.h>
#include <trisect/bsp/flat/flat_mesh.h>
#include <trisect/bsp/flat/flat_state.h>
#include <trisect/bsp/solid/uncut_root.h>

namespace trisect::detail {

namespace {

class FlatSolidMaker {
public:
    FlatSolidMaker(const FlatRegion& region, int axis, Coordinate low, Coordinate high)
        : region_(region), axis_(axis), levels_{low, high} {}

    [[nodiscard]] std::shared_ptr<const SolidState> mesh() const {
        LatticeMesh mesh;
        mesh.lattice = region_.lattice;
        const auto n = static_cast<std::uint32_t>(region_.vertices.size());
        for (const Coordinate level : levels_)
            for (const FlatRegion::Vertex& v : region_.vertices)
                mesh.points.push_back(at(v.corner(), level));
        const auto add = [&](std::array<std::uint32_t, 3> t, std::uint32_t face) {
            mesh.triangles.push_back(t);
            mesh.face_of_triangle.push_back(face);
        };
        for (const auto& [a, b, c] : flat_triangles(region_)) {
            add({a, c, b}, 0);
            add({n + a, n + b, n + c}, 1);
        }
        std::uint32_t face = 2;
        for (const FlatRegion::Segment& s : region_.segments) {
            add({s.from, s.to, n + s.to}, face);
            add({s.from, n + s.to, n + s.from}, face++);
        }
        const auto source = Source::named(Source::make(std::move(mesh)), names());
        auto state = std::make_shared<SolidState>();
        state->lattice = region_.lattice;
        state->form = CellTree{{uncut_root(*source, false), false}, {}, nullptr};
        state->whole = source->is_whole();
        state->source = source->serial();
        return state;
    }

    [[nodiscard]] std::shared_ptr<const SolidState> fragments() const {
        BrepBuilder builder(region_.lattice);
        const std::array<Plane, 2> caps{cap(0).flipped(), cap(1)};
        std::vector<std::uint32_t> numbers;
        for (std::size_t i = 0; i < 2; ++i)
            for (const FlatRegion::Vertex& v : region_.vertices)
                numbers.push_back(builder.add_vertex(point(v, i, caps[i])));
        const auto n = static_cast<std::uint32_t>(region_.vertices.size());
        const Plane figure = Plane::axis_aligned(2, 1, 0);
        std::vector<Point> points;
        for (const FlatRegion::Vertex& v : region_.vertices)
            points.push_back(flat_point(region_, v));
        for (const auto& loops : connected_regions(figure, points, flat_loops(region_)))
            add_caps(builder, caps, numbers, loops);
        for (const FlatRegion::Segment& s : region_.segments)
            builder.add_polygon(
                wall(s),
                std::array{numbers[s.from], numbers[s.to], numbers[n + s.to], numbers[n + s.from]},
                region_.lines[s.line].name);
        return cut_state(named_solid(std::move(builder).build()));
    }

private:
    [[nodiscard]] LatticePoint at(const FlatCorner& c, Coordinate level) const {
        if (axis_ == 0) return {level, c.u, c.v};
        return axis_ == 1 ? LatticePoint{c.v, level, c.u} : LatticePoint{c.u, c.v, level};
    }
    [[nodiscard]] std::vector<FaceSource> names() const {
        std::vector<FaceSource> out(region_.cap_names.begin(), region_.cap_names.end());
        for (const FlatRegion::Segment& s : region_.segments)
            out.push_back(region_.lines[s.line].name);
        return out;
    }
    /// Its normal is the axis.
    [[nodiscard]] Plane cap(std::size_t i) const {
        const auto flat = [](int u, int v) { return FlatCorner{Coordinate(u), Coordinate(v)}; };
        return Plane::through(at(flat(0, 0), levels_[i]), at(flat(1, 0), levels_[i]),
                              at(flat(0, 1), levels_[i]));
    }
    [[nodiscard]] Plane plane(const FlatRegion::Line& l) const {
        return Plane::along_axis(at(l.a, Coordinate()), at(l.b, Coordinate()), axis_);
    }
    [[nodiscard]] Plane wall(const FlatRegion::Segment& s) const {
        const FlatRegion::Line& l = region_.lines[s.line];
        return s.along ? plane(l) : plane(l).flipped();
    }
    [[nodiscard]] Point point(const FlatRegion::Vertex& v, std::size_t i, const Plane& cap) const {
        if (v.is_corner()) return Point(at(v.corner(), levels_[i]));
        return {plane(region_.lines[v.lines[0]]), plane(region_.lines[v.lines[1]]), cap};
    }
    void add_caps(BrepBuilder& builder, const std::array<Plane, 2>& caps,
                  const std::vector<std::uint32_t>& numbers,
                  const std::vector<IndexLoop>& loops) const {
        for (std::size_t i = 0; i < 2; ++i) {
            std::vector<IndexLoop> named = loops;
            for (IndexLoop& loop : named) {
                for (std::uint32_t& v : loop) v = numbers[i * region_.vertices.size() + v];
                if (i == 0) std::reverse(loop.begin(), loop.end());
            }
            builder.add_face(caps[i], named, region_.cap_names[i]);
        }
    }

    const FlatRegion& region_;
    int axis_;
    std::array<Coordinate, 2> levels_;
};

}  // namespace

std::shared_ptr<const SolidState> flat_tree(const FlatRegion& region, int axis, Coordinate low,
                                            Coordinate high) {
    if (region.is_empty()) return state_of(Solid());
    const FlatSolidMaker maker(region, axis, low, high);
    return region.has_corners_only() ? maker.mesh() : maker.fragments();
}

}  // namespace trisect::detail
