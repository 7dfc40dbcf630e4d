// SPDX-License-Identifier: Apache-2.0
//
// Building the tree in which queries run.
//
// The cell tree of a solid is as fine as the last operation needed it: a fresh mesh is one leaf
// that lists everything, and a leaf of a result may list thousands of facets that nothing cut. Its
// walls are kept, and below each leaf comes a k-d tree.
//
// Built at once, not on demand: a node on demand costs a check and a fence at every step of every
// descent, and tens of thousands of descents pay for the whole.
//
// Walls are chosen by the surface-area heuristic over bins (MacDonald and Booth 1990; Wald and
// Havran 2006): the chance that a query enters a child is taken proportional to its surface, which
// fits rays and points near the surface, and pieces of empty space are cut off as large as
// possible, which makes uniform points fast. A polygon that a wall cuts goes to both sides, each
// time with the box of its part only, so that long facets are not listed where they do not pass.
//
// Boxes are kept as floats relative to the middle of the model, rounded outwards; walls are floats
// there, too. So comparing is cheap, always on the safe side, and every polygon that meets a closed
// cell is listed in it.
//
// Every mixed leaf needs a reference point off the surface with its winding number. A node hands
// its own to the child in which it lies; for the other child it is moved across the wall along the
// axis, and a trace over the node's polygons tells the new winding number. Most polygons miss the
// line of that move by their boxes. So the whole tree costs one exact trace a node, and results of
// booleans need no search for references at all.

#include <trisect/bsp/detail/index_tree.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/bsp/detail/index_grid_lists.h>
#include <trisect/bsp/detail/index_signs.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

std::int64_t IndexTree::Node::position() const { return std::bit_cast<std::int64_t>(wall); }

double IndexTree::Node::rounded_wall() const {
    if (!is_inherited()) return wall;
    return static_cast<double>(position()) * (1.0 / static_cast<double>(wall_scale));
}

std::size_t IndexTree::bytes() const {
    return sizeof(*this) + nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(Leaf) +
           listed_.capacity() * sizeof(Id) + cells_.capacity() * sizeof(std::uint32_t) +
           grids_.capacity() * sizeof(IndexGrid);
}

std::size_t IndexTree::empty_leaves() const {
    const auto is_empty = [](const Node& n) { return n.is_leaf() && !n.is_mixed(); };
    const auto is_empty_cell = [](std::uint32_t c) { return c >= IndexGrid::outside; };
    return static_cast<std::size_t>(std::count_if(nodes_.begin(), nodes_.end(), is_empty) +
                                    std::count_if(cells_.begin(), cells_.end(), is_empty_cell));
}

const IndexTree::Node& IndexTree::empty_leaf(bool inside) {
    static const Node out{0, Node::none, Node::leaf};
    static const Node in{0, Node::none, Node::leaf | Node::inside};
    return inside ? in : out;
}

namespace {

using Id = IndexPolygons::Id;
using Node = IndexTree::Node;

constexpr int max_depth = 96;
constexpr std::size_t bin_count = 16;
constexpr std::size_t grid_items = 24;  // from so many polygons on

float rounded_down(double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) > v ? std::nextafter(f, -HUGE_VALF) : f;
}
float rounded_up(double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) < v ? std::nextafter(f, HUGE_VALF) : f;
}

struct Split {
    int axis = -1;
    float wall = 0;
    float cost = 0;
};

// Reference points are doubles, so that filters see them without error.
bool is_exact_double(std::int64_t v) {
    return static_cast<std::int64_t>(static_cast<double>(v)) == v;
}

}  // namespace

class IndexTreeBuilder {
public:
    IndexTreeBuilder(IndexTree& tree, IndexPolygons& polygons) : t_(tree), polygons_(polygons) {}

    void build(const SolidState& state);

private:
    // What is known of a node while it is built.
    struct State {
        std::uint32_t node = 0;
        int depth = 0;
        FloatBox cell;
        std::size_t first = 0;  // of items_, to the end
        FinePoint reference;
        std::int32_t winding = 0;
    };

