// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/flat/flat_boxes.h>

namespace trisect::detail {

FlatBoxes::FlatBoxes(const std::vector<FlatBox>& boxes) {
    if (boxes.empty()) return;
    items_.reserve(boxes.size());
    for (const FlatBox& box : boxes)
        items_.push_back({box, static_cast<std::uint32_t>(items_.size())});
    nodes_.reserve(boxes.size());
    (void)make(0, static_cast<std::uint32_t>(items_.size()));
}

// Halved where the centres lie, along the longer side of what contains these.
FlatBox FlatBoxes::make(std::uint32_t begin, std::uint32_t end) {
    const std::size_t number = nodes_.size();
    nodes_.push_back({items_[begin].box, begin, end, 0});
    if (end - begin <= leaf_size) {
        FlatBox box = items_[begin].box;
        for (std::uint32_t i = begin + 1; i < end; ++i) box.add(items_[i].box);
        nodes_[number].box = box;
        return box;
    }
    const auto centre = [](const Item& i, std::size_t k) { return i.box.lo[k] + i.box.hi[k]; };
    std::array<double, 2> low{centre(items_[begin], 0), centre(items_[begin], 1)};
    std::array<double, 2> high = low;
    for (std::uint32_t i = begin + 1; i < end; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], centre(items_[i], k));
            high[k] = std::max(high[k], centre(items_[i], k));
        }
    const std::size_t k = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
    const double cut = low[k] + (high[k] - low[k]) / 2;
    const auto first = items_.begin() + begin;
    const auto last = items_.begin() + end;
    auto middle = std::partition(first, last, [&](const Item& i) { return centre(i, k) < cut; });
    // Where one side has nearly all, the tree would be deep.
    const auto least = static_cast<std::ptrdiff_t>((end - begin + 7) / 8);
    if (middle - first < least || last - middle < least) {
        middle = first + (last - first) / 2;
        std::nth_element(first, middle, last, [&](const Item& i, const Item& j) {
            return centre(i, k) != centre(j, k) ? centre(i, k) < centre(j, k) : i.number < j.number;
        });
    }
    const auto split = static_cast<std::uint32_t>(middle - items_.begin());
    FlatBox box = make(begin, split);
    nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
    box.add(make(split, end));
    nodes_[number].box = box;
    return box;
}

}  // namespace trisect::detail
