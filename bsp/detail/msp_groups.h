// SPDX-License-Identifier: Apache-2.0
//
// Groups: a list of items with boxes, kept in groups of some dozens, so that a plane passes by a
// whole group at the price of one test. A chain of n cuts, which every convex solid makes, visits
// n²/2 items; in groups it visits n²/128.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

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
    /// The strict side on which all of the box lies, or On when doubles cannot tell.
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
    std::uint32_t first_key = ~std::uint32_t{0};
    ItemIndex first_item = 0;  ///< that has the smallest key
    std::vector<ItemIndex> items;
};

class Groups {
public:
    [[nodiscard]] bool is_empty() const { return count_ == 0; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] std::vector<Group>& groups() { return groups_; }
    [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }

    /// Into a group of its own or that of the items added just before.
    void add(ItemIndex item, const Extent& extent, std::uint32_t key) {
        if (open_ == closed || groups_[open_].items.size() == Group::capacity) {
            open_ = groups_.size();
            groups_.emplace_back();
        }
        put(groups_[open_], item, extent, key);
        ++count_;
    }
    void add(Group&& group) {
        count_ += group.items.size();
        // A small one joins the others, or lists would end as groups of one item each.
        if (open_ != closed && group.items.size() + groups_[open_].items.size() <= join_limit) {
            Group& g = groups_[open_];
            g.items.insert(g.items.end(), group.items.begin(), group.items.end());
            g.extent.add(group.extent);
            if (group.first_key < g.first_key) {
                g.first_key = group.first_key;
                g.first_item = group.first_item;
            }
            return;
        }
        if (group.items.size() < join_limit / 2) open_ = groups_.size();
        groups_.push_back(std::move(group));
    }

    /// The i-th item in the order of groups.
    [[nodiscard]] ItemIndex item(std::size_t i) const {
        for (const Group& g : groups_) {
            if (i < g.items.size()) return g.items[i];
            i -= g.items.size();
        }
        return 0;
    }
    /// The item of the smallest key. \pre !is_empty()
    [[nodiscard]] ItemIndex first() const {
        return std::min_element(
                   groups_.begin(), groups_.end(),
                   [](const Group& a, const Group& b) { return a.first_key < b.first_key; })
            ->first_item;
    }

private:
    static constexpr std::size_t closed = ~std::size_t{0};
    static constexpr std::size_t join_limit = Group::capacity / 2;

    static void put(Group& g, ItemIndex item, const Extent& extent, std::uint32_t key) {
        g.extent.add(extent);
        g.items.push_back(item);
        if (key < g.first_key) {
            g.first_key = key;
            g.first_item = item;
        }
    }

    std::vector<Group> groups_;
    std::size_t open_ = closed;  // the group that takes single items
    std::size_t count_ = 0;
};

}  // namespace trisect::detail::msp
