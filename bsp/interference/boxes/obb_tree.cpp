// SPDX-License-Identifier: Apache-2.0
//
// All at once, with the parts of obb_parts.cpp.

#include <trisect/bsp/interference/boxes/obb_tree.h>

#include <algorithm>

#include <trisect/bsp/interference/boxes/obb_parts.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

class ObbTreeBuilder {
public:
    ObbTreeBuilder(ObbTree& tree, ObbParts parts, std::uint32_t leaf)
        : tree_(tree), parts_(std::move(parts)), leaf_(leaf) {
        tree.origin = parts_.origin();
        tree.unit = parts_.unit();
        tree.radius = parts_.radius();
    }

    void run() {
        const std::uint32_t n = parts_.size();
        tree_.nodes.reserve(n);
        const ObbParts::Part all = parts_.whole();
        tree_.nodes.emplace_back();
        close_lanes(tree_.nodes[0], 1);
        put(0, 0, all);
        tree_.nodes[0].child[0] = below(all, 1);
        tree_.parent.assign(tree_.nodes.size(), 0);
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i)
            for (std::uint32_t k = 0; k < 4; ++k) {
                const ObbChild child = tree_.nodes[i].child[k];
                if (!child.is_leaf()) tree_.parent[child.node()] = ObbId::of(i, k).index;
            }
        tree_.order.reserve(n);
        tree_.corners.reserve(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t t = parts_.triangle(i);
            tree_.order.push_back(t);
            tree_.corners.push_back(parts_.corners(t));
        }
    }

private:
    [[nodiscard]] ObbChild below(const ObbParts::Part& part, std::size_t depth) {
        check_stop(part.size());
        tree_.depth = std::max(tree_.depth, depth);
        if (part.size() <= leaf_) return ObbChild::leaf(part.begin, part.size());
        std::array<ObbParts::Part, 4> parts;
        const std::size_t count = parts_.divide(part, leaf_, parts);
        const std::uint32_t node = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        close_lanes(tree_.nodes[node], count);
        for (std::uint32_t i = 0; i < count; ++i) put(node, i, parts[i]);
        for (std::uint32_t i = 0; i < count; ++i) {
            const ObbChild child = below(parts[i], depth + 1);
            tree_.nodes[node].child[i] = child;
        }
        return ObbChild::node(node);
    }
    void put(std::uint32_t node, std::uint32_t lane, const ObbParts::Part& part) {
        tree_.reach = std::max(tree_.reach, parts_.put(part, tree_.nodes[node], lane));
    }

    ObbTree& tree_;
    ObbParts parts_;
    std::uint32_t leaf_;
};

}  // namespace

std::uint32_t ObbTree::open(ObbId id) const { return source->open(id); }

ObbTree::ObbTree(std::span<const std::array<double, 3>> positions, double error,
                 std::span<const std::array<std::uint32_t, 3>> triangles, ObbTreeOptions options) {
    TRISECT_EXPECTS(options.leaf_triangles >= 1 && options.leaf_triangles <= ObbChild::max_leaf,
                    "a leaf size that fits into a leaf");
    TRISECT_EXPECTS(triangles.size() < (std::size_t{1} << 28), "triangles that leaves can name");
    if (triangles.empty()) return;
    ObbTreeBuilder(*this, ObbParts(positions, error, {triangles.begin(), triangles.end()}),
                   options.leaf_triangles)
        .run();
}

}  // namespace trisect::detail
