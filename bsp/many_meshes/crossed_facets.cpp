// SPDX-License-Identifier: Apache-2.0
//
// Both lists are divided by planes across the axes, down to few pairs, and compared there in
// doubles, what these leave open by integers. Facets that are long beside a cell are listed with
// the box of what lies in it, and not where that is nothing.

#include <trisect/bsp/many_meshes/crossed_facets.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <trisect/bsp/many_meshes/outlines/box_sum.h>
#include <trisect/bsp/many_meshes/outlines/small_map.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

// Pairs that are compared as they are, sixteen boxes at once; more, where facets are few.
constexpr std::uint64_t few_pairs = 16000;
constexpr std::uint64_t pairs_of_few = 160000;
constexpr std::size_t few_items = 800;
// What a splitting plane may leave of the pairs; once in a row it may leave more.
constexpr double worthy_part_of_pairs = 0.75;

// So many are listed by cells of a grid first, which are solved by themselves.
constexpr std::size_t least_in_grid = std::size_t{1} << 15;

// Of so many cells are solved on several threads, as soon as they have this part of them.
constexpr std::size_t least_items_in_parts = 4096;
constexpr std::size_t parts_of_many = 16;

constexpr std::array<std::size_t, 2> second_first{1, 0};

// How many there are of each kind, by the bits of each of them.
class CountsByAxis {
public:
    void add(unsigned bits) { counts_ += fields[bits & SingleBox::axes]; }
    void flush(std::array<std::size_t, 3>& to) {
        for (std::size_t k = 0; k < 3; ++k) to[k] += counts_ >> width * k & ((1U << width) - 1);
        counts_ = 0;
    }
    static constexpr std::size_t most = std::size_t{1} << 20;  // before they are flushed

private:
    static constexpr std::size_t width = 21;
    static constexpr std::uint64_t x = 1;
    static constexpr std::uint64_t y = x << width;
    static constexpr std::uint64_t z = y << width;
    static constexpr std::array<std::uint64_t, 8> fields{0, x,     y,     x + y,
                                                         z, x + z, y + z, x + y + z};
    std::uint64_t counts_ = 0;
};

// A triangle, cut by planes across the axes: in doubles, off by no more than its margin.
class CutTriangle {
public:
    explicit CutTriangle(const std::array<Vector3, 3>& corners) {
        for (const Vector3& c : corners) {
            points()[count_++] = c;
            for (const double v : c) margin_ = std::max(margin_, 0x1p-45 * std::fabs(v));
        }
    }
    void cut(std::size_t axis, double at, bool below) {
        const Points& from = points();
        current_ = 1 - current_;
        Points& out = points();
        std::size_t n = 0;
        const auto height = [&](const Vector3& p) { return below ? at - p[axis] : p[axis] - at; };
        for (std::size_t i = 0; i < count_; ++i) {
            const Vector3& p = from[i];
            const Vector3& q = from[i + 1 == count_ ? 0 : i + 1];
            const double a = height(p);
            const double b = height(q);
            if (a >= 0) out[n++] = p;
            if ((a >= 0) != (b >= 0)) {
                const double t = a / (a - b);
                for (std::size_t k = 0; k < 3; ++k) out[n][k] = p[k] + t * (q[k] - p[k]);
                ++n;
            }
        }
        count_ = n;
    }
    [[nodiscard]] double margin() const { return margin_; }
    [[nodiscard]] OutlineBox box() const {
        BoxSum b;
        for (std::size_t i = 0; i < count_; ++i)
            b.add(Approximation{buffers_[current_][i], margin_});
        return b.box();
    }

private:
    static constexpr std::size_t most = 10;
    using Points = std::array<Vector3, most>;
    [[nodiscard]] Points& points() { return buffers_[current_]; }
    std::array<Points, 2> buffers_;  // of which one is in use
    std::size_t current_ = 0;
    std::size_t count_ = 0;
    double margin_ = 0;
};

}  // namespace

