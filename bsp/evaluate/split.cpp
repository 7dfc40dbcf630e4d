// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/split.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/formula_operands.h>
#include <trisect/bsp/evaluate/half_space.h>
#include <trisect/bsp/evaluate/rules.h>
#include <trisect/bsp/half_spaces/between_half_spaces.h>
#include <trisect/bsp/half_spaces/mesh_slabs.h>
#include <trisect/bsp/half_spaces/parallel_planes.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::MeshSlab;
using detail::Residual;

constexpr std::size_t most_planes = 65'536;
// The rules for formulas after that for half-spaces.
constexpr std::size_t rules_after_half_spaces = 3;

EvaluateAllCounters& counters() { return detail::counters_of_thread<EvaluateAllCounters>; }

bool is_imported_mesh(const Solid& solid) {
    const auto* const tree = std::get_if<detail::CellTree>(&detail::state_of(solid)->form);
    return tree != nullptr && tree->root.node->is_leaf() &&
           tree->root.node->polygons().has_all_facets();
}

// A mesh and half-spaces.
class SlabsOfMesh {
public:
    SlabsOfMesh(const Solid& mesh, std::span<const Solid> half_spaces,
                const EvaluateOptions& options)
        : options_(options), operands_(translation_of(mesh, half_spaces), options) {
        const auto& states = operands_.states();
        const auto term = [](std::int32_t slot, bool is_above) {
            const Residual::Ref out = Residual::of_slot(slot);
            return is_above ? Residual::negation(out) : out;
        };
        for (std::size_t i = 0; i <= half_spaces.size(); ++i) {
            MeshSlab& slab = slabs_.emplace_back();
            slab.solids.push_back(states[0]);
            std::vector<Residual::Ref> terms;
            terms.reserve(3);
            terms.push_back(Residual::of_slot(0));
            const auto add = [&](std::size_t plane, bool is_above) {
                const auto slot = static_cast<std::int32_t>(slab.solids.size());
                slab.solids.push_back(states[plane + 1]);
                terms.push_back(term(slot, is_above != states[plane + 1]->root().complemented));
            };
            if (i < half_spaces.size()) add(i, false);
            if (i > 0) add(i - 1, true);
            slab.formula = Residual::combination(Residual::Kind::And, terms);
            names_.push_back({mesh});
            if (i < half_spaces.size()) names_.back().push_back(half_spaces[i]);
            if (i > 0) names_.back().push_back(half_spaces[i - 1]);
        }
    }

    [[nodiscard]] bool may_be_cut() const {
        std::vector<Plane> planes;
        for (std::size_t i = 1; i < operands_.states().size(); ++i)
            planes.push_back(detail::plane_of_half_space(*operands_.states()[i]));
        return detail::are_ascending(planes) &&
               std::ranges::all_of(slabs_, [&](const MeshSlab& slab) {
                   return detail::is_mesh_with_half_spaces(slab.formula, slab.solids,
                                                           operands_.settings());
               });
    }

    // Upwards. What one pass does not give is evaluated alone. \pre may_be_cut()
    [[nodiscard]] std::vector<Solid> cut(EvaluateReport* report) {
        detail::EvaluateStats made;
        auto values = detail::evaluate_slabs(slabs_, operands_.settings(), made);
        operands_.count(made, report);
        std::vector<Solid> out;
        bool is_any_cut = false;
        for (std::size_t i = 0; i < slabs_.size(); ++i) {
            if (auto solid = solid_of(i, std::move(values[i]))) {
                out.push_back(*std::move(solid));
                is_any_cut = true;
                continue;
            }
            out.push_back(detail::evaluate_translation({slabs_[i].formula, names_[i]}, options_,
                                                       report, rules_after_half_spaces));
            ++counters().evaluations;
        }
        counters().results += out.size();
        counters().evaluations += is_any_cut ? 1 : 0;
        return out;
    }

private:
    [[nodiscard]] std::optional<Solid> solid_of(std::size_t i, detail::SlabValue value) const {
        const MeshSlab& slab = slabs_[i];
        const auto& settings = operands_.settings();
        if (value.is_none)
            return operands_.solid_of_value(
                std::make_shared<detail::SolidState>(*detail::state_of(Solid())));
        if (value.is_all) {
            auto all = std::make_shared<detail::SolidState>(*slab.solids[0]);
            all->source = 0;
            return operands_.solid_of_value(std::move(all));
        }
        if (!value.part) return std::nullopt;
        value.part->tree = detail::lazy_tree_of(slab.formula, slab.solids, settings);
        return operands_.solid_of_value(
            detail::state_of_value(*std::move(value.part), *slab.formula, slab.solids, settings));
    }

    static detail::Translation translation_of(const Solid& mesh,
                                              std::span<const Solid> half_spaces) {
        detail::Translation out;
        out.slots.push_back(mesh);
        out.slots.insert(out.slots.end(), half_spaces.begin(), half_spaces.end());
        std::vector<Residual::Ref> terms;
        for (std::size_t i = 0; i < out.slots.size(); ++i)
            terms.push_back(Residual::of_slot(static_cast<std::int32_t>(i)));
        out.formula = Residual::combination(Residual::Kind::And, terms);
        return out;
    }

    const EvaluateOptions& options_;
    detail::FormulaOperands operands_;
    std::vector<MeshSlab> slabs_;
    std::vector<std::vector<Solid>> names_;  // the slots of each, as they were named
};

std::optional<std::vector<Solid>> slabs_of(const Solid& solid, std::span<const Solid> half_spaces,
                                           const EvaluateOptions& options, EvaluateReport* report) {
    if (!is_imported_mesh(solid)) return std::nullopt;
    SlabsOfMesh slabs(solid, half_spaces, options);
    if (!slabs.may_be_cut()) return std::nullopt;
    return slabs.cut(report);
}

}  // namespace

SplitSolid split(const Solid& a, const Solid& b, const EvaluateOptions& options,
                 EvaluateReport* report) {
    if (detail::is_half_space(*detail::state_of(b))) {
        if (auto slabs = slabs_of(a, std::span(&b, 1), options, report)) {
            const bool is_below = !detail::state_of(b)->root().complemented;
            return {std::move((*slabs)[is_below ? 0 : 1]), std::move((*slabs)[is_below ? 1 : 0])};
        }
    }
    std::vector<EvaluateReport> reports;
    auto parts = evaluate_all(std::array<Expression, 2>{a & b, a - b}, options, &reports);
    if (report != nullptr) *report = reports[0];
    return {std::move(parts[0]), std::move(parts[1])};
}

SplitSolid split(const Solid& solid, const std::array<double, 4>& plane,
                 const EvaluateOptions& options, EvaluateReport* report) {
    return split(solid, Solid::half_space(plane), options, report);
}

std::vector<Solid> split(const Solid& solid, std::span<const std::array<double, 4>> planes,
                         const EvaluateOptions& options) {
    if (planes.size() > most_planes)
        throw LimitError("split by " + std::to_string(planes.size()) + " planes; at most " +
                         std::to_string(most_planes) + " are possible");
    std::vector<Solid> half_spaces;
    for (const auto& plane : planes) half_spaces.push_back(Solid::half_space(plane));
    if (!planes.empty())
        if (auto slabs = slabs_of(solid, half_spaces, options, nullptr)) return *std::move(slabs);
    std::vector<Solid> out;
    Solid rest = solid;
    for (const Solid& half_space : half_spaces) {
        SplitSolid parts = split(rest, half_space, options);
        out.push_back(std::move(parts.common));
        rest = std::move(parts.rest);
    }
    out.push_back(std::move(rest));
    return out;
}

}  // namespace trisect
