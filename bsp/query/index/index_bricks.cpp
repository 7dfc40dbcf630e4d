// SPDX-License-Identifier: Apache-2.0
//
// Building is a matter of memory: polygons of a cell are brought into its coordinates once, and all
// that follows, planes, lists of 64 cells, winding numbers at their 125 corners, happens in the
// first cache. A recursive halving of lists would touch every polygon once a level.
//
// A cell lists polygons whose box and plane meet it, enlarged a little: by what its outermost cells
// reach beyond the grid, and by 2^-10 so that a ray that is followed in doubles is never in a cell
// that does not list what it hits.
//
// The winding number of points above all planes of a cell is that of a corner above all of them:
// the region is convex and free of polygons. Most cells of a smooth surface have such a corner on
// either side.

#include <trisect/bsp/query/index/index_bricks.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <trisect/bsp/query/index/triangle_in_boxes.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

constexpr double listing_margin = 0x1p-10;

// Of a polygon in the bricks below one cell of the grid. Facets of most meshes need two to three;
// each level has four times as many where thin ones lie side by side, and lists shorter by a half.
constexpr double most_copies = 4;

// Grids of so few are divided whatever it takes.
constexpr std::size_t few_polygons = 4096;

IndexBrickBuilder::Low sum(const IndexBrickBuilder::Low& low, std::uint32_t x, std::uint32_t y,
                           std::uint32_t z, unsigned shift) {
    return {low[0] + (x << shift), low[1] + (y << shift), low[2] + (z << shift)};
}

}  // namespace

IndexBrickBuilder::IndexBrickBuilder(const IndexPolygons& polygons, IndexCells& cells,
                                     const IndexGrid& grid, double margin, bool open)
    : polygons_(polygons), cells_(cells), grid_(grid), margin_(margin), open_(open) {
    work_.resize(static_cast<std::size_t>(grid.levels) + 1);
}

void IndexBrickBuilder::gather_triangle(BlockItem& item, Coefficients& plane,
                                        const IndexBlock& block, const Vector& scale) const {
    item.is_triangle = true;
    item.lo.fill(HUGE_VAL);
    item.hi.fill(-HUGE_VAL);
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& c = polygons_.corner(item.id, i);
        const Vector p{(c.x.to_double() - block.origin[0]) * scale[0],
                       (c.y.to_double() - block.origin[1]) * scale[1],
                       (c.z.to_double() - block.origin[2]) * scale[2]};
        for (std::size_t k = 0; k < 3; ++k) {
            item.lo[k] = std::min(item.lo[k], p[k]);
            item.hi[k] = std::max(item.hi[k], p[k]);
        }
        item.corner[static_cast<std::size_t>(i)] = p;
    }
    const auto& [a, b, c] = item.corner;
    const Vector u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Vector v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    // Corners are within 2^-50 M, M their largest coordinate; with L the largest one of the edges
    // the normal is within 2^-46 L M and the offset within 2^-43 L M^2.
    const double size = largest_component(n);
    const double m = std::max({4.0, largest_component(item.lo), largest_component(item.hi)});
    const double l = std::max(largest_component(u), largest_component(v));
    plane = {};
    if (!(0x1p-43 * l * m * m <= 0x1p-22 * size)) return;
    const double f = 1 / size;
    plane = {n[0] * f, n[1] * f, n[2] * f, -(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) * f};
}

void IndexBrickBuilder::gather_other(BlockItem& item, Coefficients& plane, const IndexBlock& block,
                                     const Vector& scale) const {
    item.is_triangle = false;
    plane = {};
    if (polygons_.is_unbounded(item.id)) {
        item.lo.fill(-0x1p40);
        item.hi.fill(0x1p40);
        return;
    }
    const DoubleBox box = polygons_.bounds(item.id);
    const Plane support = polygons_.support(item.id);
    double offset = support.approx_offset();
    double terms = std::fabs(offset);
    Vector n{};
    for (std::size_t k = 0; k < 3; ++k) {
        item.lo[k] = (box.lo[k] - block.origin[k]) * scale[k];
        item.hi[k] = (box.hi[k] - block.origin[k]) * scale[k];
        n[k] = support.approx_normal(static_cast<int>(k)) * block.size[k];
        const double t = support.approx_normal(static_cast<int>(k)) * block.origin[k];
        offset += t;
        terms += std::fabs(t);
    }
    const double size = largest_component(n);
    if (!(0x1p-48 * terms <= 0x1p-22 * size)) return;
    plane = {n[0] / size, n[1] / size, n[2] / size, offset / size};
}

