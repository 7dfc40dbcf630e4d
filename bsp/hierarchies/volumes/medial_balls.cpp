// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/volumes/medial_balls.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <trisect/bsp/interference/boxes/obb_fit.h>

namespace trisect::hierarchies {

namespace {

using detail::Vector3;

struct Sample {
    std::uint32_t vertex = 0;
    Vector3 point{};
    Vector3 normal{};  // outward, of length 1
};

// Vertices with the mean normals of their triangles, those without any left out.
std::vector<Sample> samples_of(const detail::InterferenceModelData& model, const TreeFrame& frame,
                               std::size_t most) {
    std::vector<Vector3> normals(model.positions.size());
    for (const detail::ModelTriangle& t : model.triangles) {
        const Vector3 a = frame(model.position(t.vertex[0]));
        const Vector3 n = detail::cross(detail::minus(frame(model.position(t.vertex[1])), a),
                                        detail::minus(frame(model.position(t.vertex[2])), a));
        for (const VertexId v : t.vertex)
            for (std::size_t k = 0; k < 3; ++k) normals[v.index][k] += n[k];
    }
    std::vector<Sample> samples;
    const std::size_t step = (normals.size() + most - 1) / most;
    for (std::size_t v = 0; v < normals.size(); v += step) {
        const double length = std::sqrt(detail::dot(normals[v], normals[v]));
        if (!(length > 0)) continue;
        Vector3 n = normals[v];
        for (double& c : n) c /= length;
        samples.push_back({static_cast<std::uint32_t>(v), frame(model.positions[v]), n});
    }
    return samples;
}

// The radius of the ball that touches the plane under `s` there and passes through q.
double radius_through(const Sample& s, const Vector3& q) {
    const Vector3 way = detail::minus(s.point, q);
    const double height = 2 * detail::dot(s.normal, way);
    return height > 0 ? detail::dot(way, way) / height : INFINITY;
}

std::optional<MedialBall> shrink(const Sample& s, const std::vector<Sample>& samples) {
    double radius = 2;  // as large as the model
    for (int step = 0; step < 16; ++step) {
        Vector3 center;
        for (std::size_t k = 0; k < 3; ++k) center[k] = s.point[k] - radius * s.normal[k];
        const Sample* nearest = nullptr;
        double least = radius * radius * (1 - 1e-6);
        for (const Sample& o : samples) {
            if (o.vertex == s.vertex) continue;
            const Vector3 way = detail::minus(o.point, center);
            if (const double d = detail::dot(way, way); d < least) {
                least = d;
                nearest = &o;
            }
        }
        if (nearest == nullptr) return MedialBall{s.vertex, center, radius};
        const double smaller = radius_through(s, nearest->point);
        if (!(smaller < radius) || !(smaller > 1e-6)) break;
        radius = smaller;
    }
    return std::nullopt;
}

}  // namespace

std::vector<MedialBall> medial_balls(const detail::InterferenceModelData& model,
                                     const TreeFrame& frame, std::size_t most) {
    const std::vector<Sample> samples = samples_of(model, frame, most);
    std::vector<MedialBall> balls;
    for (const Sample& s : samples)
        if (const auto ball = shrink(s, samples)) balls.push_back(*ball);
    return balls;
}

}  // namespace trisect::hierarchies
