// SPDX-License-Identifier: Apache-2.0
//
// Building the tree in which queries run.
//
// The cell tree of a solid is as fine as the last operation needed it: a fresh mesh is one leaf
// that lists everything, and a leaf of a result may list thousands of facets that nothing cut. Its
// splitting planes are kept, and a leaf with many polygons becomes a grid over the box of these,
// whose crowded cells are divided 4 x 4 x 4 at a time (index_bricks.cpp).
//
// Built at once is only the grid with its lists and winding numbers. Its cells are divided when a
// query first comes to them, under a lock, and then published by one word; queries of a corner of a
// model never pays for the rest. Cells are large enough that the lock is rare.
//
// Every mixed cell needs a point off the surface with its winding number. The lower corners of
// cells serve, and they are the same points for a cell and for the first cell of its brick. So they
// are known from lines along the axes (index_windings.cpp), counted up from the reference of the
// cell tree's leaf. Where a corner lies on a polygon, the whole grid is moved a little and made
// again; where that does not help the leaf remains a list.

#include <trisect/bsp/query/index/index_tree.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include <trisect/bsp/query/index/double_box.h>
#include <trisect/bsp/query/index/index_bricks.h>
#include <trisect/bsp/query/index/index_grid_lists.h>
#include <trisect/bsp/query/index/index_signs.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

using Id = IndexPolygons::Id;
using Node = IndexTree::Node;

constexpr std::size_t grid_polygons = 10;  // from so many on
constexpr int attempts = 4;
// Around the polygons, lattice units, and a part of their extent: corners of the grid should be
// surely off planes that bound the solid.
constexpr double room = 3;
constexpr double relative_room = 0x1p-10;

template <class T>
std::size_t bytes_of(const std::vector<T>& v) {
    return v.capacity() * sizeof(T);
}

}  // namespace

class IndexDivision {
public:
    IndexDivision(const IndexPolygons& polygons, IndexCells& cells, IndexGrid grid, double margin,
                  bool open)
        : cells_(cells),
          grid_(grid),
          lists_(polygons, grid, margin),
          builder_(polygons, cells, grid, margin, open) {}

    /// False when a corner of the grid is on a polygon.
    [[nodiscard]] bool prepare(std::span<const Id> ids, std::int32_t winding) {
        if (!lists_.list(ids)) return false;
        lists_.windings().finish(winding);
        if (lists_.listed() != 0)
            room_ =
                leaf_bytes * static_cast<double>(ids.size()) / static_cast<double>(lists_.listed());
        return true;
    }
    [[nodiscard]] std::uint32_t slot_before(std::size_t cell) const {
        if (!lists_.in(cell).empty()) return IndexSlot::pending;
        return lists_.windings().windings()[cell] > 0 ? IndexSlot::inside : IndexSlot::outside;
    }
    [[nodiscard]] std::uint32_t divide(std::size_t cell) {
        cells_.room += room_ * static_cast<double>(lists_.in(cell).size());
        const auto shift = grid_.shift();
        const auto x = static_cast<std::uint32_t>(cell % grid_.n[0]);
        const auto y = static_cast<std::uint32_t>(cell / grid_.n[0] % grid_.n[1]);
        const auto z = static_cast<std::uint32_t>(cell / grid_.n[0] / grid_.n[1]);
        return builder_.make({x << shift, y << shift, z << shift}, grid_.levels, lists_.in(cell),
                             lists_.windings().windings()[cell]);
    }
    [[nodiscard]] std::size_t depth() const { return builder_.depth(); }
    [[nodiscard]] std::size_t bytes() const { return lists_.bytes(); }

private:
    // What leaves may take for a polygon, unless planes alone take more.
    static constexpr double leaf_bytes = 160;

    IndexCells& cells_;
    IndexGrid grid_;
    double room_ = 0;  // for what one cell lists once
    IndexGridLists lists_;
    IndexBrickBuilder builder_;
};

