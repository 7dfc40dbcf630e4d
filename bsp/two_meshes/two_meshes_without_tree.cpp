// SPDX-License-Identifier: Apache-2.0
//
// Most facets of two large meshes do not come near the other mesh. To send them all down a tree
// takes half of an evaluation, and only queries of points, or later operations, need that tree. For
// a mesh of the result it is enough to find which facets cross, and on which side of the other mesh
// the others are.
//
// 1. A grid of a few thousand cubes shows which facets share a cube with the other mesh
//    (cube_grid.h): some of ten.
// 2. These alone are divided, down to cells with few of them, and compared there. Winding numbers
//    are not needed, so what does not meet the box of the other mesh's facets is left out.
// 3. Sides of facets follow from the crossings (facet_sides.cpp).
//
// Any doubt ends the attempt: then the whole is evaluated as all else.

#include <trisect/bsp/two_meshes/two_meshes_without_tree.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/choose_splitting_plane.h>
#include <trisect/bsp/divide/partition.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/bsp/two_meshes/cube_grid.h>
#include <trisect/bsp/two_meshes/facet_sides.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/stack_arena.h>

namespace trisect::detail {

namespace {

using TwoLists = std::array<std::vector<std::uint32_t>, 2>;

// Cells with fewer facets are not worth a task of their own.
constexpr std::uint64_t parallel_facets = 4096;

class PairFinder;

// What the threads of one search share.
struct SharedSearch {
    const EvaluateSettings& options;
    const Crossings& operands;  // without pairs
    MemoryBudget& memory;
    bool parallel = false;
    std::atomic<bool> in_doubt{false};  // all may stop
    PerThread<PairFinder> finders = {};

    PairFinder& finder();
};

// Compares facets of two meshes, some of each.
class PairFinder {
public:
    explicit PairFinder(SharedSearch& search) : search_(search) {
        crossings_.operands = search.operands.operands;
    }

    /// False when doubles cannot decide some pair.
    [[nodiscard]] bool run(const std::array<const CellNode*, 2>& meshes, const TwoLists& facets) {
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
        return solve(task);
    }
    [[nodiscard]] const Crossings& crossings() const { return crossings_; }
    [[nodiscard]] const EvaluateStats& stats() const { return stats_; }

private:
    [[nodiscard]] PackedBox* boxes_of(const LatticeMesh& mesh,
                                      std::span<const std::uint32_t> facets, Frame frame);
    [[nodiscard]] bool solve(CellTask& task);
    [[nodiscard]] bool divide(const CellTask& task, const SplittingPlane& splitter);
    [[nodiscard]] bool compare(const CellTask& task);
    [[nodiscard]] bool leave_out(CellTask& task);

    [[nodiscard]] bool solve_both(std::array<CellTask, 2>& children);

    SharedSearch& search_;
    EvaluateStats stats_;
    Crossings crossings_;
    StackArena arena_;
    FilteredFacets facets_;
    FilteredPairs pairs_;
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

bool PairFinder::solve(CellTask& task) {
    if (search_.in_doubt.load(std::memory_order_relaxed)) return false;
    const auto mark = arena_.mark();
    ++stats_.cells;
    check_budget(search_.options, stats_);
    stats_.depth = std::max(stats_.depth, task.depth);
    bool known = true;
    if (leave_out(task)) {
        stats_.listed_polygons += task.size();
        const bool large = task.size() > search_.options.leaf_polygons && task.stalled < 4;
        const auto splitter =
            large ? choose_splitting_plane(task, search_.options.splitting_offset) : std::nullopt;
        known = splitter ? divide(task, *splitter) : compare(task);
    }
    arena_.release(mark);
    return known;
}

bool PairFinder::divide(const CellTask& task, const SplittingPlane& splitter) {
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
    return solve_both(children);
}

// The lists of both lie in the arena of this thread, which waits for the other one.
bool PairFinder::solve_both(std::array<CellTask, 2>& children) {
    std::array<bool, 2> known{};
    if (search_.parallel && std::min(children[0].size(), children[1].size()) >= parallel_facets) {
        both_at_once([&] { known[1] = search_.finder().solve(children[1]); },
                     [&] { known[0] = with_enough_stack([&] { return solve(children[0]); }); });
    } else {
        for (std::size_t i = 0; i < 2; ++i)
            known[i] = with_enough_stack([&] { return solve(children[i]); });
    }
    return known[0] && known[1];
}

bool PairFinder::compare(const CellTask& task) {
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
    if (!facets_.list(problem) || !pairs_.relate_all(facets_, true, stats_)) {
        search_.in_doubt.store(true, std::memory_order_relaxed);
        return false;
    }
    pairs_.add_to(crossings_, facets_);
    return true;
}

// About a facet in each cube that the surface meets.
int slabs_for(std::size_t facets) {
    return std::clamp(static_cast<int>(std::sqrt(static_cast<double>(facets) / 8)), 4, 62);
}

// Of an imported mesh.
int winding_far_out(const SolidState& solid) {
    return complemented_winding(solid.root().node->winding(), solid.root().complemented);
}

bool is_below_far_out(const SolidState& solid, const Crossings::Operand& operand) {
    return (winding_far_out(solid) == operand.open) == operand.is_open_below();
}

// Both, at the same time where the search is done by several threads.
template <class First, class Second>
void do_both(bool parallel, const First& first, const Second& second) {
    if (parallel) {
        both_at_once(first, second);
    } else {
        first();
        second();
    }
}

// The meshes, and whether they are worth it.
struct TwoMeshes {
    std::array<const CellNode*, 2> nodes;
    std::array<const LatticeMesh*, 2> meshes{};
    Box common;

