// SPDX-License-Identifier: Apache-2.0
//
// Scenes: many placed solids, some of them jointed.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/interference/interference_scene.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "poses.h"
#include "run.h"

namespace trisect::python {

namespace {

// One thread at a time may use a Scene; the interpreter's lock is released while it works.
struct LockedScene {
    std::mutex mutex;
    std::atomic<std::thread::id> user;
    Scene scene;
};

class SceneUse {
public:
    explicit SceneUse(std::atomic<std::thread::id>& user) : user_(user) {
        user_ = std::this_thread::get_id();
    }
    SceneUse(const SceneUse&) = delete;
    SceneUse& operator=(const SceneUse&) = delete;
    ~SceneUse() { user_ = std::thread::id(); }

private:
    std::atomic<std::thread::id>& user_;
};

template <class F>
auto with_scene(LockedScene& locked, const F& f) {
    return run([&] {
        if (locked.user == std::this_thread::get_id())
            throw UsageError("a Scene cannot be used by what is called while it works");
        const std::lock_guard lock(locked.mutex);
        const SceneUse use(locked.user);
        return f(locked.scene);
    });
}

Ratio ratio_of(const py::object& value) {
    if (py::isinstance<py::tuple>(value)) {
        const auto [p, q] = value.cast<std::pair<std::int64_t, std::int64_t>>();
        return {p, q};
    }
    if (!py::hasattr(value, "numerator"))
        throw py::type_error("value: must be an int, a Fraction, or a pair of ints");
    return {value.attr("numerator").cast<std::int64_t>(),
            value.attr("denominator").cast<std::int64_t>()};
}

void bind_joint(py::module_& m) {
    py::class_<Joint>(m, "Joint", "The relative motion of a link and the body that carries it.")
        .def_static("fixed", &Joint::fixed, "No motion.")
        .def_static(
            "revolute",
            [](const py::object& point, const std::array<std::int64_t, 3>& axis) {
                return Joint::revolute(point_of(point, "point"), axis);
            },
            py::arg("point"), py::arg("axis"),
            R"(Turns about the line through a point along an axis of integers.

The value is the tangent of half the angle, for an axis of length 1; a pair ``(1, 0)`` is half
a turn.
)")
        .def_static(
            "prismatic",
            [](const py::object& direction) {
                return Joint::prismatic(point_of(direction, "direction"));
            },
            py::arg("direction"), "Slides along a direction, by the value times it.")
        .def(
            "value_near",
            [](const Joint& joint, double degrees, int bits) {
                const Ratio r = joint.value_near(degrees, bits);
                return py::make_tuple(r.numerator, r.denominator);
            },
            py::arg("degrees"), py::arg("bits") = 20,
            "Of a revolute joint: a value, a pair of ints, that turns nearly by so many degrees.");
}

void bind_ids(py::module_& m) {
    py::class_<BodyId>(m, "BodyId", "The name of a body of a `Scene`.")
        .def_readonly("index", &BodyId::index, "Small, and used again for later bodies.")
        .def_readonly("generation", &BodyId::generation, "Of the bodies with this index.")
        .def(
            "__eq__", [](const BodyId& a, const BodyId& b) { return a == b; }, py::is_operator())
        .def("__hash__",
             [](const BodyId& b) { return py::hash(py::make_tuple(b.index, b.generation)); })
        .def("__repr__",
             [](const BodyId& b) { return "<BodyId " + std::to_string(b.index) + ">"; });
    py::class_<ScenePair>(m, "ScenePair", "Two bodies that are not disjoint.")
        .def_property_readonly(
            "a", [](const ScenePair& p) { return p.a; }, "`BodyId`")
        .def_property_readonly(
            "b", [](const ScenePair& p) { return p.b; }, "`BodyId`")
        .def_property_readonly(
            "relation", [](const ScenePair& p) { return enum_member("Relation", p.relation); },
            "The `Relation` of a to b.")
        .def_property_readonly(
            "contacts", [](const ScenePair& p) { return p.named_contacts; },
            "List of `Contact`, if requested.")
        .def("__repr__", [](const ScenePair& p) {
            return "<ScenePair " + std::to_string(p.a.index) + " " + std::to_string(p.b.index) +
                   ": " + to_string(p.relation) + ">";
        });
}

void bind_bodies(py::class_<LockedScene>& c) {
    c.def(
        "add",
        [](LockedScene& s, const Solid& solid, const py::object& pose, std::uint32_t groups,
           std::uint32_t looks_at) {
            const Pose p = pose_of(pose, "pose");
            return with_scene(s, [&](Scene& scene) {
                return scene.add(solid, p, CollisionFilter{groups, looks_at});
            });
        },
        py::arg("solid"), py::arg("pose") = py::none(), py::kw_only(), py::arg("groups") = 1,
        py::arg("looks_at") = 0xffffffffU, R"(Adds a body and returns its `BodyId`.

Parameters
----------
solid : Solid
pose : Pose, array_like or None
groups, looks_at : int
    Bit masks: two bodies are compared only if each is in a group that the other looks at.
)");
    c.def(
        "add_link",
        [](LockedScene& s, BodyId carrier, const Solid& solid, const Joint& joint,
           const py::object& mount, bool meets_carrier) {
            LinkOptions options;
            options.mount = pose_of(mount, "mount");
            options.meets_carrier = meets_carrier;
            return with_scene(
                s, [&](Scene& scene) { return scene.add_link(carrier, solid, joint, options); });
        },
        py::arg("carrier"), py::arg("solid"), py::arg("joint"), py::kw_only(),
        py::arg("mount") = py::none(), py::arg("meets_carrier") = false,
        R"(Adds a body that another one carries through a joint, and returns its `BodyId`.

Parameters
----------
carrier : BodyId
solid : Solid
joint : Joint
mount : Pose, array_like or None
    Where the frame of the joint is in the coordinates of the carrier.
meets_carrier : bool
    Whether to compare the link and its carrier.
)");
    c.def(
        "replace",
        [](LockedScene& s, BodyId body, const Solid& solid) {
            with_scene(s, [&](Scene& scene) { scene.replace(body, solid); });
        },
        py::arg("body"), py::arg("solid"), "Puts a solid in the place of a body's.");
    c.def(
        "remove",
        [](LockedScene& s, BodyId body) {
            with_scene(s, [&](Scene& scene) { scene.remove(body); });
        },
        py::arg("body"), "Removes a body that carries no link.");
}

void bind_placement(py::class_<LockedScene>& c) {
    c.def(
        "set_pose",
        [](LockedScene& s, BodyId body, const py::object& pose) {
            const Pose p = pose_of(pose, "pose");
            with_scene(s, [&](Scene& scene) { scene.set_pose(body, p); });
        },
        py::arg("body"), py::arg("pose"), "Moves a body and all that it carries.");
    c.def(
        "set_joint",
        [](LockedScene& s, BodyId link, const py::object& value) {
            const Ratio r = ratio_of(value);
            with_scene(s, [&](Scene& scene) { scene.set_joint(link, r); });
        },
        py::arg("link"), py::arg("value"),
        "Sets the joint of a link to an int, a Fraction or a pair of ints.");
    c.def(
        "ignore",
        [](LockedScene& s, BodyId a, BodyId b, bool ignored) {
            with_scene(s, [&](Scene& scene) { scene.ignore(a, b, ignored); });
        },
        py::arg("a"), py::arg("b"), py::arg("ignored") = true,
        "Leaves these two out from now on, or takes them in again.");
    c.def(
        "pose",
        [](LockedScene& s, BodyId body) {
            return with_scene(s, [&](Scene& scene) { return scene.pose(body); });
        },
        py::arg("body"), "The `Pose` of a body in the world.");
    c.def(
        "solid",
        [](LockedScene& s, BodyId body) {
            return with_scene(s, [&](Scene& scene) { return scene.solid(body); });
        },
        py::arg("body"), "The `Solid` of a body.");
}

}  // namespace

void bind_scene(py::module_& m) {
    bind_joint(m);
    bind_ids(m);
    py::class_<LockedScene> c(m, "Scene", R"(Many solids under poses, and which of them meet.

Relations are exact for the poses as they are. What is known about pairs is kept from query to
query, so the next one is fast where little has moved.
)");
    c.def(py::init<>());
    bind_bodies(c);
    bind_placement(c);
    c.def("__len__",
          [](LockedScene& s) { return with_scene(s, [](Scene& scene) { return scene.size(); }); });
    c.def("__contains__", [](LockedScene& s, BodyId body) {
        return with_scene(s, [&](Scene& scene) { return scene.contains(body); });
    });
    c.def(
        "bodies",
        [](LockedScene& s) { return with_scene(s, [](Scene& scene) { return scene.bodies(); }); },
        "List of `BodyId`.");
    c.def(
        "interfering",
        [](LockedScene& s, bool contacts) {
            SceneQueryOptions options;
            options.contacts = contacts;
            options.threads = limits_of_thread().threads;
            return with_scene(s, [&](Scene& scene) { return scene.interfering(options); });
        },
        py::kw_only(), py::arg("contacts") = false,
        R"(All pairs of bodies that are not disjoint, a list of `ScenePair`.

Parameters
----------
contacts : bool
    Also list the pairs of faces, edges and vertices that meet.
)");
}

}  // namespace trisect::python
