// SPDX-License-Identifier: Apache-2.0
//
// A facet that reaches into several cells is in the boxes of each of them by its part there. Its
// box as a whole may be much larger than the cell, and what of it is beyond may have been cut away.

#include <trisect/bsp/interference/tree/leaf_boxes.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <trisect/bsp/interference/tree/boxes_counters.h>
#include <trisect/bsp/interference/tree/clipped_polygon.h>
#include <trisect/bsp/interference/tree/point_gap.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/spares.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

LeafBoxes::LeafBoxes(const IndexedLeaf& leaf) : leaf_(leaf) {
    const IndexPolygons& all = leaf.polygons();
    check_stop(1 + all.size());
    if (all.only_source() == nullptr) take_polygons();
    const std::size_t count = is_whole_ ? all.size() : triangle_.size();
    tree_ = std::make_unique<const LeafTree>(*this, static_cast<std::uint32_t>(count),
                                             bounds(static_cast<std::uint32_t>(count)));
}

TriangleCorners LeafBoxes::corners_of(std::uint32_t triangle) const {
    using Corners = Triangle::Corners;
    const IndexPolygons& all = polygons();
    const Id id = polygon_of(triangle);
    if (!is_whole_ && triangle_[triangle].corners != Corners::Source) {
        const Corners where = triangle_[triangle].corners;
        const std::size_t at = triangle_[triangle].at;
        if (where == Corners::Fragment) {
            const std::span<const Approximation> fragment = all.approximate_corners(id);
            return {fragment[0].c, fragment[at - 1].c, fragment[at].c};
        }
        const auto* const c = &clipped_[at];
        return where == Corners::Strip ? TriangleCorners{c[0], c[1], c[2]}
                                       : TriangleCorners{c[1], c[0], c[2]};
    }
    const Source& source = all.source(id);
    const std::uint32_t f = all.facet(id);
    return {source.corner(f, 0).doubles(), source.corner(f, 1).doubles(),
            source.corner(f, 2).doubles()};
}

bool LeafBoxes::is_clipped_late(std::uint32_t triangle) const {
    return (is_whole_ || triangle_[triangle].corners == Triangle::Corners::Source) &&
           polygons().reaches_out(polygon_of(triangle));
}

void LeafBoxes::add_parts(std::uint32_t triangle, std::vector<TriangleCorners>& parts) const {
    if (!is_clipped_late(triangle)) {
        parts.push_back(corners_of(triangle));
        return;
    }
    PolygonClipper clipper(polygons(), most_error());
    const auto& corners = clipper.clip(polygon_of(triangle)).corners;
    for (std::size_t i = 2; i < corners.size(); ++i)
        parts.push_back({corners[0], corners[i - 1], corners[i]});
}

bool LeafBoxes::has_parts() const {
    std::vector<TriangleCorners> parts;
    for (std::uint32_t t = 0; t < triangle_count() && parts.empty(); ++t) add_parts(t, parts);
    return !parts.empty();
}

void LeafBoxes::put_corners(std::span<const std::uint32_t> triangles,
                            std::span<std::array<double, 3>> corners) const {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const TriangleCorners c = corners_of(triangles[i]);
        for (std::size_t k = 0; k < 3; ++k) corners[3 * i + k] = c[k];
    }
}

double LeafBoxes::most_error() const {
    if (polygons().size() == 0) return 0;
    const DoubleBox box = polygons().bounds();
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
    return clipped_error * largest;
}

// What take_polygons fills, in memory that there is.
struct LeafBoxes::Triangles {
    std::vector<Triangle> triangle;
    std::vector<std::array<double, 3>> clipped;

    [[nodiscard]] std::size_t bytes() const {
        return triangle.capacity() * sizeof(triangle[0]) + clipped.capacity() * sizeof(clipped[0]);
    }
};

std::array<LeafBoxes::Extent, 3> LeafBoxes::extents() const {
    const IndexPolygons& all = polygons();
    std::array<Extent, 3> out;
    if (all.size() == 0) return out;
    const DoubleBox box = all.bounds();
    for (std::size_t k = 0; k < 3; ++k) {
        const double lo = rounded_position(all.cell().lo[k]);
        const double hi = rounded_position(all.cell().hi[k]);
        out[k] = {lo, hi, 0.25 * (std::min(hi, box.hi[k]) - std::max(lo, box.lo[k]))};
    }
    return out;
}

// Boxes are hardly larger for it then. Of a long triangle most may be beyond, and cut away there.
bool LeafBoxes::reaches_out_little(Id id, const std::array<Extent, 3>& extents) const {
    const DoubleBox box = polygons().bounds(id);
    for (std::size_t k = 0; k < 3; ++k) {
        const bool is_out = box.lo[k] < extents[k].lo || box.hi[k] > extents[k].hi;
        if (is_out && !(box.hi[k] - box.lo[k] <= extents[k].little)) return false;
    }
    return true;
}

void LeafBoxes::take_polygons() {
    const IndexPolygons& all = polygons();
    const std::array<Extent, 3> walls = extents();
    PolygonClipper clipper(all, most_error());
    Spare<Triangles> taken;
    taken->triangle.clear();
    taken->clipped.clear();
    for (Id id = 0; id < all.size(); ++id) {
        if (all.is_triangle(id) && (!all.reaches_out(id) || reaches_out_little(id, walls))) {
            if (all.reaches_out(id)) error_ = std::max(error_, most_error());
            taken->triangle.emplace_back(id, Triangle::Corners::Source, 0);
        } else {
            take_polygon(id, clipper.clip(id), *taken);
        }
    }
    if (is_whole_) return;
    triangle_ = taken->triangle;
    clipped_ = taken->clipped;
}