void IndexBrickBuilder::gather(Work& w, const IndexBlock& block, std::span<const Id> ids) const {
    w.items.resize(ids.size());
    w.planes.resize(ids.size());
    const Vector scale{1 / block.size[0], 1 / block.size[1], 1 / block.size[2]};
    for (std::size_t k = 0; k < 3; ++k) w.margin[k] = listing_margin + margin_ * scale[k];
    for (std::size_t i = 0; i < ids.size(); ++i) {
        w.items[i].id = ids[i];
        if (polygons_.is_triangle(ids[i])) {
            gather_triangle(w.items[i], w.planes[i], block, scale);
        } else {
            gather_other(w.items[i], w.planes[i], block, scale);
        }
        if (polygons_.is_flipped(ids[i]))
            for (double& x : w.planes[i]) x = -x;
    }
}

// The cells of a brick that a polygon may meet, a bit each.
std::uint64_t IndexBrickBuilder::cells_of(const Work& w, std::size_t item) const {
    const BlockItem& t = w.items[item];
    std::array<std::uint32_t, 3> lo{};
    std::array<std::uint32_t, 3> hi{};
    std::uint32_t count = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double l = t.lo[k] - w.margin[k];
        const double h = t.hi[k] + w.margin[k];
        if (h < 0 || l >= 4) return 0;
        lo[k] = l > 0 ? static_cast<std::uint32_t>(l) : 0;
        hi[k] = h < 4 ? static_cast<std::uint32_t>(h) : 3;
        count *= hi[k] - lo[k] + 1;
    }
    if (count == 1) return std::uint64_t{1} << IndexBrick::bit(lo[0], lo[1], lo[2]);
    const Coefficients& p = w.planes[item];
    double reach = 0x1p-16;
    for (std::size_t k = 0; k < 3; ++k) reach += std::fabs(p[k]) * (0.5 + w.margin[k]);
    const double middle = p[3] + 0.5 * (p[0] + p[1] + p[2]);
    std::uint64_t mask = 0;
    for (std::uint32_t z = lo[2]; z <= hi[2]; ++z)
        for (std::uint32_t y = lo[1]; y <= hi[1]; ++y) {
            double at = middle + p[2] * z + p[1] * y + p[0] * lo[0];
            for (std::uint32_t x = lo[0]; x <= hi[0]; ++x, at += p[0])
                if (at <= reach && at >= -reach)
                    mask |= std::uint64_t{1} << IndexBrick::bit(x, y, z);
        }
    if (count <= 4 || !t.is_triangle) return mask;
    // The box and the plane of a long triangle say little.
    const TriangleInBoxes triangle(t.corner);
    const double half = 0.5 + std::max({w.margin[0], w.margin[1], w.margin[2]});
    for (std::uint64_t left = mask; left != 0; left &= left - 1) {
        const auto bit = static_cast<unsigned>(std::countr_zero(left));
        const Vector at{(bit & 3U) + 0.5, ((bit >> 2U) & 3U) + 0.5, (bit >> 4U) + 0.5};
        if (!triangle.may_meet(at, half)) mask &= ~(std::uint64_t{1} << bit);
    }
    return mask;
}

std::size_t IndexBrickBuilder::limit(int level) const {
    return leaf_polygons << static_cast<unsigned>(grid_.levels - level);
}

