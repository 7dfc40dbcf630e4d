// SPDX-License-Identifier: Apache-2.0
//
// IndexCore: the shared state of the copies of a BrepIndex.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/query/index/index_point.h>
#include <trisect/bsp/query/index/index_polygons.h>
#include <trisect/bsp/query/index/index_tree.h>

namespace trisect::detail {

/// The tree over a solid's polygons. Immutable.
struct IndexBase {
    explicit IndexBase(const Solid& solid);

    Solid solid;  // keeps sources and fragments
    IndexPolygons polygons;
    IndexTree tree;
    double build_seconds = 0;
};

/// With the handles of a B-rep, if there is one.
class IndexHandles;

class IndexCore {
public:
    std::shared_ptr<const IndexBase> base;
    std::shared_ptr<const IndexHandles> handles;  // may be null

    [[nodiscard]] const IndexPolygons& polygons() const { return base->polygons; }
    [[nodiscard]] const IndexTree& tree() const { return base->tree; }
};

using PolygonId = IndexPolygons::Id;

/// Inside, Outside or, when the point is on the boundary, OnFace with `on` naming all polygons that
/// contain it (each once, in no order).
[[nodiscard]] Location locate_polygons(const IndexBase& index, const IndexPoint& point,
                                       std::vector<PolygonId>& on);

/// Of one of many points: its number, where it is, and when it is on the boundary the point itself
/// and the polygons that contain it.
using FoundPoint = std::function<void(std::uint32_t number, Location location,
                                      const IndexPoint* point, std::vector<PolygonId>& on)>;

/// Many points in the user's units, in an order of its own; the same as one by one but for the time
/// that is spent waiting for memory. Fewer than 2^32; on so many threads, 0 for as many as there
/// are, each of which may call `found`.
void locate_batch(const IndexBase& index, std::span<const std::array<double, 3>> points,
                  unsigned threads, const FoundPoint& found);

/// The same, but only where each point is: results[i] of points[i].
void classify_batch(const IndexBase& index, std::span<const std::array<double, 3>> points,
                    unsigned threads, std::span<Location> results);

/// Location and names of a point from the polygons that contain it, in any order, not none.
/// Handles are not set.
[[nodiscard]] Place place_on(const IndexPolygons& polygons, std::vector<PolygonId>& on,
                             const IndexPoint& point);

/// Its location alone, which doubles mostly decide.
[[nodiscard]] Location location_on(const IndexPolygons& polygons, std::vector<PolygonId>& on);

/// The same as place_on, for what is not a point: the rank is that of the normals, and no corner is
/// looked for.
[[nodiscard]] Place place_on(const IndexPolygons& polygons, std::vector<PolygonId>& on);

}  // namespace trisect::detail
