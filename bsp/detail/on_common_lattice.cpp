// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/on_common_lattice.h>

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>

#include <trisect/bsp/detail/leaf_arrangement.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

// Rebuilds one tree as a single unrefined leaf on a finer lattice. Walls of the old tree survive as
// edges of fragments only: on the finer lattice they would no longer be off the lattice.
class Refiner {
public:
    Refiner(int from, int to) : shift_(from - to), exponent_(to) {}

    CellRef refine(const CellRef& root) {
        visit(root, Cell{});
        const CellNode* node = root.node.get();
        bool complemented = root.complemented;
        while (!node->is_leaf()) {
            complemented = complemented != node->child(0).complemented;
            node = node->child(0).node.get();
        }
        FinePoint reference = node->reference();
        for (std::int64_t& c : reference.c) c = shifted(c);
        const int winding = complemented ? 1 - node->winding() : node->winding();
        return {CellNode::leaf(PolygonList(std::move(out_)), reference, winding, mixed_), false};
    }

private:
    [[nodiscard]] std::int64_t shifted(std::int64_t v) const {
        if (shift_ >= 62 || v > (universe_limit >> shift_) || v < -(universe_limit >> shift_))
            throw LimitError("a cell wall leaves the range of the common lattice of unit 2^" +
                             std::to_string(exponent_));
        return v << shift_;
    }

    const Source* renamed(const Source* s) {
        auto& r = sources_[s];
        if (!r) r = s->refined(exponent_);
        return r.get();
    }

    PolygonRef renamed(const PolygonRef& ref) {
        PolygonRef out = ref;
        out.source = renamed(ref.source);
        if (ref.fragment == nullptr) return out;
        std::vector<EdgeName> edges;
        for (EdgeName e : ref.fragment->edges()) {
            if (e.plane.is_wall()) {
                e.plane.owner = static_cast<std::uint64_t>(shifted(e.plane.position()));
            } else {
                e.plane.owner = reinterpret_cast<std::uintptr_t>(renamed(e.plane.source()));
            }
            edges.push_back(e);
        }
        Box box = ref.fragment->box();
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] *= std::int64_t{1} << shift_;
            box.hi[k] *= std::int64_t{1} << shift_;
        }
        out.fragment = new Fragment(std::move(edges), box);
        return out;
    }

    void visit(const CellRef& ref, const Cell& cell) {
        const CellNode& node = *ref.node;
        if (!node.is_leaf()) {
            for (int i = 0; i < 2; ++i) {
                CellRef c = node.child(i);
                c.complemented = c.complemented != ref.complemented;
                visit(c, i == 0 ? cell.below(node.axis(), node.wall())
                                : cell.above(node.axis(), node.wall()));
            }
            return;
        }
        mixed_ = mixed_ || node.is_mixed();
        for (const PolygonRef& r : node.polygons()) {
            bench_.clear();
            const auto part = clip_to_cell(bench_, r, cell);
            if (!part) continue;
            // Holds a clipped fragment until its copy on the new lattice is made.
            const PolygonList hold({*part});
            out_.push_back(renamed(*part));
            out_.back().flipped = part->flipped != ref.complemented;
        }
    }

    int shift_;
    int exponent_;
    bool mixed_ = false;
    std::vector<PolygonRef> out_;
    Workbench bench_;
    std::unordered_map<const Source*, std::shared_ptr<const Source>> sources_;
};

}  // namespace

Lattice move_to_common_lattice(std::vector<std::shared_ptr<const SolidState>>& states) {
    int finest = std::numeric_limits<int>::max();
    for (const auto& s : states)
        if (s->lattice_matters) finest = std::min(finest, s->lattice.exponent);
    if (finest == std::numeric_limits<int>::max()) return {};
    for (auto& s : states) {
        if (!s->lattice_matters || s->lattice.exponent == finest) continue;
        auto moved = std::make_shared<SolidState>(*s);
        moved->lattice.exponent = finest;
        moved->incomplete.clear();  // refining clips every facet to its cell
        moved->root = Refiner(s->lattice.exponent, finest).refine(s->root);
        s = std::move(moved);
    }
    return {finest};
}

}  // namespace trisect::detail