void IndexBrickBuilder::sort_into_cells(Work& w) const {
    w.begin.fill(0);
    w.masks.resize(w.items.size());
    for (std::size_t i = 0; i < w.items.size(); ++i) {
        w.masks[i] = cells_of(w, i);
        for (std::uint64_t left = w.masks[i]; left != 0; left &= left - 1)
            ++w.begin[static_cast<std::size_t>(std::countr_zero(left)) + 1];
    }
    for (std::size_t c = 0; c < 64; ++c) w.begin[c + 1] += w.begin[c];
    w.listed.resize(w.begin[64]);
    std::array<std::uint32_t, 65> next = w.begin;
    for (std::size_t i = 0; i < w.items.size(); ++i)
        for (std::uint64_t left = w.masks[i]; left != 0; left &= left - 1)
            w.listed[next[static_cast<std::size_t>(std::countr_zero(left))]++] =
                static_cast<std::uint32_t>(i);
}

// Whether a point near the surface finds a list that is shorter by a third.
bool IndexBrickBuilder::is_worth_it(const Work& w) const {
    double squares = 0;
    for (std::size_t c = 0; c < 64; ++c) {
        const double n = w.begin[c + 1] - w.begin[c];
        squares += n * n;
    }
    const auto whole = static_cast<double>(w.items.size());
    // Short lists are good enough where long polygons would be listed again and again.
    if (whole <= LeafPlanes::most && w.begin[64] > 2.5 * whole) return false;
    if (polygons_.size() > few_polygons && copies_ * w.begin[64] > most_copies * whole)
        return false;
    return squares <= 0.66 * whole * static_cast<double>(w.begin[64]);
}

bool IndexBrickBuilder::sweep(Work& w, const IndexBlock& block, std::int32_t winding) const {
    w.windings.reset(block.origin, block.size, {block.n[0] + 1, block.n[1] + 1, block.n[2] + 1});
    for (const BlockItem& item : w.items)
        if (!w.windings.add(item)) return false;
    w.windings.finish(winding);
    return true;
}

// Those that are not on a far side of a grid beyond which polygons go on.
std::uint8_t IndexBrickBuilder::known_corners(const Low& low, int level) const {
    unsigned known = 0xff;
    constexpr std::array<unsigned, 3> far{0xaa, 0xcc, 0xf0};
    if (!open_) return static_cast<std::uint8_t>(known);
    for (std::size_t k = 0; k < 3; ++k)
        if (low[k] + (1U << (2 * static_cast<unsigned>(level))) == grid_.n[k] << grid_.shift())
            known &= ~far[k];
    return static_cast<std::uint8_t>(known);
}

