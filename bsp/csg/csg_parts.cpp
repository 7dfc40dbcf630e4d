// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_parts.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/disjoint_sets.h>

namespace trisect::detail {
namespace {

struct EdgeOfTriangle {
    std::array<std::uint32_t, 2> ends{};  ///< ascending
    std::uint32_t triangle = 0;
    friend auto operator<=>(const EdgeOfTriangle&, const EdgeOfTriangle&) = default;
};

std::vector<EdgeOfTriangle> sorted_edges(const PolygonMesh& mesh) {
    std::vector<EdgeOfTriangle> out;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const std::uint32_t first = mesh.face_begin[f];
        const std::uint32_t end = mesh.face_begin[f + 1];
        for (std::uint32_t i = first; i < end; ++i) {
            const auto [low, high] =
                std::minmax(mesh.corners[i], mesh.corners[i + 1 < end ? i + 1 : first]);
            out.push_back({{low, high}, f});
        }
    }
    std::ranges::sort(out);
    return out;
}

void join_over_edges(const PolygonMesh& mesh, DisjointSets& joined) {
    const std::vector<EdgeOfTriangle> edges = sorted_edges(mesh);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
        if (end == i + 2) joined.join(edges[i].triangle, edges[i + 1].triangle);
        i = end;
    }
}

// Faces by part, in their order.
std::vector<std::vector<std::uint32_t>> parts_of(const PolygonMesh& mesh) {
    DisjointSets joined;
    joined.start(mesh.face_count());
    join_over_edges(mesh, joined);
    std::vector<std::vector<std::uint32_t>> out;
    std::vector<std::uint32_t> number(mesh.face_count(), ~std::uint32_t{0});
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        std::uint32_t& n = number[joined.root(f)];
        if (n == ~std::uint32_t{0}) {
            n = static_cast<std::uint32_t>(out.size());
            out.emplace_back();
        }
        out[n].push_back(f);
    }
    return out;
}

PolygonMesh mesh_of(const PolygonMesh& mesh, const std::vector<std::uint32_t>& faces,
                    std::vector<std::uint32_t>& numbers) {
    PolygonMesh out;
    std::vector<std::uint32_t> taken;
    for (const std::uint32_t f : faces) {
        std::vector<std::uint32_t> corners;
        for (std::uint32_t i = mesh.face_begin[f]; i < mesh.face_begin[f + 1]; ++i) {
            std::uint32_t& n = numbers[mesh.corners[i]];
            if (n == ~std::uint32_t{0}) {
                n = static_cast<std::uint32_t>(out.points.size());
                out.points.push_back(mesh.points[mesh.corners[i]]);
                taken.push_back(mesh.corners[i]);
            }
            corners.push_back(n);
        }
        out.add_face(corners);
    }
    for (const std::uint32_t v : taken) numbers[v] = ~std::uint32_t{0};
    return out;
}

// Nothing where it is none. A part may be open at an edge of more than two triangles.
std::optional<Solid> embedded(const PolygonMesh& mesh) {
    try {
        ImportedMesh imported = import_mesh(mesh);
        if (imported.mesh.triangles.empty() || !is_embedded(imported.mesh)) return std::nullopt;
        return Solid::from_import(std::move(imported));
    } catch (const Error& e) {
        if (e.code() != ErrorCode::InvalidSolid) throw;
        return std::nullopt;
    }
}

}  // namespace

std::optional<Expression> union_of_parts(const PolygonMesh& mesh) {
    const auto parts = parts_of(mesh);
    if (parts.size() < 2) return std::nullopt;
    std::vector<std::uint32_t> numbers(mesh.points.size(), ~std::uint32_t{0});
    std::vector<Expression> terms;
    for (const auto& faces : parts) {
        auto part = embedded(mesh_of(mesh, faces, numbers));
        if (!part) return std::nullopt;
        terms.emplace_back(*std::move(part));
    }
    return Expression::any_of(terms);
}

}  // namespace trisect::detail