IndexTree::IndexTree()
    : nodes_(1),
      cells_(std::make_unique<IndexCells>()),
      dividing_(std::make_unique<std::mutex>()) {}
IndexTree::~IndexTree() = default;
IndexTree::IndexTree(IndexTree&&) noexcept = default;
IndexTree& IndexTree::operator=(IndexTree&&) noexcept = default;

// What others see of a cell before its slot is the old slot, afterwards everything below it.
std::uint32_t IndexTree::divide(const IndexGrid& g, std::size_t cell) const {
    check_stop();
    const std::lock_guard lock(*dividing_);
    const std::atomic_ref slot(roots_[g.first + cell]);
    if (const std::uint32_t s = slot.load(std::memory_order_relaxed); s != IndexSlot::pending)
        return s;
    const std::uint32_t made = divisions_[g.number]->divide(cell);
    slot.store(made, std::memory_order_release);
    return made;
}

void IndexTree::divide_all() const {
    for (const IndexGrid& g : grids_)
        for (std::size_t cell = 0; cell < g.count(); ++cell) (void)slot(g, cell);
}

IndexTree::Stats IndexTree::stats() const {
    const std::lock_guard lock(*dividing_);
    Stats s;
    s.nodes = nodes_.size() + roots_.size();
    for (const Node& n : nodes_)
        if (n.is_leaf() && !n.is_mixed()) ++s.empty;
    for (std::uint32_t& root : roots_) {
        const std::uint32_t slot = std::atomic_ref(root).load(std::memory_order_relaxed);
        if (slot == IndexSlot::pending) ++s.pending;
        if (IndexSlot::is_empty(slot)) ++s.empty;
    }
    for (std::uint32_t i = 0; i < cells_->bricks.end(); ++i) {
        const IndexBrick& b = cells_->bricks[i];
        s.nodes += 64;
        s.empty += 64 - static_cast<std::size_t>(std::popcount(b.mixed));
        for (std::uint64_t left = b.mixed; left != 0; left &= left - 1)
            if (IndexSlot::is_empty(slot(b.slot(static_cast<unsigned>(std::countr_zero(left))))))
                ++s.empty;
    }
    s.mixed = cells_->leaves.end();
    for (std::uint32_t i = 0; i < cells_->leaves.end(); ++i) s.listed += cells_->leaves[i].count;
    s.depth = depth_;
    s.bytes = sizeof(*this) + bytes_of(nodes_) + bytes_of(grids_) + bytes_of(references_) +
              bytes_of(roots_) + cells_->bytes();
    for (const auto& d : divisions_) {
        s.depth = std::max(s.depth, depth_ + 1 + d->depth());
        s.bytes += d->bytes();
    }
    return s;
}

FinePoint IndexTree::reference(const Cell& c, const IndexGrid::Position& at) const {
    if (c.grid == nullptr) return references_[c.reference];
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k)
        p.c[k] = fine_position(c.grid->splitter(k, at.fine[k] >> c.shift << c.shift));
    return p;
}

class IndexTreeBuilder {
public:
    IndexTreeBuilder(IndexTree& tree, IndexPolygons& polygons)
        : t_(tree), cells_(*tree.cells_), polygons_(polygons) {}

    void build(const SolidState& state);

private:
    using Vector = std::array<double, 3>;
    struct Place {
        Vector lo{};
        Vector hi{};
        Vector least{};      // what is below it in the cell does not matter
        bool whole = false;  // contains all polygons of the leaf
    };