bool CrossedFacetsFinder::find(const OutlinedSolid& first, const OutlinedSolid& second,
                               const Places& near, std::uint32_t threads, EvaluateStats& stats) {
    solids_ = {&first, &second};
    halves_ = {PartHalves(first), PartHalves(second)};
    stats_ = &stats;
    found_.resize(1);
    found_[0].clear();
    empty(known_);
    OutlineBox place = first.box;
    for (std::size_t k = 0; k < 3; ++k) {
        place.lo[k] = std::max(place.lo[k], second.box.lo[k]);
        place.hi[k] = std::min(place.hi[k], second.box.hi[k]);
    }
    place_ = SinglePlace(place.lo, place.hi);
    if (near[0].size() + near[1].size() >= least_in_grid) return find_in_cells(near);
    Cell cell;
    cell.bounds = SingleBox::everywhere();
    for (std::size_t i = 0; i < 2; ++i) {
        if (items_[i].size() < 2 * near[i].size()) items_[i].resize(2 * near[i].size());
        Item* next = items_[i].data();
        for (const std::uint32_t f : near[i]) next = list(i, f, next);
        cell.end[i] = static_cast<std::size_t>(next - items_[i].data());
    }
    return threads != 1 && cell.count() >= least_items_in_parts ? solve_in_parts(cell)
                                                                : solve(cell);
}

bool CrossedFacetsFinder::find_in_cells(const Places& near) {
    const PlacesInCells cells(solids_, near, place_);
    return find_on_threads(cells.cell_count(), [&](CrossedFacetsFinder& finder, std::size_t c) {
        return finder.solve_cell(cells, c);
    });
}

// Each part of the cells by a finder of its own, by solve(finder, cell); what is found is the same,
// in the same order.
template <class Solve>
bool CrossedFacetsFinder::find_on_threads(std::size_t count, const Solve& solve) {
    struct Part {
        Part(const ManyMeshes& meshes, const EvaluateSettings& options)
            : special(meshes.facet_count()), finder(meshes, options, special) {}
        SpecialPosition special;
        CrossedFacetsFinder finder;
        EvaluateStats stats;
        bool is_solved = true;
    };
    const ParallelParts ranges(count, options_.threads == 1 ? 1 : 0, 1);
    std::vector<std::unique_ptr<Part>> parts(ranges.count());
    ranges.for_each([&](std::size_t range, std::size_t begin, std::size_t end) {
        parts[range] = std::make_unique<Part>(meshes_, options_);
        Part& part = *parts[range];
        part.finder.solids_ = solids_;
        part.finder.halves_ = halves_;
        part.finder.place_ = place_;
        part.finder.stats_ = &part.stats;
        part.finder.is_of_many_ = true;
        for (std::size_t c = begin; c < end && part.is_solved; ++c)
            part.is_solved = solve(part.finder, c);
        part.finder.items_ = {};
    });
    bool is_solved = true;
    for (auto& p : parts) {
        is_solved = is_solved && p->is_solved;
        *stats_ += p->stats;
        take_from(p->finder);
        p.reset();
    }
    return is_solved;
}

// One item, or one for each half. Returns what comes behind.
auto CrossedFacetsFinder::list(std::size_t solid, std::uint32_t place, Item* next) const -> Item* {
    const OutlineBox& box = solids_[solid]->boxes[place];
    const auto halves = halves_[solid].of(solids_[solid]->facets[place], box);
    if (!halves) {
        *next = Item(place_.box(box.lo, box.hi), place);
        return next + 1;
    }
    for (const OutlineBox& b : *halves) {
        *next = Item(place_.box(b.lo, b.hi), place);
        next++->set_half();
    }
    return next;
}

bool CrossedFacetsFinder::solve_cell(const PlacesInCells& cells, std::size_t number) {
    Cell cell;
    cell.bounds = cells.bounds(number);
    for (std::size_t i = 0; i < 2; ++i) {
        const auto entries = cells.of(i, number);
        if (items_[i].size() < 2 * entries.size()) items_[i].resize(2 * entries.size());
        Item* next = items_[i].data();
        for (const PlacesInCells::Entry& e : entries) {
            Item* const end = list(i, e.place(), next);
            for (; next != end; ++next) next->set_shared(e.is_shared());
        }
        cell.end[i] = static_cast<std::size_t>(next - items_[i].data());
    }
    return solve(cell);
}

// What comes behind all of this. Pairs that were found before go from their list.
void CrossedFacetsFinder::take_from(CrossedFacetsFinder& other) {
    position_.add(other.position_);
    Pairs& pairs = other.found_[0];
    std::size_t kept = 0;
    auto many = other.many_cells_.begin();
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
        const CrossedFacets& c = pairs[i];
        const bool may_be_known = many != other.many_cells_.end() && *many == i;
        if (may_be_known) ++many;
        if (may_be_known && !known_.insert({c.places[0], c.places[1]}, 0).second) continue;
        if (kept != i) pairs[kept] = c;
        ++kept;
    }
    pairs.resize(kept);
    found_.push_back(std::move(pairs));
}