    void find_bounds(const CellRef& root);
    void note_polygons(const SolidState& state, const CellRef& ref, bool turned, const Cell& cell);
    void add_cells(const CellRef& ref, bool turned, const Cell& cell, std::uint32_t node,
                   int depth);
    void add_leaf_cell(const CellNode& cell_node, bool turned, const Cell& cell, std::uint32_t node,
                       int depth);
    class GridSweep;
    [[nodiscard]] bool make_grid(const State& s);
    void subdivide(State s);
    [[nodiscard]] Split best_split(const State& s, std::size_t count) const;
    void bin_axis(const State& s, std::size_t axis, const FloatBox& bounds, Split& best) const;
    [[nodiscard]] std::size_t partition(std::size_t first, std::size_t end, const Split& split);
    void clip(IndexItem& below, IndexItem& above, const Split& split) const;
    [[nodiscard]] std::int64_t position(std::size_t k, float lo, float hi, float part) const;
    [[nodiscard]] bool is_in(const FinePoint& p, const FloatBox& cell) const;
    [[nodiscard]] bool trace(std::size_t first, const FinePoint& from, const FinePoint& to,
                             std::int32_t& winding) const;
    [[nodiscard]] bool enter_cell(State& s) const;
    [[nodiscard]] bool move_reference(State& child, const Split& split, std::size_t first) const;
    void make_leaf(const State& s);
    [[nodiscard]] float quantised(float wall) const;
    [[nodiscard]] FloatBox relative(const Cell& cell) const;
    [[nodiscard]] double middle(std::size_t k) const { return static_cast<double>(middle_[k]); }

    IndexTree& t_;
    IndexPolygons& polygons_;
    std::array<std::int64_t, 3> middle_{};
    float grid_ = 1.0F / 256;  // walls are odd multiples of it where floats have the bits
    std::vector<IndexItem> items_;
};

void IndexTreeBuilder::build(const SolidState& state) {
    find_bounds(state.root);
    if (polygons_.only_source() == nullptr) note_polygons(state, state.root, false, Cell{});
    add_cells(state.root, false, Cell{}, 0, 0);
    polygons_.finish();
    t_.nodes_.shrink_to_fit();
    t_.leaves_.shrink_to_fit();
    t_.listed_.shrink_to_fit();
}

// The box of everything, a little larger.
void IndexTreeBuilder::find_bounds(const CellRef& root) {
    Box box;
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
    // Walls are middle + float and must be doubles: multiples of the grid below 2^52 of it.
    while (static_cast<double>(reach) >= 0x1p51 * static_cast<double>(grid_)) grid_ *= 2;
    const std::int64_t step = std::max<std::int64_t>(1, static_cast<std::int64_t>(grid_));
    for (std::size_t k = 0; k < 3; ++k)
        middle_[k] = (box.lo[k] + (box.hi[k] - box.lo[k]) / 2) & ~(step - 1);
}

FloatBox IndexTreeBuilder::relative(const Cell& cell) const {
    FloatBox b;
    for (std::size_t k = 0; k < 3; ++k) {
        const double lo = static_cast<double>(cell.lo[k]) / static_cast<double>(wall_scale);
        const double hi = static_cast<double>(cell.hi[k]) / static_cast<double>(wall_scale);
        b.lo[k] = rounded_down(std::max(lo, t_.lo_[k]) - middle(k));
        b.hi[k] = rounded_up(std::min(hi, t_.hi_[k]) - middle(k));
        b.hi[k] = std::max(b.lo[k], b.hi[k]);
    }
    return b;
}

// Depth is bounded by the cell tree's own, here and in add_cells.
void IndexTreeBuilder::note_polygons(const SolidState& state, const CellRef& ref, bool turned,
                                     const Cell& cell) {
    turned = turned != ref.complemented;
    const CellNode& n = *ref.node;
    if (!n.is_leaf()) {
        note_polygons(state, n.child(0), turned, cell.below(n.axis(), n.wall()));
        note_polygons(state, n.child(1), turned, cell.above(n.axis(), n.wall()));
        return;
    }
    const auto& incomplete = state.incomplete;
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
    t_.nodes_[node] = {std::bit_cast<double>(n.wall()), children,
                       static_cast<std::uint32_t>(n.axis()) | Node::inherited};
    add_cells(n.child(0), turned, cell.below(n.axis(), n.wall()), children, depth + 1);
    add_cells(n.child(1), turned, cell.above(n.axis(), n.wall()), children + 1, depth + 1);
}

