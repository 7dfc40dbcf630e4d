// SPDX-License-Identifier: Apache-2.0
//
// Facets are divided by boxes, down to cells with few of them, and compared there in doubles. Pairs
// that these leave open are decided by integers, as if the second mesh were moved by less than any
// number (shifted_pairs.cpp): edges that meet edges, corners on facets, edges in facets.

#include <trisect/bsp/two_meshes/pair_search.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <optional>
#include <utility>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/choose_splitting_plane.h>
#include <trisect/bsp/divide/partition.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/bsp/leaf/doubles/part_near_plane.h>
#include <trisect/bsp/two_meshes/axis_plane_pairs.h>
#include <trisect/bsp/two_meshes/corner_pairs.h>
#include <trisect/bsp/two_meshes/facet_clip.h>
#include <trisect/bsp/two_meshes/shift_along.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

namespace {

class PairFinder;

bool has_long_facets_of(const CellOperand& o);
bool has_planes_of(const CellOperand& o);

// Cells are larger than leaves of a tree: boxes are compared four at a time, and a facet is listed
// anew in each cell that it is in.
constexpr std::size_t cell_factor = 2;

constexpr std::uint64_t many_pairs = 20'000;
constexpr std::uint64_t many_pairs_of_plane = 100;

// Of all pairs of facets of one plane about one in so many has a part of it in common.
constexpr std::uint64_t pairs_of_sheet = 16;

// What the threads of one search share.
struct SharedSearch {
    const EvaluateSettings& options;
    const Crossings& operands;  // without pairs
    MemoryBudget& memory;
    bool parallel;
    bool recognises_equal;
    std::uint64_t most_sheets;
    const PairsCheck* check;
    Frame frame;
    std::array<FacetClip, 2> clips;
    bool has_long_facets = false;           // set by the finder that begins
    bool has_planes = false;                // both lists have facets across an axis; set likewise
    std::atomic<bool> has_equal{false};     // all may stop
    std::atomic<bool> is_hopeless{false};   // all may stop as well
    std::atomic<std::uint64_t> sheets{0};   // pairs that count for `most_sheets`
    std::atomic<bool> is_uncertain{false};  // none stops: else it would depend on which is first
    PerThread<PairFinder> finders = {};

    PairFinder& finder();
    // What is not as wanted ends it, since no other move of the kind is tried.
    [[nodiscard]] bool is_final() const {
        return operands.shift.moves != nullptr || operands.shift.growth != 0;
    }
    [[nodiscard]] bool may_stop() const {
        return has_equal.load(std::memory_order_relaxed) ||
               is_hopeless.load(std::memory_order_relaxed);
    }
};

// Compares facets of two meshes, some of each.
class PairFinder {
public:
    explicit PairFinder(SharedSearch& search) : search_(search) {
        crossings_.operands = search.operands.operands;
    }

