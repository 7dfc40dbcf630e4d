// SPDX-License-Identifier: Apache-2.0
//
// Properties of vertices, and meshes that are bent or divided.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <manifold/manifold.h>
#include <trisect/bsp/expression.h>

#include "disjoint_sets.h"
#include "node.h"

namespace manifold {

namespace {

using Ptr = ManifoldNode::Ptr;
using Error = Manifold::Error;

// The same solid with other rows of properties. Exact corners stay exact.
template <class Change>
Ptr with_rows(const ManifoldNode& node, Change change) {
    if (node.is_mesh()) {
        TriMesh mesh = node.mesh();
        change(mesh);
        return ManifoldNode::of_mesh(std::move(mesh), node.original(), node.tolerance());
    }
    const Ptr own = renamed(node);
    TriMesh mesh = own->mesh();
    change(mesh);
    if (own->is_mesh() || own->is_empty())
        return ManifoldNode::of_mesh(std::move(mesh), node.original(), node.tolerance());
    const FaceTable& table = *own->solid().pieces.begin()->second.table;
    std::vector<std::uint32_t> group(table.triangles.size());
    for (std::uint32_t g = 0; g + 1 < table.begin.size(); ++g)
        for (std::uint32_t i = table.begin[g]; i < table.begin[g + 1]; ++i)
            group[table.triangles[i]] = g;
    return ManifoldNode::of_both(std::move(mesh), own->solid().solid, std::move(group),
                                 node.original(), node.tolerance());
}

void clear_normals(TriMesh& mesh) {
    for (Run& run : mesh.runs) run.normals = false;
}

// Rows of their own for each pair of an old row and a point.
template <class Value>
void replace_rows(TriMesh& mesh, std::size_t width, Value value) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
    std::vector<Triple> rows(mesh.corners.size());
    std::vector<double> properties;
    for (std::size_t t = 0; t < mesh.corners.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::pair key(mesh.width == 0 ? no_side : mesh.rows[t][k], mesh.corners[t][k]);
            const auto [at, is_new] =
                number.try_emplace(key, static_cast<std::uint32_t>(number.size()));
            rows[t][k] = at->second;
            if (!is_new) continue;
            properties.resize(properties.size() + width);
            value(properties.data() + properties.size() - width, mesh.corner(t, k),
                  mesh.width == 0 ? nullptr : mesh.row(t, k));
        }
    mesh.width = width;
    mesh.rows = std::move(rows);
    mesh.properties = std::move(properties);
}

// Sides at which the normal turns by more than an angle.
std::vector<bool> sharp_sides(const TriMesh& mesh, const std::vector<std::uint32_t>& opposite,
                              double degrees) {
    const double least = cosd(degrees);
    std::vector<bool> sharp(opposite.size(), true);
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        if (opposite[side] == no_side) continue;
        const vec3 a = la::normalize(mesh.normal(side / 3));
        const vec3 b = la::normalize(mesh.normal(opposite[side] / 3));
        sharp[side] = degrees < 180 && la::dot(a, b) < least;
    }
    return sharp;
}

double angle_at(const TriMesh& mesh, std::size_t t, std::size_t k) {
    const vec3 u = la::normalize(mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k));
    const vec3 v = la::normalize(mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k));
    return std::acos(std::clamp(la::dot(u, v), -1.0, 1.0));
}

void write_normals(TriMesh& mesh, std::size_t at, double degrees) {
    const std::vector<std::uint32_t> opposite = opposite_sides(mesh);
    const std::vector<bool> sharp = sharp_sides(mesh, opposite, degrees);
    // Corners around a point are joined over sides that are not sharp.
    DisjointSets fans(3 * mesh.corners.size());
    for (std::uint32_t side = 0; side < opposite.size(); ++side) {
        if (sharp[side]) continue;
        const std::uint32_t other = opposite[side];
        const std::uint32_t t = side / 3;
        const std::uint32_t o = other / 3;
        fans.join(side, 3 * o + (other + 1) % 3);
        fans.join(3 * t + (side + 1) % 3, other);
    }
    std::vector<vec3> normal(3 * mesh.corners.size());
    for (std::uint32_t c = 0; c < normal.size(); ++c) {
        const vec3 n = mesh.normal(c / 3);
        if (la::length2(n) > 0)
            normal[fans.root(c)] += la::normalize(n) * angle_at(mesh, c / 3, c % 3);
    }
    const std::size_t width = std::max(mesh.width, at + 3);
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> number;
    std::vector<Triple> rows(mesh.corners.size());
    std::vector<double> properties;
    for (std::uint32_t t = 0; t < mesh.corners.size(); ++t)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t fan = fans.root(3 * t + k);
            const std::uint32_t old = mesh.width == 0 ? no_side : mesh.rows[t][k];
            // Other places than the first have normals as the run's original lies.
            const std::uint32_t run = at == 0 ? 0 : mesh.run[t];
            const auto [found, is_new] =
                number.try_emplace({fan, old, run}, static_cast<std::uint32_t>(number.size()));
            rows[t][k] = found->second;
            if (!is_new) continue;
            properties.resize(properties.size() + width);
            double* to = properties.data() + properties.size() - width;
            if (mesh.width != 0) std::copy_n(mesh.row(t, k), mesh.width, to);
            vec3 n = normal[fan];
            const Run& r = mesh.runs[mesh.run[t]];
            if (at != 0) n = la::inverse(normal_map(r.transform)) * n * (r.backside ? -1.0 : 1.0);
            if (la::length2(n) > 0) n = la::normalize(n);
            for (int i = 0; i < 3; ++i) to[at + static_cast<std::size_t>(i)] = n[i];
        }
    mesh.width = width;
    mesh.rows = std::move(rows);
    mesh.properties = std::move(properties);
    if (at == 0)
        for (Run& run : mesh.runs) run.normals = true;
}

