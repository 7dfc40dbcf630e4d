// SPDX-License-Identifier: Apache-2.0
//
// Facets are divided by boxes, down to cells with few of them, and compared there in doubles. Pairs
// that these leave open are decided by integers, as if the second mesh were moved by less than any
// number (shifted_pairs.cpp): edges that meet edges, corners on facets, edges in facets.

#include <trisect/bsp/two_meshes/pair_search.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/choose_splitting_plane.h>
#include <trisect/bsp/divide/partition.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

namespace {

class PairFinder;

// What the threads of one search share.
struct SharedSearch {
    const EvaluateSettings& options;
    const Crossings& operands;  // without pairs
    MemoryBudget& memory;
    bool parallel;
    bool recognises_equal;
    bool decides;                           // doubtful pairs
    std::atomic<bool> has_equal{false};     // all may stop
    std::atomic<bool> is_uncertain{false};  // none stops: else it would depend on which is first
    PerThread<PairFinder> finders = {};

    PairFinder& finder();
};

// Compares facets of two meshes, some of each.
class PairFinder {
public:
    explicit PairFinder(SharedSearch& search) : search_(search) {
        crossings_.operands = search.operands.operands;
    }

    void run(const std::array<const CellNode*, 2>& meshes, const TwoLists& facets) {
        CellTask task;
        Box all;
        for (const CellNode* m : meshes) all.add(m->polygons().whole_source()->box());
        task.frame = Frame::covering(all);
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
        solve(task);
    }
    [[nodiscard]] const Crossings& crossings() const { return crossings_; }
    [[nodiscard]] const EvaluateStats& stats() const { return stats_; }
    [[nodiscard]] const PairSearch::Outcome& directions() const { return directions_; }

private:
    [[nodiscard]] PackedBox* boxes_of(const LatticeMesh& mesh,
                                      std::span<const std::uint32_t> facets, Frame frame);
    void solve(CellTask& task);
    void divide(const CellTask& task, const SplittingPlane& splitter);
    void compare(const CellTask& task);
    void decide(LeafIndex first, LeafIndex second);
    void note_special(const PolygonRef& a, const PolygonRef& b);
    void look_at_plane(const FacetCorners& first, bool is_above, bool same_side);
    [[nodiscard]] bool leave_out(CellTask& task);
    void solve_both(std::array<CellTask, 2>& children);

