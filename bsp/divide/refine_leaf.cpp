// SPDX-License-Identifier: Apache-2.0
//
// A leaf is halved several times at once. What a visit of a facet costs is looking its corners up,
// and a leaf that is halved because a small tool came to it is mostly halved again at once, around
// the tool. So boxes are packed once (packed_box.h), and lists of those are divided for some levels
// before they become leaves. Between rounded positions of the frame a comparison of packed boxes is
// exact.
//
// The splitting planes depend on the leaf and its cell alone. So the order of users does not
// matter, nor whether someone had everything refined before.

#include <trisect/bsp/divide/refine_leaf.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/packed_box.h>
#include <trisect/bsp/cells/trace/axis_trace.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/box_lists.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/stack_arena.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {

namespace {

constexpr std::int64_t splitting_offset = usual_splitting_offset;
// Levels made at once. More cost the first visitor more, fewer mean that corners are looked up more
// often.
constexpr int levels_at_once = 4;
// Where boxes get this short in the frame a leaf is left for a frame of its own.
constexpr int least_extent = 128;

/// A point of a cell and the winding number there.
struct KnownPoint {
    FinePoint at;
    int winding = 0;
};

/// Facets that may meet a cell, in the frame: those within it, and those that reach out of it.
struct ListInCell {
    Cell cell;
    KnownPoint reference;
    std::span<PackedBox> contained;
    std::span<PackedBox> crossing;
    std::size_t threads = 1;  ///< that may work on it, while others work on other parts of the leaf

    [[nodiscard]] std::size_t size() const { return contained.size() + crossing.size(); }
};

/// Memory of one thread.
struct Scratch {
    StackArena arena;
    std::vector<PackedBox> cut;  // of the list that is divided, what crosses the splitting plane
};

/// Halves one leaf.
class Halving {
public:
    Halving(const CellNode& leaf, const Cell& cell, std::uint32_t threads)
        : leaf_(leaf),
          threads_(threads),
          source_(*leaf.polygons().whole_source()),
          frame_(Frame::covering(source_.box().intersected(cell.lattice_box()))) {
        root_.cell = cell;
        root_.reference = {leaf.reference(), leaf.winding()};
        root_.threads = threads == 0 ? threads_here() : threads;
    }

    /// A node with children; null when no splitting plane separates the polygons.
    [[nodiscard]] std::shared_ptr<const CellNode> halved() {
        if (source_.box().intersected(root_.cell.lattice_box()).is_empty()) return nullptr;
        list_facets();
        return split(root_, 1, scratch_);
    }

private:
    void list_facets();
    void list_all_facets();
    [[nodiscard]] std::uint32_t threads_for(const ListInCell& list) const {
        return list.threads > 1 ? threads_ : 1;
    }
    [[nodiscard]] PackedBox packed_facet(std::uint32_t facet) const;
    [[nodiscard]] std::optional<ListCut> longest(const ListInCell& list, int shortest) const;
    [[nodiscard]] std::optional<std::array<ListInCell, 2>> divided(const ListInCell& list,
                                                                   const ListCut& cut,
                                                                   Scratch& scratch) const;
    [[nodiscard]] std::optional<KnownPoint> moved(const ListInCell& list, const KnownPoint& from,
                                                  std::size_t axis, std::int64_t to) const;
    [[nodiscard]] std::optional<KnownPoint> moved_beyond(const ListInCell& list,
                                                         const KnownPoint& from, const Cell& cell,
                                                         const SplittingPlane& splitter,
                                                         bool above) const;
    [[nodiscard]] std::optional<KnownPoint> reference_beyond(const ListInCell& list,
                                                             const Cell& cell,
                                                             const SplittingPlane& splitter,
                                                             bool above) const;
    [[nodiscard]] std::shared_ptr<const CellNode> split(const ListInCell& list, int level,
                                                        Scratch& scratch) const;
    [[nodiscard]] std::array<CellRef, 2> nodes_of(const std::array<ListInCell, 2>& halves,
                                                  int level, Scratch& scratch) const;
    [[nodiscard]] CellRef node_of(const ListInCell& list, int level, Scratch& scratch) const;
    [[nodiscard]] CellRef leaf_of(const ListInCell& list, Scratch& scratch) const;

