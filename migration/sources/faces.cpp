// SPDX-License-Identifier: Apache-2.0
//
// Faces of results get their runs, faces and properties back by the names that they have.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <trisect/brep/brep_mesh.h>
#include <trisect/kernel/error.h>

#include "disjoint_sets.h"
#include "dissolve.h"
#include "node.h"

namespace manifold {

namespace {

using trisect::FaceSource;

// Weights of the corners of a triangle at a point of its plane.
vec3 weights_at(const std::array<vec3, 3>& corner, const vec3& p) {
    const vec3 normal = la::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double size = la::length2(normal);
    if (!(size > 0)) return {1, 0, 0};
    const double a = la::dot(la::cross(corner[1] - p, corner[2] - p), normal) / size;
    const double b = la::dot(la::cross(corner[2] - p, corner[0] - p), normal) / size;
    return {a, b, 1 - a - b};
}

// What rounding leaves of the weight of a corner opposite to the side that a point lies on.
constexpr double weight_error = 1e-9;

// Rows of properties of result corners.
class RowWriter {
public:
    RowWriter(const NamedSolid& solid, TriMesh& out) : solid_(solid), out_(out) {}

    /// The row of a point on a face; equal ones are one.
    std::uint32_t row(std::uint32_t point, const FacePiece& piece, std::uint32_t group) {
        const FaceTable& table = *piece.table;
        if (table.mesh.width == 0) return plain(point, piece.first_run);
        const auto [triangle, weights] = locate(out_.points[point], piece, group);
        // At a corner or on a side of the triangle neighbours in other groups get the same row.
        std::vector<std::pair<std::uint32_t, double>> terms;
        for (int k = 0; k < 3; ++k)
            if (std::abs(weights[k]) > weight_error)
                terms.emplace_back(table.mesh.rows[triangle][static_cast<std::size_t>(k)],
                                   weights[k]);
        std::ranges::sort(terms);
        Key key{point, piece.table.get(), no_side, no_side, piece.flipped};
        if (terms.size() < 3) std::get<2>(key) = terms.front().first;
        if (terms.size() == 2) std::get<3>(key) = terms.back().first;
        if (terms.size() == 3) {
            std::get<2>(key) = group;
            std::get<3>(key) = no_side - 1;
        }
        const auto [at, is_new] = number_.try_emplace(key, count());
        if (is_new) append(piece, triangle, terms);
        return at->second;
    }

private:
    using Key = std::tuple<std::uint32_t, const FaceTable*, std::uint32_t, std::uint32_t, bool>;

    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(out_.properties.size() / out_.width);
    }

    std::uint32_t plain(std::uint32_t point, std::uint32_t run) {
        const auto [at, is_new] =
            number_.try_emplace(Key{point, nullptr, run, no_side, false}, count());
        if (is_new) out_.properties.resize(out_.properties.size() + out_.width);
        return at->second;
    }

    // The triangle of the group that has the point, or is nearest in its plane.
    std::pair<std::uint32_t, vec3> locate(const vec3& p, const FacePiece& piece,
                                          std::uint32_t group) const {
        const FaceTable& table = *piece.table;
        std::pair<std::uint32_t, vec3> best{table.triangles[table.begin[group]], vec3()};
        double least = -std::numeric_limits<double>::infinity();
        for (std::uint32_t i = table.begin[group]; i < table.begin[group + 1]; ++i) {
            const std::uint32_t t = table.triangles[i];
            std::array<vec3, 3> corner;
            for (std::size_t k = 0; k < 3; ++k)
                corner[k] = piece.place * vec4(table.mesh.corner(t, k), 1.0);
            const vec3 weights = weights_at(corner, p);
            const double inside = la::minelem(weights);
            if (inside > least) {
                least = inside;
                best = {t, weights};
            }
            if (inside >= 0) break;
        }
        return best;
    }

    void append(const FacePiece& piece, std::uint32_t triangle,
                const std::vector<std::pair<std::uint32_t, double>>& terms) {
        const TriMesh& from = piece.table->mesh;
        double sum = 0;
        for (const auto& [row, weight] : terms) sum += weight;
        const std::size_t at = out_.properties.size();
        out_.properties.resize(at + out_.width);
        double* to = out_.properties.data() + at;
        for (std::size_t i = 0; i < from.width; ++i) {
            if (terms.size() == 1)
                to[i] = from.properties[terms[0].first * from.width + i];
            else
                for (const auto& [row, weight] : terms)
                    to[i] += weight / sum * from.properties[row * from.width + i];
        }
        if (from.width < 3 || !from.runs[from.run[triangle]].normals) return;
        vec3 n = normal_map(piece.place) * vec3(to);
        n = la::normalize(piece.flipped ? -n : n);
        for (int i = 0; i < 3; ++i) to[i] = n[i];
    }

    const NamedSolid& solid_;
    TriMesh& out_;
    std::map<Key, std::uint32_t> number_;
};

// Triangles whose normals do not point to the same side as those of their exact faces.
std::size_t count_turned(const TriMesh& mesh, const trisect::Brep& brep,
                         const std::vector<trisect::FaceId>& face) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
        const trisect::Plane& plane = brep.plane(face[t]);
        const vec3 up(plane.approx_normal(0), plane.approx_normal(1), plane.approx_normal(2));
        if (la::dot(up, mesh.normal(t)) < 0) ++count;
    }
    return count;
}