// Clipped corners lie to and fro, so that any three in a row are a triangle: of a polygon of n
// corners n are kept, not three for each of n - 2 triangles.
void LeafBoxes::take_polygon(Id id, const ClippedPolygon& part, Triangles& all) {
    using Corners = Triangle::Corners;
    error_ = std::max(error_, part.error);
    if (part.is_all && polygons().is_triangle(id)) {
        all.triangle.emplace_back(id, Corners::Source, 0);
        return;
    }
    is_whole_ = false;
    const auto count = static_cast<std::uint32_t>(part.corners.size());
    if (part.is_all) {
        for (std::uint32_t i = 2; i < count; ++i)
            all.triangle.emplace_back(id, Corners::Fragment, i);
        return;
    }
    const auto first = static_cast<std::uint32_t>(all.clipped.size());
    TRISECT_EXPECTS(first + count < 1U << 30U, "too many clipped corners in a leaf");
    for (std::uint32_t i = 0; i < count; ++i)
        all.clipped.push_back(part.corners[i % 2 == 1 ? (i + 1) / 2 : (count - i / 2) % count]);
    for (std::uint32_t i = 0; i + 2 < count; ++i)
        all.triangle.emplace_back(id, i % 2 == 0 ? Corners::Strip : Corners::StripBack, first + i);
}

LeafTree::Bounds LeafBoxes::bounds(std::uint32_t count) const {
    LeafTree::Bounds b;
    b.lo.fill(HUGE_VAL);
    b.hi.fill(-HUGE_VAL);
    b.error = error_;
    const auto take = [&b](const std::array<double, 3>& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = std::min(b.lo[k], p[k]);
            b.hi[k] = std::max(b.hi[k], p[k]);
        }
    };
    if (const Source* const mesh = polygons().only_source()) {
        for (const LatticePoint& p : mesh->mesh().points) take(p.doubles());
        return b;
    }
    for (std::uint32_t t = 0; t < count; ++t)
        for (const auto& corner : corners_of(t)) take(corner);
    return b;
}

bool LeafBoxes::is_alone_at(Id polygon, const std::array<double, 3>& point, double reach) const {
    const Cell& cell = polygons().cell();
    for (std::size_t k = 0; k < 3; ++k) {
        const double slack = reach + last_place * (std::fabs(point[k]) + 2 * reach);
        const double lo = rounded_position(cell.lo[k]);
        const double hi = rounded_position(cell.hi[k]);
        if (!(point[k] - slack > lo + last_place * std::fabs(lo)) ||
            !(point[k] + slack < hi - last_place * std::fabs(hi)))
            return false;
    }
    // Of triangles that are clipped late, what is out of the cell is far.
    bool is_alone = true;
    for_triangles_near(*tree_, point, reach, [&](std::uint32_t triangle) {
        if (polygon_of(triangle) == polygon) return false;
        is_alone = is_certainly_beyond(corners_of(triangle), error_, point, reach);
        return !is_alone;
    });
    return is_alone;
}

std::vector<PolygonId> LeafBoxes::polygons_near(const std::array<double, 3>& point, double reach,
                                                bool turned) const {
    std::vector<PolygonId> out;
    std::vector<TriangleCorners> parts;
    for_triangles_near(*tree_, point, reach, [&](std::uint32_t triangle) {
        parts.clear();
        if (!is_certainly_beyond(corners_of(triangle), error_, point, reach))
            add_parts(triangle, parts);
        if (!std::ranges::all_of(parts, [&](const TriangleCorners& c) {
                return is_certainly_beyond(c, error_, point, reach);
            }))
            out.push_back({&leaf_, polygon_of(triangle), turned});
        return false;
    });
    sort_unique(out);
    return out;
}

std::size_t LeafBoxes::bytes() const {
    return sizeof(*this) + clipped_.capacity() * sizeof(clipped_[0]) +
           triangle_.capacity() * sizeof(Triangle) + tree_->bytes() +
           pieces_.capacity() * sizeof(BoundaryPoint);
}

const LeafBoxes& BoxedLeaf::boxes() const {
    work_once(once_, [this] {
        boxes_ = std::make_unique<const LeafBoxes>(listed_leaf(leaf_, cell_));
        BoxesCounters& counters = boxes_counters();
        ++counters.leaves;
        counters.triangles += boxes_->triangle_count();
    });
    return *boxes_;
}

std::size_t boxes_fact_bytes(const CellNode& node) {
    const NodeFact* const fact = node.boxes_fact().get();
    return fact != nullptr ? static_cast<const BoxedLeaf*>(fact)->bytes() : 0;
}

const BoxedLeaf& boxed_leaf(const CellNode& leaf, const Cell& cell) {
    return static_cast<const BoxedLeaf&>(leaf.boxes_fact().get_or([&] {
        ++boxes_counters().hulls;
        return std::make_unique<const BoxedLeaf>(leaf, cell);
    }));
}

}  // namespace trisect::detail
