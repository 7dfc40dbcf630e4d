// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/named_slots.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include <trisect/bsp/cells/lattice_move.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

// Of larger formulas, written out as trees, no copies are made.
constexpr std::uint32_t most_operations = 10000;

// What equal solids share.
const void* shared_part_of(const SolidState& state) {
    if (const auto* const tree = std::get_if<CellTree>(&state.form)) return tree->root.node.get();
    if (const auto* const prism = std::get_if<FlatPrism>(&state.form)) return prism->operand.get();
    return &state;
}

// \pre they share that
bool are_equal(const SolidState& a, const SolidState& b) {
    if (&a == &b) return true;
    if (!(a.lattice == b.lattice) || a.embedded != b.embedded || a.far_out != b.far_out ||
        a.form.index() != b.form.index())
        return false;
    if (const auto* const tree = std::get_if<CellTree>(&a.form))
        return tree->root.complemented == b.root().complemented && tree->incomplete.empty() &&
               b.tree().incomplete.empty();
    const auto* const prism = std::get_if<FlatPrism>(&a.form);
    if (prism == nullptr) return false;
    const auto& other = std::get<FlatPrism>(b.form);
    return prism->axis == other.axis && prism->low == other.low && prism->high == other.high;
}

// The number of the first slot with an equal solid, for each slot.
std::vector<std::size_t> first_equals(const std::vector<Solid>& slots) {
    std::vector<std::size_t> out;
    std::unordered_multimap<const void*, std::size_t> known;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const SolidState& state = *state_of(slots[i]);
        const void* const part = shared_part_of(state);
        std::size_t first = i;
        const auto [begin, end] = known.equal_range(part);
        for (auto at = begin; at != end; ++at)
            if (are_equal(*state_of(slots[at->second]), state)) first = at->second;
        if (first == i) known.emplace(part, i);
        out.push_back(first);
    }
    return out;
}

// A formula with other terms in place of its slots. Parts that are shared stay shared.
template <class TermOf>
class Rewriter {
public:
    explicit Rewriter(const TermOf& term_of) : term_of_(term_of) {}

    [[nodiscard]] Residual::Ref of(const Residual::Ref& f) {
        if (f->kind == Residual::Kind::Constant) return f;
        if (f->kind == Residual::Kind::Slot) return term_of_(static_cast<std::size_t>(f->slot));
        if (const auto at = known_.find(f.get()); at != known_.end()) return at->second;
        std::vector<Residual::Ref> terms;
        for (const Residual::Ref& c : f->children)
            terms.push_back(with_enough_stack([&] { return of(c); }));
        Residual::Ref out = f->kind == Residual::Kind::Not ? Residual::negation(std::move(terms[0]))
                                                           : Residual::combination(f->kind, terms);
        if (f.use_count() > 1) known_.emplace(f.get(), out);
        return out;
    }

private:
    const TermOf& term_of_;
    std::unordered_map<const Residual*, Residual::Ref> known_;
};

Translation over_slots(const Translation& t, const std::vector<std::size_t>& first,
                       const std::vector<std::uint8_t>& is_named) {
    Translation out;
    std::vector<Residual::Ref> terms(t.slots.size());
    for (std::size_t i = 0; i < t.slots.size(); ++i) {
        if (is_named[i] == 0) continue;
        terms[i] = Residual::of_slot(static_cast<std::int32_t>(out.slots.size()));
        out.slots.push_back(t.slots[i]);
    }
    const auto term_of = [&](std::size_t slot) { return terms[first[slot]]; };
    out.formula = Rewriter(term_of).of(t.formula);
    return out;
}

std::vector<std::uint8_t> named_slots(const Residual& formula,
                                      const std::vector<std::size_t>& first) {
    std::vector<std::uint8_t> out(first.size(), 0);
    for_each_slot(formula,
                  [&](std::int32_t slot) { out[first[static_cast<std::size_t>(slot)]] = 1; });
    return out;
}

