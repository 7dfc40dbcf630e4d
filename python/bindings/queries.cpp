// SPDX-License-Identifier: Apache-2.0
//
// Points, rays, distances and planes against a solid, by its own tree.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <trisect/bsp/brep_index.h>

#include "arrays.h"
#include "bind.h"
#include "enums.h"
#include "fractions.h"
#include "names.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

std::span<const Point3d> points_of(const py::array_t<double, py::array::c_style>& a) {
    static_assert(sizeof(Point3d) == 3 * sizeof(double));
    return {reinterpret_cast<const Point3d*>(a.data()), static_cast<std::size_t>(a.size()) / 3};
}

std::array<double, 4> plane_of(const py::object& plane) {
    const std::vector<double> v = numbers_of(plane, 4, "plane");
    return {v[0], v[1], v[2], v[3]};
}

// Points ------------------------------------------------------------------------------------------

// What a place is compared with: another place, or a Location or its number, as arrays of locate()
// have them. Anything else has its own say.
py::object equals(const Place& place, const py::object& other) {
    if (py::isinstance<Place>(other)) return py::bool_(place == other.cast<const Place&>());
    // Arrays have an index slot as well, and compare element by element.
    if (PyIndex_Check(other.ptr()) == 0 || py::isinstance<py::array>(other))
        return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::int_(static_cast<int>(place.location)).attr("__eq__")(py::int_(other));
}

void bind_place(py::module_& m) {
    bind_enum(m, "Location", "Where a point is with respect to a solid.",
              std::vector<EnumMember>{{"OUTSIDE", static_cast<int>(Location::Outside)},
                                      {"ON_FACE", static_cast<int>(Location::OnFace)},
                                      {"ON_EDGE", static_cast<int>(Location::OnEdge)},
                                      {"ON_VERTEX", static_cast<int>(Location::OnVertex)},
                                      {"INSIDE", static_cast<int>(Location::Inside)}});
    py::class_<Place>(m, "Place", R"(Where a point is, and the face, edge or vertex that carries it.

Equal to its `Location`, so that ``solid.locate(p) == Location.INSIDE`` says what it seems to say;
two places are equal if they name the same faces as well.
)")
        .def_property_readonly(
            "location", [](const Place& p) { return enum_member("Location", p.location); },
            "`Location`")
        .def_property_readonly(
            "faces", [](const Place& p) { return faces_of(p); },
            "(operand, face) of 1, 2 or 3 faces that meet on a face, edge or vertex.")
        .def_property_readonly(
            "corner", [](const Place& p) { return to_object(p.corner); },
            "(operand, corner) of a vertex that was a corner of an operand, "
            "else None.")
        .def("__eq__", &equals, "Whether the other is the same place, or the location of this one.")
        .def(
            "__hash__", [](const Place& p) { return static_cast<int>(p.location); },
            "That of the location, which may be equal.")
        .def("__repr__", [](const Place& p) {
            return "<Place: " + std::string(to_string(p.location)) + " " +
                   std::string(py::repr(faces_of(p))) + ">";
        });
}

py::object locate(const Solid& solid, const py::object& points) {
    const auto a = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(points);
    if (a && a.ndim() == 1 && a.size() == 3) {
        const Point3d p{a.data()[0], a.data()[1], a.data()[2]};
        return py::cast(run([&] { return BrepIndex(solid).locate(p); }));
    }
    const auto rows = points_array(points, "points");
    const std::span<const Point3d> list = points_of(rows);
    py::array_t<std::uint8_t> locations(static_cast<py::ssize_t>(list.size()));
    const std::span<Location> out(reinterpret_cast<Location*>(locations.mutable_data()),
                                  list.size());
    run_on_threads([&](std::uint32_t n) { BrepIndex(solid).classify(list, out, n); });
    return locations;
}

void bind_points(py::class_<Solid>& c) {
    c.def("locate", &locate, py::arg("points"), R"(Where points are, exactly.

Parameters
----------
points : array_like, shape (3,) or (n, 3)

Returns
-------
Place
    Of one point: with the faces that carry it. ``== trisect.Location.INSIDE`` compares it, too.
ndarray, shape (n,), uint8
    Of many: numbers of `Location`, which ``== trisect.Location.INSIDE`` compares.
)");
    c.def(
        "places",
        [](const Solid& solid, const py::object& points) {
            const auto rows = points_array(points, "points");
            const std::span<const Point3d> list = points_of(rows);
            return run_on_threads(
                [&](std::uint32_t n) { return BrepIndex(solid).locate(list, n); });
        },
        py::arg("points"), "A list of `Place`, one for each row of an array of shape (n, 3).");
}

