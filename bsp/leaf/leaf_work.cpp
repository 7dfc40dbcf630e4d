// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/leaf_work.h>

#include <algorithm>
#include <utility>

#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

void LeafWork::start(const LeafProblem& leaf, EvaluateStats& counters) {
    problem = &leaf;
    stats = &counters;
    bench.clear();
    items.clear();
    pieces.clear();
    steps.clear();
    incomplete.clear();
    surfaces_.clear();
    for (std::size_t o = 0; o < leaf.operands.size(); ++o) add_operand(static_cast<LeafIndex>(o));
    contacts_.clear();
    first_contact_.assign(items.size() + 1, 0);
}

void LeafWork::add_operand(LeafIndex operand) {
    const LeafOperand& o = problem->operands[as_index(operand)];
    const Box cell = problem->cell.lattice_box();
    const Source* source = nullptr;
    LeafIndex surface = -1;
    for (const PolygonRef& ref : o.polygons) {
        LeafItem& item = items.emplace_back();
        item.ref = ref;
        item.ref.flipped = ref.flipped != o.flipped;
        item.orientation = item.ref.flipped ? -1 : 1;
        item.operand = operand;
        item.side_of_reference = 2;
        if (ref.source != source) {
            source = ref.source;
            surface = surface_of(source, operand);
        }
        item.surface = surface;
        const Box& box = ref.box();
        item.contained = problem->cell.contains(box);
        // A cell without lattice points still has an inside: keep one unit around it.
        for (std::size_t k = 0; k < 3; ++k) {
            item.box.lo[k] = std::max(box.lo[k], cell.lo[k] - 1);
            item.box.hi[k] = std::min(box.hi[k], cell.hi[k] + 1);
        }
        if (ref.fragment == nullptr && ref.source->is_half_space()) {
            // Unbounded: the cell bounds it.
            item.shape = bench.clipped(bench.polygon(ref), box, problem->cell);
            if (item.shape.is_empty()) items.pop_back();
        }
    }
}

LeafIndex LeafWork::surface_of(const Source* source, LeafIndex operand) {
    const Key128 key{reinterpret_cast<std::uintptr_t>(source), static_cast<std::uint64_t>(operand)};
    return surfaces_.insert(key, static_cast<LeafIndex>(surfaces_.size())).first;
}

void LeafWork::set_contacts(std::span<const std::pair<LeafIndex, LeafContact>> pairs) {
    // Counting sort by item: `first_contact_[i + 1]` runs from the start of item i to its end.
    std::fill(first_contact_.begin(), first_contact_.end(), 0);
    for (const auto& p : pairs) ++first_contact_[as_index(p.first) + 1];
    std::size_t before = 0;
    for (std::size_t i = 1; i < first_contact_.size(); ++i) {
        const std::size_t count = first_contact_[i];
        first_contact_[i] = before;
        before += count;
    }
    contacts_.resize(pairs.size());
    for (const auto& [item, contact] : pairs)
        contacts_[first_contact_[as_index(item) + 1]++] = contact;
    for (std::size_t i = 0; i + 1 < first_contact_.size(); ++i) {
        const auto at = [&](std::size_t k) {
            return contacts_.begin() + static_cast<std::ptrdiff_t>(first_contact_[k]);
        };
        std::sort(at(i), at(i + 1),
                  [](const LeafContact& a, const LeafContact& b) { return a.other < b.other; });
    }
}

}  // namespace trisect::detail