void IndexTreeBuilder::add_leaf_cell(const CellNode& cell_node, bool turned, const Cell& cell,
                                     std::uint32_t node, int depth) {
    items_.clear();
    const FloatBox bounds = relative(cell);
    for (const PolygonRef r : cell_node.polygons()) {
        Id id = 0;
        if (const Source* only = polygons_.only_source()) {
            (void)only;
            id = r.facet;
        } else {
            id = polygons_.add(r, turned, cell);
            if (id == IndexPolygons::none) continue;
        }
        IndexItem item;
        item.id = id;
        const Box& box = r.box();
        bool meets = true;
        for (std::size_t k = 0; k < 3; ++k) {
            item.lo[k] =
                std::max(bounds.lo[k], rounded_down(static_cast<double>(box.lo[k] - middle_[k])));
            item.hi[k] =
                std::min(bounds.hi[k], rounded_up(static_cast<double>(box.hi[k] - middle_[k])));
            meets = meets && item.lo[k] <= item.hi[k];
        }
        if (meets) items_.push_back(item);
    }
    State s;
    s.node = node;
    s.depth = depth;
    s.cell = bounds;
    s.reference = cell_node.reference();
    const int inside = cell_node.winding() > 0 ? 1 : 0;
    s.winding = turned ? 1 - inside : inside;
    // A cell without polygons may be narrow or beyond the model; where there is no better reference
    // the cell's own serves, and the cell stays as it is.
    if (items_.empty() || !enter_cell(s)) {
        make_leaf(s);
        items_.clear();
        return;
    }
    if (items_.size() < grid_items || !make_grid(s)) subdivide(s);
}

float IndexTreeBuilder::quantised(float wall) const {
    if (std::fabs(wall) >= 0x1p23F * grid_) return wall;  // a multiple of the grid as it is
    const float steps = std::floor(wall / grid_);
    return (steps + (std::fmod(steps, 2.0F) == 0 ? 1.0F : 0.0F)) * grid_;
}

void IndexTreeBuilder::bin_axis(const State& s, std::size_t axis, const FloatBox& bounds,
                                Split& best) const {
    const float lo = bounds.lo[axis];
    const float extent = bounds.hi[axis] - lo;
    if (!(extent > 0)) return;
    std::array<std::uint32_t, bin_count + 1> starts{};
    std::array<std::uint32_t, bin_count + 1> ends{};
    const float scale = static_cast<float>(bin_count) * 0.99999F / extent;
    const auto bin = [&](float v) {
        return static_cast<std::size_t>(std::max(0.0F, (v - lo) * scale));
    };
    for (std::size_t i = s.first; i < items_.size(); ++i) {
        ++starts[std::min(bin(items_[i].lo[axis]), bin_count - 1)];
        ++ends[std::min(bin(items_[i].hi[axis]), bin_count - 1)];
    }
    const std::size_t j = (axis + 1) % 3;
    const std::size_t l = (axis + 2) % 3;
    const float ej = s.cell.extent(j);
    const float el = s.cell.extent(l);
    const float cap = ej * el;
    const float ring = ej + el;
    const float whole = cap + ring * s.cell.extent(axis);
    const auto count = static_cast<std::uint32_t>(items_.size() - s.first);
    const auto consider = [&](float at, std::uint32_t below, std::uint32_t above) {
        const float wall = quantised(at);
        if (!(wall > s.cell.lo[axis] && wall < s.cell.hi[axis])) return;
        const float area_below = cap + ring * (wall - s.cell.lo[axis]);
        const float area_above = cap + ring * (s.cell.hi[axis] - wall);
        const float cost = 2.5F + (area_below * static_cast<float>(below) +
                                   area_above * static_cast<float>(above)) /
                                      whole;
        if (best.axis < 0 || cost < best.cost) best = {static_cast<int>(axis), wall, cost};
    };
    std::uint32_t below = 0;
    std::uint32_t above = count;
    for (std::size_t b = 1; b < bin_count; ++b) {
        below += starts[b - 1];
        above -= ends[b - 1];
        consider(lo + extent * static_cast<float>(b) / static_cast<float>(bin_count), below, above);
    }
}

