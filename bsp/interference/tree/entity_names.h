// SPDX-License-Identifier: Apache-2.0
//
// Names of entities from places.
#pragma once

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/interference/solid_interference.h>

namespace trisect::detail {

/// \pre the place is on the boundary
[[nodiscard]] inline EntityName name_of(const Place& place) {
    EntityName name;
    name.kind = place.location == Location::OnFace   ? EntityName::Kind::Face
                : place.location == Location::OnEdge ? EntityName::Kind::Edge
                                                     : EntityName::Kind::Vertex;
    name.face_count = place.face_count;
    for (std::size_t i = 0; i < place.face_count; ++i) {
        std::size_t at = i;
        for (; at > 0 && place.faces[i] < name.faces[at - 1]; --at)
            name.faces[at] = name.faces[at - 1];
        name.faces[at] = place.faces[i];
    }
    name.corner = place.corner;
    return name;
}

}  // namespace trisect::detail
