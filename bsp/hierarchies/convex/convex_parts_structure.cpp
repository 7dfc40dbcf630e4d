// SPDX-License-Identifier: Apache-2.0
//
// After SWIFT++ (Ehmann and Lin 2001): walk down two trees of hulls, closest features instead of
// volumes. Hulls are the tightest convex volumes there are, and a walk from the features of the
// last pose takes a step or none; so few pairs are tested, each for more than a box costs. Where
// hulls meet, the larger one is replaced by its children: a concavity that its faces cover is
// looked into only then (Ponamgi, Manocha, Lin 1997).

#include <trisect/bsp/hierarchies/convex/convex_parts_structure.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include <trisect/bsp/hierarchies/convex/common_frame.h>
#include <trisect/bsp/hierarchies/convex/feature_walk.h>
#include <trisect/bsp/hierarchies/convex/walk_memory.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

namespace {

class ConvexPartsStructure final : public PairStructure {
public:
    ConvexPartsStructure(const InterferenceModel& a, const InterferenceModel& b,
                         const HullTreeOptions& options)
        : PairStructure(a, b) {
        const auto start = std::chrono::steady_clock::now();
        tree_a_.emplace(a, options);
        if (&trisect::detail::data_of(a) != &trisect::detail::data_of(b))
            tree_b_.emplace(b, options);
        const HullTree& other = tree_b();
        build_.bytes = tree_a_->bytes() + (tree_b_ ? tree_b_->bytes() : 0);
        build_.volumes = tree_a_->nodes().size() + (tree_b_ ? tree_b_->nodes().size() : 0);
        build_.depth = std::max(tree_a_->depth(), other.depth());
        build_.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        make_frame();
    }

    std::string_view name() const override { return "convex-parts"; }
    BuildReport build_report() const override { return build_; }

protected:
    void update(CostCounters&) override {
        make_frame();
        memory_.next_pose();
    }

    bool find_candidates(PairVisit visit, CostCounters& counters) override {
        std::vector<NodePair> stack{{0, 0}};
        while (!stack.empty()) {
            const NodePair at = stack.back();
            stack.pop_back();
            if (!walk(at, counters).closest().meet) continue;
            if (open(at, [&](const NodePair& child) { stack.push_back(child); })) continue;
            for (const std::uint32_t j : tree_b().triangles(node_b(at)))
                for (const std::uint32_t i : tree_a_->triangles(node_a(at)))
                    if (visit(i, j)) return true;
        }
        return false;
    }

    // Nearest first.
    void find_near(double limit, NearVisit visit, CostCounters& counters) override {
        struct Entry {
            double least;
            NodePair pair;
        };
        const auto farther = [](const Entry& a, const Entry& b) { return a.least > b.least; };
        std::vector<Entry> heap;
        const auto push = [&](const NodePair& pair, double parent) {
            const double least = std::max(parent, walk(pair, counters).bounds().lower);
            if (!(least <= limit)) return;
            heap.push_back({least, pair});
            std::push_heap(heap.begin(), heap.end(), farther);
        };
        push({0, 0}, 0);
        while (!heap.empty() && heap.front().least <= limit) {
            std::pop_heap(heap.begin(), heap.end(), farther);
            const Entry e = heap.back();
            heap.pop_back();
            if (open(e.pair, [&](const NodePair& child) { push(child, e.least); })) continue;
            for (const std::uint32_t j : tree_b().triangles(node_b(e.pair)))
                for (const std::uint32_t i : tree_a_->triangles(node_a(e.pair))) {
                    if (limit < 0) return;
                    limit = visit(i, j);
                }
        }
    }

private:
    struct NodePair {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
    };

    [[nodiscard]] const HullTree& tree_b() const { return tree_b_ ? *tree_b_ : *tree_a_; }
    [[nodiscard]] const HullTree::Node& node_a(const NodePair& p) const {
        return tree_a_->nodes()[p.a];
    }
    [[nodiscard]] const HullTree::Node& node_b(const NodePair& p) const {
        return tree_b().nodes()[p.b];
    }

    void make_frame() {
        frame_ = CommonFrame::in_lattice_of_a(pose_a(), model_a().lattice(), tree_a_->largest(),
                                              pose_b(), model_b().lattice(), tree_b().largest());
    }

    FeatureWalk walk(const NodePair& at, CostCounters& counters) {
        ++counters.volume_tests;
        FeatureWalk w(node_a(at).hull, node_b(at).hull, frame_);
        memory_.keep(at.a, at.b, w.run(memory_.start(at.a, at.b)).pair);
        return w;
    }

    // Calls take for the children of the node with more triangles; false for two leaves.
    template <class Take>
    bool open(const NodePair& at, const Take& take) const {
        const HullTree::Node& a = node_a(at);
        const HullTree::Node& b = node_b(at);
        if (a.is_leaf() && b.is_leaf()) return false;
        if (b.is_leaf() || (!a.is_leaf() && a.triangle_count >= b.triangle_count))
            for (std::uint32_t i = 0; i < a.child_count; ++i) take({a.first_child + i, at.b});
        else
            for (std::uint32_t i = 0; i < b.child_count; ++i) take({at.a, b.first_child + i});
        return true;
    }

    std::optional<HullTree> tree_a_;
    std::optional<HullTree> tree_b_;  // none where both models are one
    BuildReport build_;
    CommonFrame frame_;
    WalkMemory memory_;
};

}  // namespace

std::unique_ptr<PairStructure> make_convex_parts(const InterferenceModel& a,
                                                 const InterferenceModel& b) {
    return make_convex_parts(a, b, {});
}

std::unique_ptr<PairStructure> make_convex_parts(const InterferenceModel& a,
                                                 const InterferenceModel& b,
                                                 const HullTreeOptions& options) {
    return std::make_unique<ConvexPartsStructure>(a, b, options);
}

}  // namespace trisect::hierarchies
