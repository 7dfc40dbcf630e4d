// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_parameters.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

namespace {

struct Parameters {
    std::vector<std::string_view> in_order;
    std::vector<std::string_view> by_name_only;
};

/// As OpenSCAD has them. What has no effect on the set (convexity, a time stamp) is here as well.
const Parameters* parameters_of(std::string_view node) {
    static const Parameters none{};
    static const std::map<std::string_view, Parameters> known{
        {"group", none},
        {"union", none},
        {"difference", none},
        {"intersection", none},
        {"hull", none},
        {"color", {{"c", "alpha"}, {}}},
        {"multmatrix", {{"m"}, {}}},
        {"render", {{"convexity"}, {}}},
        {"minkowski", {{"convexity"}, {}}},
        {"cube", {{"size", "center"}, {}}},
        {"sphere", {{"r"}, {"d"}}},
        {"cylinder", {{"h", "r1", "r2", "center"}, {"r", "d", "d1", "d2"}}},
        {"polyhedron", {{"points", "faces", "convexity"}, {"triangles"}}},
        {"square", {{"size", "center"}, {}}},
        {"circle", {{"r"}, {"d"}}},
        {"polygon", {{"points", "paths", "convexity"}, {}}},
        {"linear_extrude",
         {{"file", "layer", "height", "origin", "scale", "center", "twist", "slices"},
          {"convexity", "timestamp"}}},
        {"rotate_extrude",
         {{"file", "layer", "origin", "scale"}, {"convexity", "angle", "timestamp"}}},
        {"offset", {{"r"}, {"delta", "chamfer", "join_type", "miter_limit"}}},
        {"projection", {{"cut", "convexity"}, {}}},
        {"resize", {{"newsize", "auto", "convexity"}, {}}},
        {"import",
         {{"file", "layer", "convexity", "origin", "scale"},
          {"width", "height", "filename", "layername", "center", "dpi", "id", "timestamp"}}},
        {"surface", {{"file", "center", "convexity"}, {"invert", "timestamp"}}},
        {"text",
         {{"text", "size", "font"},
          {"direction", "language", "script", "halign", "valign", "spacing"}}}};
    const auto found = known.find(node);
    return found == known.end() ? nullptr : &found->second;
}

bool is_parameter(const Parameters& of, std::string_view name) {
    const auto has = [&](const std::vector<std::string_view>& names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    return name.front() == '$' || has(of.in_order) || has(of.by_name_only);
}

void name_arguments(const CsgTree& tree, CsgNode& node, const Parameters& parameters) {
    const auto fail = [&](ErrorCode code, CsgPlace place, const std::string& message) {
        throw CsgError(code, tree.place(place), node.name + ": " + message);
    };
    std::size_t position = 0;
    for (CsgArgument& a : node.arguments) {
        if (!a.name.empty()) {
            if (!is_parameter(parameters, a.name))
                fail(ErrorCode::Unsupported, a.value.place,
                     "there is no parameter '" + a.name.substr(0, 40) + "'");
            if (node.name == "import" && a.name == "filename") a.name = "file";
            if (node.name == "import" && a.name == "layername") a.name = "layer";
            continue;
        }
        if (position == parameters.in_order.size())
            fail(ErrorCode::Input, a.value.place,
                 parameters.in_order.empty() ? "it takes no arguments"
                                             : "there are too many arguments");
        a.name = parameters.in_order[position];
        // A number in the first place is no name of a file.
        if (node.name == "linear_extrude" && position == 0 && a.value.number() != nullptr)
            a.name = "height";
        ++position;
    }
}

}  // namespace

void name_csg_arguments(CsgTree& tree) {
    for (CsgNode& node : tree.nodes)
        if (const Parameters* parameters = parameters_of(node.name))
            name_arguments(tree, node, *parameters);
}

}  // namespace trisect::detail
