// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/crossings.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/radix_sort.h>

namespace trisect::detail {

namespace {

// A formula that is one operation on operands and complements of operands.
class FlatFormula {
public:
    explicit FlatFormula(std::size_t slots) : decides_(slots, -1) {}

    /// False where it is something else.
    bool read(const Residual& formula) {
        const Residual* root = &formula;
        bool negated = false;
        for (; root->kind == Residual::Kind::Not; root = root->children[0].get())
            negated = !negated;
        if (root->kind != Residual::Kind::And && root->kind != Residual::Kind::Or) return false;
        is_union_ = (root->kind == Residual::Kind::Or) != negated;
        return add(*root, negated) &&
               std::ranges::none_of(decides_, [](std::int8_t v) { return v < 0; });
    }
    [[nodiscard]] bool is_union() const { return is_union_; }
    /// The winding number of an operand that decides the formula by itself.
    [[nodiscard]] std::int8_t decides(std::size_t slot) const { return decides_[slot]; }

private:
    bool add(const Residual& f, bool negated) {
        switch (f.kind) {
            case Residual::Kind::Slot: {
                std::int8_t& v = decides_[static_cast<std::size_t>(f.slot)];
                if (v >= 0) return false;
                v = is_union_ != negated ? 1 : 0;
                return true;
            }
            case Residual::Kind::Not:
                return with_enough_stack([&] { return add(*f.children[0], !negated); });
            case Residual::Kind::And:
            case Residual::Kind::Or:
                if (((f.kind == Residual::Kind::Or) != negated) != is_union_) return false;
                return std::ranges::all_of(f.children, [&](const Residual::Ref& c) {
                    return with_enough_stack([&] { return add(*c, negated); });
                });
            case Residual::Kind::Xor:
            case Residual::Kind::Constant:
                break;
        }
        return false;
    }

