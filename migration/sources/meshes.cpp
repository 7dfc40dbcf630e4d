// SPDX-License-Identifier: Apache-2.0
//
// Meshes in and out, and what is counted on them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <manifold/manifold.h>

#include "disjoint_sets.h"
#include "node.h"
#include "settings.h"

namespace manifold {

namespace {

using Error = Manifold::Error;

template <class Number, class Index>
Error find_error(const MeshGLP<Number, Index>& m) {
    const auto width = static_cast<std::size_t>(m.numProp);
    if (width < 3) return Error::MissingPositionProperties;
    if (m.vertProperties.size() % width != 0 || m.triVerts.size() % 3 != 0)
        return Error::PropertiesWrongLength;
    const std::size_t vertices = m.vertProperties.size() / width;
    const std::size_t triangles = m.triVerts.size() / 3;
    if (m.mergeFromVert.size() != m.mergeToVert.size()) return Error::MergeVectorsDifferentLengths;
    const auto outside = [&](Index v) { return v >= vertices; };
    if (std::ranges::any_of(m.mergeFromVert, outside) ||
        std::ranges::any_of(m.mergeToVert, outside))
        return Error::MergeIndexOutOfBounds;
    if (std::ranges::any_of(m.triVerts, outside)) return Error::VertexOutOfBounds;
    const std::size_t runs = m.runOriginalID.size();
    if (runs != 0 && !m.runTransform.empty() && m.runTransform.size() != 12 * runs)
        return Error::TransformWrongLength;
    if (!m.runIndex.empty() && m.runIndex.size() != runs && m.runIndex.size() != runs + 1)
        return Error::RunIndexWrongLength;
    if (!m.faceID.empty() && m.faceID.size() != triangles) return Error::FaceIDWrongLength;
    for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t i = 0; i < 3; ++i)
            if (!std::isfinite(m.vertProperties[v * width + i])) return Error::NonFiniteVertex;
    return Error::NoError;
}

// Each side of a triangle must be run back as often.
bool is_closed(const std::vector<Triple>& corners) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> there;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> back;
    for (const Triple& t : corners)
        for (std::size_t k = 0; k < 3; ++k) {
            there.emplace_back(t[k], t[(k + 1) % 3]);
            back.emplace_back(t[(k + 1) % 3], t[k]);
        }
    std::ranges::sort(there);
    std::ranges::sort(back);
    return there == back;
}

template <class Number, class Index>
std::vector<Run> runs_of(const MeshGLP<Number, Index>& m) {
    std::vector<Run> runs;
    for (std::size_t r = 0; r < m.runOriginalID.size(); ++r)
        runs.push_back({.original = static_cast<int>(m.runOriginalID[r]),
                        .transform = m.GetRunTransform(r),
                        .backside = m.Backside(r),
                        .normals = m.HasNormals(r) && m.numProp >= 6});
    if (runs.empty()) runs.push_back({.original = static_cast<int>(Manifold::ReserveIDs(1))});
    return runs;
}

// Vertices that are the same in all but their numbers have one row of properties.
template <class Number, class Index>
std::vector<std::uint32_t> rows_of(const MeshGLP<Number, Index>& m, DisjointSets& sets) {
    const auto width = static_cast<std::size_t>(m.numProp);
    std::map<std::uint32_t, std::vector<std::uint32_t>> merged;  // by point
    std::vector<std::uint32_t> row(m.vertProperties.size() / width);
    for (std::uint32_t v = 0; v < row.size(); ++v) row[v] = v;
    if (m.mergeFromVert.empty()) return row;
    for (std::uint32_t v = 0; v < row.size(); ++v) {
        std::vector<std::uint32_t>& there = merged[sets.root(v)];
        const auto begin = [&](std::uint32_t u) {
            return m.vertProperties.begin() + u * width + 3;
        };
        const auto same = std::ranges::find_if(there, [&](std::uint32_t u) {
            return std::equal(begin(v), begin(v) + width - 3, begin(u));
        });
        if (same != there.end())
            row[v] = *same;
        else
            there.push_back(v);
    }
    return row;
}

