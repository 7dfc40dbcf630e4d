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
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

LeafBoxes::LeafBoxes(const IndexedLeaf& leaf) : leaf_(leaf) {
    check_stop(1 + leaf.polygons().size());
    if (const Source* const mesh = leaf.polygons().only_source())
        take_mesh(*mesh);
    else
        take_polygons();
}

// Of a mesh that nothing happened to, points and triangles are those of the source.
void LeafBoxes::take_mesh(const Source& source) {
    const LatticeMesh& mesh = source.mesh();
    positions_.reserve(mesh.points.size());
    for (const LatticePoint& p : mesh.points) positions_.push_back(p.doubles());
    std::vector<std::array<std::uint32_t, 3>> corners(source.facet_count());
    for (std::uint32_t t = 0; t < corners.size(); ++t)
        for (int i = 0; i < 3; ++i)
            corners[t][static_cast<std::size_t>(i)] = source.corner_index(t, i);
    tree_ = std::make_unique<const LeafTree>(positions_, 0, std::move(corners));
}

double LeafBoxes::most_error() const {
    const IndexPolygons& all = polygons();
    double largest = 0;
    const auto take = [&largest](const DoubleBox& box) {
        for (std::size_t k = 0; k < 3; ++k)
            largest = std::max({largest, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
    };
    for (Id id = 0; id < all.size(); ++id)
        take(all.is_unbounded(id) ? all.bounds(all.cell().lattice_box()) : all.bounds(id));
    return clipped_error * largest;
}

void LeafBoxes::take_polygons() {
    const IndexPolygons& all = polygons();
    PolygonClipper clipper(all, most_error());
    std::vector<std::array<std::uint32_t, 3>> corners;
    positions_.reserve(3 * std::size_t{all.size()} + 16);
    corners.reserve(all.size() + 16);
    polygon_.reserve(all.size() + 16);
    for (Id id = 0; id < all.size(); ++id) {
        const auto first = static_cast<std::uint32_t>(positions_.size());
        if (all.is_triangle(id) && !all.reaches_out(id)) {
            for (int i = 0; i < 3; ++i) positions_.push_back(all.corner(id, i).doubles());
        } else {
            const ClippedPolygon& part = clipper.clip(id);
            error_ = std::max(error_, part.error);
            positions_.insert(positions_.end(), part.corners.begin(), part.corners.end());
        }
        for (auto i = first + 2; i < positions_.size(); ++i) {
            corners.push_back({first, i - 1, i});
            polygon_.push_back(id);
        }
    }
    tree_ = std::make_unique<const LeafTree>(positions_, error_, std::move(corners));
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
    for_triangles_near(*tree_, point, reach, [&](std::uint32_t triangle) {
        if (!is_certainly_beyond(corners_of(triangle), error_, point, reach))
            out.push_back({&leaf_, polygon_of(triangle), turned});
        return false;
    });
    sort_unique(out);
    return out;
}

std::size_t LeafBoxes::bytes() const {
    return sizeof(*this) + positions_.capacity() * sizeof(positions_[0]) +
           polygon_.capacity() * sizeof(Id) + tree_->bytes() +
           pieces_.capacity() * sizeof(BoundaryPoint);
}

const LeafBoxes& BoxedLeaf::boxes() const {
    std::call_once(once_, [this] {
        boxes_ = std::make_unique<const LeafBoxes>(listed_leaf(leaf_, cell_));
        BoxesCounters& counters = boxes_counters();
        ++counters.leaves;
        counters.triangles += boxes_->triangle_count();
    });
    return *boxes_;
}

const BoxedLeaf& boxed_leaf(const CellNode& leaf, const Cell& cell) {
    return static_cast<const BoxedLeaf&>(leaf.boxes_fact().get_or([&] {
        ++boxes_counters().hulls;
        return std::make_unique<const BoxedLeaf>(leaf, cell);
    }));
}

}  // namespace trisect::detail
