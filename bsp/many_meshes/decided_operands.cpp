// SPDX-License-Identifier: Apache-2.0
//
// Around a large operand there is a grid of cells. A small one whose box is in cells that hang
// together with what is far out is outside of the large one.

#include <trisect/bsp/many_meshes/decided_operands.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/many_meshes/outlines/boundary_cells.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

constexpr std::size_t least_operands = 64;
// A large operand has so many times as many facets as operands have on average.
constexpr std::uint64_t large = 16;
constexpr std::size_t most_large_terms = 64;

BoundaryCells cells_of(const Source& source) {
    BoundaryCells out(outline_box(source.box()), source.facet_count());
    for (std::uint32_t f = 0; f < source.facet_count(); ++f) {
        OutlineBox box = OutlineBox::none();
        for (int i = 0; i < 3; ++i) box.add(Approximation{source.corner(f, i).doubles(), 0.0});
        out.occupy(box);
    }
    out.find_parts();
    return out;
}

class Decider {
public:
    Decider(const NestedFormula& nested, std::span<const Source* const> sources,
            std::span<const std::uint8_t> open_far_out, std::uint32_t threads)
        : nested_(nested),
          sources_(sources),
          open_far_out_(open_far_out),
          large_terms_(nested_.size()) {
        for (const Source* s : sources) facet_count_ += s->facet_count();
        make_cells(threads);
        for (std::uint32_t n = 0; n < nested_.size(); ++n)
            for (const std::uint32_t t : nested_.node(n).terms)
                if (large_terms_[n].size() < most_large_terms && is_all_large(t))
                    large_terms_[n].push_back(t);
    }

    // Safe to call from many threads.
    [[nodiscard]] bool may_go(std::uint32_t leaf) const {
        const NestedFormula::Node& node = nested_.node(leaf);
        const auto slot = static_cast<std::size_t>(node.slot);
        // What is left is what it has far out, which must leave its operation alone.
        if (cells_[slot] || holds_far_out(slot) == nested_.node(node.parent).unites) return false;
        const OutlineBox box = outline_box(sources_[slot]->box());
        std::uint32_t n = leaf;
        for (std::uint32_t parent = node.parent; n != parent;
             n = std::exchange(parent, nested_.node(parent).parent)) {
            const int deciding = nested_.node(parent).unites ? 1 : 0;
            for (const std::uint32_t t : large_terms_[parent])
                if (t != n && value_around(t, box) == deciding) return true;
        }
        return false;
    }

private:
    void make_cells(std::uint32_t threads) {
        std::vector<std::size_t> large_ones;
        for (std::size_t s = 0; s < sources_.size(); ++s)
            if (is_large(*sources_[s])) large_ones.push_back(s);
        cells_.resize(sources_.size());
        ParallelParts(large_ones.size(), threads, 1)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i)
                    cells_[large_ones[i]] = cells_of(*sources_[large_ones[i]]);
            });
    }
    [[nodiscard]] bool is_large(const Source& source) const {
        return source.facet_count() * sources_.size() > large * facet_count_;
    }
    [[nodiscard]] bool is_all_large(std::uint32_t number) const {
        const NestedFormula::Node& node = nested_.node(number);
        if (node.slot >= 0) return cells_[static_cast<std::size_t>(node.slot)].has_value();
        return node.terms.size() <= most_large_terms &&
               std::ranges::all_of(node.terms, [&](std::uint32_t t) { return is_all_large(t); });
    }
    // With the complements that are above it.
    [[nodiscard]] bool holds_far_out(std::size_t slot) const { return open_far_out_[slot] != 0; }
    // Of a term of large operands; -1 where it may have both.
    [[nodiscard]] int value_around(std::uint32_t number, const OutlineBox& box) const {
        const NestedFormula::Node& node = nested_.node(number);
        if (node.slot >= 0) {
            const auto slot = static_cast<std::size_t>(node.slot);
            if (cells_[slot]->part_of(box) != BoundaryCells::outside) return -1;
            return holds_far_out(slot) ? 1 : 0;
        }
        const int deciding = node.unites ? 1 : 0;
        bool is_known = true;
        for (const std::uint32_t t : node.terms) {
            const int value = value_around(t, box);
            if (value == deciding) return deciding;
            is_known = is_known && value >= 0;
        }
        return is_known ? 1 - deciding : -1;
    }

    const NestedFormula& nested_;
    std::span<const Source* const> sources_;
    std::uint64_t facet_count_ = 0;
    std::span<const std::uint8_t> open_far_out_;
    std::vector<std::optional<BoundaryCells>> cells_;      // by slot
    std::vector<std::vector<std::uint32_t>> large_terms_;  // by node
};

}  // namespace

std::vector<std::uint8_t> decided_operands(const NestedFormula& nested,
                                           std::span<const Source* const> sources,
                                           std::span<const std::uint8_t> open_far_out,
                                           std::uint32_t threads) {
    std::vector<std::uint8_t> out(sources.size(), 0);
    if (out.size() < least_operands) return out;
    const Decider decider(nested, sources, open_far_out, threads);
    constexpr std::size_t least_nodes = 4096;  // for a thread
    ParallelParts(nested.size(), threads, least_nodes)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (auto n = static_cast<std::uint32_t>(begin); n < end; ++n)
                if (const std::int32_t slot = nested.node(n).slot; slot >= 0)
                    out[static_cast<std::size_t>(slot)] = decider.may_go(n) ? 1 : 0;
        });
    return out;
}

}  // namespace trisect::detail
