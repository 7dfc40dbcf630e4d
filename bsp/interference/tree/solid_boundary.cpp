// SPDX-License-Identifier: Apache-2.0
//
// Boxes of inner nodes are what their bounds say (index_core.h), cut off at the walls of their
// cells: those of a node are the union of its children's, exactly, whatever happened before. So a
// solid has the same tree however it was made, and nothing must be fitted again.
//
// Facts of nodes are not in floats about some origin: they would have to be made anew for each
// solid that is larger than the last one. A node's four boxes become floats when a walk opens it,
// which takes a third of the time of its first test.
//
// A box of a leaf, in units l about p, has in units v about q the centre c l/v + (p - q)/v. That is
// computed within 2^-50 and rounded to floats, by at most 2^-24 of coordinates below 4. The boxes'
// halves grow by 2^-21, which pays for both along any axis.

#include <trisect/bsp/interference/tree/solid_boundary.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/bsp/interference/tree/boxes_counters.h>
#include <trisect/bsp/interference/tree/clipped_polygon.h>
#include <trisect/bsp/query/index/index_cells.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/spares.h>

namespace trisect::detail {

namespace {

float rounded_up(double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) < v ? std::nextafter(f, std::numeric_limits<float>::infinity())
                                      : f;
}

void close_lanes(ObbNode& n) {
    for (Float4& h : n.half) h = all_lanes(-1e30F);
}

}  // namespace

SolidBoundary::SolidBoundary(const Solid& solid) : base_(std::make_unique<const IndexBase>(solid)) {
    lattice = base_->lattice();
    const CellNode& root = refined(*base_->root().node);
    if (root.size() == 0) {
        if (base_->solid().is_whole_space())
            throw UnsupportedError("interference of an unbounded solid");
        return;
    }
    find_bounds();
    if (base_->is_inside_beyond() || !(largest < 0x1p60))
        throw UnsupportedError("interference of an unbounded solid");
    set_frame();
    Memory memory = Spares<Memory>::take();
    swap_with(memory);
    boxes.source = this;
    parts_.push_back(part(root, Cell{}, base_->root().complemented));
    const std::uint32_t node = add_node(ObbId{});
    put_box(node, 0, parts_[0].box);
    part_of_[0] = 0;
    boxes.nodes[node].child[0] = ObbChild::pending(0);
}

SolidBoundary::~SolidBoundary() {
    constexpr std::size_t most = std::size_t{8} << 20U;  // of large searches nothing is kept
    Memory memory;
    swap_with(memory);
    if (memory.nodes.capacity() == 0 || memory.bytes() > most) return;
    memory.clear();
    Spares<Memory>::give(std::move(memory));
}

void SolidBoundary::swap_with(Memory& memory) noexcept {
    memory.nodes.swap(boxes.nodes);
    memory.parent.swap(boxes.parent);
    memory.order.swap(boxes.order);
    memory.corners.swap(boxes.corners);
    memory.positions.swap(positions);
    memory.parts.swap(parts_);
    memory.part_of.swap(part_of_);
    memory.leaves.swap(leaves_);
    memory.inner.swap(inner_);
    memory.triangle_of.swap(triangle_of_);
    memory.clipped.swap(clipped_);
}

void SolidBoundary::Memory::clear() {
    nodes.clear();
    parent.clear();
    order.clear();
    corners.clear();
    positions.clear();
    parts.clear();
    part_of.clear();
    leaves.clear();
    inner.clear();
    triangle_of.clear();
    clipped.clear();
}

std::size_t SolidBoundary::Memory::bytes() const {
    const auto of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return of(nodes) + of(parent) + of(order) + of(corners) + of(positions) + of(parts) +
           of(part_of) + of(leaves) + of(inner) + of(triangle_of) + of(clipped);
}

// Of a node: its bounds in its cell.
SolidBoundary::Part SolidBoundary::part(const IndexBase& base, const CellNode& node,
                                        const Cell& cell, bool turned) {
    Part p{{&node, cell, turned}, {}, false};
    const Box& bounds = bounds_of(node);
    const DoubleBox walls = box_of(cell);
    const bool whole = state_of(base.solid())->whole;
    for (std::size_t k = 0; k < 3; ++k) {
        const double room = whole ? 0 : 1;
        p.box.lo[k] = std::max(static_cast<double>(bounds.lo[k]) - room,
                               walls.lo[k] - last_place * std::fabs(walls.lo[k]));
        p.box.hi[k] = std::min(static_cast<double>(bounds.hi[k]) + room,
                               walls.hi[k] + last_place * std::fabs(walls.hi[k]));
    }
    return p;
}