Split IndexTreeBuilder::best_split(const State& s, std::size_t count) const {
    FloatBox bounds;
    bounds.lo.fill(HUGE_VALF);
    bounds.hi.fill(-HUGE_VALF);
    for (std::size_t i = s.first; i < items_.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            bounds.lo[k] = std::min(bounds.lo[k], items_[i].lo[k]);
            bounds.hi[k] = std::max(bounds.hi[k], items_[i].hi[k]);
        }
    Split best;
    // Mostly the longest axis is the right one, and looking at one costs a third.
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (s.cell.extent(k) > s.cell.extent(axis)) axis = k;
    bin_axis(s, axis, bounds, best);
    if (best.axis >= 0 && best.cost < static_cast<float>(count)) return best;
    for (std::size_t k = 0; k < 3; ++k) bin_axis(s, k, bounds, best);
    return best;
}

// The boxes of the two parts of a polygon that crosses the wall: a corner belongs to its side, and
// so does the point where an edge crosses the wall.
void IndexTreeBuilder::clip(IndexItem& below, IndexItem& above, const Split& split) const {
    const auto axis = static_cast<std::size_t>(split.axis);
    below.hi[axis] = split.wall;
    above.lo[axis] = split.wall;
    if (!polygons_.is_triangle(below.id)) return;
    std::array<std::array<double, 3>, 3> c{};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            c[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = static_cast<double>(
                polygons_.corner(below.id, i)[k] - middle_[static_cast<std::size_t>(k)]);
    const auto wall = static_cast<double>(split.wall);
    for (const std::size_t k : {(axis + 1) % 3, (axis + 2) % 3}) {
        std::array<double, 2> lo{HUGE_VAL, HUGE_VAL};
        std::array<double, 2> hi{-HUGE_VAL, -HUGE_VAL};
        const auto add = [&](std::size_t side, double v) {
            lo[side] = std::min(lo[side], v);
            hi[side] = std::max(hi[side], v);
        };
        double largest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& a = c[i];
            const auto& b = c[(i + 1) % 3];
            largest = std::max(largest, std::fabs(a[k]));
            if (a[axis] <= wall) add(0, a[k]);
            if (a[axis] >= wall) add(1, a[k]);
            if ((a[axis] < wall) != (b[axis] < wall)) {
                const double t = (wall - a[axis]) / (b[axis] - a[axis]);
                const double at = a[k] + t * (b[k] - a[k]);
                add(0, at);
                add(1, at);
            }
        }
        // A crossing is within a few roundings of values up to 2 `largest`.
        const double slack = largest * 0x1p-48;
        below.lo[k] = std::max(below.lo[k], rounded_down(lo[0] - slack));
        below.hi[k] = std::min(below.hi[k], rounded_up(hi[0] + slack));
        above.lo[k] = std::max(above.lo[k], rounded_down(lo[1] - slack));
        above.hi[k] = std::min(above.hi[k], rounded_up(hi[1] + slack));
    }
}

// Items [first, end) become those below, in place, and those above, behind the others. Returns the
// end of those below; what lies between is unused.
std::size_t IndexTreeBuilder::partition(std::size_t first, std::size_t end, const Split& split) {
    const auto axis = static_cast<std::size_t>(split.axis);
    const auto is_empty = [](const IndexItem& i) {
        return i.lo[0] > i.hi[0] || i.lo[1] > i.hi[1] || i.lo[2] > i.hi[2];
    };
    std::size_t out = first;
    for (std::size_t i = first; i < end; ++i) {
        IndexItem item = items_[i];
        if (item.hi[axis] < split.wall) {
            items_[out++] = item;
        } else if (item.lo[axis] > split.wall) {
            items_.push_back(item);
        } else {
            IndexItem above = item;
            clip(item, above, split);
            if (!is_empty(item)) items_[out++] = item;
            if (!is_empty(above)) items_.push_back(above);
        }
    }
    return out;
}