    void run(const std::array<const CellNode*, 2>& meshes, const TwoLists& facets) {
        CellTask task;
        task.frame = search_.frame;
        task.has_frame = true;
        std::array<CellOperand, 2> operands;
        const auto held =
            search_.memory.hold((facets[0].size() + facets[1].size()) * sizeof(PackedBox));
        for (std::size_t i = 0; i < 2; ++i) {
            CellOperand& o = operands[i];
            o.slot = static_cast<std::int32_t>(i);
            o.embedded = o.is_list = true;
            o.node = meshes[i];
            o.count = static_cast<std::uint32_t>(facets[i].size());
            o.entries =
                boxes_of(meshes[i]->polygons().whole_source()->mesh(), facets[i], task.frame);
            o.box = box_of(o.entries, o.count);
        }
        task.operands = operands;
        search_.has_long_facets = std::ranges::any_of(
            operands, [](const CellOperand& o) { return has_long_facets_of(o); });
        search_.has_planes =
            std::ranges::all_of(operands, [](const CellOperand& o) { return has_planes_of(o); });
        solve(task);
    }
    [[nodiscard]] Crossings take_crossings() { return std::move(crossings_); }
    [[nodiscard]] const EvaluateStats& stats() const { return stats_; }
    [[nodiscard]] const PairSearch::Outcome& directions() const { return directions_; }

private:
    [[nodiscard]] PackedBox* boxes_of(const LatticeMesh& mesh,
                                      std::span<const std::uint32_t> facets, Frame frame);
    void solve(CellTask& task);
    void divide(const CellTask& task, const SplittingPlane& splitter);
    void compare(const CellTask& task);
    void draw_in_boxes(const CellTask& task);
    void leave_out_planes();
    [[nodiscard]] bool settle_plane_of(std::span<const std::uint64_t> all);
    [[nodiscard]] bool may_have_equal(std::span<const std::uint64_t> all) const;
    [[nodiscard]] const FilteredFacet& item_of(std::uint64_t e) const {
        return facets_[static_cast<LeafIndex>(static_cast<std::uint32_t>(e))];
    }
    void decide(LeafIndex first, LeafIndex second, const Cell& cell);
    [[nodiscard]] bool has_corner(const Cell& cell, const FilteredFacet& f, std::size_t i) const;
    [[nodiscard]] ShiftedPair relate(LeafIndex first, LeafIndex second,
                                     const CommonCorners& common);
    [[nodiscard]] bool is_special(std::size_t operand, const PolygonRef& facet) const {
        const std::vector<std::uint8_t>& marks = is_special_[operand];
        return !marks.empty() && marks[facet.facet] != 0;
    }
    void note_special(std::size_t operand, const PolygonRef& facet);
    void note_special(const PolygonRef& a, const PolygonRef& b) {
        note_special(0, a);
        note_special(1, b);
    }
    void give_up() { search_.is_hopeless.store(true, std::memory_order_relaxed); }
    void look_at_plane(const PolygonRef& first, bool is_above, bool same_side);
    void count_sheets(bool is_above, bool same_side, std::uint64_t pairs);
    // Of facets in one plane, that face the same way or not: whether just one of the two meshes
    // bounds the result there.
    [[nodiscard]] bool does_one_bound(bool same_side) const {
        const auto& o = search_.operands.operands;
        return (o[0].inside_above == o[1].inside_above) == same_side;
    }
    [[nodiscard]] bool wants_above() const { return search_.operands.operands[0].is_open_below(); }
    [[nodiscard]] bool is_pair_known(const PolygonRef& first, const ShiftedPair& pair) const;
    [[nodiscard]] bool leave_out(CellTask& task);
    void solve_both(std::array<CellTask, 2>& children);
    [[nodiscard]] bool settle_plane(const CellTask& task);
    [[nodiscard]] std::optional<int> side_of_all(const PolygonRef& first,
                                                 std::span<const PolygonRef> second) const;
    [[nodiscard]] bool settle_side(std::span<const PolygonRef> first,
                                   std::span<const PolygonRef> second, bool same_side);
    [[nodiscard]] bool is_known(const std::array<int, 3>& normal, bool same_side) const {
        return std::ranges::find(known_planes_, std::pair(normal, same_side)) !=
               known_planes_.end();
    }

    SharedSearch& search_;
    EvaluateStats stats_;
    Crossings crossings_;
    StackArena arena_;
    FilteredFacets facets_;
    FilteredPairs pairs_;
    FilteredPairs::Doubtful doubtful_;
    std::array<std::vector<std::uint8_t>, 2> is_special_;  // facets that are listed as such
    PairSearch::Outcome directions_;
    // Of planes in which two facets cover a part: the signs of the first one's normal, and whether
    // the second one faces the same way. A second pair with these says nothing new.
    std::vector<std::pair<std::array<int, 3>, bool>> known_planes_;
    std::vector<PolygonRef> polygons_;
    // Of the cell that is looked at:
    std::vector<std::uint32_t> planes_;     // across axes, by item; 0 where there is none
    std::vector<std::uint64_t> in_planes_;  // those that are not 0, and items
};

PairFinder& SharedSearch::finder() {
    return finders.local([&] { return std::make_unique<PairFinder>(*this); });
}

PackedBox* PairFinder::boxes_of(const LatticeMesh& mesh, std::span<const std::uint32_t> facets,
                                Frame frame) {
    auto* const entries = arena_.take<PackedBox>(facets.size());
    PackedBox* out = entries;
    for (const std::uint32_t f : facets) {
        const auto& t = mesh.triangles[f];
        *out = box_of_three(packed_point(frame, mesh.points[t[0]]),
                            packed_point(frame, mesh.points[t[1]]),
                            packed_point(frame, mesh.points[t[2]]));
        out++->id = f;
    }
    return entries;
}

// Of facets that reach out of a box, those that are long beside it.
struct LongFacets {
    PackedBox within;
    std::array<int, 3> length{};

