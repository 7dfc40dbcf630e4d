// SPDX-License-Identifier: Apache-2.0
//
// open_edge and t_vertex: edges whose traversals do not cancel. Those that cancel together with
// other edges of their line do bound a closed surface; only its corners do not match.

#include <trisect/brep/import/line_balance.h>
#include <trisect/brep/validate/checked_mesh.h>

namespace trisect::detail {

namespace {

struct UnbalancedEdge {
    NetEdge net;
    std::vector<std::uint32_t> faces;
    bool flipped = false;  // exactly two faces, in the same direction
};

std::vector<UnbalancedEdge> find_unbalanced(const CheckedMesh& m) {
    std::vector<UnbalancedEdge> out;
    m.edges.for_each_edge(
        [&](std::uint32_t low, std::uint32_t high, std::span<const EdgeUse> uses) {
            std::int64_t net = 0;
            for (const EdgeUse& u : uses) net += u.is_forward() ? 1 : -1;
            if (net == 0) return;
            UnbalancedEdge e;
            e.net = net > 0 ? NetEdge{low, high, net} : NetEdge{high, low, -net};
            for (const EdgeUse& u : uses) e.faces.push_back(u.face());
            e.flipped = uses.size() == 2;
            out.push_back(std::move(e));
        });
    return out;
}

Defect describe(const CheckedMesh& m, const UnbalancedEdge& e, DefectKind kind) {
    const auto [from, to, count] = e.net;
    std::string s = m.edge_text(from, to);
    if (kind == DefectKind::TVertex) {
        s +=
            " of face " + std::to_string(e.faces[0]) +
            " is matched by several edges: a corner lies inside it or it is a part of another edge";
    } else if (e.faces.size() == 1) {
        s += " belongs to face " + std::to_string(e.faces[0]) + " only";
    } else {
        s += " has " + std::to_string(e.faces.size()) + " faces whose directions do not cancel";
    }
    return Defect{kind, {m.name(from), m.name(to)}, e.faces, m.place(from), std::move(s)};
}

}  // namespace

void check_open_edges(const CheckedMesh& m, ValidationReport& report) {
    const std::vector<UnbalancedEdge> edges = find_unbalanced(m);
    std::vector<NetEdge> nets;
    nets.reserve(edges.size());
    for (const auto& e : edges) nets.push_back(e.net);
    const auto open = find_uncancelled(m.mesh.points, nets);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (open[i] && edges[i].flipped) {
            report.add(DefectKind::FlippedFace,
                       [&] { return describe_flipped_face(m, nets[i], edges[i].faces); });
            continue;
        }
        const auto kind = open[i] ? DefectKind::OpenEdge : DefectKind::TVertex;
        report.add(kind, [&] { return describe(m, edges[i], kind); });
    }
}

}  // namespace trisect::detail
