// SPDX-License-Identifier: Apache-2.0
//
// VolumeHierarchy: a tree of bounding volumes over each model.
// All kinds of volumes share one traversal.
//
// A kind of volume is a class like KDopKind in volume_hierarchies.cpp:
//
//   Volume, Moved   the volume in its tree's frame; what B's become in A's
//   Pose            made from a FrameMap: moved(volume), meet(volume, moved), gap(volume, moved)
//   fit(corners, error)    around points that are known within `error`
//   unite(volumes)         around volumes, where has_unite is true: trees are built from leaves up
//   size(volume), size(moved)   what is larger is opened first
//   outline(volume), outline(moved)   for pictures, in the frame; a kind may be without
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/pair_structure.h>
#include <trisect/bsp/hierarchies/pairs/tree_frame.h>
#include <trisect/bsp/interference/boxes/tree_builder.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

/// The triangles of a model as items of a tree over them, in its frame.
[[nodiscard]] std::vector<TreeItem> items_of(const detail::InterferenceModelData& model,
                                             const TreeFrame& frame);

template <class Kind>
struct VolumeTree {
    TreeFrame frame;
    TreeShape shape;
    std::vector<typename Kind::Volume> volumes;  ///< one for each node

    VolumeTree(const detail::InterferenceModelData& model, const TreeOptions& options)
        : frame(model), shape(build_tree(items_of(model, frame), options)) {
        fit_all(model);
    }

    /// Of volumes made elsewhere, one for each node of the shape, each around all that is below it.
    VolumeTree(const TreeFrame& f, TreeShape s, std::vector<typename Kind::Volume> v)
        : frame(f), shape(std::move(s)), volumes(std::move(v)) {}

    /// To another shape of the model, of which now[t] is what triangle t has become. The tree keeps
    /// its nodes.
    void refit(const detail::InterferenceModelData& model, std::span<const std::uint32_t> now) {
        frame = TreeFrame(model);
        for (std::uint32_t& t : shape.order) t = now[t];
        fit_all(model);
    }

    [[nodiscard]] std::size_t bytes() const {
        return shape.bytes() + volumes.size() * sizeof(typename Kind::Volume);
    }

private:
    void fit_all(const detail::InterferenceModelData& model) {
        volumes.resize(shape.nodes.size());
        // Children come after their parent.
        if constexpr (Kind::has_unite) {
            for (std::size_t i = shape.nodes.size(); i-- > 0;) {
                const TreeNode& node = shape.nodes[i];
                volumes[i] = node.leaf
                                 ? leaf_volume(model, node)
                                 : Kind::unite(std::span(volumes).subspan(node.first, node.count));
            }
        } else {
            std::vector<std::array<double, 3>> corners;
            fit_below(model, 0, corners);
        }
    }
    void append_corners(const detail::InterferenceModelData& model, const TreeNode& leaf,
                        std::vector<std::array<double, 3>>& corners) const {
        for (const std::uint32_t t : shape.things(leaf))
            for (const VertexId v : model.triangles[t].vertex)
                corners.push_back(frame(model.position(v)));
    }
    typename Kind::Volume leaf_volume(const detail::InterferenceModelData& model,
                                      const TreeNode& leaf) const {
        std::vector<std::array<double, 3>> corners;
        append_corners(model, leaf, corners);
        return Kind::fit(corners, frame.error);
    }
    // Fits all volumes from a node down, and appends the corners below it, three by three.
    void fit_below(const detail::InterferenceModelData& model, std::uint32_t index,
                   std::vector<std::array<double, 3>>& corners) {
        const TreeNode node = shape.nodes[index];
        const std::size_t first = corners.size();
        if (node.leaf)
            append_corners(model, node, corners);
        else
            for (std::uint32_t k = 0; k < node.count; ++k)
                fit_below(model, node.first + k, corners);
        volumes[index] = Kind::fit(std::span(corners).subspan(first), frame.error);
    }
};

