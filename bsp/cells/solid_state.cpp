// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/solid_state.h>

#include <trisect/bsp/cells/lazy_tree.h>

namespace trisect::detail {

namespace {

struct TreeOf {
    std::shared_ptr<const LazyTree> operator()(const CellTree&) const { return nullptr; }
    template <class Form>
    std::shared_ptr<const LazyTree> operator()(const Form& form) const {
        return form.tree;
    }
};

}  // namespace

std::shared_ptr<const LazyTree> SolidState::lazy_tree() const { return std::visit(TreeOf(), form); }

std::int8_t far_out_of(const Residual& formula,
                       std::span<const std::shared_ptr<const SolidState>> solids) {
    SlotValues values;
    values.reserve(solids.size());
    for (const auto& s : solids) values.push_back(s->far_out);
    return static_cast<std::int8_t>(bounded_value_of(formula, values));
}

}  // namespace trisect::detail
