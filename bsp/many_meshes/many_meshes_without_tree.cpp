// SPDX-License-Identifier: Apache-2.0
//
// In such a formula an operand bounds the result where all others are open (crossings.h), so it is
// an intersection, of what the operands leave open. It is made pair by pair, in a balanced tree:
// operands that fill one place cut each other down, and a facet is compared with what is left of
// the others. Where all were compared with all, most crossings would not be in the result.
//
// Intermediate results are parts of whole facets by name (outlined_solid.h), so nothing gets less
// exact on the way, and no polygon is cut.

#include <trisect/bsp/many_meshes/many_meshes_without_tree.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/budget.h>
#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/outlined_facets.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/many_meshes/common_part.h>
#include <trisect/bsp/many_meshes/outlined_solid.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>

namespace trisect::detail {

namespace {

// Fewer facets are not worth a thread of their own.
constexpr std::size_t parallel_facets = 2000;

const Source& source_of(const SolidState& solid) {
    return *solid.root().node->polygons().whole_source();
}

bool is_open_far_out(const SolidState& solid, const Crossings::Operand& operand) {
    return complemented_winding(solid.root().node->winding(), solid.root().complemented) ==
           operand.open;
}

// In how many boxes of operands a point of their common box lies, on average: so many, or this part
// of all where they are few.
constexpr double crowded_depth = 2.5;
constexpr double crowded_part = 0.3;

bool are_crowded(const SolidStates& solids) {
    Box all;
    for (const auto& s : solids) all.add(source_of(*s).box());
    double sum = 0;
    for (const auto& s : solids) {
        const Box& box = source_of(*s).box();
        double part = 1;
        for (std::size_t k = 0; k < 3; ++k)
            part *= static_cast<double>(box.hi[k] - box.lo[k] + 1) /
                    static_cast<double>(all.hi[k] - all.lo[k] + 1);
        sum += part;
    }
    return sum >= std::min(crowded_depth, crowded_part * static_cast<double>(solids.size()));
}

class BalancedTree {
public:
    BalancedTree(const ManyMeshes& meshes, const SolidStates& solids,
                 const EvaluateSettings& options, bool parallel)
        : meshes_(meshes), solids_(solids), options_(options), parallel_(parallel) {}

    // What operands [first, end) leave open together.
    [[nodiscard]] std::optional<OutlinedSolid> of(std::uint32_t first, std::uint32_t end,
                                                  EvaluateStats& stats) const {
        if (first + 1 == end)
            return whole_operand(
                meshes_, first,
                is_open_far_out(*solids_[first], meshes_.operands->operands[first]));
        const std::uint32_t middle = first + (end - first) / 2;
        std::optional<OutlinedSolid> below;
        std::optional<OutlinedSolid> above;
        EvaluateStats of_above;
        const auto find_below = [&] { below = of(first, middle, stats); };
        const auto find_above = [&] { above = of(middle, end, of_above); };
        if (parallel_ && facets_of(first, end) >= parallel_facets) {
            both_at_once(find_above, find_below);
        } else {
            find_below();
            if (below) find_above();
        }
        stats += of_above;
        if (!below || !above) return std::nullopt;
        CommonPart& common =
            common_.local([&] { return std::make_unique<CommonPart>(meshes_, options_); });
        return common.of(*std::move(below), *std::move(above), stats);
    }

private:
    [[nodiscard]] std::size_t facets_of(std::uint32_t first, std::uint32_t end) const {
        std::size_t n = 0;
        for (std::uint32_t i = first; i < end; ++i) n += meshes_.sources[i]->facet_count();
        return n;
    }
    const ManyMeshes& meshes_;
    const SolidStates& solids_;
    const EvaluateSettings& options_;
    bool parallel_;
    mutable PerThread<CommonPart> common_;
};

// By what assembly needs.
UndividedMeshes form_of(const OutlinedSolid& solid, const ManyMeshes& meshes, Crossings operands,
                        std::shared_ptr<const LazyTree> tree) {
    UndividedMeshes out;
    for (std::size_t i = 0; i < meshes.sources.size(); ++i)
        out.uncrossed.push_back({meshes.sources[i], operands.operands[i].inside_above, {}});
    auto outlined = std::make_shared<OutlinedFacets>();
    outlined->vertices = solid.vertices;
    for (const OutlinedSolid::Facet& f : solid.facets) {
        if (f.whole) {
            out.uncrossed[f.slot].facets.push_back(f.number - operands.operands[f.slot].first);
            continue;
        }
        outlined->facets.push_back(
            {f.number, static_cast<std::uint32_t>(outlined->edges.size()), f.count});
        for (const OutlinedSolid::Edge& e : solid.edges_of(f)) {
            const std::uint32_t cutter =
                e.line == nullptr ? 0 : e.line->facets[e.line->facets[0] == f.number ? 1 : 0];
            outlined->edges.push_back({e.from, e.to, cutter, e.own});
        }
    }
    out.outlined = std::move(outlined);
    out.crossings = std::make_shared<const Crossings>(std::move(operands));
    out.tree = std::move(tree);
    return out;
}

}  // namespace

bool may_be_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                        const EvaluateSettings& options) {
    if (solids.size() < 3 || options.budget != nullptr || options.max_memory != 0 ||
        !crossings_of(*formula, solids))
        return false;
    return std::ranges::all_of(solids, [](const auto& s) {
        return s->root().node->refinement() == nullptr &&
               lies_outside(s->root().node->reference(), source_of(*s).box());
    });
}

bool are_many_meshes(const Residual::Ref& formula, const SolidStates& solids,
                     const EvaluateSettings& options) {
    return may_be_many_meshes(formula, solids, options) && are_crowded(solids);
}

std::optional<SolidForm> evaluate_many_without_tree(const Residual::Ref& formula,
                                                    const SolidStates& solids,
                                                    const EvaluateSettings& options,
                                                    EvaluateStats& stats,
                                                    std::shared_ptr<const LazyTree> tree) {
    std::optional<Crossings> operands = crossings_of(*formula, solids);
    ManyMeshes meshes;
    meshes.operands = &*operands;
    Box all;
    for (const auto& s : solids) {
        meshes.sources.push_back(&source_of(*s));
        all.add(source_of(*s).box());
    }
    for (std::size_t k = 0; k < 3; ++k)
        meshes.extent[k] = static_cast<double>(all.hi[k] - all.lo[k] + 2);
    EvaluateStats made;
    const auto end = static_cast<std::uint32_t>(solids.size());
    auto result = on_threads(options.threads, [&](std::uint32_t threads) {
        return BalancedTree(meshes, solids, options, threads != 1).of(0, end, made);
    });
    if (!result) return std::nullopt;
    UndividedMeshes form = form_of(*result, meshes, *std::move(operands), std::move(tree));
    for (const UncrossedFacets& u : form.uncrossed) made.untouched_polygons += u.facets.size();
    stats = made;
    return form;
}

}  // namespace trisect::detail
