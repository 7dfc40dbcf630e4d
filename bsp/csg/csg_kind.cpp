// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_kind.h>

#include <functional>
#include <map>
#include <string>

namespace trisect::detail {

CsgKind csg_kind(std::string_view name) {
    static const std::map<std::string, CsgKind, std::less<>> kinds{
        {"group", CsgKind::Group},
        {"union", CsgKind::Group},
        {"color", CsgKind::Group},
        {"render", CsgKind::Group},
        {"difference", CsgKind::Difference},
        {"intersection", CsgKind::Intersection},
        {"multmatrix", CsgKind::Matrix},
        {"hull", CsgKind::Hull},
        {"minkowski", CsgKind::Minkowski},
        {"resize", CsgKind::Resize},
        {"offset", CsgKind::Offset},
        {"projection", CsgKind::Projection},
        {"import", CsgKind::Import},
        {"linear_extrude", CsgKind::Linear},
        {"rotate_extrude", CsgKind::Revolved},
        {"cube", CsgKind::Solid},
        {"sphere", CsgKind::Solid},
        {"cylinder", CsgKind::Solid},
        {"polyhedron", CsgKind::Solid},
        {"surface", CsgKind::Solid},
        {"square", CsgKind::Flat},
        {"circle", CsgKind::Flat},
        {"polygon", CsgKind::Flat},
        {"text", CsgKind::Flat}};
    const auto it = kinds.find(name);
    return it == kinds.end() ? CsgKind::Unknown : it->second;
}

bool csg_is_whole(CsgKind kind) {
    switch (kind) {
        case CsgKind::Solid:
        case CsgKind::Flat:
        case CsgKind::Revolved:
        case CsgKind::Hull:
        case CsgKind::Minkowski:
        case CsgKind::Offset:
        case CsgKind::Projection:
        case CsgKind::Import:
            return true;
        default:
            return false;
    }
}

int csg_dimension(CsgKind kind) {
    switch (kind) {
        case CsgKind::Flat:
        case CsgKind::Offset:
        case CsgKind::Projection:
            return 2;
        case CsgKind::Solid:
        case CsgKind::Linear:
        case CsgKind::Revolved:
            return 3;
        default:
            return 0;
    }
}

}  // namespace trisect::detail
