// SPDX-License-Identifier: Apache-2.0
//
// Parts of one file share a shape, so an assembly of many copies makes a small page. What clashes
// comes first, and then the other parts while their shapes have room; how many are left out is
// said.
#include "clash_page.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "page_scene.h"
#include "values.h"

namespace trisect::app {
namespace {

constexpr std::size_t most_triangles = 500'000;  // of all shapes
constexpr std::size_t most_bodies = 5'000;

class ClashScene {
public:
    ClashScene(const ClashManifest& manifest, const ClashReport& report,
               const std::function<PlacedPart(std::uint32_t)>& part)
        : manifest_(manifest), report_(report), part_(part) {
        scene_.title = short_name(report.manifest);
        add_clashes();
        const std::size_t clashing = scene_.bodies.size();
        for (std::uint32_t i = 0; i < manifest_.parts.size(); ++i) (void)body_of_part(i, false);
        scene_.summary = {
            fmt::format("{} clashes of {} parts; {} pairs without an answer", report.clashes.size(),
                        manifest.parts.size(), report.unanswered.size()),
            fmt::format("{} parts clash", clashing)};
        if (const std::size_t left = manifest_.parts.size() - scene_.bodies.size(); left != 0)
            scene_.summary.push_back(fmt::format("{} parts are left out of the page", left));
    }
    [[nodiscard]] std::string text() const { return page_text(scene_); }

private:
    void add_clashes() {
        for (const Json& clash : report_.clashes) {
            if (scene_.findings.size() == most_page_findings) {
                ++scene_.more_findings;
                continue;
            }
            PageFinding finding;
            finding.title = clash_title(manifest_, clash);
            finding.text = text_of(clash);
            finding.kind = clash.at("relation") == "touching" || clash.at("relation") == "disjoint"
                               ? PageFinding::Kind::Warning
                               : PageFinding::Kind::Error;
            for (const char* side : {"a", "b"}) {
                const std::uint32_t number =
                    part_number(manifest_, clash.at(side).get_ref<const std::string&>());
                if (const auto body = body_of_part(number, true)) finding.bodies.push_back(*body);
            }
            add_place(clash, finding);
            scene_.findings.push_back(std::move(finding));
        }
    }

    static std::string text_of(const Json& clash) {
        std::string out = "set " + clash.at("set").get<std::string>();
        if (clash.contains("volume"))
            out += fmt::format("; common volume {}",
                               number_text(clash.at("volume").at("value").get<double>()));
        if (clash.contains("distance"))
            out += fmt::format("; distance {}",
                               number_text(clash.at("distance").at("upper").get<double>()));
        return out;
    }

    static void add_place(const Json& clash, PageFinding& finding) {
        if (clash.contains("distance")) {
            const Json& d = clash.at("distance");
            finding.segments.push_back({d.at("on_a").get<Point3d>(), d.at("on_b").get<Point3d>()});
            return;
        }
        if (clash.contains("regions"))
            for (const Json& region : clash.at("regions")) add_region(region, finding);
        if (finding.points.empty() && finding.segments.empty() && finding.loops.empty())
            finding.points.push_back(clash.at("point").get<Point3d>());
    }
    // Outlines: one finding may have many areas.
    static void add_region(const Json& region, PageFinding& finding) {
        for (const Json& loop : region.at("loops")) {
            const auto points = loop.get<std::vector<Point3d>>();
            if (points.size() == 1) finding.points.push_back(points[0]);
            for (std::size_t i = 0; i + (points.size() == 2 ? 1 : 0) < points.size(); ++i)
                if (points.size() > 1)
                    finding.segments.push_back({points[i], points[(i + 1) % points.size()]});
        }
    }

    std::optional<std::size_t> body_of_part(std::uint32_t number, bool clashes) {
        if (const auto known = bodies_.find(number); known != bodies_.end()) return known->second;
        if (scene_.bodies.size() == most_bodies) return {};
        const ClashPart& part = manifest_.parts[number];
        const auto shape = shape_of_file(part.file, number);
        if (!shape) return {};
        PageBody body;
        body.name = part.name;
        body.shape = *shape;
        body.pose = part.pose;
        body.color = clashes ? scene_.bodies.size() % 7 : 7;
        body.look = clashes ? PageBody::Look::Solid : PageBody::Look::Clear;
        scene_.bodies.push_back(std::move(body));
        return bodies_[number] = scene_.bodies.size() - 1;
    }

    std::optional<std::size_t> shape_of_file(std::uint32_t file, std::uint32_t number) {
        if (const auto known = shapes_.find(file); known != shapes_.end()) return known->second;
        const InterferenceModel model = part_(number).model;
        if (model.is_empty()) return shapes_[file] = std::nullopt;
        PageShape shape = shape_of(model.brep());
        if (triangles_ + shape.mesh.face_count() > most_triangles)
            return shapes_[file] = std::nullopt;
        triangles_ += shape.mesh.face_count();
        scene_.shapes.push_back(std::move(shape));
        return shapes_[file] = scene_.shapes.size() - 1;
    }

    const ClashManifest& manifest_;
    const ClashReport& report_;
    const std::function<PlacedPart(std::uint32_t)>& part_;
    PageScene scene_;
    std::map<std::uint32_t, std::size_t> bodies_;                 // by part
    std::map<std::uint32_t, std::optional<std::size_t>> shapes_;  // by file
    std::size_t triangles_ = 0;
};

}  // namespace

std::string clash_page(const ClashManifest& manifest, const ClashReport& report,
                       const std::function<PlacedPart(std::uint32_t)>& part) {
    return ClashScene(manifest, report, part).text();
}

}  // namespace trisect::app
