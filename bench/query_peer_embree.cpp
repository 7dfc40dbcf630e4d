// SPDX-License-Identifier: Apache-2.0

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>

#include "query_peers.h"

namespace query_peers {

namespace {

// A filter that counts a hit and rejects it, so that the ray goes on.
struct CountingContext {
    RTCIntersectContext context;
    int hits;
};

void count_hit(const RTCFilterFunctionNArguments* a) {
    ++reinterpret_cast<CountingContext*>(a->context)->hits;
    a->valid[0] = 0;
}

class Embree final : public Peer {
public:
    Embree(const trisect::PolygonMesh& mesh, bool robust) : robust_(robust) {
        const double start = thread_seconds();
        device_ = rtcNewDevice("threads=1");
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_,
                         static_cast<RTCSceneFlags>((robust ? RTC_SCENE_FLAG_ROBUST : 0) |
                                                    RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
            g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.points.size()));
        auto* faces = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.face_count()));
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                points[3 * i + k] = static_cast<float>(mesh.points[i][k]);
        for (std::size_t i = 0; i < mesh.face_count(); ++i)
            for (std::size_t k = 0; k < 3; ++k) faces[3 * i + k] = mesh.face(i)[k];
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene_, g);
        rtcReleaseGeometry(g);
        rtcCommitScene(scene_);
        build_seconds_ = thread_seconds() - start;
    }
    ~Embree() override {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    [[nodiscard]] std::string name() const override { return robust_ ? "Embree robust" : "Embree"; }
    [[nodiscard]] double build_seconds() const override { return build_seconds_; }

    void locate(std::span<const Point> points, std::span<Side> sides) const override {
        for (std::size_t i = 0; i < points.size(); ++i) {
            CountingContext context{};
            rtcInitIntersectContext(&context.context);
            context.context.filter = count_hit;
            RTCRay ray = ray_of({points[i], {0.5417, 0.3217, 0.7763}}).ray;
            rtcOccluded1(scene_, &context.context, &ray);
            sides[i] = static_cast<Side>(context.hits & 1);
        }
    }

    void first_hits(std::span<const Ray> rays, std::span<std::int64_t> hits) const override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRayHit hit = ray_of(rays[i]);
            rtcIntersect1(scene_, &context, &hit);
            hits[i] = hit.hit.geomID == RTC_INVALID_GEOMETRY_ID
                          ? -1
                          : static_cast<std::int64_t>(hit.hit.primID);
        }
    }

private:
    static RTCRayHit ray_of(const Ray& r) {
        RTCRayHit hit{};
        hit.ray.org_x = static_cast<float>(r.origin[0]);
        hit.ray.org_y = static_cast<float>(r.origin[1]);
        hit.ray.org_z = static_cast<float>(r.origin[2]);
        hit.ray.dir_x = static_cast<float>(r.direction[0]);
        hit.ray.dir_y = static_cast<float>(r.direction[1]);
        hit.ray.dir_z = static_cast<float>(r.direction[2]);
        hit.ray.tfar = std::numeric_limits<float>::infinity();
        hit.ray.mask = ~0U;
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        return hit;
    }

    bool robust_;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    double build_seconds_ = 0;
};

}  // namespace

std::unique_ptr<Peer> make_embree(const trisect::PolygonMesh& mesh, bool robust) {
    return std::make_unique<Embree>(mesh, robust);
}

}  // namespace query_peers
