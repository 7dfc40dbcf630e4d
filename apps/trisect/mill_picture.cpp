// SPDX-License-Identifier: Apache-2.0
#include "mill_picture.h"

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_transform.h>

#include <cmath>
#include <map>
#include <vector>

#include "queried_set.h"
#include "render_index_scene.h"
#include "render_picture.h"

namespace trisect::app {
namespace {

/// Numbers in the palette.
enum class MillColor : std::uint8_t { Stock, Cut, Fixture, Holder };

double diagonal(const Bounds& b) {
    return std::hypot(b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], b.hi[2] - b.lo[2]);
}

}  // namespace

std::string picture_of_run(const MillJob& job, const MillRun& run) {
    std::map<std::uint32_t, MillColor> colors{{job.stock_source, MillColor::Stock}};
    std::vector<Solid> bodies{run.stock()};
    for (const MillBody& fixture : job.fixtures) {
        bodies.push_back(fixture.solid);
        colors[fixture.source] = MillColor::Fixture;
    }
    if (run.has_collision() && run.done() > 0) {
        const MillStep& last = job.steps[run.done() - 1];
        bodies.push_back(transformed(job.holder.solid, job.pose_after(last)));
        colors[job.holder.source] = MillColor::Holder;
        MillTool tool = *job.tool;
        bodies.push_back(tool.swept(last.orientation, last.to, last.to, false).solid);
    }
    const Solid all = bodies.size() == 1 ? bodies[0] : evaluate(Expression::any_of(bodies));
    std::vector<Point3d> corners = corners_of(all);
    if (corners.empty()) corners.push_back(Point3d{});
    const PictureStyle style{{1200, 900}, 2};
    const Camera camera = Camera::fitted(View::from_text("iso", "z"), corners, style.size, {});
    const auto color = [&](std::uint32_t source) -> std::optional<std::size_t> {
        const auto known = colors.find(source);
        return static_cast<std::size_t>(known == colors.end() ? MillColor::Cut : known->second);
    };
    const double size = diagonal(bounds_of(corners).value_or(Bounds()));
    const IndexScene scene(BrepIndex(all), color, size > 0 ? size : 1);
    return png_bytes(draw_picture(scene, camera, style).image);
}

}  // namespace trisect::app
