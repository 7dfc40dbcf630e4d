// SPDX-License-Identifier: Apache-2.0
//
// Groups: a list of items with boxes, in groups of some dozens.
// A plane passes by a whole group at the price of one test. A chain of n cuts, which every convex
// solid makes, visits n²/2 items; in groups it visits n²/128.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/bsp/msp/msp_oriented_box.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail::msp {

/// A closed box in doubles that contains what it is made of.
class Extent {
public:
    void add(const Approximation& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = std::min(lo_[k], p.c[k] - p.error);
            hi_[k] = std::max(hi_[k], p.c[k] + p.error);
        }
    }
    void add(const Extent& e) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = std::min(lo_[k], e.lo_[k]);
            hi_[k] = std::max(hi_[k], e.hi_[k]);
        }
    }
    /// Squared length of the diagonal.
    [[nodiscard]] double size() const {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += (hi_[k] - lo_[k]) * (hi_[k] - lo_[k]);
        return sum;
    }
    /// The strict side on which all of the box lies, or On when doubles cannot decide.
    [[nodiscard]] Side side(const Plane& plane) const {
        double s = plane.approx_offset();
        double reach = 0;
        double terms = std::fabs(s);
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const double n = plane.approx_normal(i);
            const double centre = 0.5 * (lo_[k] + hi_[k]);
            const double half = 0.5 * (hi_[k] - lo_[k]);
            s += n * centre;
            reach += std::fabs(n) * half;
            terms += std::fabs(n) * (std::fabs(centre) + half);
        }
        // Some ten roundings of relative size 2^-53, each of at most `terms`; the box's own ends
        // carry one rounding of their size, which `terms` covers too.
        const double bound = reach + 0x1p-47 * terms;
        return s > bound ? Side::Above : (s < -bound ? Side::Below : Side::On);
    }

private:
    std::array<double, 3> lo_{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    std::array<double, 3> hi_{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

using ItemIndex = std::uint32_t;

struct Group {
    static constexpr std::size_t capacity = 64;

    Extent extent;
    std::optional<OrientedBox> oriented;  ///< made on demand
    std::uint32_t first_key = ~std::uint32_t{0};
    ItemIndex first_item = 0;  ///< that has the smallest key
    std::vector<ItemIndex> items;

    void add(ItemIndex item, const Extent& e, std::uint32_t key) {
        extent.add(e);
        oriented.reset();
        items.push_back(item);
        if (key < first_key) {
            first_key = key;
            first_item = item;
        }
    }
    void add(const Group& other) {
        extent.add(other.extent);
        oriented.reset();
        items.insert(items.end(), other.items.begin(), other.items.end());
        if (other.first_key < first_key) {
            first_key = other.first_key;
            first_item = other.first_item;
        }
    }
};

class Groups {
public:
    using Pointer = std::unique_ptr<Group>;

    [[nodiscard]] bool is_empty() const { return count_ == 0; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] std::vector<Pointer>& groups() { return groups_; }
    [[nodiscard]] const std::vector<Pointer>& groups() const { return groups_; }

    /// Into a group of its own or that of the items added just before.
    void add(ItemIndex item, const Extent& extent, std::uint32_t key) {
        if (open_ == closed || groups_[open_]->items.size() == Group::capacity) {
            open_ = groups_.size();
            groups_.push_back(std::make_unique<Group>());
        }
        groups_[open_]->add(item, extent, key);
        ++count_;
    }
    void add(Pointer group) {
        const std::size_t size = group->items.size();
        count_ += size;
        // A small one joins the others, or lists would end as groups of one item each.
        if (open_ != closed && size + groups_[open_]->items.size() <= join_limit) {
            groups_[open_]->add(*group);
            return;
        }
        if (size < join_limit / 2) open_ = groups_.size();
        groups_.push_back(std::move(group));
    }

    /// The i-th item in the order of groups.
    [[nodiscard]] ItemIndex item(std::size_t i) const {
        for (const Pointer& g : groups_) {
            if (i < g->items.size()) return g->items[i];
            i -= g->items.size();
        }
        return 0;
    }
    /// The item of the smallest key. \pre !is_empty()
    [[nodiscard]] ItemIndex first() const {
        return (*std::min_element(
                    groups_.begin(), groups_.end(),
                    [](const Pointer& a, const Pointer& b) { return a->first_key < b->first_key; }))
            ->first_item;
    }

    /// On which strict side of the plane a group of this list lies, or On when it has to be looked
    /// at. `items.points(i)` calls back with the points of an item.
    ///
    /// A long list may take the trouble of a tighter box. It does so now and then (`turn` counts
    /// cuts): a group near the cuts is made anew at each of them, and would be measured in vain.
    template <class Items>
    [[nodiscard]] Side side(Group& g, const Items& items, const Plane& plane,
                            std::size_t turn) const {
        const Side s = g.extent.side(plane);
        if (s != Side::On || count_ < long_list) return s;
        if (!g.oriented && turn % turns_between != 0) return s;
        if (!g.oriented) {
            std::vector<Approximation> points;
            for (const ItemIndex i : g.items)
                items.points(i, [&points](const Approximation& p) { points.push_back(p); });
            g.oriented.emplace(points);
        }
        return g.oriented->side(plane);
    }

private:
    static constexpr std::size_t closed = ~std::size_t{0};
    static constexpr std::size_t join_limit = Group::capacity / 2;
    static constexpr std::size_t long_list = 4096;  // from here on the tighter box pays
    static constexpr std::size_t turns_between = 8;

    std::vector<Pointer> groups_;
    std::size_t open_ = closed;  // the group that takes single items
    std::size_t count_ = 0;
};

}  // namespace trisect::detail::msp