    void find_bounds(const CellRef& root);
    void note_polygons(const SolidState& state, const CellRef& ref, bool turned, const Cell& cell);
    void add_cells(const CellRef& ref, bool turned, const Cell& cell, std::uint32_t node,
                   int depth);
    void add_leaf_cell(const CellNode& cell_node, bool turned, const Cell& cell, std::uint32_t node,
                       int depth);
    void make_leaf(std::uint32_t node, const FinePoint& reference, std::int32_t winding);
    [[nodiscard]] static Place place_of(const Cell& cell, const DoubleBox& polygons);
    [[nodiscard]] std::optional<IndexGrid> grid_over(const Place& place, int attempt) const;
    [[nodiscard]] bool make_grid(IndexGrid grid, const Place& place, std::uint32_t node,
                                 const FinePoint& reference, std::int32_t winding);
    [[nodiscard]] bool trace(const FinePoint& from, const FinePoint& to,
                             std::int32_t& winding) const;

    IndexTree& t_;
    IndexCells& cells_;
    IndexPolygons& polygons_;
    // Positions are odd multiples of it.
    double quantum_ = 1.0 / static_cast<double>(dyadic_scale);
    std::vector<Id> ids_;  // of a leaf
};

void IndexTreeBuilder::build(const SolidState& state) {
    find_bounds(state.root());
    if (polygons_.only_source() == nullptr) note_polygons(state, state.root(), false, Cell{});
    add_cells(state.root(), false, Cell{}, 0, 0);
    polygons_.finish();
    t_.nodes_.shrink_to_fit();
}

// The box of everything, a little larger.
void IndexTreeBuilder::find_bounds(const CellRef& root) {
    Box box;
    if (const Source* only = polygons_.only_source()) {
        box = only->box();
    } else {
        std::vector<const CellNode*> pending{root.node.get()};
        while (!pending.empty()) {
            const CellNode& n = *pending.back();
            pending.pop_back();
            if (!n.is_leaf()) {
                pending.push_back(n.child(0).node.get());
                pending.push_back(n.child(1).node.get());
                continue;
            }
            for (const PolygonRef r : n.polygons()) box.add(r.box());
        }
    }
    std::int64_t reach = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        if (box.is_empty()) {
            box.lo[k] = 0;
            box.hi[k] = 0;
        }
        t_.bounded_ = t_.bounded_ && std::max(-box.lo[k], box.hi[k]) < coordinate_limit;
        // Room for the reference point of a fresh mesh.
        box.lo[k] -= 3;
        box.hi[k] += 3;
        t_.lo_[k] = static_cast<double>(box.lo[k]);
        t_.hi_[k] = static_cast<double>(box.hi[k]);
        reach = std::max({reach, -box.lo[k], box.hi[k]});
    }
    // Splitting planes must be doubles: multiples of the quantum below 2^52 of it.
    while (static_cast<double>(reach) >= 0x1p51 * quantum_) quantum_ *= 2;
}

// As deep as the cell tree, here and in add_cells.
void IndexTreeBuilder::note_polygons(const SolidState& state, const CellRef& ref, bool turned,
                                     const Cell& cell) {
    turned = turned != ref.complemented;
    const CellNode& n = *ref.node;
    if (!n.is_leaf()) {
        with_enough_stack([&] {
            note_polygons(state, n.child(0), turned, cell.below(n.axis(), n.splitter()));
            note_polygons(state, n.child(1), turned, cell.above(n.axis(), n.splitter()));
        });
        return;
    }
    check_stop(1 + n.size());
    const auto& incomplete = state.tree().incomplete;
    for (const PolygonRef r : n.polygons()) {
        const bool is_incomplete =
            !incomplete.empty() && std::binary_search(incomplete.begin(), incomplete.end(),
                                                      FacetName{r.source->serial(), r.facet});
        polygons_.note(r, turned, cell, is_incomplete);
    }
}

void IndexTreeBuilder::add_cells(const CellRef& ref, bool turned, const Cell& cell,
                                 std::uint32_t node, int depth) {
    turned = turned != ref.complemented;
    const CellNode& n = *ref.node;
    if (n.is_leaf()) return add_leaf_cell(n, turned, cell, node, depth);
    const auto children = static_cast<std::uint32_t>(t_.nodes_.size());
    t_.nodes_.resize(t_.nodes_.size() + 2);
    t_.nodes_[node] = {n.splitter(), children, static_cast<std::uint32_t>(n.axis())};
    with_enough_stack([&] {
        add_cells(n.child(0), turned, cell.below(n.axis(), n.splitter()), children, depth + 1);
        add_cells(n.child(1), turned, cell.above(n.axis(), n.splitter()), children + 1, depth + 1);
    });
}

