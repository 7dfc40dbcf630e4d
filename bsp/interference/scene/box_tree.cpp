// SPDX-License-Identifier: Apache-2.0
//
// The broad phase over an R-tree (Boost.Geometry's), as the other way beside sweep and prune. When
// all bodies move, taking each out and putting it back costs a descent and a choice of where to
// split each time; packing the whole tree anew (sort-tile-recursive) costs less than that and makes
// a better tree. So the tree is packed by the first query after a change.
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <trisect/bsp/interference/boxes/broad_phase.h>

namespace trisect::detail {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using TreeEntry = std::pair<TreeBox, std::uint32_t>;
using Tree = bgi::rtree<TreeEntry, bgi::rstar<8>>;

TreeBox tree_box(const BodyBox& b) {
    return {TreePoint(b.lo[0], b.lo[1], b.lo[2]), TreePoint(b.hi[0], b.hi[1], b.hi[2])};
}

class BoxTree final : public BroadPhase {
public:
    void insert(std::uint32_t slot, const BodyBox& box) override {
        if (slot >= boxes_.size()) boxes_.resize(std::size_t{slot} + 1);
        boxes_[slot] = box;
        stale_ = true;
    }
    void update(std::uint32_t slot, const BodyBox& box) override {
        stale_ = stale_ || boxes_[slot] != box;
        boxes_[slot] = box;
    }
    void remove(std::uint32_t slot) override {
        boxes_[slot].reset();
        stale_ = true;
    }

    void pairs(std::vector<BodyPair>& out) override {
        counts_ = {};
        if (stale_) pack();
        out.clear();
        for (std::uint32_t slot = 0; slot < boxes_.size(); ++slot) {
            if (!boxes_[slot]) continue;
            const auto collect = [&out, slot](const TreeEntry& e) {
                if (slot < e.second) out.push_back({slot, e.second});
            };
            const std::size_t first = out.size();
            std::for_each(tree_.qbegin(bgi::intersects(tree_box(*boxes_[slot]))), tree_.qend(),
                          collect);
            std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
        }
    }

    // The tree does not expose these; its leaves have these entries, inner nodes an eighth as many.
    [[nodiscard]] std::size_t bytes() const override {
        return boxes_.size() * sizeof(boxes_[0]) + tree_.size() * sizeof(TreeEntry) * 8 / 7;
    }

private:
    void pack() {
        std::vector<TreeEntry> entries;
        for (std::uint32_t slot = 0; slot < boxes_.size(); ++slot)
            if (boxes_[slot]) entries.emplace_back(tree_box(*boxes_[slot]), slot);
        counts_.moves = entries.size();
        tree_ = Tree(entries);
        stale_ = false;
    }

    std::vector<std::optional<BodyBox>> boxes_;  // by slot
    Tree tree_;
    bool stale_ = false;
};

}  // namespace

std::unique_ptr<BroadPhase> make_box_tree() { return std::make_unique<BoxTree>(); }

}  // namespace trisect::detail