/// B's volumes are moved when a walk first comes to them, and then kept until the next pose.
template <class Kind>
class VolumeHierarchy : public PairStructure {
public:
    VolumeHierarchy(const InterferenceModel& a, const InterferenceModel& b,
                    const TreeOptions& options, std::string_view name)
        : VolumeHierarchy(
              a, b, [&](const auto& data) { return VolumeTree<Kind>(data, options); }, name) {}
    /// With trees that make(data of a model) returns.
    template <class Make>
    requires std::invocable<Make, const detail::InterferenceModelData&> VolumeHierarchy(
        const InterferenceModel& a, const InterferenceModel& b, Make&& make, std::string_view name)
        : PairStructure(a, b),
          start_(std::chrono::steady_clock::now()),
          a_(make(data_a())),
          b_(make(data_b())),
          moved_(b_.volumes.size()),
          moved_at_(b_.volumes.size(), 0),
          name_(name) {
        report_.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        report_.bytes = a_.bytes() + b_.bytes() + moved_.size() * sizeof(typename Kind::Moved) +
                        moved_at_.size() * sizeof(std::uint32_t);
        report_.volumes = a_.volumes.size() + b_.volumes.size();
        report_.depth = std::max(a_.shape.depth, b_.shape.depth);
    }

    [[nodiscard]] std::string_view name() const override { return name_; }
    [[nodiscard]] BuildReport build_report() const override { return report_; }

protected:
    using Volume = typename Kind::Volume;
    using Moved = typename Kind::Moved;

    void update(CostCounters&) override {
        pose_.emplace(FrameMap(a_.frame, b_.frame, placement().to_a));
        if (++pose_number_ == 0) {
            std::ranges::fill(moved_at_, 0U);
            pose_number_ = 1;
        }
    }

    bool refit_b(std::span<const std::uint32_t> now, CostCounters& counters) override {
        b_.refit(data_b(), now);
        counters.updates += b_.volumes.size();
        return true;
    }

    bool find_candidates(PairVisit visit, CostCounters& counters) override {
        stack_.clear();
        std::uint64_t tests = 0;
        const auto push = [&](std::uint32_t i, std::uint32_t j) {
            ++tests;
            if (pose_->meet(a_.volumes[i], moved(j, counters))) stack_.push_back({i, j});
        };
        push(0, 0);
        bool stopped = false;
        while (!stack_.empty() && !stopped) {
            const auto [i, j] = stack_.back();
            stack_.pop_back();
            const TreeNode& na = a_.shape.nodes[i];
            const TreeNode& nb = b_.shape.nodes[j];
            if (na.leaf && nb.leaf) {
                stopped = visit_leaves(na, nb, visit);
            } else if (opens_b(i, j)) {
                for (std::uint32_t k = 0; k < nb.count; ++k) push(i, nb.first + k);
            } else {
                for (std::uint32_t k = 0; k < na.count; ++k) push(na.first + k, j);
            }
        }
        counters.volume_tests += tests;
        return stopped;
    }

