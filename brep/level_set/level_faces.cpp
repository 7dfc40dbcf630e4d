// SPDX-License-Identifier: Apache-2.0
//
// Tetrahedra are oriented: seen from the first corner the three others run clockwise, so that the
// determinant of the edges from it is positive. So are they after an even permutation.
#include <trisect/brep/level_set/level_faces.h>

#include <algorithm>
#include <array>
#include <utility>

#include <trisect/brep/level_set/level_vertices.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {
namespace {

struct Node {
    NodePoint at{};
    std::int8_t sign = 0;
};
/// Both pairs are of one kind each: corners of cells, or centres.
using Tetrahedron = std::array<Node, 4>;

/// Signs in falling order, by an even permutation.
Tetrahedron sorted(Tetrahedron t) {
    bool is_odd = false;
    for (std::size_t i = 1; i < 4; ++i)
        for (std::size_t j = i; j > 0 && t[j - 1].sign < t[j].sign; --j) {
            std::swap(t[j - 1], t[j]);
            is_odd = !is_odd;
        }
    // Of four signs two are equal.
    for (std::size_t i = 0; is_odd; ++i)
        if (t[i].sign == t[i + 1].sign) {
            std::swap(t[i], t[i + 1]);
            is_odd = false;
        }
    return t;
}

double squared_distance(const Point3d& a, const Point3d& b) {
    double out = 0;
    for (std::size_t k = 0; k < 3; ++k) out += (a[k] - b[k]) * (a[k] - b[k]);
    return out;
}

class Faces {
public:
    Faces(const LevelGrid& grid, std::span<const LevelCrossing> crossings,
          const std::vector<std::int8_t>& signs,
          const std::unordered_map<std::size_t, Point3d>& moved)
        : grid_(grid), signs_(signs), vertices_(grid, crossings, signs, moved) {}