    explicit LongFacets(const PackedBox& box) : within(box) {
        for (std::size_t k = 0; k < 3; ++k) length[k] = (box.high(k) - box.low(k)) / long_part;
    }
    [[nodiscard]] bool has(const PackedBox& e) const {
        int along = 0;
        for (std::size_t k = 0; k < 3; ++k) along += e.high(k) - e.low(k) > length[k] ? 1 : 0;
        return along > 1 && !within.contains(e);
    }
    static constexpr int long_part = 3;
};

// Copies what meets the reach, of long facets what of them lies within; returns the end.
PackedBox* clip_to(const CellOperand& o, const LongFacets& long_facets, const FacetClip& clip,
                   const PackedReach& reach, PackedBox* end) {
    for (const PackedBox& e : o.list()) {
        if (!reach.meets(e)) continue;
        if (long_facets.has(e)) {
            *end = clip.clipped(e.id, e.intersected(long_facets.within));
            end += end->is_empty() ? 0 : 1;
        } else {
            copy(e, end++);
        }
    }
    return end;
}

// Whether more than a few of a list are longer than an eighth of all of it, by a sample.
bool has_long_facets_of(const CellOperand& o) {
    constexpr std::uint32_t sample = 256;
    const auto length = [](const PackedBox& b) {
        return std::max({b.high(0) - b.low(0), b.high(1) - b.low(1), b.high(2) - b.low(2)});
    };
    const int limit = length(o.box) / 8;
    const std::uint32_t step = std::max(o.count / sample, 1U);
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < o.count; i += step)
        found += length(o.entries[i]) > limit ? step : 0;
    return 64 * std::uint64_t{found} > o.count;
}

std::uint64_t pairs_of(const CellTask& task) {
    return std::uint64_t{task.operands[0].count} * task.operands[1].count;
}

// What part of the pairs is left on both sides of a splitting plane, by a sample of either list.
double part_left(const CellTask& task, const SplittingPlane& splitter) {
    constexpr std::uint32_t sample = 32;
    const auto axis = static_cast<std::size_t>(splitter.axis);
    const int q = task.frame.at(axis, splitter.last_below() + 1);
    double below = 1;
    double above = 1;
    for (const CellOperand& o : task.operands) {
        const std::uint32_t step = std::max(o.count / sample, 1U);
        std::array<int, 3> counts{};
        for (std::uint32_t i = 0; i < o.count; i += step) {
            counts[0] += o.entries[i].low(axis) < q ? 1 : 0;
            counts[1] += o.entries[i].high(axis) >= q ? 1 : 0;
            ++counts[2];
        }
        below *= static_cast<double>(counts[0]) / counts[2];
        above *= static_cast<double>(counts[1]) / counts[2];
    }
    return below + above;
}

// The usual one, unless facets lie along its axis: a plane across another axis parts them, and one
// that they cross makes two cells of as many pairs.
std::optional<SplittingPlane> splitter_of(const CellTask& task, std::int64_t offset,
                                          bool has_long_facets) {
    constexpr double useful = 0.7;
    auto best = choose_splitting_plane(task, offset);
    if (!best || !has_long_facets) return best;
    double least = part_left(task, *best);
    if (least < useful) return best;
    const PackedBox both = task.operands[0].box.intersected(task.operands[1].box);
    for (std::size_t k = 0; k < 3; ++k) {
        const int extent = both.high(k) - both.low(k);
        if (extent <= 0) continue;
        const int middle = both.low(k) + (extent + 1) / 2;
        const SplittingPlane other{static_cast<int>(k),
                                   task.frame.last_below(k, middle) * splitting_scale + offset};
        const double left = part_left(task, other);
        if (left >= least) continue;
        least = left;
        best = other;
    }
    return best;
}

// Takes out what does not meet the box of the other mesh's facets; false when nothing is left.
bool PairFinder::leave_out(CellTask& task) {
    for (std::size_t i = 0; i < 2; ++i) {
        CellOperand& o = task.operands[i];
        const PackedBox& other = task.operands[1 - i].box;
        if (o.count == 0 || other.is_empty() || o.box.intersected(other).is_empty()) return false;
        if (other.contains(search_.has_long_facets ? box_of(o.entries, o.count) : o.box)) continue;
        const PackedReach reach(other);
        auto* const entries = arena_.take<PackedBox>(o.count + 1);
        PackedBox* end = entries;
        if (search_.has_long_facets) {
            end = clip_to(o, LongFacets(o.box.intersected(other)), search_.clips[i], reach, end);
        } else {
            for (const PackedBox& e : o.list()) {
                copy(e, end);
                end += reach.meets(e) ? 1 : 0;
            }
        }
        o.entries = entries;
        o.count = static_cast<std::uint32_t>(end - entries);
        o.box = box_of(entries, o.count).intersected(packed_cell(task.frame, task.cell));
    }
    return std::ranges::none_of(task.operands, [](const CellOperand& o) { return o.count == 0; });
}