void IndexTreeBuilder::add_leaf_cell(const CellNode& cell_node, bool turned, const Cell& cell,
                                     std::uint32_t node, int depth) {
    check_stop(1 + cell_node.size());
    ids_.clear();
    Box bounds;
    if (const Source* only = polygons_.only_source()) {
        for (Id id = 0; id < only->facet_count(); ++id) ids_.push_back(id);
        bounds = only->box();
    } else {
        for (const PolygonRef r : cell_node.polygons()) {
            const Id id = polygons_.add(r, turned, cell);
            if (id == IndexPolygons::none || !cell.meets(r.box())) continue;
            ids_.push_back(id);
            if (!polygons_.is_unbounded(id)) bounds.add(r.box());
        }
    }
    const FinePoint reference = cell_node.reference();
    const int inside = cell_node.winding() > 0 ? 1 : 0;
    const std::int32_t winding = turned ? 1 - inside : inside;
    t_.depth_ = std::max(t_.depth_, static_cast<std::size_t>(depth));
    if (ids_.size() >= grid_polygons && !bounds.is_empty()) {
        const Place place = place_of(cell, polygons_.bounds(bounds));
        for (int attempt = 0; attempt < attempts; ++attempt) {
            const auto grid = grid_over(place, attempt);
            if (grid && make_grid(*grid, place, node, reference, winding)) return;
        }
    }
    make_leaf(node, reference, winding);
}

void IndexTreeBuilder::make_leaf(std::uint32_t node, const FinePoint& reference,
                                 std::int32_t winding) {
    Node& n = t_.nodes_[node];
    n = {};
    if (ids_.empty()) {
        if (winding > 0) n.flags |= Node::inside;
        return;
    }
    n.position = static_cast<std::int64_t>(t_.references_.size());
    t_.references_.push_back(reference);
    IndexLeaf leaf;
    leaf.first = cells_.listed.append(ids_.size());
    leaf.count = static_cast<std::uint32_t>(ids_.size());
    leaf.winding = winding;
    std::copy(ids_.begin(), ids_.end(), &cells_.listed[leaf.first]);
    n.next = cells_.leaves.append(1);
    cells_.leaves[n.next] = leaf;
}

// Where a grid is wanted: around the polygons, in the cell.
IndexTreeBuilder::Place IndexTreeBuilder::place_of(const Cell& cell, const DoubleBox& polygons) {
    Place p;
    p.whole = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const double lo = rounded_position(cell.lo[k]);
        const double hi = rounded_position(cell.hi[k]);
        const double first = polygons.lo[k];
        const double last = polygons.hi[k];
        const double around = room + std::floor(relative_room * (last - first));
        p.whole = p.whole && lo < first - around && last + around < hi;
        p.least[k] = first;
        p.lo[k] = std::max(first - around, lo);
        p.hi[k] = std::min(last + around, hi);
    }
    if (!p.whole) p.least = p.lo;
    return p;
}

