// SPDX-License-Identifier: Apache-2.0
//
// Poses, motions, interference and scenes.

#include <array>
#include <limits>
#include <vector>

#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/interference/solid_motion.h>

#include "call.h"
#include "handles.h"

using namespace trisect;  // NOLINT(google-build-using-namespace)
using c::make_handle;
using c::point_of;
using c::required;

namespace {

Pose pose_or_identity(const trisect_pose* pose) { return pose != nullptr ? pose->pose : Pose(); }

Motion motion_or_still(const trisect_motion* motion) {
    return motion != nullptr ? motion->motion : Motion();
}

std::array<std::int64_t, 4> quaternion_of(const std::int64_t* q) {
    (void)required(q, "quaternion");
    return {q[0], q[1], q[2], q[3]};
}

trisect_body to_c(const BodyId& id) { return {id.index, id.generation}; }
BodyId from_c(const trisect_body& body) { return {body.index, body.generation}; }

}  // namespace

trisect_status trisect_pose_from_rows(const double rows[12], trisect_pose** pose) {
    return make_handle(pose, "pose", [&] {
        (void)required(rows, "rows");
        std::array<double, 12> numbers{};
        for (std::size_t i = 0; i < 12; ++i) numbers[i] = rows[i];
        return Pose::from_doubles(numbers);
    });
}

trisect_status trisect_pose_from_quaternion(const int64_t quaternion[4],
                                            const double translation[3], trisect_pose** pose) {
    return make_handle(pose, "pose", [&] {
        return Pose::from_quaternion(quaternion_of(quaternion),
                                     point_of(translation, "translation"));
    });
}

trisect_status trisect_pose_product(const trisect_pose* a, const trisect_pose* b,
                                    trisect_pose** pose) {
    return make_handle(pose, "pose", [&] { return pose_or_identity(a) * pose_or_identity(b); });
}

trisect_status trisect_pose_inverse(const trisect_pose* of, trisect_pose** pose) {
    return make_handle(pose, "pose", [&] { return pose_or_identity(of).inverse(); });
}

trisect_status trisect_pose_rows(const trisect_pose* pose, double rows[12]) {
    return c::call([&] {
        (void)required(rows, "rows");
        const Pose own = pose_or_identity(pose);
        for (std::size_t i = 0; i < 12; ++i) rows[i] = own.approximate()[i];
    });
}

void trisect_pose_free(trisect_pose* pose) { delete pose; }

trisect_status trisect_interfere(const trisect_solid* a, const trisect_pose* pose_a,
                                 const trisect_solid* b, const trisect_pose* pose_b,
                                 trisect_relation* relation) {
    return c::call([&] {
        static_assert(static_cast<int>(Relation::Equal) == TRISECT_EQUAL);
        const SolidInterference found = interfere(required(a, "a").solid, pose_or_identity(pose_a),
                                                  required(b, "b").solid, pose_or_identity(pose_b));
        required(relation, "relation") = static_cast<trisect_relation>(found.relation);
    });
}

trisect_status trisect_distance(const trisect_solid* a, const trisect_pose* pose_a,
                                const trisect_solid* b, const trisect_pose* pose_b, double* lower,
                                double* upper) {
    return c::call([&] {
        (void)required(lower, "lower");
        (void)required(upper, "upper");
        const auto found = boundary_distance(required(a, "a").solid, pose_or_identity(pose_a),
                                             required(b, "b").solid, pose_or_identity(pose_b));
        *lower = found ? found->lower : std::numeric_limits<double>::infinity();
        *upper = found ? found->upper : std::numeric_limits<double>::infinity();
    });
}

trisect_status trisect_are_nearer_than(const trisect_solid* a, const trisect_pose* pose_a,
                                       const trisect_solid* b, const trisect_pose* pose_b,
                                       double distance, int* are_nearer) {
    return c::call([&] {
        required(are_nearer, "are_nearer") =
            are_nearer_than(required(a, "a").solid, pose_or_identity(pose_a),
                            required(b, "b").solid, pose_or_identity(pose_b), distance)
                ? 1
                : 0;
    });
}

