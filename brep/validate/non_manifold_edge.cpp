// SPDX-License-Identifier: Apache-2.0
//
// non_manifold_edge: more than two faces at an edge. A solid may touch itself along an edge.

#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

void check_non_manifold_edges(const CheckedMesh& m, ValidationReport& report) {
    m.edges.for_each_edge(
        [&](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
            if (uses.size() <= 2) return;
            report.add(DefectKind::NonManifoldEdge, [&] {
                std::vector<std::uint32_t> faces;
                for (const EdgeUse& u : uses) faces.push_back(u.face());
                return Defect{
                    DefectKind::NonManifoldEdge,
                    {m.name(low), m.name(high)},
                    std::move(faces),
                    m.place(low),
                    m.edge_text(low, high) + " has " + std::to_string(uses.size()) + " faces"};
            });
        });
}

}  // namespace trisect::detail