// Gives each fan of triangles around a point a point of its own. Sides of more than two triangles
// hold fans together.
void split_fans(TriMesh& mesh) {
    DisjointSets fans(3 * mesh.corners.size());
    std::vector<std::array<std::uint32_t, 3>> sides;  // the points, low first, and the corner
    for (std::uint32_t c = 0; c < 3 * mesh.corners.size(); ++c) {
        const std::uint32_t a = mesh.corners[c / 3][c % 3];
        const std::uint32_t b = mesh.corners[c / 3][(c + 1) % 3];
        sides.push_back({std::min(a, b), std::max(a, b), c});
    }
    std::ranges::sort(sides);
    for (std::size_t i = 1; i < sides.size(); ++i) {
        if (sides[i][0] != sides[i - 1][0] || sides[i][1] != sides[i - 1][1]) continue;
        const auto ends = [&](std::uint32_t c) {
            const std::uint32_t far = c / 3 * 3 + (c + 1) % 3;
            return mesh.corners[c / 3][c % 3] == sides[i][0] ? std::pair(c, far)
                                                             : std::pair(far, c);
        };
        const auto [low, high] = ends(sides[i][2]);
        const auto [other_low, other_high] = ends(sides[i - 1][2]);
        fans.join(low, other_low);
        fans.join(high, other_high);
    }
    std::vector<std::uint32_t> fan(mesh.points.size(), no_side);
    std::map<std::uint32_t, std::uint32_t> point;  // of further fans
    for (std::uint32_t c = 0; c < 3 * mesh.corners.size(); ++c) {
        std::uint32_t& p = mesh.corners[c / 3][c % 3];
        const std::uint32_t root = fans.root(c);
        if (fan[p] == no_side) fan[p] = root;
        if (fan[p] == root) continue;
        const auto [at, is_new] =
            point.try_emplace(root, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) {
            const vec3 copy = mesh.points[p];
            mesh.points.push_back(copy);
            fan.push_back(root);
        }
        p = at->second;
    }
}

// The triangles that have three vertices. Rows of properties are the mesh's vertices.
template <class Number, class Index>
TriMesh from_mesh(const MeshGLP<Number, Index>& m) {
    const auto width = static_cast<std::size_t>(m.numProp);
    const std::size_t vertices = m.vertProperties.size() / width;
    DisjointSets sets(vertices);
    for (std::size_t i = 0; i < m.mergeFromVert.size(); ++i)
        sets.join(static_cast<std::uint32_t>(m.mergeFromVert[i]),
                  static_cast<std::uint32_t>(m.mergeToVert[i]));
    TriMesh out;
    out.width = width - 3;
    out.runs = runs_of(m);
    const std::vector<std::uint32_t> row = rows_of(m, sets);
    std::vector<std::uint32_t> point(vertices, no_side);
    std::uint32_t run = 0;
    for (std::size_t t = 0; 3 * t < m.triVerts.size(); ++t) {
        while (run + 1 < out.runs.size() && run + 1 < m.runIndex.size() &&
               m.runIndex[run + 1] <= 3 * t)
            ++run;
        Triple corners{};
        Triple rows{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto v = static_cast<std::uint32_t>(m.triVerts[3 * t + k]);
            rows[k] = row[v];
            corners[k] = sets.root(v);
        }
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        out.corners.push_back(corners);
        if (out.width != 0) out.rows.push_back(rows);
        out.run.push_back(run);
        out.face.push_back(m.faceID.empty() ? t : m.faceID[t]);
    }
    // Points in the order of their vertices; of all that are used.
    for (const Triple& t : out.corners)
        for (const std::uint32_t c : t) point[c] = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
        if (point[v] == no_side) continue;
        point[v] = static_cast<std::uint32_t>(out.points.size());
        const Number* p = m.vertProperties.data() + v * width;
        out.points.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                static_cast<double>(p[2]));
    }
    for (Triple& t : out.corners)
        for (std::uint32_t& c : t) c = point[c];
    for (std::size_t v = 0; v < vertices && out.width != 0; ++v)
        for (std::size_t i = 3; i < width; ++i)
            out.properties.push_back(static_cast<double>(m.vertProperties[v * width + i]));
    return out;
}

// Faces have the smallest triangle of the given mesh that is part of them.
void name_flat_faces(TriMesh& mesh) {
    const std::vector<std::uint64_t> given = mesh.face;
    mesh.face = flat_faces(mesh);
    for (std::uint64_t& f : mesh.face) f = given[f];
}

template <class Number, class Index>
ManifoldNode::Ptr node_of(const MeshGLP<Number, Index>& m) {
    if (m.triVerts.empty() && m.vertProperties.empty()) return ManifoldNode::of_mesh({});
    if (const Error error = find_error(m); error != Error::NoError)
        return ManifoldNode::of_error(error);
    TriMesh mesh = from_mesh(m);
    if (!is_closed(mesh.corners)) return ManifoldNode::of_error(Error::NotManifold);
    if (m.faceID.empty()) name_flat_faces(mesh);
    split_fans(mesh);
    const int original = mesh.runs.size() == 1 ? mesh.runs[0].original : -1;
    auto tolerance = static_cast<double>(m.tolerance);
    if constexpr (sizeof(Number) < sizeof(double))
        tolerance =
            std::max(tolerance, std::numeric_limits<Number>::epsilon() * box_of(mesh).Scale());
    return ManifoldNode::of_mesh(std::move(mesh), original, tolerance);
}

