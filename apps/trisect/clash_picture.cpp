// SPDX-License-Identifier: Apache-2.0
#include "clash_picture.h"

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_transform.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "png_file.h"
#include "queried_set.h"
#include "render_camera.h"
#include "render_index_scene.h"
#include "render_picture.h"

namespace trisect::app {
namespace {

// What of a part is near, as a solid of the world with a name of its own: rounded, to be looked at.
Solid part_near(const PlacedPart& part, const Solid& around) {
    const Solid whole = transformed(part.model.solid(), part.pose);
    return Solid::from_mesh(evaluate(whole & around).to_mesh(),
                            {.embedding = Embedding::Check, .inside_out = InsideOut::Accept});
}

}  // namespace

std::string clash_picture(const Json& clash, const PlacedPart& a, const PlacedPart& b) {
    const auto point = clash.at("point").get<std::array<double, 3>>();
    double reach = std::max(clash.at("size").get<double>(), 1e-9);
    for (const PlacedPart* part : {&a, &b}) {
        double least = part->box.hi[0] - part->box.lo[0];
        for (std::size_t k = 1; k < 3; ++k)
            least = std::min(least, part->box.hi[k] - part->box.lo[k]);
        reach = std::max(reach, least);
    }
    const auto at = [&](double dx, double dy, double dz) {
        return Point3d{point[0] + reach * dx, point[1] + reach * dy, point[2] + reach * dz};
    };
    // The half that the eye looks into. The second part stands out of the cut by a little, since
    // faces in one plane would be drawn as one.
    const auto half = [&](double from) {
        return Solid::from_mesh(make_box(at(-1, from, -1), at(1, 1, 1)));
    };
    const Solid first = part_near(a, half(-0.01));
    const Solid second = part_near(b, half(-0.015));
    // What both have is drawn as the second one's.
    const Solid both = evaluate((first - second) | second);
    std::vector<Point3d> corners = corners_of(both);
    if (corners.empty()) corners.push_back(at(0, 0, 0));
    const View view = View::from_text("0.45,-1,0.6", "z");
    PictureStyle style;
    style.size = {480, 360};
    style.samples = 2;
    const Camera camera = Camera::fitted(view, corners, style.size, {});
    const IndexScene scene(
        BrepIndex(both),
        [&](std::uint32_t operand) -> std::optional<std::size_t> {
            return operand == first.source_id() ? 0 : 1;
        },
        4 * reach);
    return png_bytes(draw_picture(scene, camera, style).image);
}

}  // namespace trisect::app