// A coordinate of a reference strictly between two walls, a double; or one of the walls when there
// is none.
std::int64_t IndexTreeBuilder::position(std::size_t k, float lo, float hi, float part) const {
    const double step = static_cast<double>(grid_) * static_cast<double>(wall_scale);
    const double at =
        static_cast<double>(lo) +
        (static_cast<double>(hi) - static_cast<double>(lo)) * static_cast<double>(part);
    const double steps = std::floor(at / static_cast<double>(grid_));
    return middle_[k] * wall_scale + static_cast<std::int64_t>(steps * step);
}

bool IndexTreeBuilder::is_in(const FinePoint& p, const FloatBox& cell) const {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t at = p.c[k] - middle_[k] * wall_scale;
        const double lo = static_cast<double>(cell.lo[k]) * static_cast<double>(wall_scale);
        const double hi = static_cast<double>(cell.hi[k]) * static_cast<double>(wall_scale);
        if (static_cast<double>(at) <= lo || static_cast<double>(at) >= hi) return false;
        if (!is_exact_double(p.c[k])) return false;
    }
    return true;
}

// Winding number at `to`, given that at `from`; false when `to` is on a polygon. Over the items
// from `first` on, which list all that meets the segment.
bool IndexTreeBuilder::trace(std::size_t first, const FinePoint& from, const FinePoint& to,
                             std::int32_t& winding) const {
    FloatBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = static_cast<double>(from.c[k] - middle_[k] * wall_scale) /
                         static_cast<double>(wall_scale);
        const double b = static_cast<double>(to.c[k] - middle_[k] * wall_scale) /
                         static_cast<double>(wall_scale);
        box.lo[k] = rounded_down(std::min(a, b));
        box.hi[k] = rounded_up(std::max(a, b));
    }
    const IndexPoint point(to);
    const Reference reference(from);
    std::int32_t change = 0;
    for (std::size_t i = first; i < items_.size(); ++i) {
        const IndexItem& item = items_[i];
        if (item.lo[0] > box.hi[0] || item.hi[0] < box.lo[0] || item.lo[1] > box.hi[1] ||
            item.hi[1] < box.lo[1] || item.lo[2] > box.hi[2] || item.hi[2] < box.lo[2])
            continue;
        const Passing p = passing(polygons_, item.id, point, reference);
        if (p == Passing::On) return false;
        change += polygons_.is_flipped(item.id) ? -static_cast<int>(p) : static_cast<int>(p);
    }
    winding += change;
    return true;
}

constexpr std::array<float, 7> parts{0.46F, 0.37F, 0.61F, 0.23F, 0.79F, 0.53F, 0.07F};

// The reference of a cell of the cell tree may lie outside the part that is subdivided here, or be
// no double.
bool IndexTreeBuilder::enter_cell(State& s) const {
    if (is_in(s.reference, s.cell)) return true;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        FinePoint to;
        for (std::size_t k = 0; k < 3; ++k)
            to.c[k] = position(k, s.cell.lo[k], s.cell.hi[k], parts[(i + 2 * k) % parts.size()]);
        if (is_in(to, s.cell) && trace(s.first, s.reference, to, s.winding)) {
            s.reference = to;
            return true;
        }
    }
    return false;
}

// The reference of the parent, moved across the wall into the child. `first`: the parent's items.
bool IndexTreeBuilder::move_reference(State& child, const Split& split, std::size_t first) const {
    const auto axis = static_cast<std::size_t>(split.axis);
    for (const float part : parts) {
        FinePoint to = child.reference;
        to.c[axis] = position(axis, child.cell.lo[axis], child.cell.hi[axis], part);
        if (is_in(to, child.cell) && trace(first, child.reference, to, child.winding)) {
            child.reference = to;
            return true;
        }
    }
    return false;
}

