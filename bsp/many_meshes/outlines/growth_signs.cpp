// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/growth_signs.h>

#include <utility>

namespace trisect::detail {

void GrowthSigns::want(Effect one, Effect other) {
    if (one.if_it_grows == 0 && other.if_it_grows == 0) return;
    const auto number = static_cast<std::uint32_t>(wanted_.size());
    wanted_.push_back({one, other});
    of_slot_[one.slot].push_back(number);
    of_slot_[other.slot].push_back(number);
}

// What it brings about with it. A choice that what comes later cannot undo: whatever is wanted of
// what is chosen is done, so that the rest can be chosen as if that were all.
bool GrowthSigns::choose(std::uint32_t slot, std::int8_t sign, Signs& signs) const {
    std::vector<std::uint32_t> chosen{slot};
    signs[slot] = sign;
    while (!chosen.empty()) {
        const std::uint32_t s = chosen.back();
        chosen.pop_back();
        for (const std::uint32_t number : of_slot_[s]) {
            const auto& [one, other] = wanted_[number];
            const bool is_one = one.slot == s;
            if ((is_one ? one : other).if_it_grows * signs[s] > 0) continue;
            const Effect& rest = is_one ? other : one;
            if (rest.if_it_grows == 0) return false;
            const auto needed = static_cast<std::int8_t>(rest.if_it_grows);
            std::int8_t& known = signs[rest.slot];
            if (known != 0 && known != needed) return false;
            if (std::exchange(known, needed) == 0) chosen.push_back(rest.slot);
        }
    }
    return true;
}

std::optional<std::vector<std::int8_t>> GrowthSigns::near(
    const std::vector<std::int8_t>& given) const {
    Signs signs(of_slot_.size());
    for (std::uint32_t s = 0; s < signs.size(); ++s) {
        if (signs[s] != 0) continue;
        const Signs before = signs;
        if (choose(s, given[s], signs)) continue;
        signs = before;
        if (!choose(s, static_cast<std::int8_t>(-given[s]), signs)) return std::nullopt;
    }
    return signs;
}

}  // namespace trisect::detail