// Vertices of a mesh: a point and a row of properties.
struct Vertices {
    explicit Vertices(const TriMesh& mesh) {
        if (mesh.width == 0) return;
        for (std::size_t t = 0; t < mesh.corners.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                all.emplace_back(mesh.rows[t][k], mesh.corners[t][k]);
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
    }
    [[nodiscard]] std::size_t number(std::uint32_t row, std::uint32_t point) const {
        const auto at = std::ranges::lower_bound(all, std::pair(row, point));
        return static_cast<std::size_t>(at - all.begin());
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;  // row, point
};

template <class Number, class Index>
void write_vertices(const TriMesh& mesh, const Vertices& vertices, MeshGLP<Number, Index>& out) {
    const auto place = [&](const vec3& p) {
        for (int i = 0; i < 3; ++i) out.vertProperties.push_back(static_cast<Number>(p[i]));
    };
    if (mesh.width == 0) {
        for (const vec3& p : mesh.points) place(p);
        return;
    }
    std::vector<Index> first(mesh.points.size(), std::numeric_limits<Index>::max());
    for (std::size_t v = 0; v < vertices.all.size(); ++v) {
        const auto [row, point] = vertices.all[v];
        place(mesh.points[point]);
        for (std::size_t i = 0; i < mesh.width; ++i)
            out.vertProperties.push_back(
                static_cast<Number>(mesh.properties[row * mesh.width + i]));
        if (first[point] == std::numeric_limits<Index>::max()) {
            first[point] = static_cast<Index>(v);
        } else {
            out.mergeFromVert.push_back(static_cast<Index>(v));
            out.mergeToVert.push_back(first[point]);
        }
    }
}

template <class Number, class Index>
void write_runs(const TriMesh& mesh, const std::vector<std::uint32_t>& order,
                MeshGLP<Number, Index>& out) {
    std::size_t t = 0;
    for (std::size_t r = 0; r < mesh.runs.size(); ++r) {
        const Run& run = mesh.runs[r];
        out.runIndex.push_back(static_cast<Index>(3 * t));
        while (t < order.size() && mesh.run[order[t]] == r) ++t;
        out.runOriginalID.push_back(static_cast<std::uint32_t>(run.original));
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 3; ++i)
                out.runTransform.push_back(static_cast<Number>(run.transform[j][i]));
        int flags = run.backside ? MeshGL::backside_flag : 0;
        if (run.normals) flags |= MeshGL::normals_flag;
        out.runFlags.push_back(static_cast<std::uint8_t>(flags));
    }
    out.runIndex.push_back(static_cast<Index>(3 * t));
}

// Normals in other places than the first are kept as the original lies.
TriMesh with_world_normals(TriMesh mesh, std::size_t at) {
    std::vector<bool> done(mesh.properties.size() / std::max<std::size_t>(mesh.width, 1));
    for (std::size_t t = 0; t < mesh.rows.size(); ++t) {
        const Run& run = mesh.runs[mesh.run[t]];
        if (at == 0 && run.normals) continue;
        const mat3 map = normal_map(run.transform) * (run.backside ? -1.0 : 1.0);
        for (const std::uint32_t r : mesh.rows[t]) {
            if (done[r]) continue;
            done[r] = true;
            double* n = mesh.properties.data() + r * mesh.width + at;
            const vec3 turned = map * vec3(n);
            const double length = la::length(turned);
            for (int i = 0; i < 3; ++i) n[i] = length > 0 ? turned[i] / length : 0;
        }
    }
    return mesh;
}

template <class Number, class Index>
MeshGLP<Number, Index> mesh_of(const ManifoldNode& node, int normalIdx) {
    MeshGLP<Number, Index> out;
    if (node.is_empty() && node.mesh().runs.empty()) return out;
    const TriMesh* mesh = &node.mesh();
    std::optional<TriMesh> turned;
    if (normalIdx >= 0 && mesh->width >= static_cast<std::size_t>(normalIdx) + 3)
        mesh = &turned.emplace(with_world_normals(*mesh, static_cast<std::size_t>(normalIdx)));
    out.numProp = static_cast<Index>(3 + mesh->width);
    std::vector<std::uint32_t> order(mesh->corners.size());
    for (std::uint32_t t = 0; t < order.size(); ++t) order[t] = t;
    std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return mesh->run[t]; });
    const Vertices vertices(*mesh);
    write_vertices(*mesh, vertices, out);
    for (const std::uint32_t t : order) {
        for (std::size_t k = 0; k < 3; ++k)
            out.triVerts.push_back(static_cast<Index>(
                mesh->width == 0 ? mesh->corners[t][k]
                                 : vertices.number(mesh->rows[t][k], mesh->corners[t][k])));
        out.faceID.push_back(static_cast<Index>(mesh->face[t]));
    }
    write_runs(*mesh, order, out);
    const double scale = box_of(*mesh).Scale();
    const double least = static_cast<double>(std::numeric_limits<Number>::epsilon()) * scale;
    out.tolerance = static_cast<Number>(
        std::max({node.tolerance(), relative_epsilon * scale, std::isfinite(least) ? least : 0}));
    return out;
}

}  // namespace

