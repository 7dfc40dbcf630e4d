// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/axis/axis_faces.h>

#include <algorithm>

#include <trisect/bsp/assembly/axis/axis_face_outlines.h>

namespace trisect::detail {

std::unique_ptr<AxisFaces> AxisFaces::of(BoundaryParts& parts, std::uint32_t threads) {
    const bool whole = std::ranges::all_of(parts.sources, [](const FacetMarks& m) {
        return m.source()->is_half_space() || m.source()->is_whole();
    });
    if (whole) return std::make_unique<AxisFaceOutlines<std::int64_t>>(parts, threads);
    return std::make_unique<AxisFaceOutlines<Int128>>(parts, threads);
}

}  // namespace trisect::detail
