// SPDX-License-Identifier: Apache-2.0
//
// The tree that interfere() and boundary_distance() use (bsp/interference/boxes/obb_tree.h), as one
// of the family: oriented boxes in floats, four side by side, one instruction for all four. Models
// have it already, so it costs nothing to build here; the report names what it took when they were
// made. A test of one box against four counts as four.

#include <algorithm>
#include <optional>
#include <vector>

#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>
#include <trisect/bsp/interference/boxes/obb_pose.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

namespace {

using detail::ObbChild;
using detail::ObbId;
using detail::ObbNode;
using detail::ObbTree;

class PackedBoxes final : public PairStructure {
public:
    using PairStructure::PairStructure;

    std::string_view name() const override { return "obb-packed"; }
    BuildReport build_report() const override {
        BuildReport r;
        for (const auto* m : {&data_a(), &data_b()}) {
            r.seconds += m->boxes_seconds;
            r.bytes += m->boxes.bytes();
            r.volumes += 4 * m->boxes.nodes.size();
            r.depth = std::max(r.depth, static_cast<unsigned>(m->boxes.depth));
        }
        return r;
    }

protected:
    void update(CostCounters& counters) override {
        pose_.emplace(data_a().boxes, data_b().boxes, placement().to_a);
        ++counters.updates;  // of the map; boxes are turned where they are tested
    }

    bool find_candidates(PairVisit visit, CostCounters& counters) override {
        const ObbTree& a = data_a().boxes;
        const ObbTree& b = data_b().boxes;
        if (pose_->is_apart()) return false;
        stack_.assign(1, {});
        while (!stack_.empty()) {
            const Pair p = stack_.back();
            stack_.pop_back();
            const ObbChild ca = a.child(p.a);
            const ObbChild cb = b.child(p.b);
            if (ca.is_leaf() && cb.is_leaf()) {
                for (std::uint32_t j = 0; j < cb.count(); ++j)
                    for (std::uint32_t i = 0; i < ca.count(); ++i)
                        if (visit(a.order[ca.first() + i], b.order[cb.first() + j])) return true;
                continue;
            }
            counters.volume_tests += 4;
            if (opens_b(p)) {
                const unsigned hits = pose_->overlaps(a.box(p.a), b.nodes[cb.node()]);
                for (std::uint32_t k = 0; k < 4; ++k)
                    if ((hits >> k & 1U) != 0) stack_.push_back({p.a, ObbId::of(cb.node(), k)});
            } else {
                const unsigned hits = pose_->overlaps(a.nodes[ca.node()], b.box(p.b));
                for (std::uint32_t k = 0; k < 4; ++k)
                    if ((hits >> k & 1U) != 0) stack_.push_back({ObbId::of(ca.node(), k), p.b});
            }
        }
        return false;
    }

    void find_near(double limit, NearVisit visit, CostCounters& counters) override {
        const ObbTree& a = data_a().boxes;
        const ObbTree& b = data_b().boxes;
        const auto later = [](const Entry& x, const Entry& y) { return x.gap > y.gap; };
        heap_.assign(1, {});
        while (!heap_.empty() && heap_.front().gap <= limit) {
            std::ranges::pop_heap(heap_, later);
            const Entry e = heap_.back();
            heap_.pop_back();
            const ObbChild ca = a.child(e.pair.a);
            const ObbChild cb = b.child(e.pair.b);
            if (ca.is_leaf() && cb.is_leaf()) {
                for (std::uint32_t j = 0; j < cb.count(); ++j)
                    for (std::uint32_t i = 0; i < ca.count(); ++i)
                        limit = visit(a.order[ca.first() + i], b.order[cb.first() + j]);
                continue;
            }
            const bool b_opened = opens_b(e.pair);
            counters.volume_tests += 4;
            const detail::Float4 gaps = b_opened
                                            ? pose_->best_gaps(a.box(e.pair.a), b.nodes[cb.node()])
                                            : pose_->best_gaps(a.nodes[ca.node()], b.box(e.pair.b));
            const ObbNode& opened = b_opened ? b.nodes[cb.node()] : a.nodes[ca.node()];
            for (std::uint32_t k = 0; k < 4; ++k) {
                if (!(opened.half[0][k] >= 0)) continue;
                const double gap =
                    std::max(e.gap, a.unit * static_cast<double>(gaps[k]) * (1 - 0x1p-20));
                if (gap > limit) continue;
                const Pair next{b_opened ? e.pair.a : ObbId::of(ca.node(), k),
                                b_opened ? ObbId::of(cb.node(), k) : e.pair.b};
                heap_.push_back({gap, next});
                std::ranges::push_heap(heap_, later);
            }
        }
    }

private:
    struct Pair {
        ObbId a;
        ObbId b;
    };
    struct Entry {
        double gap = 0;
        Pair pair;
    };

    // \pre not both are leaves.
    [[nodiscard]] bool opens_b(const Pair& p) const {
        const ObbTree& a = data_a().boxes;
        const ObbTree& b = data_b().boxes;
        if (a.child(p.a).is_leaf() || b.child(p.b).is_leaf()) return a.child(p.a).is_leaf();
        const auto size = [](const ObbTree& t, ObbId id) {
            const ObbNode& n = t.nodes[id.node()];
            return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
        };
        return pose_->scale() * size(b, p.b) > size(a, p.a);
    }

    std::optional<detail::ObbPose> pose_;
    std::vector<Pair> stack_;
    std::vector<Entry> heap_;
};

}  // namespace

std::unique_ptr<PairStructure> make_packed_obb_tree(const InterferenceModel& a,
                                                    const InterferenceModel& b) {
    return std::make_unique<PackedBoxes>(a, b);
}

}  // namespace trisect::hierarchies
