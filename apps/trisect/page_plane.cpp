// SPDX-License-Identifier: Apache-2.0
#include "page_plane.h"

#include <fmt/format.h>

#include <string>

namespace trisect::app {
namespace {

std::string hexadecimal(const Plane::Coefficient& value) {
    const Plane::Coefficient size = value.abs();
    std::string digits;
    for (int i = 5; i >= 0; --i)
        if (const auto limb = size.limb(i); !digits.empty())
            digits += fmt::format("{:016x}", limb);
        else if (limb != 0 || i == 0)
            digits += fmt::format("{:x}", limb);
    return (value.is_negative() ? "-" : "") + digits;
}

}  // namespace

Json plane_json(const Plane& plane) {
    return Json::array({hexadecimal(plane.normal(0)), hexadecimal(plane.normal(1)),
                        hexadecimal(plane.normal(2)), hexadecimal(plane.offset())});
}

}  // namespace trisect::app