    const CellNode& leaf_;
    std::uint32_t threads_;
    const Source& source_;
    Frame frame_;
    Scratch scratch_;
    ListInCell root_;
};

PackedBox Halving::packed_facet(std::uint32_t facet) const {
    PackedBox b = PackedBox::of(frame_, source_.facet_box(facet));
    b.id = facet;
    return b;
}

// Every corner of a mesh is rounded once.
void Halving::list_all_facets() {
    const LatticeMesh& mesh = source_.mesh();
    const auto mark = scratch_.arena.mark();
    auto* points = scratch_.arena.take<PackedBox>(mesh.points.size());
    ParallelParts(mesh.points.size(), threads_, parallel_list)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            if (source_.is_whole()) {
                for (std::size_t i = begin; i < end; ++i)
                    points[i] = packed_point<true>(frame_, mesh.points[i]);
            } else {
                for (std::size_t i = begin; i < end; ++i)
                    points[i] = packed_point<false>(frame_, mesh.points[i]);
            }
        });
    ParallelParts(root_.contained.size(), threads_, parallel_list)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) {
                const auto& t = mesh.triangles[f];
                root_.contained[f] = box_of_three(points[t[0]], points[t[1]], points[t[2]]);
                root_.contained[f].id = static_cast<std::uint32_t>(f);
            }
        });
    scratch_.arena.release(mark);
}

void Halving::list_facets() {
    const PolygonList& polygons = leaf_.polygons();
    const std::size_t contained = polygons.contained();
    auto* entries = scratch_.arena.take<PackedBox>(polygons.size());
    root_.contained = {entries, contained};
    root_.crossing = {entries + contained, polygons.size() - contained};
    if (polygons.has_all_facets()) return list_all_facets();
    const std::span<const std::uint32_t> facets = polygons.facets();
    ParallelParts(polygons.size(), threads_, parallel_list)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) entries[i] = packed_facet(facets[i]);
        });
}

// The middle of the longest extent; nothing when none is `shortest` positions long.
std::optional<ListCut> Halving::longest(const ListInCell& list, int shortest) const {
    PackedBox all = box_of_list(list.contained, threads_for(list));
    all.add(box_of(list.crossing.data(), list.crossing.size()));
    all = all.intersected(PackedBox::of(frame_, list.cell.lattice_box()));
    std::optional<ListCut> cut;
    int extent = shortest - 1;
    for (std::size_t k = 0; k < 3; ++k) {
        if (all.high(k) - all.low(k) <= extent) continue;
        extent = all.high(k) - all.low(k);
        cut = ListCut{k, all.low(k) + (extent + 1) / 2};
    }
    return cut;
}

// A point and the winding number there, moved along an axis; nothing where the way passes an edge
// or a corner.
std::optional<KnownPoint> Halving::moved(const ListInCell& list, const KnownPoint& from,
                                         std::size_t axis, std::int64_t to) const {
    FinePoint p = from.at;
    p.c[axis] = to;
    AxisTrace trace(from.at, p, static_cast<int>(axis));
    Box segment;
    for (std::size_t i = 0; i < 3; ++i) {
        segment.lo[i] = lattice_below(std::min(p.c[i], from.at.c[i])) - 1;
        segment.hi[i] = lattice_below(std::max(p.c[i], from.at.c[i])) + 2;
    }
    const PackedReach reach(PackedBox::of(frame_, segment));
    for (const auto& part : {list.contained, list.crossing})
        for_each_meeting(part, reach, threads_for(list), [&](const PackedBox& e) {
            if (source_.facet_box(e.id).overlaps(segment))
                trace.add({&source_, nullptr, e.id, leaf_.polygons().flipped(), false});
        });
    const auto change = trace.change(false);
    if (!change) return std::nullopt;
    return KnownPoint{p, from.winding + *change};
}

