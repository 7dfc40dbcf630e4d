// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/motion/event_model.h>

namespace trisect::detail {

ModelEvents::ModelEvents(const InterferenceModelData& data) : EventModel(data), data_(data) {
    resize(data.triangles.size());
    std::vector<bool> vertex_done(data.positions.size());
    std::vector<bool> edge_done(data.brep.edges().size());
    for (std::uint32_t t = 0; t < data.triangles.size(); ++t) {
        const ModelTriangle& triangle = data.triangles[t];
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexId v = triangle.vertex[i];
            const EdgeId e = triangle.edge[i];
            if (!vertex_done[v.index]) set_owns_vertex(t, i);
            vertex_done[v.index] = true;
            if (!e.is_valid()) continue;
            if (!edge_done[e.index]) set_owns_edge(t, i);
            edge_done[e.index] = true;
        }
    }
}

EventModel::Corners ModelEvents::corners(std::uint32_t t) const {
    Corners r;
    const double e = data_.position_error;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::array<double, 3>& p = data_.position(triangle(t).vertex[i]);
        r[i] = {Ball(p[0], e), Ball(p[1], e), Ball(p[2], e)};
    }
    return r;
}

}  // namespace trisect::detail
