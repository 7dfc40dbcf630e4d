// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/translate.h>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <variant>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/bsp/evaluate/expression_node.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

namespace {

// Meshes with fewer facets are not looked at: what coincides in them costs little.
constexpr std::uint32_t least_facets = 64;

// The mesh that a solid was imported from, if the solid is still that; else null.
const Source* imported_mesh_of(const SolidState& solid) {
    const auto* const tree = std::get_if<CellTree>(&solid.form);
    if (tree == nullptr) return nullptr;
    const CellNode& root = *tree->root.node;
    if (!root.is_leaf() || !root.polygons().has_all_facets()) return nullptr;
    const Source* const source = root.polygons().whole_source();
    return source == nullptr || source->is_half_space() || source->facet_count() < least_facets
               ? nullptr
               : source;
}

// The same points and triangles in the same order, and the same side of them.
bool are_equal_meshes(const SolidState& a, const SolidState& b) {
    const LatticeMesh& m = imported_mesh_of(a)->mesh();
    const LatticeMesh& n = imported_mesh_of(b)->mesh();
    return a.lattice == b.lattice && a.embedded == b.embedded && a.far_out == b.far_out &&
           a.root().complemented == b.root().complemented &&
           a.root().node->polygons().flipped() == b.root().node->polygons().flipped() &&
           m.triangles == n.triangles && m.points == n.points;
}

// Of what equal meshes have in common and most others have not.
std::uint64_t key_of(const Source& mesh) {
    std::uint64_t key = mesh.facet_count();
    for (const auto& corner : {mesh.box().lo, mesh.box().hi})
        for (const std::int64_t c : corner) key = mix64(key ^ static_cast<std::uint64_t>(c));
    return key;
}

// Iterative, and nested operators of one kind are joined as they are met: a chain of a hundred
// thousand differences is one conjunction, made in linear time. Nodes with several parents are
// translated once and stay nodes with several parents; to find them, only those with other owners
// have to be counted.
class Translator {
public:
    explicit Translator(bool has_values) : has_values_(has_values) {}

    Translation translate(const Expression& expression) {
        count_parents(*root_of(expression));
        open(*root_of(expression));
        while (true) {
            Frame& f = frames_.back();
            if (f.pending.empty()) {
                const Residual::Ref done = close(f);
                if (is_shared(f.node)) translated_.emplace(f.node, done);
                frames_.pop_back();
                if (frames_.empty()) {
                    out_.formula = done;
                    return std::move(out_);
                }
                frames_.back().done.push_back(done);
                continue;
            }
            const ExpressionNode* next = f.pending.back();
            f.pending.pop_back();
            if (const auto known = translated_.find(next); known != translated_.end()) {
                f.done.push_back(known->second);
            } else if (next->kind == f.kind && !is_shared(next) &&
                       f.kind != ExpressionNode::Kind::Not) {
                f.pending.insert(f.pending.end(), next->children.size(), nullptr);
                std::transform(next->children.rbegin(), next->children.rend(),
                               f.pending.end() - static_cast<std::ptrdiff_t>(next->children.size()),
                               [](const auto& c) { return c.get(); });
            } else if (next->kind == ExpressionNode::Kind::Leaf) {
                f.done.push_back(slot_of(next->solid));
            } else {
                open(*next);
            }
        }
    }

private:
    struct Frame {
        const ExpressionNode* node = nullptr;
        ExpressionNode::Kind kind = ExpressionNode::Kind::Leaf;
        std::vector<const ExpressionNode*> pending;  // last first
        std::vector<Residual::Ref> done;
    };

    void count_parents(const ExpressionNode& root) {
        std::vector<const ExpressionNode*> pending{&root};
        std::size_t leaves = 0;
        while (!pending.empty()) {
            const ExpressionNode& n = *pending.back();
            pending.pop_back();
            leaves += n.kind == ExpressionNode::Kind::Leaf ? 1 : 0;
            for (const auto& c : n.children)
                if (c.use_count() == 1 || ++parents_[c.get()] == 1) pending.push_back(c.get());
        }
        slots_.reserve(leaves);
        meshes_.reserve(leaves);
    }

    bool is_shared(const ExpressionNode* node) const {
        const auto at = parents_.find(node);
        return at != parents_.end() && at->second > 1;
    }

    void open(const ExpressionNode& node) {
        // Simplification and evaluation of formulas recurse over alternating operations.
        if (frames_.size() >= 4096)
            throw LimitError("the formula nests more than 4096 alternating operations");
        Frame f;
        f.node = &node;
        f.kind = node.kind;
        if (node.kind == ExpressionNode::Kind::Leaf) f.done.push_back(slot_of(node.solid));
        for (auto c = node.children.rbegin(); c != node.children.rend(); ++c)
            f.pending.push_back(c->get());
        frames_.push_back(std::move(f));
    }

    static Residual::Ref close(const Frame& f) {
        switch (f.kind) {
            case ExpressionNode::Kind::Leaf:
                return f.done[0];
            case ExpressionNode::Kind::Not:
                return Residual::negation(f.done[0]);
            case ExpressionNode::Kind::And:
                return Residual::combination(Residual::Kind::And, f.done);
            case ExpressionNode::Kind::Or:
                return Residual::combination(Residual::Kind::Or, f.done);
            case ExpressionNode::Kind::Xor:
                return Residual::combination(Residual::Kind::Xor, f.done);
        }
        return {};
    }

    Residual::Ref slot_of(const Solid& solid) {
        const SolidState& state = *detail::state_of(solid);
        if (has_values_ && !state.lattice_matters && state.far_out >= 0)
            return Residual::constant(state.far_out > 0);
        const auto next = static_cast<std::int32_t>(out_.slots.size());
        const auto [at, inserted] = slots_.insert({detail::state_of(solid).get(), next});
        if (inserted) {
            at->second = slot_of_equal_mesh(*detail::state_of(solid), next);
            if (at->second == next) {
                out_.slots.push_back(solid);
                residuals_.push_back(Residual::of_slot(next));
            }
        }
        return residuals_[static_cast<std::size_t>(at->second)];
    }

    // A file that was read twice is one operand: nothing has to be compared then, where all would
    // coincide.
    std::int32_t slot_of_equal_mesh(const SolidState& solid, std::int32_t next) {
        const Source* const mesh = imported_mesh_of(solid);
        if (mesh == nullptr) return next;
        const std::uint64_t key = key_of(*mesh);
        const auto [begin, end] = meshes_.equal_range(key);
        for (auto known = begin; known != end; ++known)
            if (are_equal_meshes(
                    *detail::state_of(out_.slots[static_cast<std::size_t>(known->second)]), solid))
                return known->second;
        meshes_.emplace(key, next);
        return next;
    }

    bool has_values_;
    std::vector<Frame> frames_;
    std::unordered_map<const SolidState*, std::int32_t> slots_;
    std::unordered_multimap<std::uint64_t, std::int32_t> meshes_;  // slots of imported meshes
    std::vector<Residual::Ref> residuals_;                         // of the slots
    std::unordered_map<const ExpressionNode*, std::uint32_t> parents_;
    std::unordered_map<const ExpressionNode*, Residual::Ref> translated_;
    Translation out_;
};

}  // namespace

Translation translate(const Expression& expression) {
    return Translator(false).translate(expression);
}

Translation translate_without_constants(const Expression& expression) {
    Translation out = Translator(true).translate(expression);
    return out.slots.empty() ? translate(expression) : out;
}

}  // namespace trisect::detail