    PolygonMesh mesh() {
        const auto& [x, y, z] = grid_.cells();
        for (std::int32_t k = 0; k <= z; ++k)
            for (std::int32_t j = 0; j <= y; ++j) {
                check_stop(static_cast<std::uint64_t>(x));
                for (std::int32_t i = 0; i <= x; ++i) add_cell({i, j, k});
            }
        mesh_.points = vertices_.places();
        return std::move(mesh_);
    }

private:
    /// Faces of a cell that are low on their axes.
    void add_cell(const std::array<std::int32_t, 3>& cell) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t u = (axis + 1) % 3;
            const std::size_t v = (axis + 2) % 3;
            if (cell[u] < grid_.cells()[u] && cell[v] < grid_.cells()[v]) add_square(cell, axis);
        }
    }

    void add_square(const std::array<std::int32_t, 3>& cell, std::size_t axis) {
        const std::size_t u = (axis + 1) % 3;
        const std::size_t v = (axis + 2) % 3;
        const NodePoint corner{2 * cell[0], 2 * cell[1], 2 * cell[2]};
        const std::size_t first = grid_.number(corner);
        const NodePoint high{corner[0] + 1, corner[1] + 1, corner[2] + 1};
        const std::size_t centre = grid_.number(high);
        const auto& steps = grid_.corner_steps();
        const std::array<std::size_t, 4> numbers{first, first + steps[u],
                                                 first + steps[u] + steps[v], first + steps[v]};
        const std::int8_t below = signs_[centre - grid_.centre_steps()[axis]];
        const std::int8_t above = signs_[centre];
        int sum = below + above;
        for (const std::size_t n : numbers) sum += signs_[n];
        if (sum == -6) return;
        const bool is_side = cell[axis] == 0 || cell[axis] == grid_.cells()[axis];
        if (sum == 6 && !is_side) return;
        std::array<Node, 4> square{};
        for (std::size_t i = 0; i < 4; ++i) square[i] = {corner, signs_[numbers[i]]};
        square[1].at[u] += 2;
        square[2].at[u] += 2;
        square[2].at[v] += 2;
        square[3].at[v] += 2;
        NodePoint low = high;
        low[axis] -= 2;
        const Node bottom{low, below};
        const Node top{high, above};
        for (std::size_t i = 0; i < 4; ++i) {
            const Node& p = square[i];
            const Node& q = square[(i + 1) % 4];
            add_tetrahedron({p, q, bottom, top});
            if (cell[axis] == 0) add_side({q, p, bottom});
            if (cell[axis] == grid_.cells()[axis]) add_side({p, q, top});
        }
    }

    [[nodiscard]] std::uint32_t between(const Node& a, const Node& b) const {
        return vertices_.on_edge(a.at, b.at);
    }
    [[nodiscard]] std::uint32_t at(const Node& a) const { return vertices_.at_node(a.at); }

    void add_tetrahedron(const Tetrahedron& given) {
        const auto count = [&](int sign) { return std::ranges::count(given, sign, &Node::sign); };
        const auto in = count(1);
        const auto out = count(-1);
        if (in == 0 || (out == 0 && in > 1)) return;
        const Tetrahedron t = sorted(given);
        if (out == 0) {
            if (in == 1 && sign_beyond(given, t[0]) < 0)
                mesh_.add_triangle(at(t[1]), at(t[2]), at(t[3]));
        } else if (in == 1) {
            // Where a corner is on the surface, it takes the place of the crossing before it.
            const auto corner = [&](std::size_t i) {
                return t[i].sign == 0 ? at(t[i]) : between(t[0], t[i]);
            };
            mesh_.add_triangle(corner(1), corner(2), corner(3));
        } else if (out == 1) {
            const auto corner = [&](std::size_t i) {
                return t[i].sign == 0 ? at(t[i]) : between(t[i], t[3]);
            };
            mesh_.add_triangle(corner(0), corner(1), corner(2));
        } else {
            add_quad({between(t[0], t[2]), between(t[0], t[3]), between(t[1], t[3]),
                      between(t[1], t[2])});
        }
    }

    /// Of the node across the face of a tetrahedron without one of its corners.
    [[nodiscard]] std::int8_t sign_beyond(const Tetrahedron& t, const Node& corner) const {
        const std::size_t pair = corner.at == t[0].at || corner.at == t[1].at ? 2 : 0;
        NodePoint beyond{};
        for (std::size_t k = 0; k < 3; ++k)
            beyond[k] = t[pair].at[k] + t[pair + 1].at[k] - corner.at[k];
        return signs_[grid_.number(beyond)];
    }

    /// The shorter diagonal is an edge.
    void add_quad(const std::array<std::uint32_t, 4>& q) {
        const auto& places = vertices_.places();
        if (squared_distance(places[q[0]], places[q[2]]) <=
            squared_distance(places[q[1]], places[q[3]])) {
            mesh_.add_triangle(q[0], q[1], q[2]);
            mesh_.add_triangle(q[0], q[2], q[3]);
        } else {
            mesh_.add_triangle(q[0], q[1], q[3]);
            mesh_.add_triangle(q[1], q[2], q[3]);
        }
    }

    /// What is inside of a triangle in a side of the box.
    void add_side(const std::array<Node, 3>& t) {
        std::array<std::uint32_t, 4> corners{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Node& next = t[(i + 1) % 3];
            if (t[i].sign > 0) corners[count++] = at(t[i]);
            if (t[i].sign != next.sign) corners[count++] = between(t[i], next);
        }
        if (count == 3) mesh_.add_triangle(corners[0], corners[1], corners[2]);
        if (count == 4) add_quad(corners);
    }

    const LevelGrid& grid_;
    const std::vector<std::int8_t>& signs_;
    LevelVertices vertices_;
    PolygonMesh mesh_;
};

}  // namespace

PolygonMesh level_faces(const LevelGrid& grid, std::span<const LevelCrossing> crossings,
                        const std::vector<std::int8_t>& signs,
                        const std::unordered_map<std::size_t, Point3d>& moved) {
    return Faces(grid, crossings, signs, moved).mesh();
}

}  // namespace trisect::detail