    bool is_union_ = false;
    std::vector<std::int8_t> decides_;
};

bool has_repeated_source(std::span<const Crossings::Operand> operands) {
    if (operands.size() == 2) return operands[0].serial == operands[1].serial;
    std::vector<std::uint64_t> serials;
    serials.reserve(operands.size());
    for (const Crossings::Operand& o : operands) serials.push_back(o.serial);
    std::ranges::sort(serials);
    return std::ranges::adjacent_find(serials) != serials.end();
}

}  // namespace

std::optional<Crossings> crossing_operands(
    std::span<const std::shared_ptr<const SolidState>> states, CrossingOperands kinds) {
    if (states.size() < 2) return std::nullopt;
    std::uint64_t facets = 0;
    Crossings out;
    out.operands.reserve(states.size());
    for (const auto& state : states) {
        const CellRef& root = state->root();
        const PolygonList* polygons = root.node->is_leaf() ? &root.node->polygons() : nullptr;
        if (polygons == nullptr || !polygons->has_all_facets() || !state->embedded)
            return std::nullopt;
        if (polygons->whole_source()->is_half_space() &&
            (kinds == CrossingOperands::Meshes || polygons->size() != 1 ||
             !polygons->whole_source()->is_unbounded()))
            return std::nullopt;
        Crossings::Operand& o = out.operands.emplace_back();
        o.serial = polygons->whole_source()->serial();
        o.flipped = polygons->flipped() != root.complemented;
        o.first = static_cast<std::uint32_t>(facets);
        facets += polygons->size();
        if (facets > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
    }
    if (has_repeated_source(out.operands)) return std::nullopt;
    return out;
}

std::optional<Crossings> crossings_of(const Residual& formula,
                                      std::span<const std::shared_ptr<const SolidState>> states,
                                      CrossingOperands kinds) {
    FlatFormula flat(states.size());
    if (!flat.read(formula)) return std::nullopt;
    std::optional<Crossings> out = crossing_operands(states, kinds);
    if (!out) return std::nullopt;
    for (std::size_t i = 0; i < states.size(); ++i) {
        Crossings::Operand& o = out->operands[i];
        o.open = static_cast<std::int8_t>(1 - flat.decides(i));
        // Above the source's facets is its outside.
        o.inside_above = flat.is_union() == ((o.flipped ? 1 : 0) == flat.decides(i));
    }
    return out;
}

std::size_t Crossings::operand_of(std::uint32_t number) const {
    const auto next = std::ranges::upper_bound(operands, number, {}, &Operand::first);
    return static_cast<std::size_t>(next - operands.begin()) - 1;
}

void Crossings::append(Crossings&& part) {
    if (pairs.empty()) {
        pairs = std::move(part.pairs);
    } else {
        pairs.insert(pairs.end(), part.pairs.begin(), part.pairs.end());
    }
    uncertain.insert(uncertain.end(), part.uncertain.begin(), part.uncertain.end());
    containments.insert(containments.end(), part.containments.begin(), part.containments.end());
    special.insert(special.end(), part.special.begin(), part.special.end());
}

void Crossings::arrange() {
    const auto make_unique = [](auto& list) {
        std::ranges::sort(list);
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    make_unique(uncertain);
    make_unique(hidden);
    make_unique(special);
    const std::uint64_t count = operands.size();
    radix_sort(containments, [count](const Containment& c) { return c.facet * count + c.operand; });
    containments.erase(std::unique(containments.begin(), containments.end()), containments.end());
    sort_pairs();
    list_shown();
    containments = {};
    hidden = {};
}

// By small keys: a crossing is a hundred bytes. Of as few digits as the facets need: each is a
// pass.
void Crossings::sort_pairs() {
    using Key = std::pair<std::uint64_t, std::uint32_t>;
    std::uint64_t last = 0;
    for (const FacetCrossing& c : pairs) last = std::max(last, std::uint64_t{c.facets[1]});
    PoolVector<Key> keys;
    keys.reserve(pairs.size());
    for (const FacetCrossing& c : pairs)
        keys.emplace_back(c.facets[0] * (last + 1) + c.facets[1],
                          static_cast<std::uint32_t>(keys.size()));
    radix_sort(keys, [](const Key& k) { return k.first; });
    keys.erase(std::unique(keys.begin(), keys.end(),
                           [](const Key& a, const Key& b) { return a.first == b.first; }),
               keys.end());
    PoolVector<FacetCrossing> sorted;
    sorted.reserve(keys.size());
    for (const auto& [facets, at] : keys) sorted.push_back(pairs[at]);
    pairs = std::move(sorted);
    for (std::uint32_t i = 0; i < keys.size(); ++i) keys[i] = {pairs[i].facets[1], i};
    radix_sort(keys, [](const Key& k) { return k.first; });
    by_second.clear();
    by_second.reserve(keys.size());
    for (const auto& [second, at] : keys) by_second.push_back(at);
}

// An operand that contains a part of a facet contains all of it unless it crosses it elsewhere.
void Crossings::list_shown() {
    std::size_t first = 0;   // in pairs
    std::size_t second = 0;  // in by_second
    auto containment = containments.begin();
    const auto crosses = [&](std::uint32_t operand, std::size_t p, std::size_t end_p, std::size_t q,
                             std::size_t end_q) {
        const auto is_of = [&](std::uint32_t facet) {
            return facet >= operands[operand].first &&
                   (operand + 1 == operands.size() || facet < operands[operand + 1].first);
        };
        for (; p < end_p; ++p)
            if (is_of(pairs[p].facets[1])) return true;
        for (; q < end_q; ++q)
            if (is_of(pairs[by_second[q]].facets[0])) return true;
        return false;
    };
    while (first < pairs.size() || second < by_second.size()) {
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        const std::uint32_t facet =
            std::min(first < pairs.size() ? pairs[first].facets[0] : none,
                     second < by_second.size() ? pairs[by_second[second]].facets[1] : none);
        const std::size_t p = first;
        const std::size_t q = second;
        while (first < pairs.size() && pairs[first].facets[0] == facet) ++first;
        while (second < by_second.size() && pairs[by_second[second]].facets[1] == facet) ++second;
        while (containment != containments.end() && containment->facet < facet) ++containment;
        bool is_covered = false;
        for (; containment != containments.end() && containment->facet == facet; ++containment)
            is_covered = is_covered || !crosses(containment->operand, p, first, q, second);
        if (std::ranges::binary_search(hidden, facet)) continue;
        if (!is_covered || std::ranges::binary_search(uncertain, facet)) shown.push_back(facet);
    }
}

}  // namespace trisect::detail
