// SPDX-License-Identifier: Apache-2.0
//
// Motions that no rational formula describes, and their first contact.

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/interference/least_distance.h>
#include <trisect/bsp/interference/solid_motion.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "poses.h"
#include "run.h"

namespace trisect::python {

namespace {

// A Python object that threads without Python's lock may copy and drop.
using SharedObject = std::shared_ptr<py::object>;

SharedObject shared(const py::object& o) {
    return {new py::object(o), [](py::object* p) {
                const py::gil_scoped_acquire acquire;
                delete p;
            }};
}

SharedObject function_of(const py::object& f, const char* what) {
    if (PyCallable_Check(f.ptr()) == 0)
        throw py::type_error(std::string(what) + ": must be callable");
    return shared(f);
}

std::array<double, 12> rows_of(const py::object& matrix) {
    const auto a = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(matrix);
    if (!a) {
        PyErr_Clear();
        throw py::type_error("pose: must return an array of numbers");
    }
    const bool fits = a.ndim() == 2 && a.shape(1) == 4 && (a.shape(0) == 3 || a.shape(0) == 4);
    if (!fits) throw UsageError("pose: must return a matrix of shape (3, 4) or (4, 4)");
    std::array<double, 12> rows{};
    for (std::size_t i = 0; i < 12; ++i) rows[i] = a.data()[i];
    return rows;
}

EnclosedMotion smooth_motion(const py::object& pose, const py::object& bend,
                             const std::vector<double>& breaks, double error) {
    SmoothMotion motion;
    motion.pose = [f = function_of(pose, "pose")](double t) {
        const py::gil_scoped_acquire acquire;
        return rows_of((*f)(t));
    };
    motion.bend = [f = function_of(bend, "bend")](double from, double to) {
        const py::gil_scoped_acquire acquire;
        return (*f)(from, to).cast<double>();
    };
    motion.error = error;
    return EnclosedMotion::smooth(std::move(motion), breaks);
}

std::vector<KeyFrame> frames_of(const py::object& times, const py::object& rotations,
                                const py::object& positions) {
    const auto t = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(times);
    const auto q =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(rotations);
    if (!t || !q) {
        PyErr_Clear();
        throw py::type_error("times and rotations: must be arrays of numbers");
    }
    const auto p = points_array(positions, "positions");
    const py::ssize_t n = t.size();
    if (t.ndim() != 1) throw UsageError("times: must have the shape (n,)");
    if (q.ndim() != 2 || q.shape(0) != n || q.shape(1) != 4)
        throw UsageError("rotations: must have the shape (" + std::to_string(n) +
                         ", 4), a quaternion (w, x, y, z) for each time");
    if (p.size() != 3 * n)
        throw UsageError("positions: must have the shape (" + std::to_string(n) + ", 3)");
    std::vector<KeyFrame> frames(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].time = t.data()[i];
        for (std::size_t k = 0; k < 4; ++k) frames[i].rotation[k] = q.data()[4 * i + k];
        for (std::size_t k = 0; k < 3; ++k) frames[i].position[k] = p.data()[3 * i + k];
    }
    return frames;
}

EnclosedMotion turning_motion(const py::object& start, const py::object& axis, double degrees,
                              const py::object& center, const py::object& shift, double duration) {
    ConstantTurn turn;
    turn.axis = point_of(axis, "axis");
    // The double nearest to the angle in radians is the angle: nothing is exact here.
    turn.angle = degrees * (std::acos(-1.0) / 180);
    turn.center = point_of(center, "center");
    turn.shift = point_of(shift, "shift");
    return EnclosedMotion::turning(pose_of(start, "start"), turn, duration);
}

void bind_enclosed_motion_type(py::module_& m) {
    py::class_<EnclosedMotion>(
        m, "EnclosedMotion",
        R"(A motion over time that is enclosed by rational ones, with a proof.

For turns of constant speed, key frames and functions, which no rational formula describes. The motion
is the real one: a turn by two radians is that, not a polygon.

Parameters
----------
motion : Motion, optional
    A rational motion, exactly; its parameter is the time. By default nothing moves.
)")
        .def(py::init([](const Motion& motion) { return EnclosedMotion(motion); }),
             py::arg_v("motion", Motion(), "Motion()"))
        .def_static("turning", &turning_motion, py::arg("start"), py::arg("axis"),
                    py::arg("degrees"), py::kw_only(),
                    py::arg("center") = py::make_tuple(0.0, 0.0, 0.0),
                    py::arg("shift") = py::make_tuple(0.0, 0.0, 0.0), py::arg("duration") = 1.0,
                    R"(A turn of constant angular speed, with a straight shift of constant speed.

Parameters
----------
start : Pose, array_like or None
axis : array_like, shape (3,)
    Of any length.
degrees : float
    Over the whole duration, any number of turns; the double nearest to it in radians is the angle.
center : array_like, shape (3,)
    A point of the axis.
shift : array_like, shape (3,)
    Over the whole duration.
duration : float
)")
        .def_static(
            "through",
            [](const py::object& times, const py::object& rotations, const py::object& positions) {
                return EnclosedMotion::through(frames_of(times, rotations, positions));
            },
            py::arg("times"), py::arg("rotations"), py::arg("positions"),
            R"(From key frame to key frame: constant angular speed, positions on straight lines.

Parameters
----------
times : array_like, shape (n,)
    Ascending from 0.
rotations : array_like, shape (n, 4)
    Quaternions (w, x, y, z) of any length; between two of them the shorter way round.
positions : array_like, shape (n, 3)
)")
        .def_static("smooth", &smooth_motion, py::arg("pose"), py::arg("bend"), py::kw_only(),
                    py::arg("breaks") = std::vector<double>{0.0, 1.0}, py::arg("error") = 0.0,
                    R"(A motion given by a function, with a bound on how it bends.

Parameters
----------
pose : callable
    ``pose(t)`` is a matrix of shape (3, 4) or (4, 4), continuous in t.
bend : callable
    ``bend(t0, t1)`` bounds the magnitude of the second derivative of each of its twelve numbers
    between two times. What is proved is proved from this.
breaks : sequence of float
    From 0, ascending, to the duration: where the motion may have a kink.
error : float
    Every number that ``pose`` returns is within this of the motion's.
)")
        .def_property_readonly("duration", &EnclosedMotion::duration,
                               "The time runs from 0 to this.")
        .def("__repr__", [](const EnclosedMotion& motion) {
            return "<trisect.EnclosedMotion: duration " +
                   std::string(py::repr(py::float_(motion.duration()))) + ">";
        });
}

std::string contact_text(const NamedEnclosedContact& c) {
    const std::string free = py::repr(py::float_(c.free_until));
    switch (c.outcome) {
        case EnclosedContact::Outcome::None:
            return "<EnclosedContact: none>";
        case EnclosedContact::Outcome::Contact:
            return "<EnclosedContact between " + free + " and " +
                   std::string(py::repr(py::float_(*c.contact_by))) + ">";
        case EnclosedContact::Outcome::Undecided:
            break;
    }
    return "<EnclosedContact: undecided from " + free + ">";
}

void bind_enclosed_contact_type(py::module_& m) {
    bind_enum(m, "ContactOutcome", "What `enclosed_first_contact` proved.",
              std::vector<EnumMember>{
                  {"NONE", static_cast<int>(EnclosedContact::Outcome::None)},
                  {"CONTACT", static_cast<int>(EnclosedContact::Outcome::Contact)},
                  {"UNDECIDED", static_cast<int>(EnclosedContact::Outcome::Undecided)}});
    py::class_<NamedEnclosedContact>(
        m, "EnclosedContact", "The first contact of enclosed motions, as an interval of time.")
        .def_property_readonly(
            "outcome",
            [](const NamedEnclosedContact& c) { return enum_member("ContactOutcome", c.outcome); },
            R"(`ContactOutcome`

NONE: at no time have the solids a point in common. CONTACT: they have at `contact_by`. UNDECIDED:
they may touch during `undecided`, and certainly do at no other time.
)")
        .def_readonly("free_until", &NamedEnclosedContact::free_until,
                      "At no time before this have the solids a point in common.")
        .def_readonly("contact_by", &NamedEnclosedContact::contact_by,
                      "At this time they have; None where that is not proved of any.")
        .def_readonly("is_narrow", &NamedEnclosedContact::is_narrow,
                      "Whether these two times are as close as requested.")
        .def_property_readonly(
            "undecided",
            [](const NamedEnclosedContact& c) {
                py::list spans;
                for (const TimeSpan& s : c.undecided) spans.append(py::make_tuple(s.from, s.to));
                return spans;
            },
            "Spans of time (from, to) of which nothing is proved: grazing, resting, sliding.")
        .def_readonly("witnesses", &NamedEnclosedContact::witnesses,
                      "List of `Witness`: faces that pass through each other at `contact_by`.")
        .def("__repr__", &contact_text);
}

EnclosedMotion enclosed_motion_of(const py::object& motion, const char* what) {
    if (py::isinstance<EnclosedMotion>(motion)) return motion.cast<EnclosedMotion>();
    if (py::isinstance<Motion>(motion)) return EnclosedMotion(motion.cast<Motion>());
    throw py::type_error(std::string(what) + ": must be a Motion or an EnclosedMotion");
}

void bind_least_distance(py::module_& m) {
    py::class_<LeastDistance>(m, "LeastDistance",
                              "How near moving solids come to each other, as a proved interval.")
        .def_readonly("lower", &LeastDistance::lower, "At no time is the distance below this.")
        .def_readonly("upper", &LeastDistance::upper, "At `time` it is not above this.")
        .def_readonly("time", &LeastDistance::time, "When the distance is at most `upper`.")
        .def_readonly("is_narrow", &LeastDistance::is_narrow,
                      "Whether the bounds are as close as requested.")
        .def_property_readonly(
            "a", [](const LeastDistance& d) { return d.a; },
            "`EntityName` on the first solid that is so near.")
        .def_property_readonly(
            "b", [](const LeastDistance& d) { return d.b; }, "`EntityName` on the second one.")
        .def_property_readonly(
            "on_a", [](const LeastDistance& d) { return to_array(d.on_a); },
            "Float array of shape (3,), near to the closest point of the first solid, in the "
            "world.")
        .def_property_readonly(
            "on_b", [](const LeastDistance& d) { return to_array(d.on_b); },
            "The same of the second solid.")
        .def("__repr__", [](const LeastDistance& d) {
            return "<LeastDistance between " + std::string(py::repr(py::float_(d.lower))) +
                   " and " + std::string(py::repr(py::float_(d.upper))) + ">";
        });
    m.def(
        "least_distance",
        [](const Solid& a, const py::object& motion_a, const Solid& b, const py::object& motion_b,
           double relative, double absolute) {
            const EnclosedMotion of_a = enclosed_motion_of(motion_a, "motion_a");
            const EnclosedMotion of_b = enclosed_motion_of(motion_b, "motion_b");
            return run([&] { return least_distance(a, of_a, b, of_b, {relative, absolute}); });
        },
        py::arg("a"), py::arg("motion_a"), py::arg("b"), py::arg("motion_b"), py::kw_only(),
        py::arg("relative") = 1e-6, py::arg("absolute") = 0.0,
        R"(How near two moving solids come to each other, over the whole time.

Parameters
----------
a, b : Solid
motion_a, motion_b : Motion or EnclosedMotion
    Of the same duration, or one of them stands still.
relative : float
    How far apart the bounds may be, as a part of the upper one.
absolute : float
    The same in units of length: what is below this need not be told from 0.

Returns
-------
LeastDistance or None
    Proved; None when one of the solids is empty. Of boundaries: of a solid inside of another it is
    the clearance. Both bounds are 0 where boundaries certainly pass through each other.

Raises
------
UsageError
    For widths out of range, and durations that differ.
)");
}

}  // namespace

void bind_enclosed(py::module_& m) {
    bind_least_distance(m);
    bind_enclosed_motion_type(m);
    bind_enclosed_contact_type(m);
    m.def(
        "enclosed_first_contact",
        [](const Solid& a, const EnclosedMotion& motion_a, const Solid& b,
           const EnclosedMotion& motion_b, double width) {
            EnclosedContactOptions options;
            options.width = width;
            return run([&] { return enclosed_first_contact(a, motion_a, b, motion_b, options); });
        },
        py::arg("a"), py::arg("motion_a"), py::arg("b"), py::arg("motion_b"), py::kw_only(),
        py::arg("width") = 1e-9, R"(When solids in enclosed motion first have a point in common.

Parameters
----------
a, b : Solid
motion_a, motion_b : EnclosedMotion
    Of the same duration, or one of them stands still.
width : float
    How far apart `free_until` and `contact_by` may be, in units of time.

Returns
-------
EnclosedContact
    Proved, as an interval of time; touching without crossing may stay undecided.

Raises
------
UsageError
    For a width that is not positive, and durations that differ.
)");
}

}  // namespace trisect::python