std::uint32_t IndexBrickBuilder::make_leaf(Work& w, std::span<const std::uint32_t> items,
                                           const Low& cell, std::uint8_t known) {
    IndexLeaf leaf;
    leaf.known = known;
    leaf.winding = w.windings.at(cell[0], cell[1], cell[2]);
    for (std::uint32_t c = 0; c < 8; ++c)
        if (w.windings.at(cell[0] + (c & 1U), cell[1] + (c >> 1U & 1U), cell[2] + (c >> 2U)) > 0)
            leaf.inside = static_cast<std::uint8_t>(leaf.inside | 1U << c);

    // Planes that miss the cell are left out; of the others the sides of the corners.
    const std::size_t most = items.size();
    w.leaf_items.resize(most);
    w.rows.resize(4 * most);
    float* const rows = w.rows.data();
    std::uint32_t n = 0;
    constexpr float e = LeafPlanes::unsure;
    const Float4 up = {e, e, e, e};
    const Float4 down = -up;
    Mask4 above0 = {-1, -1, -1, -1};
    Mask4 above1 = above0;
    Mask4 below0 = above0;
    Mask4 below1 = above0;
    for (const std::uint32_t i : items) {
        const Coefficients& p = w.planes[i];
        const double offset = p[3] + p[0] * cell[0] + p[1] * cell[1] + p[2] * cell[2];
        double lowest = offset - 0x1p-16;
        double highest = offset + 0x1p-16;
        for (std::size_t k = 0; k < 3; ++k) {
            const double slack = std::fabs(p[k]) * w.margin[k];
            lowest += std::min(p[k], 0.0) - slack;
            highest += std::max(p[k], 0.0) + slack;
        }
        if (lowest > 0 || highest < 0) continue;
        const auto a = static_cast<float>(p[0]);
        const auto b = static_cast<float>(p[1]);
        const auto c = static_cast<float>(p[2]);
        const auto d = static_cast<float>(offset);
        const Float4 low = {d, d + a, d + b, d + a + b};
        const Float4 high = low + c;
        above0 &= low > up;
        above1 &= high > up;
        below0 &= low < down;
        below1 &= high < down;
        w.leaf_items[n] = i;
        rows[n] = a;
        rows[most + n] = b;
        rows[2 * most + n] = c;
        rows[3 * most + n] = d;
        ++n;
    }
    if (n == 0) return leaf.winding > 0 ? IndexSlot::inside : IndexSlot::outside;
    for (std::uint32_t c = 0; c < 8; ++c) {
        if ((known >> c & 1U) == 0) continue;
        const auto inside = static_cast<std::uint8_t>(leaf.inside >> c & 1U);
        const auto lane = c & 3U;
        if ((c < 4 ? above0[lane] : above1[lane]) != 0) leaf.above = inside;
        if ((c < 4 ? below0[lane] : below1[lane]) != 0) leaf.below = inside;
    }
    leaf.count = n;
    leaf.first = cells_.listed.append(n);
    for (std::uint32_t i = 0; i < n; ++i)
        cells_.listed[leaf.first + i] = w.items[w.leaf_items[i]].id;
    // Where there are fewer than four planes the first one is repeated.
    const std::uint32_t stride = LeafPlanes::stride_of(n);
    const bool has_corners = has_room_for_corners(n);
    leaf.planes =
        cells_.planes.append(std::size_t{4} * stride + (has_corners ? LeafCorners::floats(n) : 0));
    float* out = &cells_.planes[leaf.planes];
    for (std::uint32_t row = 0; row < 4; ++row, out += stride) {
        std::copy_n(rows + row * most, n, out);
        for (std::uint32_t i = n; i < stride; ++i) out[i] = out[0];
    }
    if (has_corners) leaf.step = write_corners(w, n, cell, out);
    const std::uint32_t number = cells_.leaves.append(1);
    cells_.leaves[number] = leaf;
    return number;
}

// Corners make traces twice as fast, so they may take what is left of the room; where long
// triangles are listed in many cells that is less than what all leaves would need.
bool IndexBrickBuilder::has_room_for_corners(std::uint32_t count) const {
    const std::size_t taken = cells_.planes.bytes() + cells_.listed.bytes() + cells_.leaves.bytes();
    const std::size_t wanted = sizeof(float) * LeafCorners::floats(count);
    return static_cast<double>(taken + wanted) <= cells_.room;
}

// The corners of a leaf's triangles, after its planes; returns their step.
float IndexBrickBuilder::write_corners(const Work& w, std::uint32_t count, const Low& cell,
                                       float* out) {
    const auto from_middle = [&](const Vector& p, std::size_t k) {
        return p[k] - static_cast<double>(cell[k]) - 0.5;
    };
    const auto reach_of = [&](const BlockItem& t) {
        double r = t.is_triangle ? 0 : HUGE_VAL;
        for (std::size_t k = 0; k < 3; ++k)
            r = std::max({r, -from_middle(t.lo, k), from_middle(t.hi, k)});
        return r;
    };
    double reach = 0.75;  // of query points
    for (std::uint32_t i = 0; i < count; ++i)
        if (const double r = reach_of(w.items[w.leaf_items[i]]); r < LeafCorners::farthest)
            reach = std::max(reach, r);
    const auto step = static_cast<float>(reach / LeafCorners::most_steps);
    const double scale = 1 / static_cast<double>(step);
    std::fill_n(out, LeafCorners::floats(count), 0.F);
    auto* to = reinterpret_cast<unsigned char*>(out);
    for (std::uint32_t i = 0; i < count; ++i) {
        const BlockItem& t = w.items[w.leaf_items[i]];
        const bool fits = reach_of(t) < LeafCorners::farthest;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t c = 0; c < 3; ++c, to += 2) {
                if (!fits) continue;
                // Rounded by a shift into what is positive; no call of a library.
                const double v = from_middle(t.corner[c], k) * scale + 0x1p16 + 0.5;
                const auto number =
                    static_cast<std::int16_t>(static_cast<std::int32_t>(v) - 0x10000);
                std::memcpy(to, &number, sizeof number);
            }
    }
    return step;
}