std::size_t CrossedFacetsFinder::pair_count() const {
    std::size_t count = 0;
    for (const Pairs& pairs : found_) count += pairs.size();
    return count;
}

bool CrossedFacetsFinder::solve(Cell& cell) { return !begin(cell) || solve_begun(cell); }

// False where nothing is to be done.
bool CrossedFacetsFinder::begin(Cell& cell) {
    ++stats_->cells;
    check_budget(options_, *stats_);
    return leave_out(cell);
}

bool CrossedFacetsFinder::are_few(const Cell& cell) const {
    return cell.pair_count() <= (cell.count() <= few_items ? pairs_of_few : few_pairs);
}

bool CrossedFacetsFinder::solve_begun(Cell& cell) {
    if (are_few(cell)) return compare(cell);
    const Splitter splitter = splitter_of(cell);
    const bool stalls = splitter.part_left > worthy_part_of_pairs;
    if (stalls && cell.stalled) return compare(cell);
    cell.stalled = stalls;
    return with_enough_stack([&] { return divide(cell, splitter); });
}

// The same cells in the same order, some of them at the same time.
bool CrossedFacetsFinder::solve_in_parts(Cell& cell) {
    std::vector<CellOfItems> parts;
    list_parts(cell, cell.count() / parts_of_many, parts);
    return find_on_threads(parts.size(), [&](CrossedFacetsFinder& finder, std::size_t number) {
        CellOfItems& part = parts[number];
        finder.items_ = std::move(part.items);
        return finder.solve_begun(part.cell);
    });
}

// Divides it down to cells of so many, which have begun.
void CrossedFacetsFinder::list_parts(Cell& cell, std::size_t most, std::vector<CellOfItems>& out) {
    if (!begin(cell)) return;
    if (cell.count() > most && !are_few(cell)) {
        const Splitter splitter = splitter_of(cell);
        const bool stalls = splitter.part_left > worthy_part_of_pairs;
        if (!stalls || !cell.stalled) {
            cell.stalled = stalls;
            auto [below, above] = halves_of(cell, splitter);
            list_parts(below, most, out);
            list_parts(above, most, out);
            return;
        }
    }
    CellOfItems& part = out.emplace_back();
    part.cell = cell;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto items = items_of(cell, i);
        part.items[i].assign(items.begin(), items.end());
        part.cell.first[i] = 0;
        part.cell.end[i] = items.size();
    }
}

// Takes out what does not meet the other ones' boxes in the cell; false when nothing is left.
bool CrossedFacetsFinder::leave_out(Cell& cell) {
    for (std::size_t i = 0; i < 2; ++i) {
        SingleBox reach = box_of(items_of(cell, 1 - i));
        reach.cut(cell.bounds);
        // What they have as the fourth number is nothing here.
        reach.lo[3] = reach.down[3] = 0;
        cell.reach = reach;
        cell.end[i] = cell.first[i] + leave_out(i, items_of(cell, i), reach);
        if (cell.count(i) == 0) return false;
    }
    return true;
}

// Of those that are left, which come first, how many. Without a branch for nearly all.
std::size_t CrossedFacetsFinder::leave_out(std::size_t solid, std::span<Item> items,
                                           const SingleBox& reach) const {
    const FourFloats zero(0);
    const FourFloats lo(reach.lo);
    const FourFloats down(reach.down);
    const FourFloats hi = zero - down;
    const FourFloats minus_lo = zero - lo;
    const FourFloats extent = hi - lo;
    std::size_t left = 0;
    for (const Item& listed : items) {
        const Item item = listed;
        const FourFloats item_lo(item.box().lo);
        const FourFloats item_down(item.box().down);
        const bool is_apart =
            ((greater(item_lo, hi) | greater(item_down, minus_lo)) & SingleBox::axes) != 0;
        const bool is_within =
            ((greater(lo, item_lo) | greater(down, item_down)) & SingleBox::axes) == 0;
        // Long beside the reach along two axes.
        const unsigned along =
            greater(FourFloats(-2) * (item_lo + item_down), extent) & SingleBox::axes;
        items[left] = item;
        if (!is_apart && !is_within && (along & (along - 1)) != 0) {
            draw_in(solid, items[left], reach);
            if (!items[left].box().meets(reach)) continue;
        }
        left += is_apart ? 0 : 1;
    }
    return left;
}