void PairFinder::solve(CellTask& task) {
    if (search_.may_stop()) return;
    const auto mark = arena_.mark();
    ++stats_.cells;
    check_budget(search_.options, stats_);
    stats_.depth = std::max(stats_.depth, task.depth);
    if (leave_out(task) && (search_.check != nullptr || !settle_plane(task))) {
        stats_.listed_polygons += task.size();
        const std::size_t factor = search_.check != nullptr ? 1 : cell_factor;
        const bool large = task.size() > factor * search_.options.leaf_polygons &&
                           task.stalled < (pairs_of(task) > many_pairs ? 16 : 4);
        const auto splitter =
            large ? splitter_of(task, search_.options.splitting_offset, search_.has_long_facets)
                  : std::nullopt;
        if (splitter) {
            divide(task, *splitter);
        } else {
            compare(task);
        }
    }
    arena_.release(mark);
}

void PairFinder::divide(const CellTask& task, const SplittingPlane& splitter) {
    std::array<CellTask, 2> children;
    for (std::size_t i = 0; i < 2; ++i) {
        CellTask& c = children[i];
        c.cell = i == 0 ? task.cell.below(splitter.axis, splitter.position)
                        : task.cell.above(splitter.axis, splitter.position);
        c.frame = task.frame;
        c.has_frame = true;
        c.depth = task.depth + 1;
        c.operands = {arena_.take<CellOperand>(2), 2};
        for (std::size_t n = 0; n < 2; ++n) ::new (&c.operands[n]) CellOperand(task.operands[n]);
    }
    partition(task, splitter, {children[0].cell, children[1].cell}, arena_, 1,
              {children[0].operands, children[1].operands});
    const auto held =
        search_.memory.hold((children[0].size() + children[1].size()) * sizeof(PackedBox));
    const std::uint64_t left = pairs_of(children[0]) + pairs_of(children[1]);
    const bool stalls = 10 * left > 9 * pairs_of(task);
    for (CellTask& c : children) c.stalled = stalls ? task.stalled + 1 : 0;
    solve_both(children);
}

// The lists of both lie in the arena of this thread, which waits for the other one.
void PairFinder::solve_both(std::array<CellTask, 2>& children) {
    if (search_.parallel && std::min(children[0].size(), children[1].size()) >= parallel_facets) {
        both_at_once([&] { search_.finder().solve(children[1]); },
                     [&] { with_enough_stack([&] { solve(children[0]); }); });
    } else {
        for (CellTask& c : children) with_enough_stack([&] { solve(c); });
    }
}

void PairFinder::compare(const CellTask& task) {
    if (search_.check != nullptr) {
        if (!(*search_.check)(task.operands[0].list(), task.operands[1].list())) give_up();
        return;
    }
    polygons_.clear();
    for (const CellOperand& o : task.operands)
        for (const PackedBox& e : o.list()) polygons_.push_back(o.polygon(e.id));
    std::array<LeafOperand, 2> operands;
    std::size_t first = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const CellOperand& o = task.operands[i];
        operands[i] = {o.slot, std::span(polygons_).subspan(first, o.count), false, true, 0};
        first += o.count;
    }
    FinePoint near;
    const PolygonRef& any = polygons_.front();
    const LatticePoint& corner = any.source->corner(any.facet, 0);
    for (std::size_t k = 0; k < 3; ++k)
        near.c[k] = position_of(corner[static_cast<int>(k)]) * splitting_scale;
    ++stats_.mixed_leaves;
    ++stats_.filtered_leaves;
    const LeafProblem problem{task.cell, near, operands, nullptr, &search_.options};
    if (!facets_.list(problem)) {
        search_.is_uncertain.store(true, std::memory_order_relaxed);
        return;
    }
    if (search_.has_long_facets) draw_in_boxes(task);
    leave_out_planes();
    pairs_.relate_all_but(doubtful_, facets_, stats_);
    pairs_.add_to(crossings_, facets_);
    for (const auto& [a, b] : doubtful_) decide(a, b, task.cell);
}

