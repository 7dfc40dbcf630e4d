// SPDX-License-Identifier: Apache-2.0
//
// The kinds of volumes that the walk of volume_hierarchy.h is made for.

#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>

#include <trisect/bsp/hierarchies/volumes/kdop.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchy.h>

namespace trisect::hierarchies {

std::vector<TreeItem> items_of(const detail::InterferenceModelData& model, const TreeFrame& frame) {
    std::vector<TreeItem> items(model.triangles.size());
    for (std::size_t t = 0; t < items.size(); ++t) {
        TreeItem& item = items[t];
        item.lo = item.hi = frame(model.position(model.triangles[t].vertex[0]));
        for (std::size_t i = 1; i < 3; ++i) {
            const std::array<double, 3> p = frame(model.position(model.triangles[t].vertex[i]));
            for (std::size_t k = 0; k < 3; ++k) {
                item.lo[k] = std::min(item.lo[k], p[k]);
                item.hi[k] = std::max(item.hi[k], p[k]);
            }
        }
        for (std::size_t k = 0; k < 3; ++k) item.center[k] = 0.5 * (item.lo[k] + item.hi[k]);
    }
    return items;
}

namespace {

template <std::size_t K>
struct KDopKind {
    using Volume = KDop<K>;
    using Moved = KDop<K>;
    class Pose {
    public:
        explicit Pose(const FrameMap& map) : turn_(KDop<K>::directions, map) {}
        [[nodiscard]] Moved moved(const Volume& v) const { return v.turned(turn_); }
        [[nodiscard]] static bool meet(const Volume& a, const Moved& b) { return a.meets(b); }
        [[nodiscard]] static double gap(const Volume& a, const Moved& b) { return a.gap(b); }

    private:
        KDopTurn turn_;
    };
    static constexpr bool has_unite = true;
    static Volume fit(std::span<const std::array<double, 3>> corners, double error) {
        Volume r;
        r.add(corners, error);
        return r;
    }
    static Volume unite(std::span<const Volume> volumes) {
        Volume r;
        for (const Volume& v : volumes) r.add(v);
        return r;
    }
    static float size(const Volume& v) { return v.size(); }
    static VolumeOutline outline(const Volume& v) {
        VolumeOutline out;
        for (std::size_t i = 0; i < KDop<K>::n; ++i) {
            Slab slab;
            for (std::size_t k = 0; k < 3; ++k) slab.direction[k] = KDop<K>::directions[i][k];
            slab.lower = -v.h[KDop<K>::n + i];
            slab.upper = v.h[i];
            out.slabs.push_back(slab);
        }
        return out;
    }
};

// Slabs that are fitted to the moved triangles of B at every pose, from the leaves up.
template <std::size_t K>
class RefittedSlabs final : public VolumeHierarchy<KDopKind<K>> {
    using Base = VolumeHierarchy<KDopKind<K>>;

public:
    using Base::Base;

protected:
    void update(CostCounters& counters) override {
        Base::update(counters);
        const detail::InterferenceModelData& model = this->data_b();
        const TreeFrame& frame = this->b_.frame;
        const FrameMap map(this->a_.frame, frame, this->placement().to_a);
        points_.resize(model.positions.size());
        for (std::size_t i = 0; i < points_.size(); ++i)
            points_[i] = map(frame(model.positions[i]));
        const double error = 2 * map.stretch * frame.error + map.error();
        auto& moved = this->moved_;
        for (std::size_t i = moved.size(); i-- > 0;) {
            const TreeNode& node = this->b_.shape.nodes[i];
            KDop<K> slabs;
            if (node.leaf) {
                corners_.clear();
                for (const std::uint32_t t : this->b_.shape.things(node))
                    for (const VertexId v : model.triangles[t].vertex)
                        corners_.push_back(points_[v.index]);
                slabs.add(corners_, error);
            } else {
                for (std::uint32_t k = 0; k < node.count; ++k) slabs.add(moved[node.first + k]);
            }
            moved[i] = slabs;
            this->moved_at_[i] = this->pose_number_;
        }
        counters.updates += moved.size();
    }

private:
    std::vector<std::array<double, 3>> points_;
    std::vector<std::array<double, 3>> corners_;
};

template <std::size_t K>
std::unique_ptr<PairStructure> make_kdop_tree(const InterferenceModel& a,
                                              const InterferenceModel& b, std::string_view name,
                                              const TreeOptions& options = {}) {
    return std::make_unique<VolumeHierarchy<KDopKind<K>>>(a, b, options, name);
}

}  // namespace

std::unique_ptr<PairStructure> make_aabb_tree(const InterferenceModel& a,
                                              const InterferenceModel& b) {
    return std::make_unique<RefittedSlabs<6>>(a, b, TreeOptions{}, "aabb");
}
std::unique_ptr<PairStructure> make_refitted_kdop18_tree(const InterferenceModel& a,
                                                         const InterferenceModel& b) {
    return std::make_unique<RefittedSlabs<18>>(a, b, TreeOptions{}, "kdop18-refit");
}
std::unique_ptr<PairStructure> make_kdop6_tree(const InterferenceModel& a,
                                               const InterferenceModel& b) {
    return make_kdop_tree<6>(a, b, "kdop6");
}
std::unique_ptr<PairStructure> make_kdop14_tree(const InterferenceModel& a,
                                                const InterferenceModel& b) {
    return make_kdop_tree<14>(a, b, "kdop14");
}
std::unique_ptr<PairStructure> make_kdop18_tree(const InterferenceModel& a,
                                                const InterferenceModel& b,
                                                const TreeOptions& options) {
    return make_kdop_tree<18>(a, b, "kdop18", options);
}
std::unique_ptr<PairStructure> make_kdop18_tree(const InterferenceModel& a,
                                                const InterferenceModel& b) {
    return make_kdop_tree<18>(a, b, "kdop18");
}
std::unique_ptr<PairStructure> make_kdop26_tree(const InterferenceModel& a,
                                                const InterferenceModel& b) {
    return make_kdop_tree<26>(a, b, "kdop26");
}

}  // namespace trisect::hierarchies
