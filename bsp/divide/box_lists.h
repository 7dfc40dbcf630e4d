// SPDX-License-Identifier: Apache-2.0
//
// Lists of packed boxes and their halves.
// Long ones are gone through by several threads; the outcome does not depend on their number. They
// are divided in two passes: with the numbers of each part's entries every part has places of its
// own in both halves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/packed_box.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

/// Smaller lists are not worth a thread.
inline constexpr std::size_t parallel_list = 32768;

/// The box of all. `threads`: 0 means as many as there are here.
[[nodiscard]] inline PackedBox box_of_list(std::span<const PackedBox> boxes,
                                           std::uint32_t threads) {
    const ParallelParts parts(boxes.size(), threads, parallel_list);
    if (parts.count() == 1) return box_of(boxes.data(), boxes.size());
    std::vector<PackedBox> of_parts(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        of_parts[part] = box_of(boxes.data() + begin, end - begin);
    });
    return box_of(of_parts.data(), of_parts.size());
}

/// Those that are met, in their order; for long lists.
[[nodiscard]] inline std::vector<PackedBox> boxes_that_meet(std::span<const PackedBox> boxes,
                                                            const PackedReach& reach,
                                                            std::uint32_t threads) {
    const ParallelParts parts(boxes.size(), threads, parallel_list);
    std::vector<std::vector<PackedBox>> of_parts(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        for (const PackedBox& e : boxes.subspan(begin, end - begin))
            if (reach.meets(e)) of_parts[part].push_back(e);
    });
    std::vector<PackedBox> out = std::move(of_parts[0]);
    for (std::size_t i = 1; i < of_parts.size(); ++i)
        out.insert(out.end(), of_parts[i].begin(), of_parts[i].end());
    return out;
}

/// Calls visit(box) for the boxes that meet a box, in their order, on the calling thread.
template <class Visit>
void for_each_meeting(std::span<const PackedBox> boxes, const PackedReach& reach,
                      std::uint32_t threads, const Visit& visit) {
    if (threads != 1 && boxes.size() >= 2 * parallel_list) {
        for (const PackedBox& e : boxes_that_meet(boxes, reach, threads)) visit(e);
        return;
    }
    for (const PackedBox& e : boxes)
        if (reach.meets(e)) visit(e);
}

/// Where a list is divided: below the rounded position `first_above`.
struct ListCut {
    std::size_t axis = 0;
    int first_above = 0;
    [[nodiscard]] bool has_below(const PackedBox& b) const {
        return b.lo[axis] < static_cast<std::int16_t>(first_above);
    }
    [[nodiscard]] bool has_above(const PackedBox& b) const {
        return b.minus_hi[axis] <= static_cast<std::int16_t>(-first_above);
    }
};

/// How many of a list are on one side alone.
struct HalfSizes {
    std::size_t below = 0;
    std::size_t above = 0;
};

// Every entry is written to the front and to the end of the room, which are advanced by the outcome
// of the comparisons.
inline HalfSizes divide_alone(std::span<const PackedBox> boxes, ListCut cut,
                              std::span<PackedBox> room, std::vector<PackedBox>& across) {
    PackedBox* below = room.data();
    PackedBox* above = room.data() + room.size();
    for (const PackedBox& e : boxes) {
        const bool b = cut.has_below(e);
        const bool a = cut.has_above(e);
        if (b && a) [[unlikely]] {
            across.push_back(e);
            continue;
        }
        copy(e, below);
        copy(e, above - 1);
        below += b ? 1 : 0;
        above -= a ? 1 : 0;
    }
    return {static_cast<std::size_t>(below - room.data()),
            static_cast<std::size_t>(room.data() + room.size() - above)};
}

// Of some entries: how many reach below, above, and to both sides.
struct Reaches {
    std::size_t below = 0;
    std::size_t above = 0;
    std::size_t both = 0;
};

inline Reaches reaches_of(std::span<const PackedBox> boxes, ListCut cut) {
    std::size_t below = 0;
    std::size_t above = 0;
    for (const PackedBox& e : boxes) {
        below += cut.has_below(e) ? 1 : 0;
        above += cut.has_above(e) ? 1 : 0;
    }
    // Each reaches to one side at least.
    return {below, above, below + above - boxes.size()};
}

// A part must not write where the next one does: one place for each entry.
inline void write_halves(std::span<const PackedBox> boxes, ListCut cut, PackedBox* below,
                         PackedBox* above, PackedBox* across) {
    for (const PackedBox& e : boxes) {
        const bool b = cut.has_below(e);
        const bool a = cut.has_above(e);
        if (b && a) [[unlikely]] {
            copy(e, across++);
            continue;
        }
        copy(e, b ? below : above - 1);
        below += b ? 1 : 0;
        above -= a ? 1 : 0;
    }
}

/// Writes those below to the front of `room`, in their order, those above to its end, in the
/// opposite order, and what reaches to both sides to `across`, in its order.
/// \pre room.size() == boxes.size()
inline HalfSizes divide_list(std::span<const PackedBox> boxes, const ListCut& cut,
                             std::span<PackedBox> room, std::vector<PackedBox>& across,
                             std::uint32_t threads) {
    across.clear();
    const ParallelParts parts(boxes.size(), threads, parallel_list);
    if (parts.count() == 1) return divide_alone(boxes, cut, room, across);
    std::vector<Reaches> counts(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        counts[part] = reaches_of(boxes.subspan(begin, end - begin), cut);
    });
    Reaches all;  // before each part
    for (Reaches& c : counts) {
        const Reaches here = c;
        c = {all.below - all.both, all.above - all.both, all.both};
        all = {all.below + here.below, all.above + here.above, all.both + here.both};
    }
    across.resize(all.both);
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        const Reaches& before = counts[part];
        write_halves(boxes.subspan(begin, end - begin), cut, room.data() + before.below,
                     room.data() + room.size() - before.above, across.data() + before.both);
    });
    return {all.below - all.both, all.above - all.both};
}

}  // namespace trisect::detail