    // Nearest first. What lies nearest of all after a pair is opened is usually one of its
    // children: it is opened next without a way through the heap, whose size is what most of the
    // time goes into where everything is equally near.
    void find_near(double limit, NearVisit visit, CostCounters& counters) override {
        heap_.clear();
        const auto later = [](const Entry& x, const Entry& y) { return x.gap > y.gap; };
        const auto push = [&](const Entry& e) {
            heap_.push_back(e);
            std::ranges::push_heap(heap_, later);
        };
        std::optional<Entry> nearest;  // of the children
        const auto offer = [&](std::uint32_t i, std::uint32_t j, double least) {
            ++counters.volume_tests;
            const double gap = a_.frame.unit * pose_->gap(a_.volumes[i], moved(j, counters));
            const Entry e{std::max(least, gap), i, j};
            if (e.gap > limit) return;
            if (!nearest) {
                nearest = e;
                return;
            }
            push(later(*nearest, e) ? std::exchange(*nearest, e) : e);
        };
        const auto take_nearest = [&] {
            if (nearest && (heap_.empty() || !later(*nearest, heap_.front())))
                return std::exchange(nearest, std::nullopt);
            if (nearest) push(*std::exchange(nearest, std::nullopt));
            if (heap_.empty()) return std::optional<Entry>();
            std::ranges::pop_heap(heap_, later);
            const Entry e = heap_.back();
            heap_.pop_back();
            return std::optional(e);
        };
        offer(0, 0, 0);
        for (std::optional<Entry> e = take_nearest(); e && e->gap <= limit; e = take_nearest()) {
            const TreeNode& na = a_.shape.nodes[e->a];
            const TreeNode& nb = b_.shape.nodes[e->b];
            if (na.leaf && nb.leaf) {
                for (const std::uint32_t t : b_.shape.things(nb))
                    for (const std::uint32_t s : a_.shape.things(na)) limit = visit(s, t);
            } else if (opens_b(e->a, e->b)) {
                for (std::uint32_t k = 0; k < nb.count; ++k) offer(e->a, nb.first + k, e->gap);
            } else {
                for (std::uint32_t k = 0; k < na.count; ++k) offer(na.first + k, e->b, e->gap);
            }
        }
    }

    std::vector<VolumeOutline> list_outlines(bool of_b, unsigned levels) override {
        std::vector<VolumeOutline> out;
        if constexpr (requires(const Volume& v, const Moved& m) {
                          Kind::outline(v);
                          Kind::outline(m);
                      }) {
            CostCounters unused;
            const TreeShape& shape = of_b ? b_.shape : a_.shape;
            std::vector<std::uint32_t> nodes{0};
            for (unsigned level = 0; level < levels; ++level) {
                std::vector<std::uint32_t> children;
                for (const std::uint32_t i : nodes) {
                    const TreeNode& node = shape.nodes[i];
                    out.push_back(of_b ? Kind::outline(moved(i, unused))
                                       : Kind::outline(a_.volumes[i]));
                    out.back().level = level;
                    out.back().is_leaf = node.leaf;
                    out.back().to_user(a_.frame, this->model_a().lattice());
                    for (std::uint32_t k = 0; !node.leaf && k < node.count; ++k)
                        children.push_back(node.first + k);
                }
                nodes = std::move(children);
            }
        }
        return out;
    }

private:
    struct Pair {
        std::uint32_t a;
        std::uint32_t b;
    };
    struct Entry {
        double gap;
        std::uint32_t a;
        std::uint32_t b;
    };

    [[nodiscard]] const Moved& moved(std::uint32_t j, CostCounters& counters) {
        if (moved_at_[j] != pose_number_) {
            moved_at_[j] = pose_number_;
            moved_[j] = pose_->moved(b_.volumes[j]);
            ++counters.updates;
        }
        return moved_[j];
    }
    // \pre not both are leaves.
    [[nodiscard]] bool opens_b(std::uint32_t i, std::uint32_t j) const {
        if (a_.shape.nodes[i].leaf || b_.shape.nodes[j].leaf) return a_.shape.nodes[i].leaf;
        return Kind::size(moved_[j]) > Kind::size(a_.volumes[i]);
    }
    [[nodiscard]] bool visit_leaves(const TreeNode& na, const TreeNode& nb, PairVisit visit) const {
        for (const std::uint32_t t : b_.shape.things(nb))
            for (const std::uint32_t s : a_.shape.things(na))
                if (visit(s, t)) return true;
        return false;
    }

    std::chrono::steady_clock::time_point start_;  // before the trees, which it times

protected:
    VolumeTree<Kind> a_;
    VolumeTree<Kind> b_;
    std::optional<typename Kind::Pose> pose_;
    std::vector<Moved> moved_;
    std::vector<std::uint32_t> moved_at_;  ///< the pose that B's volumes were moved for
    std::uint32_t pose_number_ = 0;

private:
    std::vector<Pair> stack_;
    std::vector<Entry> heap_;
    std::string_view name_;
    BuildReport report_;
};

}  // namespace trisect::hierarchies
