// SPDX-License-Identifier: Apache-2.0

#include <chrono>

#include <fcl/fcl.h>

#include "interference_peers.h"

namespace interference_peers {

namespace {

using Transform = fcl::Transform3<double>;
using Transforms = std::vector<Transform, Eigen::aligned_allocator<Transform>>;

Transform transform(const Placement& p) {
    Transform t = Transform::Identity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) t.linear()(i, j) = p[static_cast<std::size_t>(4 * i + j)];
        t.translation()[i] = p[static_cast<std::size_t>(4 * i + 3)];
    }
    return t;
}
Transforms transforms(std::span<const Placement> placements) {
    Transforms out;
    for (const Placement& p : placements) out.push_back(transform(p));
    return out;
}

template <class Volume>
class Fcl : public Peer {
public:
    using Model = fcl::BVHModel<Volume>;

    Fcl(std::string name, bool distance, bool slow, const trisect::PolygonMesh& a,
        const trisect::PolygonMesh& b, std::span<const Placement> placements,
        const Placement& home = home_placement)
        : name_(std::move(name)),
          distance_(distance),
          slow_(slow),
          home_(transform(home)),
          poses_(transforms(placements)) {
        const auto start = std::chrono::steady_clock::now();
        a_ = model(a);
        build_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        b_ = model(b);
    }

    [[nodiscard]] std::string name() const override { return "FCL " + name_; }
    [[nodiscard]] double build_seconds() const override { return build_; }
    [[nodiscard]] bool is_slow() const override { return slow_; }
    [[nodiscard]] bool collide(std::size_t i) override {
        const fcl::CollisionRequest<double> request(1, false);
        fcl::CollisionResult<double> result;
        fcl::collide(a_.get(), home_, b_.get(), poses_[i], request, result);
        return result.isCollision();
    }
    [[nodiscard]] std::optional<std::size_t> contacts(std::size_t i) override {
        const fcl::CollisionRequest<double> request(10000000, true);
        fcl::CollisionResult<double> result;
        fcl::collide(a_.get(), home_, b_.get(), poses_[i], request, result);
        return result.numContacts();
    }
    [[nodiscard]] std::optional<double> distance(std::size_t i) override {
        if (!distance_) return {};
        const fcl::DistanceRequest<double> request(false);
        fcl::DistanceResult<double> result;
        return fcl::distance(a_.get(), home_, b_.get(), poses_[i], request, result);
    }

private:
    static std::shared_ptr<Model> model(const trisect::PolygonMesh& mesh) {
        std::vector<fcl::Vector3<double>> points;
        std::vector<fcl::Triangle> triangles;
        for (const auto& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            const auto c = mesh.face(f);
            triangles.emplace_back(c[0], c[1], c[2]);
        }
        auto m = std::make_shared<Model>();
        m->beginModel(static_cast<int>(triangles.size()), static_cast<int>(points.size()));
        m->addSubModel(points, triangles);
        m->endModel();
        return m;
    }

    std::string name_;
    bool distance_;
    bool slow_;
    Transform home_;
    Transforms poses_;
    double build_ = 0;
    std::shared_ptr<Model> a_;
    std::shared_ptr<Model> b_;
};

class FclBoxes : public Peer {
public:
    FclBoxes(const std::array<double, 3>& a, const std::array<double, 3>& b,
             std::span<const Placement> placements, const Placement& home)
        : a_(a[0], a[1], a[2]),
          b_(b[0], b[1], b[2]),
          home_(transform(home)),
          poses_(transforms(placements)) {}

    [[nodiscard]] std::string name() const override { return "FCL boxes"; }
    [[nodiscard]] double build_seconds() const override { return 0; }
    [[nodiscard]] bool collide(std::size_t i) override {
        const fcl::CollisionRequest<double> request(1, false);
        fcl::CollisionResult<double> result;
        fcl::collide(&a_, home_, &b_, poses_[i], request, result);
        return result.isCollision();
    }
    [[nodiscard]] std::optional<double> distance(std::size_t i) override {
        const fcl::DistanceRequest<double> request(false, true);
        fcl::DistanceResult<double> result;
        return fcl::distance(&a_, home_, &b_, poses_[i], request, result);
    }

private:
    fcl::Box<double> a_;
    fcl::Box<double> b_;
    Transform home_;
    Transforms poses_;
};

}  // namespace

void add_fcl(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
             std::span<const Placement> p, const Placement& home) {
    using std::make_unique;
    peers.push_back(make_unique<Fcl<fcl::OBB<double>>>("OBB", false, false, a, b, p, home));
    peers.push_back(make_unique<Fcl<fcl::OBBRSS<double>>>("OBBRSS", true, false, a, b, p, home));
    peers.push_back(make_unique<Fcl<fcl::RSS<double>>>("RSS", true, true, a, b, p, home));
    peers.push_back(make_unique<Fcl<fcl::kIOS<double>>>("kIOS", true, false, a, b, p, home));
    peers.push_back(make_unique<Fcl<fcl::KDOP<double, 16>>>("KDOP16", false, true, a, b, p, home));
    peers.push_back(make_unique<Fcl<fcl::AABB<double>>>("AABB", false, true, a, b, p, home));
}

void add_fcl_obbrss(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
                    std::span<const Placement> p) {
    peers.push_back(std::make_unique<Fcl<fcl::OBBRSS<double>>>("OBBRSS", true, false, a, b, p));
}

void add_fcl_boxes(Peers& peers, const std::array<double, 3>& a, const std::array<double, 3>& b,
                   std::span<const Placement> placements, const Placement& home) {
    peers.push_back(std::make_unique<FclBoxes>(a, b, placements, home));
}

void add_fcl_volumes(Peers& peers, const trisect::PolygonMesh& a, const trisect::PolygonMesh& b,
                     std::span<const Placement> p) {
    using std::make_unique;
    peers.push_back(make_unique<Fcl<fcl::AABB<double>>>("AABB", false, true, a, b, p));
    peers.push_back(make_unique<Fcl<fcl::KDOP<double, 16>>>("KDOP16", false, true, a, b, p));
    peers.push_back(make_unique<Fcl<fcl::KDOP<double, 18>>>("KDOP18", false, true, a, b, p));
    peers.push_back(make_unique<Fcl<fcl::KDOP<double, 24>>>("KDOP24", false, true, a, b, p));
    peers.push_back(make_unique<Fcl<fcl::OBB<double>>>("OBB", false, false, a, b, p));
}

}  // namespace interference_peers
