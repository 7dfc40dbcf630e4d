// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/formula_reach.h>

#include <cstddef>
#include <utility>

#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

// A set and its complement; nothing where one is not bounded.
struct Reach {
    std::optional<Box> inside;
    std::optional<Box> outside;

    [[nodiscard]] Reach flipped() const { return {outside, inside}; }
};

std::optional<Box> common(const std::optional<Box>& a, const std::optional<Box>& b) {
    if (!a) return b;
    return b ? std::optional(a->intersected(*b)) : a;
}

std::optional<Box> both(const std::optional<Box>& a, const std::optional<Box>& b) {
    if (!a || !b) return std::nullopt;
    Box out = *a;
    if (!b->is_empty()) out.add(*b);
    return out;
}

Reach reach_of_solid(const SolidState& solid) {
    const CellRef& root = solid.root();
    const Box& box = root.node->polygons().whole_source()->box();
    const bool holds_far = (root.node->winding() > 0) != root.complemented;
    return holds_far ? Reach{std::nullopt, box} : Reach{box, std::nullopt};
}

Reach reach_of_term(const Residual& f, const SolidStates& solids) {
    using Kind = Residual::Kind;
    if (f.kind == Kind::Slot) return reach_of_solid(*solids[as_index(f.slot)]);
    if (f.kind == Kind::Constant) return {};
    Reach out;
    for (std::size_t i = 0; i < f.children.size(); ++i) {
        const Reach term = with_enough_stack([&] { return reach_of_term(*f.children[i], solids); });
        if (i == 0) {
            out = term;
        } else if (f.kind == Kind::And) {
            out = {common(out.inside, term.inside), both(out.outside, term.outside)};
        } else if (f.kind == Kind::Or) {
            out = {both(out.inside, term.inside), common(out.outside, term.outside)};
        } else {
            out = {both(out.inside, term.inside), std::nullopt};
        }
    }
    return f.kind == Kind::Not ? out.flipped() : out;
}

}  // namespace

std::optional<Box> reach_of(const Residual& formula, const SolidStates& solids) {
    const Reach reach = reach_of_term(formula, solids);
    return reach.inside ? reach.inside : reach.outside;
}

}  // namespace trisect::detail