TriMesh with_names(const NamedSolid& solid, const trisect::Brep& brep, trisect::MeshMap& map) {
    const trisect::PolygonMesh polygons = trisect::to_polygon_mesh(brep, {}, &map);
    const std::vector<FaceSource>& source = map.source;
    TriMesh out;
    out.width = solid.width;
    out.runs = solid.runs;
    for (const trisect::Point3d& p : polygons.points) out.points.emplace_back(p[0], p[1], p[2]);
    RowWriter rows(solid, out);
    for (std::size_t f = 0; f < polygons.face_count(); ++f) {
        const auto loop = polygons.face(f);
        out.corners.push_back({loop[0], loop[1], loop[2]});
        const auto found = solid.pieces.find(source[f].operand);
        // Faces of half-spaces have the last run.
        if (found == solid.pieces.end()) {
            out.run.push_back(static_cast<std::uint32_t>(out.runs.size() - 1));
            out.face.push_back(0);
            if (out.width == 0) continue;
            static const FaceTable nothing;
            const FacePiece none{.table = {std::shared_ptr<void>(), &nothing},
                                 .first_run = out.run.back()};
            Triple row{};
            for (std::size_t k = 0; k < 3; ++k) row[k] = rows.row(loop[k], none, 0);
            out.rows.push_back(row);
            continue;
        }
        const FacePiece& piece = found->second;
        const std::uint32_t group = source[f].face;
        const std::uint32_t first = piece.table->triangles[piece.table->begin[group]];
        out.run.push_back(piece.first_run + piece.table->mesh.run[first]);
        out.face.push_back(piece.table->mesh.face[first]);
        if (out.width == 0) continue;
        Triple row{};
        for (std::size_t k = 0; k < 3; ++k) row[k] = rows.row(loop[k], piece, group);
        out.rows.push_back(row);
    }
    out.turned = count_turned(out, brep, map.face);
    return out;
}

}  // namespace

TriMesh triangles_of(const NamedSolid& solid) {
    const trisect::Brep brep = dissolved(solid.solid.to_brep({.maximal_faces = false}));
    trisect::MeshMap map;
    return with_names(solid, brep, map);
}

std::vector<std::uint32_t> groups_of(const TriMesh& mesh) {
    const std::vector<std::uint32_t> opposite = opposite_sides(mesh);
    DisjointSets sets(mesh.corners.size());
    for (std::uint32_t side = 0; side < opposite.size(); ++side) {
        const std::uint32_t other = opposite[side];
        if (other == no_side || other < side) continue;
        const std::uint32_t a = side / 3;
        const std::uint32_t b = other / 3;
        if (mesh.run[a] != mesh.run[b] || mesh.face[a] != mesh.face[b]) continue;
        if (mesh.width != 0 && (mesh.rows[a][side % 3] != mesh.rows[b][(other + 1) % 3] ||
                                mesh.rows[a][(side + 1) % 3] != mesh.rows[b][other % 3]))
            continue;
        sets.join(a, b);
    }
    std::vector<std::uint32_t> group(mesh.corners.size(), no_side);
    std::uint32_t next = 0;
    for (std::uint32_t t = 0; t < group.size(); ++t) {
        const std::uint32_t root = sets.root(t);
        if (group[root] == no_side) group[root] = next++;
        group[t] = group[root];
    }
    return group;
}

std::shared_ptr<const FaceTable> face_table(TriMesh mesh, const std::vector<std::uint32_t>& group) {
    auto table = std::make_shared<FaceTable>();
    const std::uint32_t count = group.empty() ? 0 : *std::ranges::max_element(group) + 1;
    table->begin.assign(count + 1, 0);
    for (const std::uint32_t g : group) ++table->begin[g + 1];
    for (std::size_t g = 0; g < count; ++g) table->begin[g + 1] += table->begin[g];
    table->triangles.resize(group.size());
    std::vector<std::uint32_t> at(table->begin.begin(), table->begin.end() - 1);
    for (std::uint32_t t = 0; t < group.size(); ++t) table->triangles[at[group[t]]++] = t;
    table->mesh = std::move(mesh);
    return table;
}

ManifoldNode::Ptr renamed(const ManifoldNode& node) {
    const NamedSolid& solid = node.solid();
    if (node.is_mesh())
        return ManifoldNode::of_mesh(node.mesh(), node.original(), node.tolerance());
    trisect::MeshMap map;
    try {
        const trisect::Brep brep = dissolved(solid.solid.to_brep({.maximal_faces = false}));
        TriMesh mesh = with_names(solid, brep, map);
        std::vector<std::uint32_t> group;
        for (const trisect::FaceId f : map.face) group.push_back(f.index);
        // What a move rounded may meet itself.
        return ManifoldNode::of_both(std::move(mesh),
                                     trisect::Solid::from_brep(brep, trisect::Embedding::Check),
                                     std::move(group), node.original(), node.tolerance());
    } catch (const trisect::Error& error) {
        if (error.code() != trisect::ErrorCode::Unsupported) throw;
        return ManifoldNode::of_mesh(node.mesh(), node.original(), node.tolerance());
    }
}

}  // namespace manifold