FacetCorners corners_of(const PolygonRef& ref) {
    const auto at = [&](int i) { return &ref.source->corner(ref.facet, i); };
    return {at(0), at(1), at(2)};
}

// Which axis a facet is across; else 3.
int axis_across(const PolygonRef& ref) {
    const FacetCorners c = corners_of(ref);
    int axis = 0;
    while (axis < 3 && ((*c[0])[axis] != (*c[1])[axis] || (*c[0])[axis] != (*c[2])[axis])) ++axis;
    return axis;
}

// Whether some of a list are across an axis, by a sample.
bool has_planes_of(const CellOperand& o) {
    constexpr std::uint32_t sample = 256;
    const std::uint32_t step = std::max(o.count / sample, 1U);
    for (std::uint32_t i = 0; i < o.count; i += step)
        if (axis_across(o.polygon(o.entries[i].id)) < 3) return true;
    return false;
}

// The plane of a facet, to ask others about: without arithmetic where it is across an axis.
class PlaneOfFacet {
public:
    explicit PlaneOfFacet(const PolygonRef& ref)
        : axis_(axis_across(ref)), plane_(ref.source->support(ref.facet)) {
        if (axis_ < 3) at_ = ref.source->corner(ref.facet, 0)[axis_];
    }
    [[nodiscard]] bool has(const PolygonRef& ref) const {
        for (int i = 0; i < 3; ++i) {
            const LatticePoint& p = ref.source->corner(ref.facet, i);
            if (axis_ < 3 ? p[axis_] != at_ : sign_of(side_of(p, plane_)) != 0) return false;
        }
        return true;
    }

private:
    int axis_;
    Coordinate at_;
    Plane plane_;
};

// All facets of two lists in one plane.
class FacetsOfPlane {
public:
    // False where some are not in the plane of the first one.
    [[nodiscard]] bool list(const CellTask& task) {
        const CellOperand& first = task.operands[0];
        const CellOperand& second = task.operands[1];
        const PolygonRef any = first.polygon(first.entries[0].id);
        const PlaneOfFacet plane(any);
        const auto is_in_plane = [&](const PolygonRef& r) { return plane.has(r); };
        // The last ones before all others: they are of another plane most often.
        for (const CellOperand* o : {&second, &first})
            if (!is_in_plane(o->polygon(o->entries[o->count - 1].id))) return false;
        normal_ = normal_signs(corners_of(any));
        for (std::size_t i = 0; i < 2; ++i)
            for (const PackedBox& e : task.operands[i].list()) {
                const PolygonRef r = task.operands[i].polygon(e.id);
                if (!is_in_plane(r)) return false;
                facets_[i][normal_signs(corners_of(r)) == normal_ ? 0 : 1].push_back(r);
            }
        return true;
    }
    // Those of an operand that face as the first one does, or the other way.
    [[nodiscard]] std::span<const PolygonRef> facing(std::size_t operand, std::size_t way) const {
        return facets_[operand][way];
    }

private:
    std::array<int, 3> normal_{};
    std::array<std::array<std::vector<PolygonRef>, 2>, 2> facets_;
};

// In a cell in which all facets lie in one plane none cross. All are as good as special, and of the
// plane no more is to be known than whether some cover a part of it together; so the pairs are not
// compared, which may all have a part in common where long facets cover a face in two ways.
bool PairFinder::settle_plane(const CellTask& task) {
    if (pairs_of(task) < many_pairs_of_plane) return false;
    FacetsOfPlane plane;
    if (!plane.list(task)) return false;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            if (!settle_side(plane.facing(0, i), plane.facing(1, j), i == j)) return false;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t way = 0; way < 2; ++way)
            for (const PolygonRef& r : plane.facing(i, way)) note_special(i, r);
    return true;
}

// On which side of a facet others of its plane go; nothing where they do not go to one.
std::optional<int> PairFinder::side_of_all(const PolygonRef& first,
                                           std::span<const PolygonRef> second) const {
    const InfinitesimalShift& shift = search_.operands.shift;
    const FacetCorners corners = corners_of(first);
    const int side = side_of_shifted(corners, corners_of(second[0]), shift);
    const auto is_same = [&](const PolygonRef& r) {
        return side_of_shifted(corners, corners_of(r), shift) == side;
    };
    if (side == 0 || (shift.moves != nullptr && !std::ranges::all_of(second.subspan(1), is_same)))
        return std::nullopt;
    return side;
}