    explicit TwoMeshes(const SolidStates& solids)
        : nodes{solids[0]->root().node.get(), solids[1]->root().node.get()} {
        common = source(0).box();
        for (std::size_t i = 0; i < 2; ++i) {
            meshes[i] = &source(i).mesh();
            common = common.intersected(source(i).box());
        }
    }
    [[nodiscard]] const Source& source(std::size_t i) const {
        return *nodes[i]->polygons().whole_source();
    }
    [[nodiscard]] std::size_t larger() const {
        return std::max(nodes[0]->size(), nodes[1]->size());
    }
    [[nodiscard]] std::size_t smaller() const {
        return std::min(nodes[0]->size(), nodes[1]->size());
    }
    // A mesh with an index is not looked at as a whole again, and neither is one that outnumbers
    // the other one and hence gets an index now (evaluator.cpp).
    [[nodiscard]] bool are_of_a_size() const {
        return nodes[0]->refinement() == nullptr && nodes[1]->refinement() == nullptr &&
               larger() < 4 * smaller();
    }
    [[nodiscard]] bool have_outer_references() const {
        return lies_outside(nodes[0]->reference(), source(0).box()) &&
               lies_outside(nodes[1]->reference(), source(1).box());
    }
};

// All pairs of facets that cross, arranged; false when doubles cannot decide one.
bool find_pairs(const TwoMeshes& two, const TwoLists& near, const EvaluateSettings& options,
                MemoryBudget& memory, bool parallel, Crossings& crossings, EvaluateStats& stats) {
    SharedSearch search{options, crossings, memory, parallel};
    if (!search.finder().run(two.nodes, near)) return false;
    search.finders.for_each([&](const PairFinder& f) {
        crossings.append(f.crossings());
        stats += f.stats();
    });
    crossings.arrange();
    return true;
}

// What bounds the result and is not crossed, of either mesh; nothing when that is not known.
std::optional<std::vector<UncrossedFacets>> find_uncrossed(const TwoMeshes& two,
                                                           const SolidStates& solids,
                                                           const EvaluateSettings& options,
                                                           bool parallel, Crossings& crossings,
                                                           EvaluateStats& stats) {
    MemoryBudget memory(options.max_memory);
    const CubeGrid grid(two.common, slabs_for(two.larger()));
    std::array<std::optional<OccupiedCubes>, 2> cubes;
    do_both(
        parallel, [&] { cubes[0].emplace(grid, *two.meshes[0]); },
        [&] { cubes[1].emplace(grid, *two.meshes[1]); });
    if (!cubes[0]->is_useful() || !cubes[1]->is_useful()) return std::nullopt;
    const auto of_cubes = memory.hold(cubes[0]->bytes() + cubes[1]->bytes());
    TwoLists near;
    do_both(
        parallel, [&] { near[0] = cubes[0]->facets_in(cubes[1]->cubes()); },
        [&] { near[1] = cubes[1]->facets_in(cubes[0]->cubes()); });
    if (near[0].empty() || near[1].empty()) return std::nullopt;
    const auto of_near = memory.hold((near[0].size() + near[1].size()) * sizeof(std::uint32_t));
    if (!find_pairs(two, near, options, memory, parallel, crossings, stats) ||
        crossings.pairs.empty())
        return std::nullopt;
    std::array<std::optional<std::vector<std::uint32_t>>, 2> facets;
    const auto find = [&](std::size_t i) {
        const Crossings::Operand& other = crossings.operands[1 - i];
        FacetSides sides(grid, *two.meshes[i], *cubes[i], cubes[1 - i]->cubes(), near[i]);
        facets[i] = sides.uncrossed(crossings, i, is_below_far_out(*solids[1 - i], other),
                                    other.is_open_below());
    };
    do_both(
        parallel, [&] { find(0); }, [&] { find(1); });
    if (!facets[0] || !facets[1]) return std::nullopt;
    std::vector<UncrossedFacets> out;
    for (std::size_t i = 0; i < 2; ++i) {
        stats.untouched_polygons += facets[i]->size();
        memory.keep(facets[i]->size() * sizeof(std::uint32_t));
        out.push_back({&two.source(i), crossings.operands[i].inside_above, *std::move(facets[i])});
    }
    stats.memory = memory.peak();
    return out;
}

}  // namespace

bool are_two_large_meshes(const Residual::Ref& formula, const SolidStates& solids,
                          const EvaluateSettings& options, std::size_t least_facets) {
    if (solids.size() != 2 || options.budget != nullptr || !crossings_of(*formula, solids))
        return false;
    const TwoMeshes two(solids);
    return two.smaller() >= least_facets && two.are_of_a_size() && two.have_outer_references() &&
           !two.common.is_empty();
}

std::optional<SolidForm> evaluate_without_tree(const Residual::Ref& formula,
                                               const SolidStates& solids,
                                               const EvaluateSettings& options,
                                               EvaluateStats& stats,
                                               std::shared_ptr<const LazyTree> tree) {
    std::optional<Crossings> crossings = crossings_of(*formula, solids);
    const TwoMeshes two(solids);
    const bool parallel =
        options.threads != 1 && two.larger() + two.smaller() >= 2 * parallel_facets;
    EvaluateStats made;
    auto uncrossed = on_threads(parallel ? options.threads : 1, [&](std::uint32_t) {
        return find_uncrossed(two, solids, options, parallel, *crossings, made);
    });
    if (!uncrossed) return std::nullopt;
    stats = made;
    return UndividedMeshes{*std::move(uncrossed),
                           std::make_shared<const Crossings>(*std::move(crossings)),
                           std::move(tree)};
}

}  // namespace trisect::detail