void CrossedFacetsFinder::draw_in(std::size_t solid, Item& item, const SingleBox& reach) const {
    const OutlinedSolid::Facet& f = solids_[solid]->facets[item.place()];
    CutTriangle part(meshes_.corners(f.slot, f.number - meshes_.operands->operands[f.slot].first));
    for (std::size_t k = 0; k < 3; ++k) {
        if (item.box().lo[k] < reach.lo[k])
            part.cut(k, place_.lower(reach, k) - part.margin(), false);
        if (item.box().hi(k) > reach.hi(k))
            part.cut(k, place_.upper(reach, k) + part.margin(), true);
    }
    const OutlineBox box = part.box();
    item.cut(place_.box(box.lo, box.hi));
}

// In the middle, across the axis that leaves the fewest pairs.
CrossedFacetsFinder::Splitter CrossedFacetsFinder::splitter_of(const Cell& cell) const {
    SingleBox all = box_of(items_of(cell, 0));
    all.add(box_of(items_of(cell, 1)));
    all.cut(cell.bounds);
    alignas(16) SingleBox::Four at{};
    for (std::size_t k = 0; k < 3; ++k) at[k] = all.lo[k] + (all.hi(k) - all.lo[k]) / 2;
    const FourFloats middle(at);
    const FourFloats minus_middle = FourFloats(0) - middle;
    std::array<double, 3> below{1, 1, 1};
    std::array<double, 3> above{1, 1, 1};
    for (std::size_t i = 0; i < 2; ++i) {
        std::array<std::size_t, 3> begin_below{};
        std::array<std::size_t, 3> end_below{};
        const std::span<const Item> items = items_of(cell, i);
        for (std::size_t first = 0; first < items.size(); first += CountsByAxis::most) {
            CountsByAxis begins;
            CountsByAxis ends;
            const std::size_t count = std::min(CountsByAxis::most, items.size() - first);
            for (const Item& item : items.subspan(first, count)) {
                begins.add(greater(middle, FourFloats(item.box().lo)));
                ends.add(greater(FourFloats(item.box().down), minus_middle));
            }
            begins.flush(begin_below);
            ends.flush(end_below);
        }
        const auto part = [&](std::size_t n) {
            return static_cast<double>(n) / static_cast<double>(items.size());
        };
        for (std::size_t k = 0; k < 3; ++k) {
            below[k] *= part(begin_below[k]);
            above[k] *= part(items.size() - end_below[k]);
        }
    }
    Splitter best{0, at[0], 2};
    for (std::size_t k = 0; k < 3; ++k)
        if (below[k] + above[k] < best.part_left) best = {k, at[k], below[k] + above[k]};
    return best;
}

bool CrossedFacetsFinder::divide(const Cell& cell, const Splitter& splitter) {
    auto [below, above] = halves_of(cell, splitter);
    return solve(below) && solve(above);
}

auto CrossedFacetsFinder::halves_of(const Cell& cell, const Splitter& splitter)
    -> std::array<Cell, 2> {
    Cell below;
    below.bounds = cell.bounds;
    below.stalled = cell.stalled;
    Cell above = below;
    below.bounds.down[splitter.axis] = -splitter.at;
    above.bounds.lo[splitter.axis] = splitter.at;
    for (std::size_t i = 0; i < 2; ++i) take_halves(i, below, above, cell, splitter);
    return {below, above};
}

// Behind all others; those above come first, since they stay while what is below is solved. Without
// a branch.
void CrossedFacetsFinder::take_halves(std::size_t solid, Cell& below, Cell& above, const Cell& cell,
                                      const Splitter& splitter) {
    const auto [axis, at, part_left] = splitter;
    PoolVector<Item>& all = items_[solid];
    const std::size_t count = cell.count(solid);
    const std::size_t room = cell.end[solid] + 2 * count;
    if (all.size() < room) all.resize(std::max(room, all.size() + all.size() / 2));
    above.first[solid] = cell.end[solid];
    below.first[solid] = cell.end[solid] + count;
    Item* next_above = all.data() + above.first[solid];
    Item* next_below = all.data() + below.first[solid];
    for (const Item& listed : items_of(cell, solid)) {
        const bool is_below = listed.box().lo[axis] < at;
        const bool is_above = listed.box().hi(axis) >= at;
        *next_above = listed;
        next_above->set_shared(is_below && is_above);
        *next_below = listed;
        next_below->set_shared(is_below && is_above);
        next_above += is_above ? 1 : 0;
        next_below += is_below ? 1 : 0;
    }
    above.end[solid] = static_cast<std::size_t>(next_above - all.data());
    below.end[solid] = static_cast<std::size_t>(next_below - all.data());
}

