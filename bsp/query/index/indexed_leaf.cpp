// SPDX-License-Identifier: Apache-2.0
//
// Building the structure in which queries run.
//
// The cell tree of a solid is as fine as the last operation needed it: a fresh mesh is one leaf
// that lists everything, and a leaf of a result may list thousands of facets that nothing cut. A
// leaf with many polygons becomes a grid over the box of these, whose crowded cells are divided
// 4 x 4 x 4 at a time (index_bricks.cpp).
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

#include <trisect/bsp/query/index/indexed_leaf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <trisect/bsp/query/index/double_box.h>
#include <trisect/bsp/query/index/index_bricks.h>
#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/query/index/index_grid_lists.h>
#include <trisect/bsp/query/index/index_signs.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

namespace {

using Id = IndexPolygons::Id;

constexpr std::size_t divided_polygons = 10;  // by a grid of several cells, from so many on
constexpr std::size_t made_at_once = 64;      // up to so many, without waiting for queries
constexpr int attempts = 4;
// Around the polygons, lattice units, and a part of their extent: corners of the grid should be
// surely off planes that bound the solid.
constexpr double room = 3;
constexpr double relative_room = 0x1p-10;

template <class T>
std::size_t bytes_of(const std::vector<T>& v) {
    return v.capacity() * sizeof(T);
}

// Whether a point is beyond the polygons' box.
bool lies_beyond(const IndexPolygons& polygons, const Reference& point) {
    const DoubleBox box = polygons.bounds();
    for (std::size_t k = 0; k < 3; ++k)
        if (point.c[k] + point.error < box.lo[k] || point.c[k] - point.error > box.hi[k])
            return true;
    return false;
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

IndexCells::IndexCells(std::size_t polygons) {
    // About a brick for 200 polygons, a leaf for 8, each polygon listed three times.
    const auto bits = static_cast<unsigned>(std::bit_width(polygons));
    const auto chunk = [&](unsigned more, unsigned less) {
        return std::clamp(bits + more, less + 2, less + 10) - less;
    };
    slots = GrowingArray<std::uint32_t>(chunk(0, 2));
    bricks = GrowingArray<IndexBrick>(chunk(0, 6));
    leaves = GrowingArray<IndexLeaf>(chunk(0, 3));
    listed = GrowingArray<Id>(chunk(1, 0));
    planes = GrowingArray<float>(chunk(4, 0));
}

IndexedLeaf::~IndexedLeaf() = default;

// Few threads divide at a time, so leaves share mutexes.
std::mutex& IndexedLeaf::dividing() const {
    static std::array<std::mutex, 64> mutexes;
    return mutexes[mix64(reinterpret_cast<std::uintptr_t>(this)) % mutexes.size()];
}

// Along a line from the reference. A whole mesh is closed, so all around its box is as the
// reference is, if that is there.
bool IndexedLeaf::find_side(std::size_t side) const {
    const Reference from(reference_);
    if (polygons_.only_source() != nullptr && lies_beyond(polygons_, from)) {
        for (auto& s : sides_) s.store(winding_ > 0 ? 1 : 0, std::memory_order_relaxed);
        return winding_ > 0;
    }
    const std::size_t k = side / 2;
    FinePoint to = reference_;
    to.c[k] =
        side % 2 == 0
            ? reference_position(
                  (static_cast<std::int64_t>(std::floor(below_[k])) - 2) * splitting_scale, -1)
            : reference_position(
                  (static_cast<std::int64_t>(std::ceil(above_[k])) + 2) * splitting_scale, 1);
    std::int32_t winding = winding_;
    const IndexPoint point(to);
    for (Id id = 0; id < polygons_.size(); ++id) {
        const DoubleBox box = polygons_.bounds(id);
        bool near = true;
        for (std::size_t j = 0; j < 3; ++j)
            near = near && (j == k || (box.lo[j] <= from.c[j] + from.error &&
                                       box.hi[j] >= from.c[j] - from.error));
        if (!near) continue;
        const int passed = static_cast<int>(passing(polygons_, id, point, from));
        winding += polygons_.is_flipped(id) ? -passed : passed;
    }
    sides_[side].store(winding > 0 ? 1 : 0, std::memory_order_relaxed);
    return winding > 0;
}

IndexedLeaf::Cell IndexedLeaf::whole() const {
    Cell c;
    c.inside = winding_ > 0;
    if (polygons_.size() != 0) c.leaf = 0;
    return c;
}

// What others see of a cell before its slot is the old slot, afterwards everything below it.
std::uint32_t IndexedLeaf::divide(std::size_t cell) const {
    check_stop();
    const WorkLock lock(dividing());
    const std::atomic_ref slot(roots_[cell]);
    if (const std::uint32_t s = slot.load(std::memory_order_relaxed); s != IndexSlot::pending)
        return s;
    const std::uint32_t made = division_->divide(cell);
    slot.store(made, std::memory_order_release);
    return made;
}

void IndexedLeaf::divide_all() const {
    for (std::size_t cell = 0; cell < roots_.size(); ++cell) (void)grid_slot(cell);
}

IndexedLeaf::Stats IndexedLeaf::stats() const {
    const WorkLock lock(dividing());
    Stats s;
    s.nodes = roots_.size();
    for (std::uint32_t& root : roots_) {
        const std::uint32_t slot = std::atomic_ref(root).load(std::memory_order_relaxed);
        if (slot == IndexSlot::pending) ++s.pending;
        if (IndexSlot::is_empty(slot)) ++s.empty;
    }
    for (std::uint32_t i = 0; i < cells_.bricks.end(); ++i) {
        const IndexBrick& b = cells_.bricks[i];
        s.nodes += 64;
        s.empty += 64 - static_cast<std::size_t>(std::popcount(b.mixed));
        for (std::uint64_t left = b.mixed; left != 0; left &= left - 1)
            if (IndexSlot::is_empty(slot(b.slot(static_cast<unsigned>(std::countr_zero(left))))))
                ++s.empty;
    }
    s.mixed = cells_.leaves.end();
    for (std::uint32_t i = 0; i < cells_.leaves.end(); ++i) s.listed += cells_.leaves[i].count;
    s.bytes = sizeof(*this) + polygons_.bytes() + bytes_of(roots_) + cells_.bytes();
    if (division_ != nullptr) {
        s.depth = 1 + division_->depth();
        s.bytes += division_->bytes();
    }
    return s;
}

FinePoint IndexedLeaf::reference(const Cell& c, const IndexGrid::Position& at) const {
    if (c.grid == nullptr) return reference_;
    FinePoint p;
    for (std::size_t k = 0; k < 3; ++k)
        p.c[k] = fine_position(c.grid->splitter(k, at.fine[k] >> c.shift << c.shift));
    return p;
}

class IndexedLeafBuilder {
public:
    explicit IndexedLeafBuilder(IndexedLeaf& index)
        : index_(index), cells_(index.cells_), polygons_(index.polygons_) {}

    void build();

private:
    using Vector = std::array<double, 3>;
    struct Place {
        Vector lo{};
        Vector hi{};
        Vector least{};      // what is below it in the cell does not matter
        bool whole = false;  // contains all polygons of the leaf
    };

    void find_sides(const DoubleBox& bounds);
    void find_quantum(const Place& place);
    void make_list();
    void divide_all();
    [[nodiscard]] static Place place_of(const Cell& cell, const DoubleBox& polygons);
    [[nodiscard]] std::optional<IndexGrid> grid_over(const Place& place, int attempt) const;
    [[nodiscard]] bool make_grid(const IndexGrid& grid, const Place& place);
    [[nodiscard]] bool trace(const FinePoint& from, const FinePoint& to,
                             std::int32_t& winding) const;

    IndexedLeaf& index_;
    IndexCells& cells_;
    const IndexPolygons& polygons_;
    // Positions are odd multiples of it.
    double quantum_ = 1.0 / static_cast<double>(dyadic_scale);
    std::vector<Id> ids_;
};

void IndexedLeafBuilder::build() {
    const std::uint32_t n = polygons_.size();
    if (n == 0) return;
    check_stop(1 + n);
    ids_.resize(n);
    std::iota(ids_.begin(), ids_.end(), Id{0});
    DoubleBox bounds;
    bool is_bounded = false;
    for (const Id id : ids_) {
        if (polygons_.is_unbounded(id)) continue;
        const DoubleBox b = polygons_.bounds(id);
        for (std::size_t k = 0; k < 3; ++k) {
            bounds.lo[k] = is_bounded ? std::min(bounds.lo[k], b.lo[k]) : b.lo[k];
            bounds.hi[k] = is_bounded ? std::max(bounds.hi[k], b.hi[k]) : b.hi[k];
        }
        is_bounded = true;
    }
    if (is_bounded) {
        find_sides(bounds);
        const Place place = place_of(polygons_.cell(), bounds);
        find_quantum(place);
        for (int attempt = 0; attempt < attempts; ++attempt) {
            const auto grid = grid_over(place, attempt);
            if (!grid || !make_grid(*grid, place)) continue;
            if (n <= made_at_once) divide_all();
            return;
        }
    }
    make_list();
}

// Where the cell goes on beyond the polygons far enough for a point with a known position.
void IndexedLeafBuilder::find_sides(const DoubleBox& bounds) {
    constexpr double least = 4;
    for (Id id : ids_)
        if (polygons_.is_unbounded(id)) return;
    const Cell& cell = polygons_.cell();
    for (std::size_t k = 0; k < 3; ++k) {
        if (bounds.lo[k] - rounded_position(cell.lo[k]) > least) index_.below_[k] = bounds.lo[k];
        if (rounded_position(cell.hi[k]) - bounds.hi[k] > least) index_.above_[k] = bounds.hi[k];
    }
}

// Splitting planes must be doubles: multiples of the quantum below 2^52 of it.
void IndexedLeafBuilder::find_quantum(const Place& place) {
    double reach = 1;
    for (std::size_t k = 0; k < 3; ++k)
        reach = std::max({reach, std::fabs(place.lo[k]), std::fabs(place.hi[k])});
    while (reach >= 0x1p51 * quantum_) quantum_ *= 2;
}

void IndexedLeafBuilder::divide_all() {
    for (std::size_t cell = 0; cell < index_.roots_.size(); ++cell)
        if (index_.roots_[cell] == IndexSlot::pending)
            index_.roots_[cell] = index_.division_->divide(cell);
    index_.division_.reset();
}

void IndexedLeafBuilder::make_list() {
    IndexLeaf leaf;
    leaf.first = cells_.listed.append(ids_.size());
    leaf.count = static_cast<std::uint32_t>(ids_.size());
    leaf.winding = index_.winding_;
    std::copy(ids_.begin(), ids_.end(), &cells_.listed[leaf.first]);
    cells_.leaves[cells_.leaves.append(1)] = leaf;
}

// Where a grid is wanted: around the polygons, in the cell.
IndexedLeafBuilder::Place IndexedLeafBuilder::place_of(const Cell& cell,
                                                       const DoubleBox& polygons) {
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

std::optional<IndexGrid> IndexedLeafBuilder::grid_over(const Place& place, int attempt) const {
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
    const double wanted = ids_.size() < divided_polygons
                              ? 1.0
                              : std::max(8.0, 0.12 * static_cast<double>(ids_.size()));
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

bool IndexedLeafBuilder::make_grid(const IndexGrid& g, const Place& place) {
    // What the first and last cells reach beyond the grid; where all polygons are in it, only what
    // is beyond their box counts.
    double margin = 0;
    for (std::size_t k = 0; k < 3; ++k) margin = std::max(margin, g.origin[k] - place.least[k]);
    margin *= 1.001;
    FinePoint corner;
    for (std::size_t k = 0; k < 3; ++k) corner.c[k] = fine_position(g.origin[k]);
    std::int32_t winding = index_.winding_;
    if (!trace(index_.reference_, corner, winding)) return false;
    auto division = std::make_unique<IndexDivision>(polygons_, cells_, g, margin, !place.whole);
    if (!division->prepare(ids_, winding)) return false;
    index_.roots_.resize(g.count());
    for (std::size_t cell = 0; cell < g.count(); ++cell)
        index_.roots_[cell] = division->slot_before(cell);
    index_.grid_ = g;
    index_.division_ = std::move(division);
    return true;
}

// Winding number at `to`, given that at `from`; false when `to` is on a polygon.
bool IndexedLeafBuilder::trace(const FinePoint& from, const FinePoint& to,
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

IndexedLeaf::IndexedLeaf(const CellNode& node, const detail::Cell& cell)
    : cells_(0),
      polygons_(node.polygons(), cell),
      reference_(node.reference()),
      winding_(node.winding() > 0 ? 1 : 0) {
    cells_ = IndexCells(polygons_.size());
}

void IndexedLeaf::build() const {
    const WorkLock lock(dividing());
    if (divided_.load(std::memory_order_relaxed)) return;
    // Nobody has seen what is made now.
    IndexedLeafBuilder(const_cast<IndexedLeaf&>(*this)).build();
    divided_.store(true, std::memory_order_release);
}

const IndexedLeaf& listed_leaf(const CellNode& leaf, const Cell& cell) {
    if (const NodeFact* const there = leaf.index_fact().get())
        return static_cast<const IndexedLeaf&>(*there);
    // A deferred leaf is arranged before the slot is locked.
    (void)leaf.polygons();
    return static_cast<const IndexedLeaf&>(leaf.index_fact().get_or([&] {
        ++index_counters().leaves;
        return std::make_unique<const IndexedLeaf>(leaf, cell);
    }));
}

}  // namespace trisect::detail
