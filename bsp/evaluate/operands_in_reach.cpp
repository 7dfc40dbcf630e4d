// SPDX-License-Identifier: Apache-2.0
//
// Of a formula, and of its complement, a box is known in which it lies, if it is bounded. An
// intersection is asked about where all boxes of its terms meet: elsewhere it is empty. An operand
// is what it is far out in a box that its own one is beside. If it is beside all in which it is
// asked about, that value may stand for it everywhere: no box gets larger by that, so each
// intersection stays empty where it was known to be.

#include <trisect/bsp/evaluate/operands_in_reach.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/named_slots.h>
#include <trisect/bsp/evaluate/user_box.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

constexpr std::size_t least_operands_in_reach = 3;

struct BoxedOperand {
    UserBox box;
    bool is_inside_far_out = false;
    bool is_kept = false;
};

std::vector<BoxedOperand> boxed_operands(const std::vector<Solid>& slots) {
    std::vector<BoxedOperand> out;
    out.reserve(slots.size());
    for (const Solid& s : slots) {
        const SolidState& state = *state_of(s);
        const auto box = box_around_mesh(state);
        if (!box) return {};
        out.push_back({*box, state.far_out != 0});
    }
    return out;
}

class OperandsInReach {
public:
    explicit OperandsInReach(std::vector<BoxedOperand> operands) : operands_(std::move(operands)) {}

    // Finds out which are kept. Written out as a tree.
    void look_at(const Residual& formula) {
        (void)reach_of_term(formula);
        keep(formula, UserBox::all());
    }
    // Those of the others.
    [[nodiscard]] SlotValues values() const {
        SlotValues out;
        for (const BoxedOperand& o : operands_)
            out.push_back(static_cast<std::int8_t>(o.is_kept ? -1 : (o.is_inside_far_out ? 1 : 0)));
        return out;
    }

private:
    // Boxes of a set and of its complement: all of space where one is not bounded.
    struct UserReach {
        UserBox inside = UserBox::all();
        UserBox outside = UserBox::all();
    };

    // In the order of a walk, terms after what they are of.
    UserReach reach_of_term(const Residual& f) {
        const std::size_t number = reaches_.size();
        reaches_.emplace_back();
        UserReach out;
        if (f.kind == Residual::Kind::Slot) {
            const BoxedOperand& o = operands_[as_index(f.slot)];
            (o.is_inside_far_out ? out.outside : out.inside) = o.box;
        } else if (f.kind == Residual::Kind::Constant) {
            (f.value ? out.outside : out.inside) = UserBox();
        } else {
            out = reach_of_operation(f);
        }
        return reaches_[number] = out;
    }

    UserReach reach_of_operation(const Residual& f) {
        UserReach all;       // what all terms have in common
        UserReach together;  // what they have together
        together.inside = together.outside = UserBox();
        for (const Residual::Ref& c : f.children) {
            const UserReach term = with_enough_stack([&] { return reach_of_term(*c); });
            all.inside = all.inside.intersected(term.inside);
            all.outside = all.outside.intersected(term.outside);
            together.inside.add(term.inside);
            together.outside.add(term.outside);
        }
        switch (f.kind) {
            case Residual::Kind::And:
                return {all.inside, together.outside};
            case Residual::Kind::Or:
                return {together.inside, all.outside};
            case Residual::Kind::Not:
                return {all.outside, all.inside};
            default:
                return {};
        }
    }

    // `box` has all in which the term is asked about.
    void keep(const Residual& f, UserBox box) {
        const UserReach& reach = reaches_[looked_at_++];
        if (f.kind == Residual::Kind::Slot) {
            BoxedOperand& o = operands_[as_index(f.slot)];
            o.is_kept = o.is_kept || !o.box.is_beside(box);
        }
        if (f.kind == Residual::Kind::And) box = box.intersected(reach.inside);
        if (f.kind == Residual::Kind::Or) box = box.intersected(reach.outside);
        for (const Residual::Ref& c : f.children) with_enough_stack([&] { keep(*c, box); });
    }

    std::vector<BoxedOperand> operands_;
    std::vector<UserReach> reaches_;
    std::size_t looked_at_ = 0;
};

}  // namespace

Translation with_operands_in_reach(Translation translation) {
    const std::size_t slots = translation.slots.size();
    // Where parts of the formula are named again and again it is not written out.
    if (slots < least_operands_in_reach || translation.formula->operations > 2 * slots)
        return translation;
    std::vector<BoxedOperand> operands = boxed_operands(translation.slots);
    if (operands.empty()) return translation;
    OperandsInReach search(std::move(operands));
    search.look_at(*translation.formula);
    Residual::Ref formula = simplified(translation.formula, search.values());
    if (formula == translation.formula) return translation;
    if (formula->kind == Residual::Kind::Constant)
        return {std::move(formula), {translation.slots.front()}};
    translation.formula = std::move(formula);
    return with_named_slots(std::move(translation));
}

}  // namespace trisect::detail
