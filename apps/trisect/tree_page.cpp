// SPDX-License-Identifier: Apache-2.0
//
// The page decides on which side of a cut a point is, by fractions. So it gets all cuts as whole
// numbers: positions of splitting planes, coefficients of planes of faces.
#include "tree_page.h"

#include <trisect/brep/measure.h>
#include <trisect/bsp/cell_tree_view.h>
#include <trisect/bsp/msp_tree.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "page_plane.h"
#include "page_scene.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::size_t most_cell_nodes = 200'000;
constexpr std::size_t most_plane_faces = 2'000;
constexpr std::size_t most_plane_nodes = 100'000;

/// Levels of a tree, from the root on, whose nodes are few enough.
std::size_t shown_depth(const std::vector<std::size_t>& depth) {
    std::vector<std::size_t> at_depth;
    for (const std::size_t d : depth) {
        if (d >= at_depth.size()) at_depth.resize(d + 1);
        ++at_depth[d];
    }
    std::size_t sum = 0;
    for (std::size_t d = 0; d < at_depth.size(); ++d)
        if ((sum += at_depth[d]) > most_cell_nodes) return d == 0 ? 0 : d - 1;
    return at_depth.size();
}

std::vector<std::size_t> depths_of(const std::vector<CellTreeNode>& nodes) {
    std::vector<std::size_t> depth(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].axis >= 0) depth[i + 1] = depth[nodes[i].above] = depth[i] + 1;
    return depth;
}

/// A cut is [axis, position, below, above]; a leaf [-1, polygons, inside, arranged]; what lies
/// deeper than the page goes is [-2].
Json cells_json(const std::vector<CellTreeNode>& nodes) {
    const std::vector<std::size_t> depth = depths_of(nodes);
    const std::size_t deepest = shown_depth(depth);
    std::vector<std::size_t> number(nodes.size());
    std::size_t shown = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (depth[i] <= deepest) number[i] = shown++;
    Json out = Json::array();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const CellTreeNode& n = nodes[i];
        if (depth[i] > deepest) continue;
        if (n.axis < 0)
            out.push_back({-1, n.polygons, n.is_inside ? 1 : 0, n.is_arranged ? 1 : 0});
        else if (depth[i] == deepest)
            out.push_back(Json::array({-2}));
        else
            out.push_back({n.axis, std::to_string(n.position), number[i + 1], number[n.above]});
    }
    return out;
}

/// An inner node by its number, a leaf as -1 - kind - 5 · entity.
std::int64_t ref_number(MspTree::Ref ref) {
    if (!ref.is_leaf()) return ref.index();
    return -1 - static_cast<std::int64_t>(ref.kind()) - 5 * std::int64_t{ref.entity()};
}

Json planes_json(const MspTree& tree) {
    Json planes = Json::array();
    Json nodes = Json::array();
    std::vector<Json> by_number;
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        const auto ref = MspTree::Ref::node(i);
        const MspTree::Node& node = tree.node(ref);
        if (node.plane >= by_number.size()) by_number.resize(node.plane + 1);
        if (by_number[node.plane].is_null()) by_number[node.plane] = plane_json(tree.plane(node));
        nodes.push_back({node.plane, ref_number(node.below), ref_number(node.on),
                         ref_number(node.above), tree.dimension(ref)});
    }
    for (Json& p : by_number) planes.push_back(std::move(p));
    return {{"root", ref_number(tree.root())}, {"planes", planes}, {"nodes", nodes}};
}

/// Nothing, with the reason, where the tree would be too large to be looked at.
Json planes_or_reason(const Brep& brep, std::string& reason) {
    if (brep.faces().size() > most_plane_faces) {
        reason = fmt::format("more than {} faces", most_plane_faces);
        return {};
    }
    try {
        const MspTree tree = MspTree::from_brep(brep);
        if (tree.node_count() <= most_plane_nodes) return planes_json(tree);
        reason = fmt::format("more than {} cuts", most_plane_nodes);
    } catch (const UnsupportedError& e) {
        reason = e.what();
    }
    return {};
}

}  // namespace

std::string tree_page(const std::string& title, const Solid& solid, const Brep& brep) {
    PageScene scene;
    scene.kind = "tree";
    scene.title = title;
    scene.shapes.push_back(shape_of(brep));
    PageBody body;
    body.name = title;
    scene.bodies.push_back(std::move(body));
    PageData data;
    data.add("cells", cells_json(cell_tree_nodes(solid)).dump());
    std::string reason;
    if (const Json planes = planes_or_reason(brep, reason); !planes.is_null())
        data.add("planes", planes.dump());
    Json more;
    more["unit"] = solid.lattice().exponent;
    more["scale"] = cell_position_scale;
    more["no_planes"] = reason;
    return page_text(scene, std::move(data), more);
}

}  // namespace trisect::app