void IndexTreeBuilder::make_leaf(const State& s) {
    t_.depth_ = std::max(t_.depth_, static_cast<std::size_t>(s.depth));
    const std::size_t count = items_.size() - s.first;
    Node& n = t_.nodes_[s.node];
    n.flags = Node::leaf;
    if (count == 0) {
        n.next = Node::none;
        if (s.winding > 0) n.flags |= Node::inside;
        return;
    }
    TRISECT_EXPECTS(t_.listed_.size() + count < Node::none, "too many polygons for an index");
    n.next = static_cast<std::uint32_t>(t_.leaves_.size());
    t_.leaves_.push_back({s.reference, static_cast<std::uint32_t>(t_.listed_.size()),
                          static_cast<std::uint32_t>(count), s.winding});
    for (std::size_t i = s.first; i < items_.size(); ++i) t_.listed_.push_back(items_[i].id);
}

// Items from s.first on belong to the node; they are gone on return.
void IndexTreeBuilder::subdivide(State s) {
    const std::size_t end = items_.size();
    const std::size_t count = end - s.first;
    Split split;
    if (count > 8 && s.depth < max_depth) split = best_split(s, count);
    const bool worth = split.axis >= 0 && split.cost < static_cast<float>(count);
    if (!worth) {
        make_leaf(s);
        items_.resize(s.first);
        return;
    }
    const auto axis = static_cast<std::size_t>(split.axis);
    State below = s;
    State above = s;
    below.cell.hi[axis] = split.wall;
    above.cell.lo[axis] = split.wall;
    const bool is_below = static_cast<double>(s.reference.c[axis] - middle_[axis] * wall_scale) <
                          static_cast<double>(split.wall) * static_cast<double>(wall_scale);
    if (!move_reference(is_below ? above : below, split, s.first)) {
        make_leaf(s);
        items_.resize(s.first);
        return;
    }
    const auto children = static_cast<std::uint32_t>(t_.nodes_.size());
    t_.nodes_.resize(t_.nodes_.size() + 2);
    t_.nodes_[s.node] = {middle(axis) + static_cast<double>(split.wall), children,
                         static_cast<std::uint32_t>(split.axis)};
    below.node = children;
    above.node = children + 1;
    ++below.depth;
    ++above.depth;
    above.first = end;
    const std::size_t below_end = partition(s.first, end, split);
    subdivide(above);
    items_.resize(below_end);
    subdivide(below);
}

// Grids ------------------------------------------------------------------------------------------

// References of cells lie at the same place in every cell. They are swept: along x through every
// row, from row to row along y at the start of rows, from layer to layer along z. A segment between
// the references of neighbours stays in the two cells, so their lists decide. Along empty cells
// nothing changes: the last reference serves for all of them.
class IndexTreeBuilder::GridSweep {
public:
    struct Known {
        FinePoint at;
        std::int32_t winding = 0;
        std::size_t cell = 0;
        bool valid = false;
    };

    GridSweep(IndexTreeBuilder& builder, const IndexGridLists& grid,
              const std::vector<IndexItem>& all)
        : b_(builder), grid_(grid), all_(all) {}