// Each triangle into n * n; sides into n.
TriMesh refined(const TriMesh& mesh, std::uint32_t n) {
    TriMesh out;
    out.width = mesh.width;
    out.runs = mesh.runs;
    using Key = std::array<std::uint32_t, 6>;  // corners with their weights, sorted by corner
    std::map<Key, std::uint32_t> points;
    std::map<Key, std::uint32_t> rows;
    const auto key = [](const Triple& c, const Triple& w) {
        std::array<std::pair<std::uint32_t, std::uint32_t>, 3> terms;
        for (std::size_t i = 0; i < 3; ++i)
            terms[i] = w[i] == 0 ? std::pair{no_side, 0U} : std::pair{c[i], w[i]};
        std::ranges::sort(terms);
        return Key{terms[0].first,  terms[0].second, terms[1].first,
                   terms[1].second, terms[2].first,  terms[2].second};
    };
    const auto weight = [&](std::uint32_t w) { return static_cast<double>(w) / n; };
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
        const auto at = [&](std::uint32_t i, std::uint32_t j) {
            const Triple w{n - i - j, i, j};
            const Key k = key(mesh.corners[t], w);
            const auto [p, new_point] =
                points.try_emplace(k, static_cast<std::uint32_t>(out.points.size()));
            if (new_point) {
                vec3 sum;
                for (std::size_t c = 0; c < 3; ++c) sum += mesh.corner(t, c) * weight(w[c]);
                out.points.push_back(sum);
            }
            std::uint32_t row = 0;
            if (mesh.width != 0) {
                const auto [r, new_row] = rows.try_emplace(
                    key(mesh.rows[t], w),
                    static_cast<std::uint32_t>(out.properties.size() / mesh.width));
                row = r->second;
                for (std::size_t x = 0; new_row && x < mesh.width; ++x)
                    out.properties.push_back(mesh.row(t, 0)[x] * weight(w[0]) +
                                             mesh.row(t, 1)[x] * weight(w[1]) +
                                             mesh.row(t, 2)[x] * weight(w[2]));
            }
            return std::pair(p->second, row);
        };
        const auto add = [&](auto a, auto b, auto c) {
            out.corners.push_back({a.first, b.first, c.first});
            if (mesh.width != 0) out.rows.push_back({a.second, b.second, c.second});
            out.run.push_back(mesh.run[t]);
            out.face.push_back(mesh.face[t]);
        };
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; i + j < n; ++j) {
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return out;
}

}  // namespace

Manifold Manifold::SetProperties(
    int numProp,
    const std::function<void(double* to, vec3 position, const double* from)>& property) const {
    if (Status() != Error::NoError) return *this;
    const auto width = static_cast<std::size_t>(std::max(numProp, 0));
    return Manifold(with_rows(*node_, [&](TriMesh& mesh) {
        const std::size_t old = mesh.width;
        clear_normals(mesh);
        if (width == 0) {
            mesh.width = 0;
            mesh.rows.clear();
            mesh.properties.clear();
            return;
        }
        replace_rows(mesh, width, [&](double* to, const vec3& p, const double* from) {
            if (property)
                property(to, p, from);
            else if (from != nullptr)
                std::copy_n(from, std::min(old, width), to);
        });
    }));
}

Manifold Manifold::CalculateNormals(int normalIdx, double minSharpAngle) const {
    if (Status() != Error::NoError || IsEmpty() || normalIdx < 0) return *this;
    return Manifold(with_rows(*node_, [&](TriMesh& mesh) {
        write_normals(mesh, static_cast<std::size_t>(normalIdx), minSharpAngle);
    }));
}

Manifold Manifold::Warp(const std::function<void(vec3&)>& warp) const {
    return WarpBatch([&](VecView<vec3> points) {
        for (vec3& p : points) warp(p);
    });
}

Manifold Manifold::WarpBatch(const std::function<void(VecView<vec3>)>& warp) const {
    if (Status() != Error::NoError) return *this;
    TriMesh mesh = node_->mesh();
    warp(VecView<vec3>(mesh.points));
    for (const vec3& p : mesh.points)
        if (!std::isfinite(p.x + p.y + p.z))
            return Manifold(ManifoldNode::of_error(Error::NonFiniteVertex));
    return Manifold(ManifoldNode::of_mesh(std::move(mesh), -1, node_->tolerance()));
}

Manifold Manifold::Refine(int pieces) const {
    if (Status() != Error::NoError || pieces < 2) return *this;
    return Manifold(
        ManifoldNode::of_mesh(refined(node_->mesh(), static_cast<std::uint32_t>(pieces)),
                              node_->original(), node_->tolerance()));
}

Manifold Manifold::Simplify(double tolerance) const {
    if (Status() != Error::NoError || IsEmpty()) return *this;
    if (tolerance > GetTolerance()) throw NotSupported("Simplify with a tolerance");
    // The assembly joins what is left of one group, and what meets itself is resolved.
    NamedSolid solid = node_->solid();
    solid.solid = trisect::evaluate(trisect::Expression::any_of({solid.solid}));
    TriMesh mesh = triangles_of(solid);
    return Manifold(ManifoldNode::of_mesh(std::move(mesh), node_->original(), node_->tolerance()));
}

}  // namespace manifold
