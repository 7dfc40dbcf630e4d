// SPDX-License-Identifier: Apache-2.0
//
// Best first: the pair of hulls with the least distance so far is opened next. What makes it
// sensitive to the output is the acceptance of hulls whose closest features are real: two gears
// beside each other are decided by a few features of a few hulls, without looking into one gap
// between teeth that does not face the other gear.

#include <trisect/bsp/hierarchies/convex/sub_part_tracker.h>

#include <algorithm>
#include <limits>
#include <optional>

#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>

namespace trisect::hierarchies {

namespace {

struct Farther {
    template <class Entry>
    bool operator()(const Entry& a, const Entry& b) const {
        return a.least > b.least;
    }
};

void expect_single_triangles(const InterferenceModel& model, const HullTree& tree) {
    if (!trisect::detail::data_of(model).all_lattice)
        throw UnsupportedError("hulls are tracked exactly only around lattice points");
    for (const HullTree::Node& n : tree.nodes())
        if (n.is_leaf() && n.triangle_count != 1)
            throw UsageError("a tree of hulls to be tracked needs leaves of one triangle");
}

}  // namespace

SubPartTracker::SubPartTracker(const InterferenceModel& model_a, const HullTree& a,
                               const InterferenceModel& model_b, const HullTree& b)
    : a_(&a), b_(&b), lattice_a_(model_a.lattice()), lattice_b_(model_b.lattice()) {
    expect_single_triangles(model_a, a);
    expect_single_triangles(model_b, b);
}

void SubPartTracker::visit(std::uint32_t a, std::uint32_t b, double parent) {
    const HullTree::Node& x = a_->nodes()[a];
    const HullTree::Node& y = b_->nodes()[b];
    FeatureWalk walk(x.hull, y.hull, frame_, &counts_.walks);
    const WalkEnd& end = walk.run(memory_.start(a, b));
    memory_.keep(a, b, end.pair);
    const bool leaves = x.is_leaf() && y.is_leaf();
    const bool real_a = x.is_leaf() || x.is_real(end.pair.a);
    const bool real_b = y.is_leaf() || y.is_real(end.pair.b);
    const bool real = real_a && real_b;
    if (end.meet && (leaves || (real && !end.inside))) {
        meet_ = true;
        if (!leaves) ++counts_.accepted;
        return;
    }
    const FeatureWalk::Bounds d = walk.bounds();
    const Entry e{std::max(parent, d.lower), a, b, !real_a, !real_b};
    if (!(e.least <= bounds_.upper)) return;
    if (!end.meet && real) {
        if (!leaves) ++counts_.accepted;
        bounds_.upper = std::min(bounds_.upper, d.upper);
        nearest_.push_back(e);
        return;
    }
    heap_.push_back(e);
    std::push_heap(heap_.begin(), heap_.end(), Farther{});
}

void SubPartTracker::open(const Entry& e) {
    ++counts_.opened;
    const HullTree::Node& x = a_->nodes()[e.a];
    const HullTree::Node& y = b_->nodes()[e.b];
    const bool larger_a = x.triangle_count >= y.triangle_count;
    const bool first =
        y.is_leaf() || (!x.is_leaf() && (e.open_a == e.open_b ? larger_a : e.open_a));
    const HullTree::Node& n = first ? x : y;
    for (std::uint32_t i = 0; i < n.child_count && !meet_; ++i)
        visit(first ? n.first_child + i : e.a, first ? e.b : n.first_child + i, e.least);
}

void SubPartTracker::update(const Pose& a, const Pose& b) {
    frame_ = CommonFrame(a, lattice_a_, a_->largest(), b, lattice_b_, b_->largest());
    memory_.next_pose();
    heap_.clear();
    nearest_.clear();
    counts_ = {};
    meet_ = false;
    bounds_ = {0, std::numeric_limits<double>::infinity()};
    visit(0, 0, 0);
    while (!heap_.empty() && !meet_ && heap_.front().least <= bounds_.upper) {
        std::pop_heap(heap_.begin(), heap_.end(), Farther{});
        const Entry e = heap_.back();
        heap_.pop_back();
        open(e);
    }
    if (meet_) {
        bounds_ = {};
        return;
    }
    std::erase_if(nearest_, [this](const Entry& e) { return e.least > bounds_.upper; });
    bounds_.lower = bounds_.upper;
    for (const Entry& e : nearest_) bounds_.lower = std::min(bounds_.lower, e.least);
}

ExactRational SubPartTracker::squared_distance() {
    if (meet_) return {};
    std::optional<ExactRational> least;
    for (const Entry& e : nearest_) {
        FeatureWalk walk(a_->nodes()[e.a].hull, b_->nodes()[e.b].hull, frame_);
        walk.run(memory_.start(e.a, e.b));
        ExactRational d = walk.squared_distance();
        if (!least || d < *least) least = std::move(d);
    }
    return *least;
}

}  // namespace trisect::hierarchies