// Looks for two that cover a part of the plane. False where there are none among many. It does not
// ask what is known: that depends on which cells a thread has come to.
bool PairFinder::settle_side(std::span<const PolygonRef> first, std::span<const PolygonRef> second,
                             bool same_side) {
    if (first.empty() || second.empty()) return true;
    const auto side = side_of_all(first[0], second);
    if (!side) return false;
    const bool is_above = *side > 0;
    std::size_t tries = 16 * (first.size() + second.size());
    for (const PolygonRef& a : first)
        for (const PolygonRef& b : second) {
            if (tries-- == 0) return false;
            if (coplanar_overlap(corners_of(a), corners_of(b)) != Overlap::Insides) continue;
            count_sheets(is_above, same_side, 1 + first.size() * second.size() / pairs_of_sheet);
            look_at_plane(a, is_above, same_side);
            return true;
        }
    return false;
}

// Pairs of facets of one plane across an axis, where both meshes have enough of them.
void PairFinder::leave_out_planes() {
    pairs_.leave_out_planes({});
    if (!search_.has_planes) return;
    in_planes_.clear();
    std::array<std::size_t, 2> counts{};
    for (LeafIndex i = 0; i < facets_.size(); ++i) {
        const FilteredFacet& f = facets_[i];
        if (f.lo[0] != f.hi[0] && f.lo[1] != f.hi[1] && f.lo[2] != f.hi[2]) continue;
        ++counts[as_index(f.operand)];
        in_planes_.push_back(static_cast<std::uint32_t>(i));
    }
    if (counts[0] * counts[1] < many_pairs_of_plane) return;
    planes_.assign(as_index(facets_.size()), 0);
    FlatMap numbers;
    for (std::uint64_t& e : in_planes_) {
        const PolygonRef& ref = item_of(e).ref;
        const int axis = axis_across(ref);
        if (axis == 3) continue;
        const double at = ref.source->corner(ref.facet, 0)[axis].to_double();
        const Key128 key{std::bit_cast<std::uint64_t>(at), static_cast<std::uint64_t>(axis)};
        const auto next = static_cast<std::int32_t>(numbers.size());
        const auto number = static_cast<std::uint32_t>(numbers.insert(key, next).first) + 1;
        planes_[e] = number;
        e |= std::uint64_t{number} << 32;
    }
    std::erase_if(in_planes_, [](std::uint64_t e) { return e >> 32 == 0; });
    std::ranges::sort(in_planes_);
    bool are_some = false;
    for (std::span<const std::uint64_t> left(in_planes_); !left.empty();) {
        std::size_t n = 1;
        while (n < left.size() && left[n] >> 32 == left[0] >> 32) ++n;
        const bool is_settled = settle_plane_of(left.first(n));
        are_some = are_some || is_settled;
        for (const std::uint64_t e : left.first(n))
            if (!is_settled) planes_[static_cast<std::uint32_t>(e)] = 0;
        left = left.subspan(n);
    }
    if (are_some) pairs_.leave_out_planes(planes_);
}

// Whether facets of both have the same box, or hashes as if they had.
bool PairFinder::may_have_equal(std::span<const std::uint64_t> all) const {
    FlatMap of_first;
    for (const LeafIndex operand : {0, 1})
        for (const std::uint64_t e : all) {
            const FilteredFacet& f = item_of(e);
            if (f.operand != operand) continue;
            Key128 key;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [low, high] =
                    std::minmax({f.corners[0][k], f.corners[1][k], f.corners[2][k]});
                key.a = mix64(key.a ^ std::bit_cast<std::uint64_t>(low));
                key.b = mix64(key.b ^ std::bit_cast<std::uint64_t>(high));
            }
            if (operand == 0) of_first.insert(key, 0);
            if (operand == 1 && of_first.find(key) >= 0) return true;
        }
    return false;
}