// Where half-spaces are listed as whole planes, bounds of nodes say nothing and those of cells do.
void SolidBoundary::find_bounds() {
    DoubleBox all;
    all.lo.fill(HUGE_VAL);
    all.hi.fill(-HUGE_VAL);
    const auto add = [&all](const DoubleBox& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            all.lo[k] = std::min(all.lo[k], b.lo[k]);
            all.hi[k] = std::max(all.hi[k], b.hi[k]);
        }
    };
    if (base_->is_bounded()) {
        add(part(refined(*base_->root().node), Cell{}, false).box);
    } else {
        for_tree_leaves(
            *base_, [](const DoubleBox&) { return true; },
            [&](const LeafInTree& leaf) {
                if (leaf.node.size() == 0) return;
                const Part p = part(leaf.node, leaf.cell, false);
                if (!p.is_empty()) add(p.box);
            });
    }
    lo = all.lo;
    hi = all.hi;
    for (std::size_t k = 0; k < 3; ++k)
        largest = std::max({largest, std::fabs(lo[k]), std::fabs(hi[k])});
    // Those of leaves are smaller, or the same.
    const CellNode& root = refined(*base_->root().node);
    const bool is_mesh =
        root.is_leaf() && boxed_leaf(root, Cell{}).boxes().polygons().only_source() != nullptr;
    position_error = is_mesh ? 0 : clipped_error * largest;
}

void SolidBoundary::set_frame() {
    double extent = 0;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double e = hi[k] - lo[k];
        boxes.origin[k] = lo[k] + 0.5 * e;
        extent = std::max(extent, e);
        square += 0.25 * e * e;
    }
    boxes.unit = extent > 0 ? std::ldexp(1.0, std::ilogb(extent)) : 1.0;
    boxes.radius =
        bound_slack * (std::sqrt(square) + 2 * clipped_error * largest) / boxes.unit + 0x1p-40;
    // Boxes that stick out farther are replaced by others.
    boxes.reach = 1.5 * boxes.radius;
}

std::uint32_t SolidBoundary::add_node(ObbId above) {
    const auto node = static_cast<std::uint32_t>(boxes.nodes.size());
    close_lanes(boxes.nodes.emplace_back());
    boxes.parent.push_back(above.index);
    part_of_.resize(part_of_.size() + 4, none);
    ++boxes_counters().nodes;
    return node;
}

// Along the axes. The half pays for the rounding of the centre, and for what is between the two
// sets that a box stands for.
void SolidBoundary::put_box(std::uint32_t node, std::uint32_t lane, const DoubleBox& box) {
    ObbNode& n = boxes.nodes[node];
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = (box.lo[k] - boxes.origin[k]) / boxes.unit;
        const double b = (box.hi[k] - boxes.origin[k]) / boxes.unit;
        const auto center = static_cast<float>(0.5 * (a + b));
        const double c = static_cast<double>(center);
        const double half = std::max(b - c, c - a) + position_error / boxes.unit + 0x1p-45;
        n.center[k][lane] = center;
        n.half[k][lane] = rounded_up(half * (1 + 0x1p-20));
        for (std::size_t j = 0; j < 3; ++j) n.axis[k][j][lane] = k == j ? 1.0F : 0.0F;
    }
}

