// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/disjoint_operands.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/user_box.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

constexpr std::size_t least_disjoint_operands = 3;
constexpr std::size_t most_pairs_of_box = 64;

bool is_exclusive_or_of_slots(const Residual& formula) {
    return formula.kind == Residual::Kind::Xor &&
           formula.children.size() >= least_disjoint_operands &&
           std::ranges::all_of(formula.children, [](const Residual::Ref& c) {
               return c->kind == Residual::Kind::Slot;
           });
}

// The axis along which they overlap least.
std::size_t axis_of_sweep(const std::vector<UserBox>& boxes) {
    UserBox all;
    std::array<double, 3> lengths{};
    for (const UserBox& b : boxes) {
        all.add(b);
        for (std::size_t k = 0; k < 3; ++k) lengths[k] += b.hi[k] - b.lo[k];
    }
    std::size_t best = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (lengths[k] * (all.hi[best] - all.lo[best]) < lengths[best] * (all.hi[k] - all.lo[k]))
            best = k;
    return best;
}

// False where it would take too many pairs, too.
bool have_no_common_insides(std::vector<UserBox> boxes) {
    const std::size_t axis = axis_of_sweep(boxes);
    std::ranges::sort(boxes, {}, [axis](const UserBox& b) { return b.lo[axis]; });
    std::size_t left = most_pairs_of_box * boxes.size();
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size() && boxes[j].lo[axis] < boxes[i].hi[axis]; ++j)
            if (left-- == 0 || !boxes[i].has_no_inside_in(boxes[j])) return false;
    return true;
}

// Nothing where one is no imported mesh, or leaves open what is far out.
std::optional<std::vector<UserBox>> least_boxes(const Translation& t) {
    std::vector<UserBox> out;
    for (const Residual::Ref& c : t.formula->children) {
        const SolidState& state = *state_of(t.slots[as_index(c->slot)]);
        if (state.far_out != 0 || !box_around_mesh(state)) return std::nullopt;
        out.push_back(least_box_of_mesh(state));
        // Mostly the first two say that they overlap.
        if (out.size() == 2 && !out[0].has_no_inside_in(out[1])) return std::nullopt;
    }
    return out;
}

}  // namespace

Translation with_unions_of_disjoint(Translation translation) {
    if (!is_exclusive_or_of_slots(*translation.formula)) return translation;
    auto boxes = least_boxes(translation);
    if (!boxes || !have_no_common_insides(*std::move(boxes))) return translation;
    translation.formula = Residual::of_distinct(Residual::Kind::Or, translation.formula->children);
    return translation;
}

}  // namespace trisect::detail
