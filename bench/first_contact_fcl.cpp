// SPDX-License-Identifier: Apache-2.0

#include <fcl/fcl.h>

#include <vector>

#include "first_contact_peer.h"

namespace peer {

struct Body::Data {
    std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> model;
};

bool is_available() { return true; }

Body::Body(const trisect::PolygonMesh& mesh) {
    auto d = std::make_shared<Data>();
    d->model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    std::vector<fcl::Vector3d> points;
    for (const auto& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
    std::vector<fcl::Triangle> triangles;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        for (std::size_t i = 2; i < corners.size(); ++i)
            triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
    }
    d->model->beginModel();
    d->model->addSubModel(points, triangles);
    d->model->endModel();
    data = std::move(d);
}

std::optional<double> first_contact(const Body& a, const Body& b,
                                    const std::array<double, 12>& start,
                                    const std::array<double, 3>& by, Solver solver) {
    fcl::Transform3d from = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            from.matrix()(i, j) = start[static_cast<std::size_t>(4 * i + j)];
    fcl::Transform3d to = from;
    to.translation() += fcl::Vector3d(by[0], by[1], by[2]);
    fcl::ContinuousCollisionRequestd request;
    request.ccd_motion_type = fcl::CCDM_TRANS;
    request.ccd_solver_type = solver == Solver::ConservativeAdvancement
                                  ? fcl::CCDC_CONSERVATIVE_ADVANCEMENT
                                  : fcl::CCDC_NAIVE;
    if (solver == Solver::ManySamples) request.num_max_iterations = 1000;
    fcl::ContinuousCollisionResultd result;
    const fcl::Transform3d rest = fcl::Transform3d::Identity();
    fcl::continuousCollide(a.data->model.get(), rest, rest, b.data->model.get(), from, to, request,
                           result);
    if (!result.is_collide) return std::nullopt;
    return result.time_of_contact;
}

}  // namespace peer