// False when it sticks out too far.
bool SolidBoundary::put_box(std::uint32_t node, std::uint32_t lane,
                            const std::array<double, 3>& origin, double unit,
                            const OrientedBox& box) {
    const double scale = unit / boxes.unit;
    std::array<double, 3> center{};
    std::array<float, 3> half{};
    double from_origin = 0;
    double diagonal = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        center[k] =
            (origin[k] - boxes.origin[k]) / boxes.unit + static_cast<double>(box.center[k]) * scale;
        half[k] = rounded_up((static_cast<double>(box.half[k]) * scale + 0x1p-21) * (1 + 0x1p-22));
        from_origin += center[k] * center[k];
        diagonal += static_cast<double>(half[k]) * static_cast<double>(half[k]);
    }
    if (!(bound_slack * (std::sqrt(from_origin) + std::sqrt(diagonal)) < boxes.reach)) return false;
    ObbNode& n = boxes.nodes[node];
    for (std::size_t k = 0; k < 3; ++k) {
        n.center[k][lane] = static_cast<float>(center[k]);
        n.half[k][lane] = half[k];
        for (std::size_t j = 0; j < 3; ++j) n.axis[k][j][lane] = box.axis[k][j];
    }
    return true;
}

std::uint32_t SolidBoundary::open(ObbId id) {
    const std::uint32_t what = boxes.nodes[id.node()].child[id.lane()].pending();
    const std::uint32_t node = add_node(id);
    if (const std::uint32_t p = part_of_[id.index]; p != none) {
        const Part part = parts_[p];
        if (part.is_hull)
            open_leaf(part, node);
        else if (part.at.node->is_leaf())
            open_hull(part, node);
        else
            open_cells(part, node);
    } else {
        const Inner inner = inner_[what];
        const LeafTree& tree = leaves_[inner.leaf].boxes->tree();
        if (inner.node->has_few(inner.lane))
            take_few(inner.leaf, tree.triangles(*inner.node, inner.lane), node);
        else
            take_node(inner.leaf, tree.below(*inner.node, inner.lane), node);
    }
    boxes.nodes[id.node()].child[id.lane()] = ObbChild::node(node);
    return node;
}

// Up to four nodes of the tree below, each time those of the largest one.
void SolidBoundary::open_cells(const Part& above, std::uint32_t node) {
    std::array<LeafAt, 4> below;
    std::size_t count = 0;
    const auto add_children = [&](const LeafAt& at, std::size_t place) {
        bool first = true;
        for (int i = 0; i < 2; ++i) {
            const CellNode& n = *at.node;
            const CellRef& child = n.child(i);
            const CellNode& c = refined(*child.node);
            if (c.size() == 0) continue;
            const Cell cell = i == 0 ? at.cell.below(n.axis(), n.splitter())
                                     : at.cell.above(n.axis(), n.splitter());
            below[first ? place : count] = {&c, cell, at.turned != child.complemented};
            if (!first || place == count) ++count;
            first = false;
        }
    };
    add_children(above.at, 0);
    while (count < 4) {
        std::size_t most = 4;
        for (std::size_t i = 0; i < count; ++i)
            if (!below[i].node->is_leaf() &&
                (most == 4 || below[i].node->size() > below[most].node->size()))
                most = i;
        if (most == 4) break;
        const LeafAt opened = below[most];
        add_children(opened, most);
    }
    std::uint32_t lane = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Part p = part(*below[i].node, below[i].cell, below[i].turned);
        if (p.is_empty()) continue;
        part_of_[ObbId::of(node, lane).index] = static_cast<std::uint32_t>(parts_.size());
        parts_.push_back(p);
        put_box(node, lane, p.box);
        boxes.nodes[node].child[lane] = ObbChild::pending(0);
        ++lane;
    }
}

// A tighter box for a leaf, before its triangles are made.
void SolidBoundary::open_hull(const Part& part, std::uint32_t node) {
    const LeafHull& hull = part.at.boxed().hull();
    if (!hull.is_known || !put_box(node, 0, hull.origin, hull.unit, hull.box))
        put_box(node, 0, part.box);
    part_of_[ObbId::of(node, 0).index] = static_cast<std::uint32_t>(parts_.size());
    parts_.push_back({part.at, part.box, true});
    boxes.nodes[node].child[0] = ObbChild::pending(0);
}

void SolidBoundary::open_leaf(const Part& part, std::uint32_t node) {
    const LeafBoxes& leaf = part.at.boxed().boxes();
    if (leaf.tree().size() == 0) return;
    const auto number = static_cast<std::uint32_t>(leaves_.size());
    leaves_.push_back({&leaf, part.at.turned});
    take_node(number, leaf.tree().root(), node);
}