bool PairFinder::settle_plane_of(std::span<const std::uint64_t> all) {
    std::array<std::array<std::vector<PolygonRef>, 2>, 2> facing;  // by mesh and way
    std::array<std::size_t, 2> counts{};
    for (const std::uint64_t e : all) ++counts[as_index(item_of(e).operand)];
    if (counts[0] * counts[1] < many_pairs_of_plane) return false;
    if (search_.recognises_equal && may_have_equal(all)) return false;
    const std::array<int, 3> normal = normal_signs(corners_of(item_of(all[0]).ref));
    for (const std::uint64_t e : all) {
        const FilteredFacet& f = item_of(e);
        const std::size_t way = normal_signs(corners_of(f.ref)) == normal ? 0 : 1;
        facing[as_index(f.operand)][way].push_back(f.ref);
    }
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            if (!settle_side(facing[0][i], facing[1][j], i == j)) return false;
    for (const std::uint64_t e : all) note_special(as_index(item_of(e).operand), item_of(e).ref);
    return true;
}

// To those of the list, which are of what of long facets lies near the other mesh's.
void PairFinder::draw_in_boxes(const CellTask& task) {
    const Frame& frame = task.frame;
    LeafIndex item = 0;
    Vector3 origin;
    for (std::size_t k = 0; k < 3; ++k) origin[k] = static_cast<double>(frame.origin[k]);
    origin = facets_.from_lattice({origin, 0.0}).c;
    const double unit = std::ldexp(1.0, frame.shift);
    for (const CellOperand& o : task.operands)
        for (const PackedBox& e : o.list()) {
            FilteredFacet& f = facets_[item++];
            for (std::size_t k = 0; k < 3; ++k) {
                f.lo[k] = std::max(f.lo[k], origin[k] + unit * (e.low(k) - 1));
                f.hi[k] = std::min(f.hi[k], origin[k] + unit * (e.high(k) + 2));
            }
        }
}

// Whether a corner lies in the cell that is looked at.
bool PairFinder::has_corner(const Cell& cell, const FilteredFacet& f, std::size_t i) const {
    return facets_.is_whole()
               ? facets_.in_cell(f.corners[i])
               : cell.contains(Box::of(f.ref.source->corner(f.ref.facet, static_cast<int>(i))));
}

ShiftedPair PairFinder::relate(LeafIndex first, LeafIndex second, const CommonCorners& common) {
    const InfinitesimalShift& shift = search_.operands.shift;
    const PolygonRef& a = facets_[first].ref;
    const PolygonRef& b = facets_[second].ref;
    if (common.count < 3)
        if (const auto known = relate_across_axis(corners_of(a), corners_of(b), shift))
            return *known;
    if (shift.moves != nullptr)
        if (const auto known = relate_at_corners(facets_, first, second, common, shift))
            return *known;
    return relate_shifted(corners_of(a), corners_of(b), shift);
}

// A pair that doubles leave open. Both facets are listed in the cell of a common corner, so others
// leave them to that.
void PairFinder::decide(LeafIndex first, LeafIndex second, const Cell& cell) {
    const CommonCorners common(facets_[first], facets_[second]);
    if (common.count > 0 && !has_corner(cell, facets_[first], common.any())) return;
    if (common.count == 0 &&
        are_apart_near_planes({facets_[first].corners, facets_.plane(first)},
                              {facets_[second].corners, facets_.plane(second)}))
        return;
    const PolygonRef& a = facets_[first].ref;
    const PolygonRef& b = facets_[second].ref;
    const ShiftedPair pair = relate(first, second, common);
    ++stats_.doubtful_pairs;
    if (pair.touches) note_special(a, b);
    if (pair.is_torn && coplanar_overlap(corners_of(a), corners_of(b)) == Overlap::Insides)
        give_up();
    switch (pair.kind) {
        case ShiftedPair::Kind::Apart:
            break;
        case ShiftedPair::Kind::Crossing:
            ++stats_.pairs_touching;
            ++stats_.pairs_cutting;
            crossings_.pairs.push_back(
                {{crossings_.number_of(0, a.facet), crossings_.number_of(1, b.facet)}, pair.ends});
            break;
        case ShiftedPair::Kind::Equal:
            if (search_.recognises_equal) {
                search_.has_equal.store(true, std::memory_order_relaxed);
            } else {
                note_special(a, b);
                look_at_plane(a, pair.is_above, pair.same_side);
            }
            break;
        case ShiftedPair::Kind::Coplanar: {
            count_sheets(pair.is_above, pair.same_side, 1);
            if (is_special(0, a) && is_special(1, b) && is_pair_known(a, pair)) break;
            const Overlap overlap = coplanar_overlap(corners_of(a), corners_of(b));
            if (overlap != Overlap::None) note_special(a, b);
            if (overlap == Overlap::Insides) look_at_plane(a, pair.is_above, pair.same_side);
            break;
        }
    }
}

