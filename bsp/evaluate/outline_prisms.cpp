// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/outline_prisms.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/bsp/divide/cell_task.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/leaf/prism/prism_arrangement.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// Of an operand that is all facets of one mesh: the mesh, else null.
const Source* only_mesh_of(const SolidState& solid) {
    const CellNode& root = *solid.root().node;
    if (!solid.embedded || !root.is_leaf() || root.deferred() != nullptr || root.size() == 0)
        return nullptr;
    const PolygonList& polygons = root.polygons();
    const Source* const source = polygons[0].source;
    if (source->is_half_space() || source->facet_count() != polygons.size()) return nullptr;
    if (polygons.has_all_facets()) return source;
    // As moving to a finer lattice leaves it.
    std::uint32_t next = 0;
    const auto is_next = [&](const PolygonRef& r) {
        return r.source == source && r.fragment == nullptr && !r.touched && r.facet == next++;
    };
    return std::all_of(polygons.begin(), polygons.end(), is_next) ? source : nullptr;
}

std::uint64_t total_size(std::span<const std::shared_ptr<const SolidState>> solids) {
    std::uint64_t total = 0;
    for (const auto& s : solids) total += s->root().node->size();
    return total;
}

}  // namespace

bool may_be_prisms_of_one_axis(const Residual::Ref&, const SolidStates& solids,
                               const EvaluateSettings& options) {
    if (solids.size() < 2 || options.budget != nullptr || options.max_memory != 0) return false;
    return std::ranges::all_of(solids, [](const auto& s) {
        const Source* const mesh = only_mesh_of(*s);
        return mesh != nullptr && lies_outside(s->root().node->reference(), mesh->box()) &&
               PrismFacets::may_be_of_wall({mesh, nullptr, 0, false, false});
    });
}

namespace {

std::optional<SolidForm> outline_on_threads(const Residual::Ref& formula, const SolidStates& solids,
                                            const EvaluateSettings& options, EvaluateStats& stats,
                                            std::shared_ptr<const LazyTree> tree) {
    Box all;
    PoolVector<PolygonRef> polygons;
    polygons.reserve(total_size(solids));
    for (const auto& s : solids) {
        for (const PolygonRef r : s->root().node->polygons()) polygons.push_back(r);
        all.add(polygons.back().source->box());
    }
    std::vector<LeafOperand> operands;
    SlotValues values;
    std::size_t first = 0;
    for (std::size_t i = 0; i < solids.size(); ++i) {
        const CellRef& root = solids[i]->root();
        operands.push_back({static_cast<std::int32_t>(i),
                            std::span(polygons).subspan(first, root.node->size()),
                            root.complemented, true,
                            complemented_winding(root.node->winding(), root.complemented)});
        first += root.node->size();
        values.push_back(is_inside(operands.back().winding, options.winding) ? 1 : 0);
    }
    const FinePoint reference = point_beyond(all);
    LeafFindings findings;
    auto result = PrismArrangement().arrange(
        {Cell{}, reference, operands, formula.get(), &options, true}, findings);
    if (!result) return std::nullopt;
    auto& made = std::get<LeafOutlines>(*result);
    stats = findings.stats;
    stats.cells = stats.mixed_leaves = stats.prism_leaves = 1;
    stats.listed_polygons = polygons.size();
    auto whole = CellNode::leaf(PolygonList(std::move(made.whole)), reference,
                                value_of(*formula, values) ? 1 : 0, true);
    if (made.outlines.faces.empty()) return CellTree{{std::move(whole), false}, {}, nullptr};
    return PrismOutlines{std::move(whole),
                         std::make_shared<const NamedOutlines>(std::move(made.outlines)),
                         std::move(tree)};
}

}  // namespace

std::optional<SolidForm> outline_prisms(const Residual::Ref& formula, const SolidStates& solids,
                                        const EvaluateSettings& options, EvaluateStats& stats,
                                        std::shared_ptr<const LazyTree> tree) {
    return on_threads(options.threads, [&](std::uint32_t threads) {
        EvaluateSettings here = options;
        here.threads = threads;
        return outline_on_threads(formula, solids, here, stats, std::move(tree));
    });
}

}  // namespace trisect::detail