trisect_status trisect_motion_still(const trisect_pose* pose, trisect_motion** motion) {
    return make_handle(motion, "motion", [&] { return Motion(pose_or_identity(pose)); });
}

trisect_status trisect_motion_translation(const trisect_pose* start, const double by[3],
                                          trisect_motion** motion) {
    return make_handle(motion, "motion", [&] {
        return Motion::translation(pose_or_identity(start), point_of(by, "by"));
    });
}

trisect_status trisect_motion_screw(const trisect_pose* start, const int64_t quaternion[4],
                                    const double center[3], const double shift[3],
                                    trisect_motion** motion) {
    return make_handle(motion, "motion", [&] {
        return Motion::screw(
            pose_or_identity(start),
            Screw{quaternion_of(quaternion), point_of(center, "center"), point_of(shift, "shift")});
    });
}

void trisect_motion_free(trisect_motion* motion) { delete motion; }

trisect_status trisect_first_contact(const trisect_solid* a, const trisect_motion* motion_a,
                                     const trisect_solid* b, const trisect_motion* motion_b,
                                     int until_overlap, int* exists, double* time) {
    return c::call([&] {
        (void)required(exists, "exists");
        (void)required(time, "time");
        FirstContactOptions options;
        options.event = until_overlap != 0 ? ContactEvent::Overlap : ContactEvent::Touch;
        const NamedFirstContact found =
            first_contact(required(a, "a").solid, motion_or_still(motion_a), required(b, "b").solid,
                          motion_or_still(motion_b), options);
        *exists = found.exists() ? 1 : 0;
        *time = found.exists() ? found.time->to_double() : std::numeric_limits<double>::infinity();
    });
}

trisect_status trisect_scene_create(trisect_scene** scene) {
    if (scene != nullptr) *scene = nullptr;
    return c::call([&] { required(scene, "scene") = new trisect_scene; });
}

trisect_status trisect_scene_add(trisect_scene* scene, const trisect_solid* solid,
                                 const trisect_pose* pose, trisect_body* body) {
    return c::call([&] {
        (void)required(body, "body");
        *body = to_c(required(scene, "scene")
                         .scene.add(required(solid, "solid").solid, pose_or_identity(pose)));
    });
}

trisect_status trisect_scene_set_pose(trisect_scene* scene, trisect_body body,
                                      const trisect_pose* pose) {
    return c::call(
        [&] { required(scene, "scene").scene.set_pose(from_c(body), pose_or_identity(pose)); });
}

trisect_status trisect_scene_replace(trisect_scene* scene, trisect_body body,
                                     const trisect_solid* solid) {
    return c::call([&] {
        required(scene, "scene").scene.replace(from_c(body), required(solid, "solid").solid);
    });
}

trisect_status trisect_scene_remove(trisect_scene* scene, trisect_body body) {
    return c::call([&] { required(scene, "scene").scene.remove(from_c(body)); });
}

trisect_status trisect_scene_interfering(trisect_scene* scene, const trisect_pair** pairs,
                                         size_t* count) {
    if (pairs != nullptr) *pairs = nullptr;
    if (count != nullptr) *count = 0;
    return c::call([&] {
        trisect_scene& own = required(scene, "scene");
        (void)required(pairs, "pairs");
        (void)required(count, "count");
        SceneQueryOptions options;
        options.threads = c::limits_of_thread().threads;
        own.pairs.clear();
        for (const ScenePair& p : own.scene.interfering(options))
            own.pairs.push_back({to_c(p.a), to_c(p.b), static_cast<trisect_relation>(p.relation)});
        *pairs = own.pairs.data();
        *count = own.pairs.size();
    });
}

void trisect_scene_free(trisect_scene* scene) { delete scene; }
