// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/motion/solved_pairs.h>

#include <limits>

namespace trisect::detail {

std::uint64_t SolvedPairs::add(std::uint32_t part_a, std::uint32_t part_b, EarliestEvents& events) {
    const auto [number, is_new] =
        numbers_.insert({part_a, part_b}, static_cast<std::int32_t>(solved_.size()));
    const std::uint64_t compared = is_new ? solve(part_a, part_b) : 0;
    Pair& pair = solved_[static_cast<std::size_t>(number)];
    if (pair.search == search_) return compared;
    pair.search = search_;
    for (std::uint32_t i = pair.begin; i < pair.end; ++i)
        events.add(events_[i].time, events_[i].pair);
    return compared;
}

std::uint64_t SolvedPairs::solve(std::uint32_t part_a, std::uint32_t part_b) {
    const EventModel::Range of_a = a_.triangles_of(part_a);
    const EventModel::Range of_b = b_.triangles_of(part_b);
    EarliestEvents all(std::nullopt, std::numeric_limits<std::size_t>::max());
    for (std::uint32_t j = of_b.begin; j < of_b.end; ++j)
        for (std::uint32_t i = of_a.begin; i < of_a.end; ++i) pairs_.find(i, j, piece_, all);
    Pair& pair = solved_.emplace_back();
    pair.begin = static_cast<std::uint32_t>(events_.size());
    for (const EventsAtATime& at : all.events())
        for (const FeaturePair& p : at.pairs) events_.push_back({at.time, p});
    pair.end = static_cast<std::uint32_t>(events_.size());
    return std::uint64_t{of_a.end - of_a.begin} * (of_b.end - of_b.begin);
}

}  // namespace trisect::detail