// A point moved straight through a splitting plane, into a cell.
std::optional<KnownPoint> Halving::moved_beyond(const ListInCell& list, const KnownPoint& from,
                                                const Cell& cell, const SplittingPlane& splitter,
                                                bool above) const {
    const auto k = static_cast<std::size_t>(splitter.axis);
    const std::int64_t direction = above ? 1 : -1;
    for (const std::int64_t step :
         {first_reference_steps[above ? 1 : 0][k], std::int64_t{37}, std::int64_t{59},
          std::int64_t{101}, std::int64_t{1001}, std::int64_t{10001}}) {
        FinePoint p = from.at;
        p.c[k] = reference_position(splitter.position + direction * step, direction);
        if (!cell.contains(p)) continue;
        if (auto beyond = moved(list, from, k, p.c[k])) return beyond;
    }
    return std::nullopt;
}

// The list's reference beyond the splitting plane. Where all ways straight through it pass an edge,
// as they do if the reference is above one, it is moved aside first.
std::optional<KnownPoint> Halving::reference_beyond(const ListInCell& list, const Cell& cell,
                                                    const SplittingPlane& splitter,
                                                    bool above) const {
    if (auto beyond = moved_beyond(list, list.reference, cell, splitter, above)) return beyond;
    const std::size_t aside = splitter.axis == 0 ? 1 : 0;
    for (const std::int64_t step : {59, -59, 1001, -1001, 100'003, -100'003}) {
        FinePoint p = list.reference.at;
        p.c[aside] = reference_position(p.c[aside] + step, step);
        if (!list.cell.contains(p)) continue;
        const auto beside = moved(list, list.reference, aside, p.c[aside]);
        if (!beside) continue;
        if (auto beyond = moved_beyond(list, *beside, cell, splitter, above)) return beyond;
    }
    return std::nullopt;
}

// Both halves of a list; nothing when no reference point is found.
std::optional<std::array<ListInCell, 2>> Halving::divided(const ListInCell& list,
                                                          const ListCut& cut,
                                                          Scratch& scratch) const {
    StackArena& arena = scratch.arena;
    std::vector<PackedBox>& cut_entries = scratch.cut;
    const int axis = static_cast<int>(cut.axis);
    const std::int64_t splitter =
        frame_.last_below(cut.axis, cut.first_above) * splitting_scale + splitting_offset;

    std::array<ListInCell, 2> out;
    out[0].cell = list.cell.below(axis, splitter);
    out[1].cell = list.cell.above(axis, splitter);
    for (std::size_t i = 0; i < 2; ++i) {
        out[i].threads = std::max<std::size_t>(1, list.threads / 2);
        out[i].reference = list.reference;
        if (out[i].cell.contains(list.reference.at)) continue;
        const auto beyond = reference_beyond(list, out[i].cell, {axis, splitter}, i == 1);
        if (!beyond) return std::nullopt;
        out[i].reference = *beyond;
    }
    const std::span room(arena.take<PackedBox>(list.contained.size()), list.contained.size());
    const HalfSizes sizes = divide_list(list.contained, cut, room, cut_entries, threads_for(list));
    out[0].contained = room.first(sizes.below);
    out[1].contained = room.last(sizes.above);
    for (std::size_t i = 0; i < 2; ++i) {
        auto* entries = arena.take<PackedBox>(cut_entries.size() + list.crossing.size());
        auto* end = std::copy(cut_entries.begin(), cut_entries.end(), entries);
        end = std::ranges::copy_if(list.crossing, end, [&](const PackedBox& e) {
                  return i == 0 ? cut.has_below(e) : cut.has_above(e);
              }).out;
        arena.shrink(end);
        out[i].crossing = {entries, end};
    }
    return out;
}