// Written out as a tree.
class CopyWriter {
public:
    explicit CopyWriter(const Translation& t) : slots_(t.slots), is_named_(t.slots.size(), 0) {
        for (const Solid& s : slots_) {
            states_.push_back(cut_state(s));
            const Source* const mesh = mesh_of(*states_.back());
            facets_ += mesh == nullptr ? 0 : mesh->facet_count();
        }
    }

    [[nodiscard]] std::optional<Translation> write(const Residual& formula) {
        Translation out;
        out.formula = of(formula);
        if (out.formula == nullptr || slots_.size() == is_named_.size()) return std::nullopt;
        out.slots = std::move(slots_);
        return out;
    }

private:
    static const Source* mesh_of(const SolidState& state) {
        const auto* const tree = std::get_if<CellTree>(&state.form);
        if (tree == nullptr || !state.embedded) return nullptr;
        const CellNode& root = *tree->root.node;
        if (!root.is_leaf() || !root.polygons().has_all_facets()) return nullptr;
        const Source* const mesh = root.polygons().whole_source();
        if (mesh == nullptr || mesh->is_half_space() || root.polygons().flipped()) return nullptr;
        return mesh;
    }
    static Solid copy_of(const SolidState& state, const Source& mesh) {
        const CellRef& root = state.root();
        const auto source = mesh.moved(LatticeMove());
        auto copy = std::make_shared<SolidState>(state);
        copy->form =
            CellTree{{CellNode::leaf(PolygonList::all_facets(*source), root.node->reference(),
                                     root.node->winding(), root.node->is_mixed()),
                      root.complemented},
                     {},
                     nullptr};
        return solid_of(std::move(copy));
    }
    // Null where there is none.
    [[nodiscard]] Residual::Ref of(const Residual& f) {
        if (f.kind == Residual::Kind::Xor || f.kind == Residual::Kind::Constant) return nullptr;
        if (f.kind == Residual::Kind::Slot) return of_slot(static_cast<std::size_t>(f.slot));
        std::vector<Residual::Ref> terms;
        for (const Residual::Ref& c : f.children) {
            Residual::Ref term = with_enough_stack([&] { return of(*c); });
            if (term == nullptr) return nullptr;
            terms.push_back(std::move(term));
        }
        return f.kind == Residual::Kind::Not ? Residual::negation(std::move(terms[0]))
                                             : Residual::combination(f.kind, terms);
    }
    // Of two sources of one serial, as one on two lattices, the second one counts as a copy too.
    [[nodiscard]] Residual::Ref of_slot(std::size_t slot) {
        const Source* const mesh = mesh_of(*states_[slot]);
        const bool is_new = std::exchange(is_named_[slot], 1) == 0 &&
                            (mesh == nullptr || serials_.insert(mesh->serial()).second);
        if (is_new) return Residual::of_slot(static_cast<std::int32_t>(slot));
        if (mesh == nullptr || mesh->facet_count() > facets_) return nullptr;
        facets_ -= mesh->facet_count();
        slots_.push_back(copy_of(*states_[slot], *mesh));
        return Residual::of_slot(static_cast<std::int32_t>(slots_.size() - 1));
    }

    std::vector<Solid> slots_;
    std::vector<std::uint8_t> is_named_;
    SolidStates states_;
    std::unordered_set<std::uint64_t> serials_;
    std::uint64_t facets_ = 0;  // that copies may have
};

}  // namespace

Translation with_named_slots(Translation translation) {
    const std::vector<std::size_t> first = first_equals(translation.slots);
    const std::vector<std::uint8_t> is_named = named_slots(*translation.formula, first);
    const auto named = static_cast<std::size_t>(std::count(is_named.begin(), is_named.end(), 1));
    if (named == 0 || named == translation.slots.size()) return translation;
    return over_slots(translation, first, is_named);
}

std::optional<Translation> with_copies(const Translation& translation) {
    if (translation.formula->operations > most_operations) return std::nullopt;
    return CopyWriter(translation).write(*translation.formula);
}

}  // namespace trisect::detail
