// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/translate.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

// Iterative, and nested operators of one kind are joined as they are met: a chain of a hundred
// thousand differences is one conjunction, made in linear time.
class Translator {
public:
    Translation translate(const Expression& expression) {
        open(*expression.root());
        while (true) {
            Frame& f = frames_.back();
            if (f.pending.empty()) {
                const Residual::Ref done = close(f);
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
            if (next->kind == f.kind && f.kind != Expression::Kind::Not) {
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
        Expression::Kind kind = Expression::Kind::Leaf;
        std::vector<const Expression::Node*> pending;  // last first
        std::vector<Residual::Ref> done;
    };

    void open(const Expression::Node& node) {
        // Simplification and evaluation of formulas recurse over alternating operations.
        if (frames_.size() >= 4096)
            throw LimitError("the formula nests more than 4096 alternating operations");
        Frame f;
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
        if (inserted) out_.slots.push_back(solid);
        return Residual::of_slot(at->second);
    }

    std::vector<Frame> frames_;
    std::unordered_map<const SolidState*, std::int32_t> slots_;
    Translation out_;
};

}  // namespace

Translation translate(const Expression& expression) { return Translator().translate(expression); }

}  // namespace trisect::detail
