// SPDX-License-Identifier: Apache-2.0
#include "scene_peer.h"

#include <algorithm>
#include <chrono>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

namespace scene_peer {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometry<double>>;

template <class BoundingVolume>
Geometry geometry_of(const trisect::PolygonMesh& mesh) {
    auto model = std::make_shared<fcl::BVHModel<BoundingVolume>>();
    const auto point = [&mesh](std::uint32_t v) {
        return fcl::Vector3d(mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]);
    };
    model->beginModel();
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        for (std::size_t k = 2; k < corners.size(); ++k)
            model->addTriangle(point(corners[0]), point(corners[k - 1]), point(corners[k]));
    }
    model->endModel();
    return model;
}

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace

struct FclScene::State {
    std::vector<std::unique_ptr<fcl::CollisionObject<double>>> objects;
    fcl::DynamicAABBTreeCollisionManager<double> manager;
    std::vector<Pair> found;
    std::size_t boxes_met = 0;
    double narrow_seconds = 0;

    static bool ask(fcl::CollisionObject<double>* a, fcl::CollisionObject<double>* b, void* data) {
        State& state = *static_cast<State*>(data);
        ++state.boxes_met;
        const double start = now();
        fcl::CollisionRequest<double> request;
        fcl::CollisionResult<double> result;
        fcl::collide(a, b, request, result);
        state.narrow_seconds += now() - start;
        if (result.isCollision()) {
            const auto number = [](fcl::CollisionObject<double>* o) {
                return static_cast<std::uint32_t>(
                    reinterpret_cast<std::uintptr_t>(o->getUserData()));
            };
            state.found.emplace_back(std::min(number(a), number(b)),
                                     std::max(number(a), number(b)));
        }
        return false;  // go on
    }
};

FclScene::FclScene(const std::vector<trisect::PolygonMesh>& models,
                   const std::vector<std::size_t>& model_of_body, Volume volume)
    : state_(std::make_unique<State>()) {
    std::vector<Geometry> geometries;
    for (const trisect::PolygonMesh& mesh : models)
        geometries.push_back(volume == Volume::Obb ? geometry_of<fcl::OBB<double>>(mesh)
                                                   : geometry_of<fcl::OBBRSS<double>>(mesh));
    for (std::size_t i = 0; i < model_of_body.size(); ++i) {
        state_->objects.push_back(
            std::make_unique<fcl::CollisionObject<double>>(geometries[model_of_body[i]]));
        state_->objects.back()->setUserData(reinterpret_cast<void*>(i));
        state_->manager.registerObject(state_->objects.back().get());
    }
    state_->manager.setup();
}

FclScene::~FclScene() = default;

std::vector<Pair> FclScene::frame(const std::vector<Rows>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Rows& m = poses[i];
        fcl::Matrix3d r;
        r << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
        state_->objects[i]->setTransform(r, fcl::Vector3d(m[3], m[7], m[11]));
        state_->objects[i]->computeAABB();
    }
    state_->manager.update();
    state_->found.clear();
    state_->boxes_met = 0;
    state_->narrow_seconds = 0;
    state_->manager.collide(state_.get(), State::ask);
    std::sort(state_->found.begin(), state_->found.end());
    return state_->found;
}

std::size_t FclScene::boxes_met() const { return state_->boxes_met; }
double FclScene::narrow_seconds() const { return state_->narrow_seconds; }

}  // namespace scene_peer