    SharedSearch& search_;
    EvaluateStats stats_;
    Crossings crossings_;
    StackArena arena_;
    FilteredFacets facets_;
    FilteredPairs pairs_;
    FilteredPairs::Doubtful doubtful_;
    std::array<std::vector<std::uint8_t>, 2> is_special_;  // facets that are listed as such
    PairSearch::Outcome directions_;
    std::vector<PolygonRef> polygons_;
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

// Takes out what does not meet the box of the other mesh's facets; false when nothing is left.
bool PairFinder::leave_out(CellTask& task) {
    for (std::size_t i = 0; i < 2; ++i) {
        CellOperand& o = task.operands[i];
        const PackedBox& other = task.operands[1 - i].box;
        if (o.count == 0 || other.is_empty() || o.box.intersected(other).is_empty()) return false;
        if (other.contains(o.box)) continue;
        const PackedReach reach(other);
        auto* const entries = arena_.take<PackedBox>(o.count + 1);
        PackedBox* end = entries;
        for (const PackedBox& e : o.list()) {
            copy(e, end);
            end += reach.meets(e) ? 1 : 0;
        }
        o.entries = entries;
        o.count = static_cast<std::uint32_t>(end - entries);
        o.box = box_of(entries, o.count).intersected(packed_cell(task.frame, task.cell));
    }
    return std::ranges::none_of(task.operands, [](const CellOperand& o) { return o.count == 0; });
}

void PairFinder::solve(CellTask& task) {
    if (search_.has_equal.load(std::memory_order_relaxed)) return;
    const auto mark = arena_.mark();
    ++stats_.cells;
    check_budget(search_.options, stats_);
    stats_.depth = std::max(stats_.depth, task.depth);
    if (leave_out(task)) {
        stats_.listed_polygons += task.size();
        const bool large = task.size() > search_.options.leaf_polygons && task.stalled < 4;
        const auto splitter =
            large ? choose_splitting_plane(task, search_.options.splitting_offset) : std::nullopt;
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
    const std::uint64_t largest = std::max(children[0].size(), children[1].size());
    for (CellTask& c : children) c.stalled = 10 * largest > 9 * task.size() ? task.stalled + 1 : 0;
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
    pairs_.relate_all_but(doubtful_, facets_, stats_);
    pairs_.add_to(crossings_, facets_);
    if (!doubtful_.empty() && !search_.decides)
        search_.is_uncertain.store(true, std::memory_order_relaxed);
    for (const auto& [a, b] : doubtful_)
        if (search_.decides) decide(a, b);
}

// A pair that doubles leave open.
void PairFinder::decide(LeafIndex first, LeafIndex second) {
    const auto corners = [](const PolygonRef& ref) -> FacetCorners {
        const auto at = [&](int i) { return &ref.source->corner(ref.facet, i); };
        return {at(0), at(1), at(2)};
    };
    const PolygonRef& a = facets_[first].ref;
    const PolygonRef& b = facets_[second].ref;
    const InfinitesimalShift& shift = search_.operands.shift;
    const ShiftedPair pair = relate_shifted(corners(a), corners(b), shift);
    ++stats_.doubtful_pairs;
    if (pair.touches) note_special(a, b);
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
                look_at_plane(corners(a), shift.along(normal_signs(corners(a))) > 0,
                              pair.same_side);
            }
            break;
        case ShiftedPair::Kind::Coplanar: {
            const Overlap overlap = coplanar_overlap(corners(a), corners(b));
            if (overlap != Overlap::None) note_special(a, b);
            if (overlap == Overlap::Insides)
                look_at_plane(corners(a), pair.is_above, pair.same_side);
            break;
        }
    }
}

void PairFinder::note_special(const PolygonRef& a, const PolygonRef& b) {
    for (std::size_t i = 0; i < 2; ++i) {
        const PolygonRef& r = i == 0 ? a : b;
        if (is_special_[i].empty()) is_special_[i].resize(r.source->facet_count());
        if (std::exchange(is_special_[i][r.facet], std::uint8_t{1}) == 0)
            crossings_.special.push_back(crossings_.number_of(i, r.facet));
    }
}

// Two facets that cover a part of one plane. Moved to the side on which the first mesh leaves it
// open, the second one bounds nothing there: the first one stands for both, or the other mesh
// covers it as well. On the other side the second one stands for both, or there is a result, or
// none, of no thickness between them.
void PairFinder::look_at_plane(const FacetCorners& first, bool is_above, bool same_side) {
    const auto& operands = search_.operands.operands;
    const bool same_way = operands[0].inside_above == operands[1].inside_above;
    const bool wants_above = operands[0].is_open_below();
    std::array<int, 3> direction = normal_signs(first);
    if (!wants_above)
        for (int& d : direction) d = -d;
    const bool one_does = same_way == same_side;
    auto& list = one_does ? directions_.wished : directions_.wanted;
    if (std::ranges::find(list, direction) == list.end()) list.push_back(direction);
    bool& is_so = one_does ? directions_.is_as_wished : directions_.is_as_wanted;
    is_so = is_so && is_above == wants_above;
}

}  // namespace

PairSearch::Outcome PairSearch::run(Crossings& crossings, EvaluateStats& stats) const {
    Outcome out;
    SharedSearch search{options_, crossings, memory_, parallel_, recognises_equal, decides_};
    for (const TwoLists& lists : parts) {
        if (lists[0].empty() || lists[1].empty()) continue;
        search.finder().run(nodes_, lists);
        if (search.has_equal.load()) break;
    }
    out.has_equal = search.has_equal.load();
    out.is_certain = !search.is_uncertain.load();
    search.finders.for_each([&](const PairFinder& f) {
        if (!out.has_equal) crossings.append(f.crossings());
        stats += f.stats();
        const Outcome& found = f.directions();
        out.wanted.insert(out.wanted.end(), found.wanted.begin(), found.wanted.end());
        out.wished.insert(out.wished.end(), found.wished.begin(), found.wished.end());
        out.is_as_wanted = out.is_as_wanted && found.is_as_wanted;
        out.is_as_wished = out.is_as_wished && found.is_as_wished;
    });
    return out;
}

}  // namespace trisect::detail