// A leaf without planes.
std::uint32_t IndexBrickBuilder::make_list(std::span<const Id> ids, std::int32_t winding) {
    IndexLeaf leaf;
    leaf.winding = winding;
    leaf.count = static_cast<std::uint32_t>(ids.size());
    leaf.first = cells_.listed.append(ids.size());
    std::copy_n(ids.data(), ids.size(), &cells_.listed[leaf.first]);
    const std::uint32_t number = cells_.leaves.append(1);
    cells_.leaves[number] = leaf;
    return number;
}

// A cell that is not divided: a block of one.
std::uint32_t IndexBrickBuilder::make_alone(Work& w, const Low& low, int level,
                                            std::span<const Id> ids, std::int32_t winding) {
    IndexBlock block = grid_.brick(low, level + 1);
    block.n = {1, 1, 1};
    gather(w, block, ids);
    if (!sweep(w, block, winding)) return make_list(ids, winding);
    w.listed.resize(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) w.listed[i] = static_cast<std::uint32_t>(i);
    return make_leaf(w, w.listed, {0, 0, 0}, known_corners(low, level));
}

std::uint32_t IndexBrickBuilder::make_cells(Work& w, const Low& low, int level) {
    IndexBrick brick;
    for (unsigned bit = 0; bit < 64; ++bit) {
        if (w.begin[bit + 1] != w.begin[bit]) {
            brick.mixed |= std::uint64_t{1} << bit;
        } else if (w.windings.at(bit & 3U, bit >> 2U & 3U, bit >> 4U) > 0) {
            brick.inside |= std::uint64_t{1} << bit;
        }
    }
    brick.first = cells_.slots.append(static_cast<std::size_t>(std::popcount(brick.mixed)));
    const unsigned shift = 2U * static_cast<unsigned>(level - 1);
    std::uint32_t at = brick.first;
    for (std::uint64_t left = brick.mixed; left != 0; left &= left - 1) {
        const auto bit = static_cast<unsigned>(std::countr_zero(left));
        const Low cell{bit & 3U, bit >> 2U & 3U, bit >> 4U};
        const Low place = sum(low, cell[0], cell[1], cell[2], shift);
        const auto items =
            std::span(w.listed).subspan(w.begin[bit], w.begin[bit + 1] - w.begin[bit]);
        std::uint32_t made = 0;
        if (items.size() > limit(level - 1) && level > 1) {
            w.ids.clear();
            for (const std::uint32_t i : items) w.ids.push_back(w.items[i].id);
            made = make(place, level - 1, w.ids, w.windings.at(cell[0], cell[1], cell[2]));
        } else {
            made = make_leaf(w, items, cell, known_corners(place, level - 1));
        }
        cells_.slots[at++] = made;
    }
    const std::uint32_t number = cells_.bricks.append(1);
    cells_.bricks[number] = brick;
    return number | IndexSlot::brick_flag;
}

std::uint32_t IndexBrickBuilder::make(const Low& low, int level, std::span<const Id> ids,
                                      std::int32_t winding) {
    std::unique_ptr<Work>& work = work_[static_cast<std::size_t>(level)];
    if (work == nullptr) work = std::make_unique<Work>(polygons_);
    Work& w = *work;
    depth_ = std::max(depth_, static_cast<std::size_t>(grid_.levels - level));
    if (ids.size() <= limit(level) || level == 0) return make_alone(w, low, level, ids, winding);
    const IndexBlock block = grid_.brick(low, level);
    gather(w, block, ids);
    sort_into_cells(w);
    if (!is_worth_it(w)) return make_alone(w, low, level, ids, winding);
    if (!sweep(w, block, winding)) return make_list(ids, winding);
    const double copies = copies_;
    copies_ *= static_cast<double>(w.begin[64]) / static_cast<double>(ids.size());
    const std::uint32_t made = make_cells(w, low, level);
    copies_ = copies;
    return made;
}

}  // namespace trisect::detail
