// SPDX-License-Identifier: Apache-2.0

#include "names.h"

namespace trisect::python {

namespace {

template <class Named>
py::tuple first_faces(const Named& named) {
    py::tuple faces(named.face_count);
    for (std::size_t i = 0; i < named.face_count; ++i) faces[i] = to_tuple(named.faces[i]);
    return faces;
}

}  // namespace

py::tuple to_tuple(const FaceSource& face) { return py::make_tuple(face.operand, face.face); }

py::tuple faces_of(const Place& place) { return first_faces(place); }
py::tuple faces_of(const EntityName& name) { return first_faces(name); }

py::object to_object(const CornerSource& corner) {
    if (!corner.is_valid()) return py::none();
    return py::make_tuple(corner.operand, corner.corner);
}

}  // namespace trisect::python