std::optional<IndexGrid> IndexTreeBuilder::grid_over(const Place& place, int attempt) const {
    IndexGrid g;
    Vector extent{};
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        // Odd multiples of the quantum, not in step with each other: planes that lie at 45 degrees
        // through lattice points pass by.
        constexpr std::array<double, 3> step{9, 23, 37};
        const double shift =
            std::min(step[k] * (1 + attempt), 0x1p-6 * (place.hi[k] - place.lo[k]) / quantum_);
        double position = std::ceil(place.lo[k] / quantum_) + std::floor(shift);
        if (std::fmod(position, 2.0) == 0) position += 1;
        g.origin[k] = position * quantum_;
        extent[k] = place.hi[k] - g.origin[k];
        if (!(extent[k] > 0)) return std::nullopt;
        largest = std::max(largest, extent[k]);
    }
    const double wanted = std::max(8.0, 0.12 * static_cast<double>(ids_.size()));
    double size = largest;
    const auto count = [&](std::size_t k) {
        return std::clamp(std::round(extent[k] / size), 1.0, 512.0);
    };
    while (count(0) * count(1) * count(2) < wanted && size > largest / 512) size *= 0.9;
    // Edges are rounded up to multiples of twice the quantum for the finest cells; that must not
    // make much of a difference.
    for (g.levels = 6; g.levels > 0; --g.levels) {
        bool fits = true;
        const double finest = 2 * quantum_ * static_cast<double>(1U << g.shift());
        for (std::size_t k = 0; k < 3; ++k) fits = fits && 16 * finest * count(k) <= extent[k];
        if (fits) break;
    }
    const double finest = 2 * quantum_ * static_cast<double>(1U << g.shift());
    for (std::size_t k = 0; k < 3; ++k) {
        g.n[k] = static_cast<std::uint32_t>(count(k));
        g.fine[k] = std::ceil(extent[k] / (finest * count(k))) * 2 * quantum_;
        g.scale[k] = 1 / g.fine[k];
    }
    return g;
}

bool IndexTreeBuilder::make_grid(IndexGrid g, const Place& place, std::uint32_t node,
                                 const FinePoint& reference, std::int32_t winding) {
    // What the first and last cells reach beyond the grid; where all polygons are in it, only what
    // is beyond their box counts.
    double margin = 0;
    for (std::size_t k = 0; k < 3; ++k) margin = std::max(margin, g.origin[k] - place.least[k]);
    margin *= 1.001;
    FinePoint corner;
    for (std::size_t k = 0; k < 3; ++k) corner.c[k] = fine_position(g.origin[k]);
    if (!trace(reference, corner, winding)) return false;
    auto division = std::make_unique<IndexDivision>(polygons_, cells_, g, margin, !place.whole);
    if (!division->prepare(ids_, winding)) return false;
    g.first = static_cast<std::uint32_t>(t_.roots_.size());
    g.number = static_cast<std::uint32_t>(t_.grids_.size());
    t_.roots_.resize(g.first + g.count());
    for (std::size_t cell = 0; cell < g.count(); ++cell)
        t_.roots_[g.first + cell] = division->slot_before(cell);
    t_.nodes_[node].next = g.number;
    t_.nodes_[node].flags = Node::leaf | Node::grid_flag;
    t_.grids_.push_back(g);
    t_.divisions_.push_back(std::move(division));
    return true;
}

// Winding number at `to`, given that at `from`; false when `to` is on a polygon.
bool IndexTreeBuilder::trace(const FinePoint& from, const FinePoint& to,
                             std::int32_t& winding) const {
    const IndexPoint point(to);
    const Reference reference(from);
    DoubleBox way;
    for (std::size_t k = 0; k < 3; ++k) {
        const double slack = 0x1p-50 * (std::fabs(point[k]) + std::fabs(reference.c[k]));
        way.lo[k] = std::min(point[k], reference.c[k]) - slack;
        way.hi[k] = std::max(point[k], reference.c[k]) + slack;
    }
    for (const Id id : ids_) {
        if (!polygons_.bounds(id).overlaps(way) && !polygons_.is_unbounded(id)) continue;
        const Passing p = passing(polygons_, id, point, reference);
        if (p == Passing::On) return false;
        winding += polygons_.is_flipped(id) ? -static_cast<int>(p) : static_cast<int>(p);
    }
    return true;
}

IndexTree::IndexTree(const SolidState& state, IndexPolygons& polygons) : IndexTree() {
    IndexTreeBuilder(*this, polygons).build(state);
}

}  // namespace trisect::detail
