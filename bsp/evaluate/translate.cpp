// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/translate.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

// Iterative, and nested operators of one kind are joined as they are met: a chain of a hundred
// thousand differences is one conjunction, made in linear time. Nodes with several parents are
// translated once and stay nodes with several parents; to find them, only those that somebody else
// holds as well have to be counted.
class Translator {
public:
    Translation translate(const Expression& expression) {
        count_parents(*expression.root());
        open(*expression.root());
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
            const Expression::Node* next = f.pending.back();
            f.pending.pop_back();
            if (const auto known = translated_.find(next); known != translated_.end()) {
                f.done.push_back(known->second);
            } else if (next->kind == f.kind && !is_shared(next) &&
                       f.kind != Expression::Kind::Not) {
                f.pending.insert(f.pending.end(), next->children.size(), nullptr);
                std::transform(next->children.rbegin(), next->children.rend(),
                               f.pending.end() - static_cast<std::ptrdiff_t>(next->children.size()),
                               [](const auto& c) { return c.get(); });
            } else if (next->kind == Expression::Kind::Leaf) {
                f.done.push_back(slot_of(next->solid));
            } else {
                open(*next);
            }
        }
    }

private:
    struct Frame {
        const Expression::Node* node = nullptr;
        Expression::Kind kind = Expression::Kind::Leaf;
        std::vector<const Expression::Node*> pending;  // last first
        std::vector<Residual::Ref> done;
    };

    void count_parents(const Expression::Node& root) {
        std::vector<const Expression::Node*> pending{&root};
        while (!pending.empty()) {
            const Expression::Node& n = *pending.back();
            pending.pop_back();
            for (const auto& c : n.children)
                if (c.use_count() == 1 || ++parents_[c.get()] == 1) pending.push_back(c.get());
        }
    }

    bool is_shared(const Expression::Node* node) const {
        const auto at = parents_.find(node);
        return at != parents_.end() && at->second > 1;
    }

    void open(const Expression::Node& node) {
        // Simplification and evaluation of formulas recurse over alternating operations.
        if (frames_.size() >= 4096)
            throw LimitError("the formula nests more than 4096 alternating operations");
        Frame f;
        f.node = &node;
        f.kind = node.kind;
        if (node.kind == Expression::Kind::Leaf) f.done.push_back(slot_of(node.solid));
        for (auto c = node.children.rbegin(); c != node.children.rend(); ++c)
            f.pending.push_back(c->get());
        frames_.push_back(std::move(f));
    }

    static Residual::Ref close(const Frame& f) {
        switch (f.kind) {
            case Expression::Kind::Leaf:
                return f.done[0];
            case Expression::Kind::Not:
                return Residual::negation(f.done[0]);
            case Expression::Kind::And:
                return Residual::combination(Residual::Kind::And, f.done);
            case Expression::Kind::Or:
                return Residual::combination(Residual::Kind::Or, f.done);
            case Expression::Kind::Xor:
                return Residual::combination(Residual::Kind::Xor, f.done);
        }
        return {};
    }

    Residual::Ref slot_of(const Solid& solid) {
        const auto next = static_cast<std::int32_t>(out_.slots.size());
        const auto [at, inserted] = slots_.insert({solid.state().get(), next});
        if (inserted) {
            out_.slots.push_back(solid);
            residuals_.push_back(Residual::of_slot(next));
        }
        return residuals_[static_cast<std::size_t>(at->second)];
    }

    std::vector<Frame> frames_;
    std::unordered_map<const SolidState*, std::int32_t> slots_;
    std::vector<Residual::Ref> residuals_;  // of the slots
    std::unordered_map<const Expression::Node*, std::uint32_t> parents_;
    std::unordered_map<const Expression::Node*, Residual::Ref> translated_;
    Translation out_;
};

}  // namespace

Translation translate(const Expression& expression) { return Translator().translate(expression); }

}  // namespace trisect::detail
