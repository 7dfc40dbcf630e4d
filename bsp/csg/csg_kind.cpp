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
        {"linear_extrude", CsgKind::Linear},
        {"rotate_extrude", CsgKind::Revolved},
        {"cube", CsgKind::Solid},
        {"sphere", CsgKind::Solid},
        {"cylinder", CsgKind::Solid},
        {"polyhedron", CsgKind::Solid},
        {"square", CsgKind::Flat},
        {"circle", CsgKind::Flat},
        {"polygon", CsgKind::Flat}};
    const auto it = kinds.find(name);
    return it == kinds.end() ? CsgKind::Unknown : it->second;
}

}  // namespace trisect::detail
