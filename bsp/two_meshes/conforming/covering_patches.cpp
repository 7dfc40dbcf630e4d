// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/two_meshes/conforming/covering_patches.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include <trisect/bsp/two_meshes/conforming/edge_order.h>

namespace trisect::detail {

namespace {

// Facets of both meshes that are in one set.
class CoveringSet {
public:
    explicit CoveringSet(const CornerNames& names) : names_(names) {}

    [[nodiscard]] bool is_in_plane(std::span<const std::uint32_t> items) {
        corners_.clear();
        for (const std::uint32_t item : items) {
            const CornerNames::Triple& t = names_.corners(item);
            corners_.insert(corners_.end(), t.begin(), t.end());
        }
        std::ranges::sort(corners_);
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
        const CornerNames::Triple& t = names_.corners(items[0]);
        return std::ranges::all_of(corners_, [&](std::uint32_t v) {
            return v == t[0] || v == t[1] || v == t[2] ||
                   orientation(names_.point(t[0]), names_.point(t[1]), names_.point(t[2]),
                               names_.point(v)) == 0;
        });
    }

    // 1 where the borders of both meshes' facets are equal, -1 where one is the other backwards,
    // else 0.
    [[nodiscard]] int compare_borders(std::span<const std::uint32_t> items) {
        uses_.clear();
        for (const std::uint32_t item : items) {
            const CornerNames::Triple& t = names_.corners(item);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = t[k];
                const std::uint32_t to = t[(k + 1) % 3];
                Use use{{std::min(from, to), std::max(from, to)}, {}};
                use.often[names_.mesh_of(item)] = from < to ? 1 : -1;
                uses_.push_back(use);
            }
        }
        std::ranges::sort(uses_, {}, &Use::ends);
        bool same = true;
        bool opposite = true;
        for (std::size_t i = 0; i < uses_.size();) {
            std::array<int, 2> often{};
            std::size_t end = i;
            for (; end < uses_.size() && uses_[end].ends == uses_[i].ends; ++end)
                for (std::size_t mesh = 0; mesh < 2; ++mesh) often[mesh] += uses_[end].often[mesh];
            same = same && often[0] == often[1];
            opposite = opposite && often[0] == -often[1];
            i = end;
        }
        return same == opposite ? 0 : (same ? 1 : -1);
    }

private:
    struct Use {
        std::array<std::uint32_t, 2> ends;
        std::array<int, 2> often;  // by mesh, counted from the first end to the second one
    };
    const CornerNames& names_;
    std::vector<std::uint32_t> corners_;
    std::vector<Use> uses_;
};

}  // namespace

std::optional<CoveringPatches> find_covering(const CornerNames& names, const Patches& patches) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_root;
    for (std::uint32_t item = 0; item < names.item_count(); ++item) {
        if (!patches.is_covered(item)) continue;
        if (patches.side(item) != FacetRelation::Unknown) return std::nullopt;
        by_root.emplace_back(patches.root(item), item);
    }
    std::ranges::sort(by_root);
    CoveringPatches out;
    CoveringSet set(names);
    std::vector<std::uint32_t> items;
    for (std::size_t i = 0; i < by_root.size();) {
        items.clear();
        const std::uint32_t root = by_root[i].first;
        for (; i < by_root.size() && by_root[i].first == root; ++i)
            items.push_back(by_root[i].second);
        const int way = set.is_in_plane(items) ? set.compare_borders(items) : 0;
        if (way == 0) return std::nullopt;
        if (way < 0) out.opposite.insert(out.opposite.end(), items.begin(), items.end());
    }
    return out;
}

}  // namespace trisect::detail