    /// Writes which empty cells are inside, from place `first` on, and leaves the references of the
    /// others in mixed(). False when a reference cannot be moved.
    bool run(const State& s, std::uint32_t first) {
        Known layer = first_cell(s);
        if (!layer.valid) return false;
        for (std::uint32_t z = 0; z < grid_.n()[2]; ++z) {
            if (z != 0 && !advance(layer, 0, 0, z)) return false;
            Known row = layer;
            for (std::uint32_t y = 0; y < grid_.n()[1]; ++y) {
                if (y != 0 && !advance(row, 0, y, z)) return false;
                if (!sweep_row(row, y, z, first)) return false;
            }
        }
        return true;
    }
    [[nodiscard]] const std::vector<Known>& mixed() const { return mixed_; }

private:
    bool sweep_row(Known at, std::uint32_t y, std::uint32_t z, std::uint32_t first) {
        for (std::uint32_t x = 0; x < grid_.n()[0]; ++x) {
            if (x != 0 && !advance(at, x, y, z)) return false;
            const std::size_t c = grid_.number(x, y, z);
            if (grid_.items_in(c).empty()) {
                b_.t_.cells_[first + c] = at.winding > 0 ? IndexGrid::inside : IndexGrid::outside;
            } else {
                mixed_.push_back(at);
            }
        }
        return true;
    }
    bool advance(Known& from, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const std::size_t cell = grid_.number(x, y, z);
        const bool in_row = x != 0;  // the start of a row is the reference of the next one
        if (in_row && grid_.items_in(cell).empty() && grid_.items_in(from.cell).empty())
            return true;
        from = step(from, x, y, z);
        return from.valid;
    }
    // The first cell from the node's reference, over everything.
    Known first_cell(const State& s) {
        b_.items_ = all_;
        Known from;
        from.at = s.reference;
        from.winding = s.winding;
        return moved(from, 0, grid_.box_of(0, 0, 0));
    }
    // The reference of a cell, from the one of its neighbour.
    Known step(const Known& from, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const std::size_t cell = grid_.number(x, y, z);
        const auto mine = grid_.items_in(cell);
        const auto theirs = grid_.items_in(from.cell);
        b_.items_.clear();
        for (const std::uint32_t i : theirs) b_.items_.push_back(all_[i]);
        for (const std::uint32_t i : mine)
            if (std::find(theirs.begin(), theirs.end(), i) == theirs.end())
                b_.items_.push_back(all_[i]);
        return moved(from, cell, grid_.box_of(x, y, z));
    }
    // To the first of some places in a box that a trace over the builder's items reaches.
    Known moved(const Known& from, std::size_t cell, const FloatBox& box) const {
        Known to;
        to.cell = cell;
        for (std::size_t i = 0; i < parts.size() && !to.valid; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                to.at.c[k] =
                    b_.position(k, box.lo[k], box.hi[k], parts[(i + 2 * k) % parts.size()]);
            to.winding = from.winding;
            to.valid = b_.is_in(to.at, box) && b_.trace(0, from.at, to.at, to.winding);
        }
        return to;
    }

    IndexTreeBuilder& b_;
    const IndexGridLists& grid_;
    const std::vector<IndexItem>& all_;
    std::vector<Known> mixed_;
};

bool IndexTreeBuilder::make_grid(const State& s) {
    const std::array<double, 3> middle{this->middle(0), this->middle(1), this->middle(2)};
    const std::vector<IndexItem> all = std::move(items_);
    items_ = {};
    IndexGridLists grid(middle, s.cell, all, polygons_, grid_);
    const auto first = static_cast<std::uint32_t>(t_.cells_.size());
    const auto give_up = [&] {
        t_.cells_.resize(first);
        items_ = all;
        return false;
    };
    if (grid.cell_count() < 8) return give_up();
    grid.list();
    t_.cells_.resize(t_.cells_.size() + grid.cell_count());
    GridSweep sweep(*this, grid, all);
    if (!sweep.run(s, first)) return give_up();

    IndexGrid out;
    for (std::size_t k = 0; k < 3; ++k)
        out.origin[k] = middle[k] + static_cast<double>(grid.origin()[k]);
    out.size = static_cast<double>(grid.size());
    out.scale = 1 / out.size;
    out.n = grid.n();
    out.first = first;
    t_.nodes_[s.node].next = static_cast<std::uint32_t>(t_.grids_.size());
    t_.nodes_[s.node].flags = Node::leaf | Node::grid_flag;
    t_.grids_.push_back(out);
    for (const GridSweep::Known& known : sweep.mixed()) {
        const auto [x, y, z] = grid.place_of(known.cell);
        State cell;
        cell.cell = grid.box_of(x, y, z);
        cell.depth = s.depth + 1;
        cell.node = static_cast<std::uint32_t>(t_.nodes_.size());
        cell.reference = known.at;
        cell.winding = known.winding;
        t_.nodes_.emplace_back();
        t_.cells_[first + known.cell] = cell.node;
        items_.clear();
        for (const std::uint32_t i : grid.items_in(known.cell)) {
            IndexItem item = all[i];
            for (std::size_t k = 0; k < 3; ++k) {
                item.lo[k] = std::max(item.lo[k], cell.cell.lo[k]);
                item.hi[k] = std::min(item.hi[k], cell.cell.hi[k]);
            }
            items_.push_back(item);
        }
        subdivide(cell);
    }
    items_.clear();
    return true;
}

IndexTree::IndexTree(const SolidState& state, IndexPolygons& polygons) : nodes_(1) {
    IndexTreeBuilder(*this, polygons).build(state);
}

}  // namespace trisect::detail