std::shared_ptr<const CellNode> Halving::split(const ListInCell& list, int level,
                                               Scratch& scratch) const {
    const auto cut = longest(list, level == 1 ? 1 : least_extent);
    if (!cut) return nullptr;
    const auto mark = scratch.arena.mark();
    const auto halves = divided(list, *cut, scratch);
    std::shared_ptr<const CellNode> node;
    // Both halves nearly as large as the whole: a splitting plane that separates nothing.
    const std::size_t most = list.size() - list.size() / 16;
    if (halves && ((*halves)[0].size() <= most || (*halves)[1].size() <= most)) {
        const std::int64_t splitter = (*halves)[0].cell.hi[cut->axis];
        auto [below, above] = nodes_of(*halves, level, scratch);
        node = CellNode::split(static_cast<int>(cut->axis), splitter, std::move(below),
                               std::move(above));
    }
    scratch.arena.release(mark);
    return node;
}

std::array<CellRef, 2> Halving::nodes_of(const std::array<ListInCell, 2>& halves, int level,
                                         Scratch& scratch) const {
    std::array<CellRef, 2> out;
    if (threads_ != 1 && std::min(halves[0].size(), halves[1].size()) >= parallel_list) {
        both_at_once(
            [&] {
                Scratch own;
                out[1] = node_of(halves[1], level, own);
            },
            [&] { out[0] = node_of(halves[0], level, scratch); });
    } else {
        for (std::size_t i = 0; i < 2; ++i) out[i] = node_of(halves[i], level, scratch);
    }
    return out;
}

CellRef Halving::node_of(const ListInCell& list, int level, Scratch& scratch) const {
    if (level < levels_at_once && list.size() >= refinable_leaf)
        if (auto node = split(list, level + 1, scratch)) return {std::move(node), false};
    return leaf_of(list, scratch);
}

CellRef Halving::leaf_of(const ListInCell& list, Scratch& scratch) const {
    const auto mark = scratch.arena.mark();
    auto* facets = scratch.arena.take<std::uint32_t>(list.size());
    auto* end = facets;
    for (const auto& part : {list.contained, list.crossing})
        for (const PackedBox& e : part) *end++ = e.id;
    PolygonList polygons = PolygonList::whole_facets(source_, leaf_.polygons().flipped(),
                                                     {facets, end}, list.contained.size());
    scratch.arena.release(mark);
    return {CellNode::leaf(std::move(polygons), list.reference.at, list.reference.winding,
                           leaf_.is_mixed()),
            false};
}

}  // namespace

const CellNode* refined(const CellNode& leaf, const Cell& cell, std::uint32_t threads) {
    if (const CellNode* done = leaf.refinement()) return done;
    const PolygonList& polygons = leaf.polygons();
    if (polygons.whole_source() == nullptr || polygons.whole_source()->is_half_space())
        return nullptr;
    return leaf.refine([&] { return Halving(leaf, cell, threads).halved(); });
}

namespace {

// Both halves of a large leaf are independent.
void refine_below(const CellNode& node, const Cell& cell, bool parallel) {
    const CellNode* at = &node;
    if (at->is_leaf()) {
        if (at->size() < refinable_leaf) return;
        at = refined(*at, cell, parallel ? 0 : 1);
        if (at == nullptr) return;
    }
    const auto below = [&](int i) {
        const Cell c = i == 0 ? cell.below(at->axis(), at->splitter())
                              : cell.above(at->axis(), at->splitter());
        refine_below(*at->child(i).node, c, parallel);
    };
    if (parallel && at->size() > 64 * refinable_leaf) {
        FirstFailure failure;
        fork_join([&] { failure.guard(1, [&] { below(1); }); },
                  [&] { failure.guard(0, [&] { below(0); }); });
        failure.rethrow();
    } else {
        below(0);
        below(1);
    }
}

}  // namespace

void refine_all(const CellRef& root, std::uint32_t threads) {
    if (threads == 1) {
        refine_below(*root.node, Cell{}, false);
        return;
    }
    in_arena(threads, [&] { refine_below(*root.node, Cell{}, true); });
}

}  // namespace trisect::detail
