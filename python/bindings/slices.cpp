// SPDX-License-Identifier: Apache-2.0
//
// Slices of solids.

#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/modelling/slices.h>

#include "arrays.h"
#include "bind.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

SliceFrame frame_of(const py::object& axis) {
    if (py::isinstance<py::str>(axis)) {
        const auto word = axis.cast<std::string>();
        if (word == "x") return SliceFrame::across(0);
        if (word == "y") return SliceFrame::across(1);
        if (word == "z") return SliceFrame::across(2);
        throw UsageError("axis: must be 'x', 'y', 'z' or three numbers, not '" + word + "'");
    }
    const std::vector<double> v = numbers_of(axis, 3, "axis");
    return SliceFrame({v[0], v[1], v[2]});
}

SliceRule rule_of(const std::string& word) {
    if (word == "closed") return SliceRule::Closed;
    if (word == "below") return SliceRule::Below;
    if (word == "above") return SliceRule::Above;
    throw UsageError("faces: must be 'closed', 'below' or 'above', not '" + word + "'");
}

py::object loop_of(const Slice& slice, std::uint32_t loop, const SliceFrame& frame) {
    std::vector<Point3d> points;
    points.reserve(slice.loops[loop].size());
    for (const std::uint32_t v : slice.loops[loop])
        points.push_back(frame.space(slice.points[v], slice.height));
    return to_array(std::move(points));
}

py::list layer_of(const Slice& slice, const SliceFrame& frame) {
    py::list out;
    for (const auto& region : slice.regions) {
        py::list holes;
        for (std::size_t i = 1; i < region.size(); ++i)
            holes.append(loop_of(slice, region[i], frame));
        out.append(py::make_tuple(loop_of(slice, region[0], frame), holes));
    }
    return out;
}

}  // namespace

void bind_slices(py::module_& m) {
    auto c = solid_class(m);
    c.def(
        "slices",
        [](const Solid& solid, const py::object& heights, const py::object& axis,
           const std::string& faces) {
            SliceOptions options;
            options.frame = frame_of(axis);
            options.rule = rule_of(faces);
            const std::vector<double> planes = numbers_of(heights, "heights");
            const std::vector<Slice> found = run_on_threads([&](std::uint32_t threads) {
                options.evaluate.threads = threads;
                return slices(solid, planes, options);
            });
            py::list out;
            for (const Slice& slice : found) out.append(layer_of(slice, options.frame));
            return out;
        },
        py::arg("heights"), py::kw_only(), py::arg("axis") = "z", py::arg("faces") = "closed",
        R"(Sections with many parallel planes, found in one walk over the boundary.

Parameters
----------
heights : array_like, shape (n,)
    In any order.
axis : {'x', 'y', 'z'} or array_like, shape (3,)
    What the planes are across; of a direction n they are the points p with n . p = height, exactly.
faces : {'closed', 'below', 'above'}
    What counts where a face is in a plane: the face, or what is right below it, or right above it.

Returns
-------
list of list of (outline, holes)
    For each height the connected pieces, as `section` has them: arrays of shape (k, 3), outlines
    counter-clockwise about the axis, holes clockwise, corners rounded once. Along a direction that is
    no axis one of their coordinates is computed in doubles.

Raises
------
UnsupportedError
    For an unbounded set.
)");
}

}  // namespace trisect::python
