// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/flat/flat_boxes.h>

#include <numeric>

namespace trisect::detail {

FlatBoxes::FlatBoxes(std::vector<FlatBox> boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    boxes_ = std::move(boxes);
    if (order_.empty()) return;
    nodes_.reserve(order_.size());
    make(0, static_cast<std::uint32_t>(order_.size()));
    std::vector<FlatBox> sorted(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) sorted[i] = boxes_[order_[i]];
    boxes_ = std::move(sorted);
}

void FlatBoxes::make(std::uint32_t begin, std::uint32_t end) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    Node node{boxes_[order_[begin]], begin, end, 0};
    for (std::uint32_t i = begin + 1; i < end; ++i) node.box.add(boxes_[order_[i]]);
    nodes_.push_back(node);
    if (end - begin <= leaf_size) return;
    const std::size_t k =
        node.box.hi[0] - node.box.lo[0] >= node.box.hi[1] - node.box.lo[1] ? 0 : 1;
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto centre = [&](std::uint32_t i) { return boxes_[i].lo[k] + boxes_[i].hi[k]; };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t i, std::uint32_t j) {
                         return centre(i) != centre(j) ? centre(i) < centre(j) : i < j;
                     });
    make(begin, middle);
    nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
    make(middle, end);
}

}  // namespace trisect::detail