// Rays --------------------------------------------------------------------------------------------

void bind_hit(py::module_& m) {
    py::class_<RayHit>(m, "RayHit", R"(A part of a ray on one entity of the boundary.

It is a point, or an interval where the ray runs along an edge or in a face. Parameters count
in lengths of the direction.
)")
        .def_property_readonly(
            "t", [](const RayHit& h) { return h.enter.nearest(); }, "The parameter, rounded once.")
        .def_property_readonly(
            "t_leave", [](const RayHit& h) { return h.leave.nearest(); },
            "Where an interval ends; ``t`` for a point.")
        .def_property_readonly(
            "is_interval", [](const RayHit& h) { return h.is_interval; },
            "Whether the ray runs along an edge or in a face.")
        .def_property_readonly(
            "place", [](const RayHit& h) { return h.place; }, "`Place`")
        .def(
            "exact_t", [](const RayHit& h) { return to_fraction(h.enter.exact()); },
            "The parameter as a Fraction.")
        .def("__repr__", [](const RayHit& h) {
            return "<RayHit at " + std::string(py::repr(py::float_(h.enter.nearest()))) + ": " +
                   to_string(h.place.location) + ">";
        });
}

Ray ray_of(const py::object& origin, const py::object& direction) {
    return {point_of(origin, "origin"), point_of(direction, "direction")};
}

py::tuple first_hits(const Solid& solid, const py::object& origins, const py::object& directions) {
    const auto from = points_array(origins, "origins");
    const auto along = points_array(directions, "directions");
    const std::span<const Point3d> starts = points_of(from);
    const std::span<const Point3d> ways = points_of(along);
    if (starts.size() != ways.size())
        throw UsageError("first_hits: " + std::to_string(starts.size()) + " origins and " +
                         std::to_string(ways.size()) + " directions");
    std::vector<double> t(starts.size(), std::numeric_limits<double>::infinity());
    std::vector<FaceSource> faces(starts.size());
    run([&] {
        const BrepIndex index(solid);
        for (std::size_t i = 0; i < starts.size(); ++i) {
            detail::check_stop();
            const auto hit = index.first_facet(Ray{starts[i], ways[i]});
            if (!hit) continue;
            t[i] = hit->lo + (hit->hi - hit->lo) / 2;
            faces[i] = hit->face;
        }
    });
    const auto n = static_cast<py::ssize_t>(t.size());
    return py::make_tuple(adopt<double>(std::move(t), {n}), to_array(std::move(faces)));
}

void bind_rays(py::class_<Solid>& c) {
    c.def(
        "first_hit",
        [](const Solid& solid, const py::object& origin, const py::object& direction) {
            const Ray ray = ray_of(origin, direction);
            return run([&] { return BrepIndex(solid).first_hit(ray); });
        },
        py::arg("origin"), py::arg("direction"),
        "The first `RayHit` of a ray, or None. Both are arrays of shape (3,).");
    c.def(
        "all_hits",
        [](const Solid& solid, const py::object& origin, const py::object& direction) {
            const Ray ray = ray_of(origin, direction);
            return run([&] { return BrepIndex(solid).all_hits(ray); });
        },
        py::arg("origin"), py::arg("direction"), "All hits of a ray in order, a list of `RayHit`.");
    c.def("first_hits", &first_hits, py::arg("origins"), py::arg("directions"),
          R"(The first hits of many rays.

Parameters
----------
origins, directions : array_like, shape (n, 3)

Returns
-------
t : ndarray, shape (n,)
    Parameters in lengths of the directions, infinite where nothing is hit.
faces : ndarray, shape (n, 2), uint32
    The operand and its face; of no meaning where nothing is hit.
)");
}

// Distances ---------------------------------------------------------------------------------------

void bind_nearest_type(py::module_& m) {
    py::class_<Nearest>(m, "Nearest", "The nearest point of a boundary.")
        .def_property_readonly(
            "distance", [](const Nearest& n) { return n.distance; }, "The distance, rounded once.")
        .def_property_readonly(
            "place", [](const Nearest& n) { return n.place; }, "`Place`")
        .def_property_readonly(
            "point",
            [](const Nearest& n) {
                return to_array(Point3d{n.point[0].to_double(), n.point[1].to_double(),
                                        n.point[2].to_double()});
            },
            "The point, rounded, array of shape (3,).")
        .def(
            "exact_point", [](const Nearest& n) { return to_fractions(n.point); },
            "The point as three Fractions.")
        .def(
            "exact_squared_distance",
            [](const Nearest& n) { return to_fraction(n.squared_distance); },
            "The square of the distance as a Fraction.")
        .def("__repr__", [](const Nearest& n) {
            return "<Nearest: " + std::string(to_string(n.place.location)) + " at distance " +
                   std::string(py::repr(py::float_(n.distance))) + ">";
        });
}

