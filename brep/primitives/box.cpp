// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/primitives/box.h>

#include <cmath>

#include <trisect/kernel/error.h>

namespace trisect {

PolygonMesh make_box(const Point3d& low, const Point3d& high) {
    for (std::size_t i = 0; i < 3; ++i)
        if (!std::isfinite(low[i]) || !std::isfinite(high[i]) || !(low[i] < high[i]))
            throw UsageError("the corners of a box must be finite and low < high");
    PolygonMesh m;
    // Corner i has the higher x, y, z where bits 0, 1, 2 of i are set.
    for (unsigned i = 0; i < 8; ++i)
        m.points.push_back({(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1],
                            (i & 4U) != 0 ? high[2] : low[2]});
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& f : faces) m.add_face(f);
    return m;
}

PolygonMesh make_box(const Point3d& size) { return make_box({0, 0, 0}, size); }

}  // namespace trisect
