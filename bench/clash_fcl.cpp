// SPDX-License-Identifier: Apache-2.0
//
// clash_fcl MANIFEST EXPECTED.json
//
// The clashes of an assembly by FCL: its dynamic tree of boxes over all parts, and trees of boxes
// over the triangles of each file, shared by its parts. Asked is what `trisect clash` answers:
// which parts collide, and which are nearer than the largest clearance of the manifest. Prints the
// time of each step, and what was found of the parts that scripts/make-plant planted.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fcl/fcl.h>
#include <nlohmann/json.hpp>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/bsp/solid.h>

#include "trisect/clash_manifest.h"

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;
using Object = fcl::CollisionObjectd;
using trisect::app::ClashManifest;
using trisect::app::ClashPart;
using Pair = std::pair<std::size_t, std::size_t>;

// Of the processor, since the last lap.
class Clock {
public:
    double lap() {
        timespec t{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
        const double now = static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
        return now - std::exchange(last_, now);
    }

private:
    double last_ = 0;
};

std::shared_ptr<Model> model_of(const std::string& file) {
    const trisect::PolygonMesh mesh = trisect::Solid::from_mesh(trisect::read_mesh(file)).to_mesh();
    auto out = std::make_shared<Model>();
    out->beginModel();
    const auto point = [&](std::uint32_t corner) {
        const auto& p = mesh.points[corner];
        return fcl::Vector3d(p[0], p[1], p[2]);
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);  // convex
        for (std::size_t i = 2; i < face.size(); ++i)
            out->addTriangle(point(face[0]), point(face[i - 1]), point(face[i]));
    }
    out->endModel();
    return out;
}

fcl::Transform3d transform_of(const ClashPart& part) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            t.linear()(i, j) = part.pose[static_cast<std::size_t>(4 * i + j)];
        t.translation()[i] = part.pose[static_cast<std::size_t>(4 * i + 3)];
    }
    return t;
}

std::size_t number_of(const Object& object) {
    return static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
}

// Pairs whose boxes, grown by half of the clearance each, meet.
bool collect(Object* a, Object* b, void* found) {
    static_cast<std::vector<std::pair<Object*, Object*>>*>(found)->emplace_back(a, b);
    return false;
}

struct Found {
    std::map<Pair, bool> pairs;  // whether they collide; those that are not are near
};

void print_planted(const ClashManifest& manifest, const Found& found, const char* expected) {
    nlohmann::json planted;
    std::ifstream(expected) >> planted;
    struct Count {
        int all = 0;
        int colliding = 0;
        int near = 0;
    };
    std::map<std::string, Count> counts;
    std::set<Pair> wanted;
    for (const auto& p : planted) {
        const std::size_t a = part_number(manifest, p["part"].get<std::string>());
        const std::size_t b = part_number(manifest, p["beam"].get<std::string>());
        const Pair pair(std::min(a, b), std::max(a, b));
        wanted.insert(pair);
        Count& count = counts[p["kind"].get<std::string>()];
        ++count.all;
        const auto at = found.pairs.find(pair);
        if (at != found.pairs.end()) ++(at->second ? count.colliding : count.near);
    }
    std::size_t others = 0;
    for (const auto& [pair, collides] : found.pairs) others += wanted.count(pair) == 0 ? 1 : 0;
    for (const auto& [kind, count] : counts)
        std::printf("%-10s planted %d, colliding %d, near %d\n", kind.c_str(), count.all,
                    count.colliding, count.near);
    std::printf("others     %zu\n", others);
}

void run(const char* manifest_name, const char* expected) {
    Clock clock;
    const ClashManifest manifest = trisect::app::read_clash_manifest(manifest_name);
    std::printf("manifest   %.3f s\n", clock.lap());
    std::vector<std::shared_ptr<Model>> models;
    for (const std::string& file : manifest.files) models.push_back(model_of(file));
    std::printf("models     %.3f s\n", clock.lap());

    double clearance = 0;
    for (const auto& set : manifest.sets) clearance = std::max(clearance, set.clearance);
    std::vector<std::unique_ptr<Object>> objects;
    std::vector<Object*> pointers;
    for (std::size_t i = 0; i < manifest.parts.size(); ++i) {
        const ClashPart& part = manifest.parts[i];
        objects.push_back(std::make_unique<Object>(models[part.file], transform_of(part)));
        objects.back()->setUserData(reinterpret_cast<void*>(static_cast<std::uintptr_t>(i)));
        objects.back()->computeAABB();
        const_cast<fcl::AABBd&>(objects.back()->getAABB())
            .expand(fcl::Vector3d::Constant(clearance / 2));
        pointers.push_back(objects.back().get());
    }
    fcl::DynamicAABBTreeCollisionManagerd manager;
    manager.registerObjects(pointers);
    manager.setup();
    std::printf("tree       %.3f s\n", clock.lap());
    std::vector<std::pair<Object*, Object*>> candidates;
    manager.collide(&candidates, collect);
    std::printf("pairs      %.3f s, %zu pairs of boxes\n", clock.lap(), candidates.size());

    Found found;
    std::vector<std::pair<Object*, Object*>> apart;
    for (const auto& [a, b] : candidates) {
        const fcl::CollisionRequestd request(1, false);
        fcl::CollisionResultd result;
        fcl::collide(a, b, request, result);
        const auto [first, second] = std::minmax({number_of(*a), number_of(*b)});
        if (result.isCollision())
            found.pairs[{first, second}] = true;
        else
            apart.emplace_back(a, b);
    }
    std::printf("collisions %.3f s, %zu\n", clock.lap(), found.pairs.size());
    for (const auto& [a, b] : apart) {
        const fcl::DistanceRequestd request(false);
        fcl::DistanceResultd result;
        if (fcl::distance(a, b, request, result) >= clearance) continue;
        const auto [first, second] = std::minmax({number_of(*a), number_of(*b)});
        found.pairs[{first, second}] = false;
    }
    std::printf("distances  %.3f s, %zu pairs in all\n", clock.lap(), found.pairs.size());
    print_planted(manifest, found, expected);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: clash_fcl MANIFEST EXPECTED.json\n");
        return 2;
    }
    run(argv[1], argv[2]);
    return 0;
}