py::array_t<double> signed_distances(const Solid& solid, const py::object& points) {
    const auto rows = points_array(points, "points");
    const std::span<const Point3d> list = points_of(rows);
    std::vector<double> distances(list.size());
    run_on_threads([&](std::uint32_t n) {
        const BrepIndex index(solid);
        std::vector<Location> locations(list.size());
        index.classify(list, locations, n);
        for (std::size_t i = 0; i < list.size(); ++i) {
            detail::check_stop();
            const auto bounds = index.distance(list[i]);
            const bool is_on =
                locations[i] != Location::Inside && locations[i] != Location::Outside;
            const double d = !bounds ? std::numeric_limits<double>::infinity()
                                     : bounds->lo + (bounds->hi - bounds->lo) / 2;
            distances[i] = is_on ? 0.0 : locations[i] == Location::Inside ? -d : d;
        }
    });
    const auto n = static_cast<py::ssize_t>(distances.size());
    return adopt<double>(std::move(distances), {n});
}

void bind_distances(py::class_<Solid>& c) {
    c.def(
        "nearest",
        [](const Solid& solid, const py::object& point) {
            const Point3d p = point_of(point, "point");
            return run([&] { return BrepIndex(solid).nearest(p); });
        },
        py::arg("point"), "The `Nearest` point of the boundary; None where there is none.");
    c.def("signed_distances", &signed_distances, py::arg("points"),
          R"(Distances of points to the boundary, below 0 inside.

The sign, and 0 on the boundary, are exact; the number is right to some thirteen digits.

Parameters
----------
points : array_like, shape (n, 3)

Returns
-------
ndarray, shape (n,)
)");
}

// Planes and boxes --------------------------------------------------------------------------------

py::list loops_of(std::vector<SectionRegion>&& regions) {
    py::list out;
    for (SectionRegion& r : regions) {
        py::list holes;
        for (SectionLoop& hole : r.holes) holes.append(to_array(std::move(hole.rounded)));
        out.append(py::make_tuple(to_array(std::move(r.outer.rounded)), holes));
    }
    return out;
}

void bind_planes(py::module_& m, py::class_<Solid>& c) {
    bind_enum(
        m, "PlaneRelation", "How a boundary lies to a plane.",
        std::vector<EnumMember>{{"EMPTY", static_cast<int>(PlaneRelation::Empty)},
                                {"BELOW", static_cast<int>(PlaneRelation::Below)},
                                {"TOUCHING_BELOW", static_cast<int>(PlaneRelation::TouchingBelow)},
                                {"STRADDLING", static_cast<int>(PlaneRelation::Straddling)},
                                {"TOUCHING_ABOVE", static_cast<int>(PlaneRelation::TouchingAbove)},
                                {"ABOVE", static_cast<int>(PlaneRelation::Above)}});
    c.def(
        "section",
        [](const Solid& solid, const py::object& plane) {
            const auto p = plane_of(plane);
            return loops_of(run([&] { return BrepIndex(solid).section(p); }));
        },
        py::arg("plane"), R"(The solid's points in a plane.

Parameters
----------
plane : array_like, shape (4,)
    a, b, c, d of a x + b y + c z + d = 0, exactly; the normal is (a, b, c).

Returns
-------
list of (outline, holes)
    Connected pieces: the outline counter-clockwise about the normal and a list of holes,
    clockwise, arrays of shape (n, 3).
)");
    c.def(
        "relation_to_plane",
        [](const Solid& solid, const py::object& plane) {
            const auto p = plane_of(plane);
            return enum_member("PlaneRelation",
                               run([&] { return BrepIndex(solid).relation_to(p); }));
        },
        py::arg("plane"), "The `PlaneRelation` of the boundary to a plane.");
    c.def(
        "faces_in_box",
        [](const Solid& solid, const py::object& low, const py::object& high) {
            const Point3d lo = point_of(low, "low");
            const Point3d hi = point_of(high, "high");
            return to_array(run([&] { return BrepIndex(solid).in_box(lo, hi); }).faces);
        },
        py::arg("low"), py::arg("high"),
        "The faces that meet a closed box, array of shape (n, 2) of operands and faces.");
}

}  // namespace

void bind_queries(py::module_& m) {
    bind_place(m);
    bind_hit(m);
    bind_nearest_type(m);
    py::class_<Solid> c = solid_class(m);
    bind_points(c);
    bind_rays(c);
    bind_distances(c);
    bind_planes(m, c);
}

}  // namespace trisect::python
