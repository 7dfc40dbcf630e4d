// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlined_solid.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <trisect/bsp/many_meshes/spare_outlines.h>

namespace trisect::detail {

OutlineBox OutlineBox::none() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

OutlinedSolid whole_operand(const ManyMeshes& meshes, std::uint32_t slot, bool open_far_out,
                            std::size_t room, SpareOutlines& spare) {
    const LatticeMesh& mesh = meshes.sources[slot]->mesh();
    const std::uint32_t first = meshes.operands->operands[slot].first;
    // What is reserved and not used takes no memory, but addresses. Facets that are cut get more
    // edges.
    constexpr std::size_t most_reserved = std::size_t{1} << 18U;
    const std::size_t own = mesh.triangles.size();
    const std::size_t more = std::min(std::max(room, own) - own, most_reserved);
    OutlinedSolid out =
        spare.take(own + more, 3 * own + 6 * more, mesh.points.size() + more + more / 2);
    out.open_far_out = open_far_out;
    out.vertices.resize(mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
        out.vertices[v].at = {mesh.points[v].doubles(), 0.0};
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        const auto& t = mesh.triangles[f];
        out.facets.push_back({first + f, slot, 3 * f, 3, true});
        OutlineBox& box = out.boxes.emplace_back(OutlineBox::none());
        for (std::uint32_t i = 0; i < 3; ++i) {
            out.edges.push_back({t[i], t[(i + 1) % 3], EdgeOrigin(i)});
            OutlineVertex& v = out.vertices[t[i]];
            v.facets[0] = first + f;
            v.which = static_cast<std::int8_t>(i);
            box.add(v.at);
        }
        out.box.add(box);
    }
    return out;
}

void add_apart(OutlinedSolid& solid, OutlinedSolid& to) {
    if (to.facets.empty()) {
        std::swap(to, solid);
        return;
    }
    const auto vertex = static_cast<std::uint32_t>(to.vertices.size());
    const auto edge = static_cast<std::uint32_t>(to.edges.size());
    to.vertices.insert(to.vertices.end(), solid.vertices.begin(), solid.vertices.end());
    to.boxes.insert(to.boxes.end(), solid.boxes.begin(), solid.boxes.end());
    for (OutlinedSolid::Facet& f : solid.facets) {
        f.first += edge;
        to.facets.push_back(f);
    }
    for (OutlinedSolid::Edge& e : solid.edges) {
        e.from += vertex;
        e.to += vertex;
        to.edges.push_back(e);
    }
    to.unused_edges += solid.unused_edges;
    std::ranges::move(solid.lines, std::back_inserter(to.lines));
    to.box.add(solid.box);
}

}  // namespace trisect::detail
