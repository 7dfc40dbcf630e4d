// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/leaf_patches.h>

#include <algorithm>
#include <numeric>

namespace trisect::detail {

LeafPatches::LeafPatches(const LeafWork& work) : work_(work) {
    const auto n = work_.items.size();
    patch_.resize(n);
    std::iota(patch_.begin(), patch_.end(), 0);
    for (std::size_t i = 0; i < n; ++i) {
        const LeafItem& item = work_.items[i];
        if (item.ref.fragment != nullptr || item.ref.source->is_half_space()) continue;
        for (int k = 0; k < 3; ++k) {
            if (!edge_ends_in_cell(item, k)) continue;
            const auto next = static_cast<LeafIndex>(edge_users_.size());
            const auto [id, inserted] = edge_ids_.insert(edge_key(item, k), next);
            if (inserted) edge_users_.push_back({});
            EdgeUsers& users = edge_users_[LeafWork::u(id)];
            if (users.count < 2) users.item[LeafWork::u(users.count)] = static_cast<LeafIndex>(i);
            ++users.count;
        }
    }
    for (const EdgeUsers& e : edge_users_) {
        if (e.count < 2) continue;
        const LeafItem& a = work_.item(e.item[0]);
        const LeafItem& b = work_.item(e.item[1]);
        if (a.touched || b.touched || a.operand != b.operand) continue;
        if (a.orientation != b.orientation) continue;
        if (e.count > 2 && !work_.operand_of(a).embedded) continue;
        patch_[LeafWork::u(patch_of(e.item[0]))] = patch_of(e.item[1]);
    }
    within_cell_.assign(n, -1);
    for (std::size_t i = 0; i < n; ++i)
        if (work_.problem->cell.contains(work_.items[i].ref.box()))
            within_cell_[LeafWork::u(patch_of(static_cast<LeafIndex>(i)))] =
                static_cast<LeafIndex>(i);
}

bool LeafPatches::edge_ends_in_cell(const LeafItem& item, int k) const {
    const auto in_cell = [&](int corner) {
        Box b;
        b.add(item.ref.source->corner(item.ref.facet, corner));
        return work_.problem->cell.contains(b);
    };
    return in_cell(k) || in_cell((k + 1) % 3);
}

Key128 LeafPatches::edge_key(const LeafItem& item, int k) {
    const auto v = item.ref.source->corner_index(item.ref.facet, k);
    const auto w = item.ref.source->corner_index(item.ref.facet, (k + 1) % 3);
    return {(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(item.ref.source)) << 16) ^
                static_cast<std::uint64_t>(item.operand),
            (std::uint64_t{std::min(v, w)} << 32) | std::max(v, w)};
}

LeafIndex LeafPatches::patch_of(LeafIndex i) {
    while (patch_[LeafWork::u(i)] != i)
        i = patch_[LeafWork::u(i)] = patch_[LeafWork::u(patch_[LeafWork::u(i)])];
    return i;
}

}  // namespace trisect::detail