void PairFinder::note_special(std::size_t operand, const PolygonRef& facet) {
    std::vector<std::uint8_t>& marks = is_special_[operand];
    if (marks.empty()) marks.resize(facet.source->facet_count());
    if (std::exchange(marks[facet.facet], std::uint8_t{1}) == 0)
        crossings_.special.push_back(crossings_.number_of(operand, facet.facet));
}

// Two facets that cover a part of one plane. Moved to the side on which the first mesh leaves it
// open, the second one bounds nothing there: the first one stands for both, or the other mesh
// covers it as well. On the other side the second one stands for both, or there is a result, or
// none, of no thickness between them.
void PairFinder::look_at_plane(const PolygonRef& first, bool is_above, bool same_side) {
    const bool is_so_now = is_above == wants_above();
    const bool one_does = does_one_bound(same_side);
    if (search_.is_final()) {
        directions_.has_wish = directions_.has_wish || one_does;
        if (one_does || is_so_now) return;
        directions_.has_sheets = true;
        if (search_.most_sheets == 0) give_up();
        return;
    }
    bool& is_so = one_does ? directions_.is_as_wished : directions_.is_as_wanted;
    is_so = is_so && is_so_now;
    std::array<int, 3> direction = normal_signs(corners_of(first));
    if (!is_known(direction, same_side)) known_planes_.emplace_back(direction, same_side);
    if (!wants_above())
        for (int& d : direction) d = -d;
    auto& list = one_does ? directions_.wished : directions_.wanted;
    if (std::ranges::find(list, direction) != list.end()) return;
    list.push_back(direction);
    if (!one_does && !shift_along(list)) give_up();
}

// Each in every cell that has it, whatever is known: so all threads together count the same.
void PairFinder::count_sheets(bool is_above, bool same_side, std::uint64_t pairs) {
    if (search_.most_sheets == 0 || does_one_bound(same_side) || is_above == wants_above()) return;
    if (search_.sheets.fetch_add(pairs, std::memory_order_relaxed) + pairs > search_.most_sheets)
        give_up();
}

// Whether another pair of one plane says nothing new.
bool PairFinder::is_pair_known(const PolygonRef& first, const ShiftedPair& pair) const {
    if (search_.is_final()) {
        if (does_one_bound(pair.same_side)) return directions_.has_wish;
        return pair.is_above == wants_above() || directions_.has_sheets;
    }
    return is_known(normal_signs(corners_of(first)), pair.same_side);
}

}  // namespace

PairSearch::Outcome PairSearch::run(Crossings& crossings, EvaluateStats& stats) const {
    Outcome out;
    const auto source = [&](std::size_t i) -> const Source& {
        return *nodes_[i]->polygons().whole_source();
    };
    Box all = source(0).box();
    all.add(source(1).box());
    const Frame frame = Frame::covering(all);
    SharedSearch search{options_,
                        crossings,
                        memory_,
                        parallel_,
                        recognises_equal,
                        most_sheets,
                        check,
                        frame,
                        {FacetClip(frame, source(0).mesh()), FacetClip(frame, source(1).mesh())}};
    for (const TwoLists& lists : parts) {
        if (lists[0].empty() || lists[1].empty()) continue;
        search.finder().run(nodes_, lists);
        if (search.may_stop()) break;
    }
    out.has_equal = search.has_equal.load();
    out.is_hopeless = search.is_hopeless.load();
    out.is_certain = !search.is_uncertain.load();
    search.finders.for_each([&](PairFinder& f) {
        if (!out.has_equal) crossings.append(f.take_crossings());
        stats += f.stats();
        const Outcome& found = f.directions();
        out.wanted.insert(out.wanted.end(), found.wanted.begin(), found.wanted.end());
        out.wished.insert(out.wished.end(), found.wished.begin(), found.wished.end());
        out.is_as_wanted = out.is_as_wanted && found.is_as_wanted;
        out.is_as_wished = out.is_as_wished && found.is_as_wished;
        out.has_wish = out.has_wish || found.has_wish;
        out.has_sheets = out.has_sheets || found.has_sheets;
    });
    return out;
}

}  // namespace trisect::detail
