// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/scene/packed_phase.h>

#include <algorithm>
#include <cmath>

namespace trisect::hierarchies {

using detail::BodyBox;
using detail::BodyPair;

namespace {

bool is_bounded(const BodyBox& b) {
    // Lengths are finite as well, below.
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::abs(b.lo[k]) + std::abs(b.hi[k]);
    return sum < 0x1p1000;
}

}  // namespace

double PackedPhase::extent(const BodyBox& box) {
    return std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]});
}

void PackedPhase::insert(std::uint32_t slot, const BodyBox& box) {
    if (slot >= by_slot_.size()) by_slot_.resize(std::size_t{slot} + 1);
    by_slot_[slot] = box;
    stale_ = true;
}

void PackedPhase::update(std::uint32_t slot, const BodyBox& box) {
    stale_ = stale_ || *by_slot_[slot] != box;
    by_slot_[slot] = box;
}

void PackedPhase::remove(std::uint32_t slot) {
    by_slot_[slot].reset();
    stale_ = true;
}

std::size_t PackedPhase::bytes() const {
    return by_slot_.size() * sizeof(by_slot_[0]) + finite_.size() * sizeof(finite_[0]) +
           (slot_.size() + unbounded_.size()) * sizeof(slot_[0]) + cell_bytes();
}

void PackedPhase::pairs(std::vector<BodyPair>& out) {
    counts_ = {};
    out.clear();
    out_ = &out;
    if (stale_) {
        finite_.clear();
        slot_.clear();
        unbounded_.clear();
        for (std::uint32_t slot = 0; slot < by_slot_.size(); ++slot) {
            if (!by_slot_[slot]) continue;
            if (is_bounded(*by_slot_[slot])) {
                finite_.push_back(*by_slot_[slot]);
                slot_.push_back(slot);
            } else {
                unbounded_.push_back(slot);
            }
        }
        pack();
        cells_ = counts_.cells;
        counts_.moves = finite_.size();
        stale_ = false;
    }
    counts_.cells = cells_;
    find_pairs();
    for (std::size_t i = 0; i < unbounded_.size(); ++i) {
        const BodyBox& box = *by_slot_[unbounded_[i]];
        counts_.box_tests += finite_.size() + i;
        for (std::size_t j = 0; j < finite_.size(); ++j)
            if (box.meets(finite_[j])) keep(unbounded_[i], slot_[j]);
        for (std::size_t j = 0; j < i; ++j)
            if (box.meets(*by_slot_[unbounded_[j]])) keep(unbounded_[i], unbounded_[j]);
    }
    std::sort(out.begin(), out.end());
}

}  // namespace trisect::hierarchies