Manifold::Manifold() : node_(ManifoldNode::of_mesh({})) {}
Manifold::Manifold(std::shared_ptr<const ManifoldNode> node) : node_(std::move(node)) {}
Manifold::Manifold(const MeshGL& mesh) : node_(node_of(mesh)) {}
Manifold::Manifold(const MeshGL64& mesh) : node_(node_of(mesh)) {}
MeshGL Manifold::GetMeshGL(int normalIdx) const {
    return mesh_of<float, std::uint32_t>(*node_, normalIdx);
}
MeshGL64 Manifold::GetMeshGL64(int normalIdx) const {
    return mesh_of<double, std::uint64_t>(*node_, normalIdx);
}

Manifold::Error Manifold::Status() const {
    if (node_->context() != nullptr && node_->context()->cancelled) return Error::Cancelled;
    return node_->status();
}
Manifold Manifold::WithContext(const ExecutionContext& context) const {
    return Manifold(node_->with_context(context.impl_));
}
bool Manifold::IsEmpty() const { return node_->is_empty(); }
std::size_t Manifold::NumVert() const { return node_->mesh().points.size(); }
std::size_t Manifold::NumTri() const { return node_->mesh().corners.size(); }
std::size_t Manifold::NumEdge() const { return NumTri() / 2 * 3; }
std::size_t Manifold::NumProp() const {
    return node_->is_mesh() ? node_->mesh().width : node_->solid().width;
}
std::size_t Manifold::NumPropVert() const {
    return NumProp() == 0 ? NumVert() : Vertices(node_->mesh()).all.size();
}
int Manifold::Genus() const {
    const auto count = [](std::size_t n) { return static_cast<int>(n); };
    return 1 - (count(NumVert()) - count(NumEdge()) + count(NumTri())) / 2;
}
double Manifold::GetEpsilon() const { return relative_epsilon * BoundingBox().Scale(); }
double Manifold::GetTolerance() const { return std::max(node_->tolerance(), GetEpsilon()); }
int Manifold::OriginalID() const { return node_->original(); }

Manifold Manifold::SetTolerance(double tolerance) const {
    return Manifold(node_->with_tolerance(tolerance));
}

Manifold Manifold::AsOriginal() const {
    if (Status() != Error::NoError) return *this;
    const int id = static_cast<int>(ReserveIDs(1));
    const auto made_original = [&](TriMesh mesh) {
        const bool normals = std::ranges::all_of(mesh.runs, &Run::normals);
        mesh.runs.assign(1, {.original = id, .normals = normals && !mesh.runs.empty()});
        mesh.run.assign(mesh.corners.size(), 0);
        mesh.face = flat_faces(mesh);
        return mesh;
    };
    if (node_->is_mesh())
        return Manifold(
            ManifoldNode::of_mesh(made_original(node_->mesh()), id, node_->tolerance()));
    const ManifoldNode::Ptr own = renamed(*node_);
    if (own->is_mesh() || own->is_empty())
        return Manifold(ManifoldNode::of_mesh(made_original(own->mesh()), id, node_->tolerance()));
    const FaceTable& table = *own->solid().pieces.begin()->second.table;
    std::vector<std::uint32_t> group(table.triangles.size());
    for (std::uint32_t g = 0; g + 1 < table.begin.size(); ++g)
        for (std::uint32_t i = table.begin[g]; i < table.begin[g + 1]; ++i)
            group[table.triangles[i]] = g;
    return Manifold(ManifoldNode::of_both(made_original(own->mesh()), own->solid().solid,
                                          std::move(group), id, node_->tolerance()));
}

bool Manifold::HasSimpleProps() const {
    // One row of properties for each vertex.
    return NumPropVert() == NumVert();
}

std::size_t Manifold::NumDegenerateTris() const {
    const TriMesh& mesh = node_->mesh();
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.corners.size(); ++t)
        if (!(la::length2(mesh.normal(t)) > 0)) ++count;
    return count;
}

bool Manifold::MatchesTriNormals() const { return node_->mesh().turned == 0; }

}  // namespace manifold
