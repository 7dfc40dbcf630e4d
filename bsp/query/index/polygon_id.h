// SPDX-License-Identifier: Apache-2.0
//
// PolygonId: a polygon of a solid, by the leaf that lists it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include <trisect/bsp/query/index/indexed_leaf.h>

namespace trisect::detail {

/// A polygon as one leaf lists it. What of it is beyond the leaf's cell says nothing. The leaf must
/// outlive the name.
struct PolygonId {
    const IndexedLeaf* leaf = nullptr;
    std::uint32_t number = 0xffffffffU;
    bool turned = false;  ///< the leaf is read as that of a complement

    [[nodiscard]] bool is_valid() const { return leaf != nullptr; }
    [[nodiscard]] const IndexPolygons& all() const { return leaf->polygons(); }
    [[nodiscard]] const Source& source() const { return all().source(number); }
    [[nodiscard]] std::uint32_t facet() const { return all().facet(number); }
    [[nodiscard]] bool is_flipped() const { return all().is_flipped(number) != turned; }
    [[nodiscard]] bool is_triangle() const { return all().is_triangle(number); }
    [[nodiscard]] bool is_unbounded() const { return all().is_unbounded(number); }
    [[nodiscard]] bool reaches_out() const { return all().reaches_out(number); }
    [[nodiscard]] bool enters() const { return all().enters(number); }
    [[nodiscard]] ConvexPolygon part() const { return all().part(number); }
    [[nodiscard]] const LatticePoint& corner(int i) const { return all().corner(number, i); }
    [[nodiscard]] Plane support() const { return all().support(number); }
    [[nodiscard]] Plane outward() const {
        const Plane p = support();
        return is_flipped() ? p.flipped() : p;
    }
    [[nodiscard]] DoubleBox bounds() const { return all().bounds(number); }
    [[nodiscard]] FacetName name() const { return all().name(number); }
    [[nodiscard]] FaceSource face_source() const { return all().face_source(number); }

    /// The same leaf's polygon.
    friend bool operator==(const PolygonId& a, const PolygonId& b) {
        return a.leaf == b.leaf && a.number == b.number;
    }
    friend bool operator<(const PolygonId& a, const PolygonId& b) {
        return a.leaf != b.leaf ? std::less<>()(a.leaf, b.leaf) : a.number < b.number;
    }
};

/// Sorted, each once.
inline void sort_unique(std::vector<PolygonId>& ids) {
    if (ids.size() < 2) return;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace trisect::detail