bool CrossedFacetsFinder::compare(const Cell& cell) {
    ++stats_->mixed_leaves;
    ++stats_->filtered_leaves;
    stats_->listed_polygons += cell.count();
    const SingleBox& some = items_[0][cell.first[0]].box();
    pairs_.start(cell.count(),
                 {place_.lower(some, 0), place_.lower(some, 1), place_.lower(some, 2)}, cell.reach);
    for (const std::size_t i : second_first) {
        for (const Item& item : items_of(cell, i)) {
            const OutlinedSolid::Facet& f = solids_[i]->facets[item.place()];
            pairs_.add(f.slot, f.number, item.box());
        }
        if (i == 1) pairs_.end_second();
    }
    leave_out_planes(cell);
    if (!pairs_.find()) return false;
    stats_->pairs_boxes += pairs_.box_pairs();
    stats_->pairs_touching += pairs_.crossings().size();
    stats_->pairs_cutting += pairs_.crossings().size();
    for (const WholeFacetPairs::Crossing& c : pairs_.crossings())
        keep(pair_of(cell, c.places), c.ends);
    decide(cell);
    return true;
}

// Facets of one plane do not cross, and what they touch is found for all of them together.
void CrossedFacetsFinder::leave_out_planes(const Cell& cell) {
    planes_.clear();
    for (const std::size_t i : second_first) {
        in_planes_[i].clear();
        for (const Item& item : items_of(cell, i)) {
            const OutlinedSolid::Facet& f = solids_[i]->facets[item.place()];
            const std::uint32_t plane = special_.plane_across_axis(f.number);
            planes_.push_back(plane);
            if (plane != 0) in_planes_[i].push_back({plane, f.number, f.slot, item.box()});
        }
        std::ranges::stable_sort(in_planes_[i], {}, &SpecialPairs::InCell::plane);
    }
    if (in_planes_[0].empty() || in_planes_[1].empty()) return;
    special_.look_at_planes(in_planes_[0], in_planes_[1]);
    pairs_.leave_out_planes(planes_);
}

void CrossedFacetsFinder::decide(const Cell& cell) {
    for (const WholeFacetPairs::Places& places : pairs_.doubtful()) {
        ++stats_->doubtful_pairs;
        const Pair pair = pair_of(cell, places);
        const auto crossing = special_.crossing(solids_[0]->facets[pair[0].place()].number,
                                                solids_[1]->facets[pair[1].place()].number);
        if (!crossing) continue;
        ++stats_->pairs_touching;
        ++stats_->pairs_cutting;
        keep(pair, crossing->ends);
    }
}

// Whether a crossing meets the boxes of both items.
bool CrossedFacetsFinder::meets(const Pair& pair,
                                const std::array<FacetCrossing::End, 2>& ends) const {
    BoxSum sum;
    for (const FacetCrossing::End& end : ends) sum.add(end.at);
    const OutlineBox box = sum.box();
    const SingleBox single = place_.box(box.lo, box.hi);
    return pair[0].box().meets(single) && pair[1].box().meets(single);
}

// A pair may be listed in several cells, but not where one of them is in one alone. Of two parts
// the whole facets may cross somewhere else.
void CrossedFacetsFinder::keep(const Pair& pair, const std::array<FacetCrossing::End, 2>& ends) {
    const std::array places{pair[0].place(), pair[1].place()};
    const std::array facets{&solids_[0]->facets[places[0]], &solids_[1]->facets[places[1]]};
    if (!facets[0]->whole || !facets[1]->whole) {
        BoxSum box;
        for (const FacetCrossing::End& end : ends) box.add(end.at);
        const BoxProbe probe(box.box());
        for (std::size_t i = 0; i < 2; ++i)
            if (!facets[i]->whole && !probe.meets(solids_[i]->boxes[places[i]])) return;
    }
    const bool is_of_half = pair[0].is_half() || pair[1].is_half();
    if (is_of_half && !meets(pair, ends)) return;
    if (is_of_half || (pair[0].is_shared() && pair[1].is_shared())) {
        if (!known_.insert({places[0], places[1]}, 0).second) return;
        if (is_of_many_) many_cells_.push_back(static_cast<std::uint32_t>(found_[0].size()));
    }
    CrossedFacets& made = found_[0].emplace_back();
    made.places = places;
    made.crossing.ends = ends;
    for (std::size_t k = 0; k < 2; ++k) made.crossing.facets[k] = facets[k]->number;
}

}  // namespace trisect::detail