void SolidBoundary::put_lane(const LeafTree& tree, const ObbNode& from, std::uint32_t node,
                             std::uint32_t lane) {
    if (!put_box(node, lane, tree.origin(), tree.unit(), from.box(lane)))
        put_box(node, lane, {lo, hi});
}

void SolidBoundary::take_node(std::uint32_t leaf, const LeafTree::Node& from, std::uint32_t node) {
    const LeafBoxes& all = *leaves_[leaf].boxes;
    const LeafTree& tree = all.tree();
    for (std::uint32_t lane = 0; lane < 4 && from.is_used(lane); ++lane) {
        put_lane(tree, from.boxes(), node, lane);
        if (from.has_few(lane) && tree.triangles(from, lane).size() == 1 &&
            !all.is_clipped_late(tree.triangles(from, lane)[0])) {
            const std::uint32_t triangle = tree.triangles(from, lane)[0];
            boxes.nodes[node].child[lane] =
                ObbChild::leaf(add_triangle(leaf, triangle, all.corners_of(triangle)), 1);
        } else {
            boxes.nodes[node].child[lane] =
                ObbChild::pending(static_cast<std::uint32_t>(inner_.size()));
            inner_.push_back({leaf, &from, lane});
        }
    }
}

// Clipped as far as they are still to be. A lane for each part, if there are so few; otherwise for
// those of each triangle that has any.
void SolidBoundary::take_few(std::uint32_t leaf, std::span<const std::uint32_t> triangles,
                             std::uint32_t node) {
    const LeafBoxes& all = *leaves_[leaf].boxes;
    const auto first = static_cast<std::uint32_t>(triangle_of_.size());
    clipped_.clear();
    std::array<std::uint32_t, 4> ends{};
    std::uint32_t lanes = 0;
    for (const std::uint32_t triangle : triangles) {
        const std::size_t before = clipped_.size();
        all.add_parts(triangle, clipped_);
        for (std::size_t i = before; i < clipped_.size(); ++i)
            add_triangle(leaf, triangle, clipped_[i]);
        if (clipped_.size() != before) ends[lanes++] = static_cast<std::uint32_t>(clipped_.size());
    }
    if (clipped_.size() <= 4) {
        lanes = static_cast<std::uint32_t>(clipped_.size());
        for (std::uint32_t i = 0; i < lanes; ++i) ends[i] = i + 1;
    }
    const LeafTree& tree = all.tree();
    const ObbNode each = tree.boxes_of(clipped_, std::span(ends).first(lanes));
    std::uint32_t begin = 0;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        put_lane(tree, each, node, lane);
        boxes.nodes[node].child[lane] = ObbChild::leaf(first + begin, ends[lane] - begin);
        begin = ends[lane];
    }
}

std::uint32_t SolidBoundary::add_triangle(std::uint32_t leaf, std::uint32_t triangle,
                                          const TriangleCorners& corners) {
    const auto at = static_cast<std::uint32_t>(positions.size());
    for (const auto& corner : corners) positions.push_back(corner);
    boxes.corners.push_back({at, at + 1, at + 2});
    const auto number = static_cast<std::uint32_t>(triangle_of_.size());
    boxes.order.push_back(number);
    triangle_of_.push_back({leaf, triangle});
    return number;
}

std::uint32_t SolidBoundary::open_all() const {
    std::vector<ObbId> open{ObbId{}};
    while (!open.empty()) {
        const ObbId id = open.back();
        open.pop_back();
        if (boxes.is_leaf(id)) continue;
        const std::uint32_t node = boxes.child(id).node();
        for (std::uint32_t k = 0; k < 4; ++k)
            if (boxes.nodes[node].half[0][k] >= 0) open.push_back(ObbId::of(node, k));
    }
    return static_cast<std::uint32_t>(boxes.order.size());
}

SolidBoundary::Origin SolidBoundary::origin(std::uint32_t triangle) const {
    const TriangleOf& t = triangle_of_[triangle];
    return {leaves_[t.leaf].boxes, t.triangle, leaves_[t.leaf].turned};
}

bool SolidBoundary::is_alone_at(std::uint32_t triangle, const std::array<double, 3>& point,
                                double reach) const {
    const Origin at = origin(triangle);
    return at.leaf->is_alone_at(at.leaf->polygon_of(at.triangle), point, reach);
}

}  // namespace trisect::detail
