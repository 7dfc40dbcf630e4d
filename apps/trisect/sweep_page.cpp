// SPDX-License-Identifier: Apache-2.0
#include "sweep_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page_entities.h"
#include "values.h"

namespace trisect::app {
namespace {

Point3d along(const std::array<Point3d, 2>& s, double t) {
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = s[0][k] + t * (s[1][k] - s[0][k]);
    return out;
}

// The middle of the nearest points of two lines, in doubles; of parallel ones that of two ends.
Point3d between_lines(const std::array<Point3d, 2>& p, const std::array<Point3d, 2>& q) {
    double uu = 0;
    double uv = 0;
    double vv = 0;
    double uw = 0;
    double vw = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double u = p[1][k] - p[0][k];
        const double v = q[1][k] - q[0][k];
        const double w = p[0][k] - q[0][k];
        uu += u * u;
        uv += u * v;
        vv += v * v;
        uw += u * w;
        vw += v * w;
    }
    const double det = uu * vv - uv * uv;
    const bool parallel = !(det > 1e-12 * uu * vv);
    const double s = parallel ? 0 : std::clamp((uv * vw - vv * uw) / det, 0.0, 1.0);
    const double t = vv > 0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0;
    return along({along(p, s), along(q, t)}, 0.5);
}

// Where the entities of a witness meet, if it is a point that they name.
void add_place(PageFinding& finding) {
    if (!finding.points.empty())
        finding.points.resize(1);
    else if (finding.segments.size() == 2)
        finding.points.push_back(between_lines(finding.segments[0], finding.segments[1]));
}

PageFinding witness_finding(const ContactWitness& witness, const std::array<PlacedBody, 2>& bodies,
                            const std::array<PosePlace, 2>& poses) {
    PageFinding out;
    const std::array entities{witness.a, witness.b};
    for (std::size_t i = 0; i < 2; ++i) {
        const Brep& brep = bodies.at(i).model.brep();
        out.text += (i == 0 ? "" : ", ") + entity_words(entities.at(i), brep, bodies.at(i).name);
        mark_entity(out, i, entities.at(i), brep, poses.at(i));
    }
    add_place(out);
    constexpr std::array names{"vertex", "edge", "face"};
    out.title = fmt::format("{} meets {}", names.at(static_cast<std::size_t>(witness.a.kind())),
                            names.at(static_cast<std::size_t>(witness.b.kind())));
    out.kind = PageFinding::Kind::Error;
    return out;
}

}  // namespace

PageTimeline timeline_of(const PageMotion& motion, std::optional<double> event) {
    PageTimeline out;
    out.unit = motion.unit;
    for (std::uint64_t i = 0; i <= motion.frames; ++i)
        out.times.push_back(motion.end * static_cast<double>(i) /
                            static_cast<double>(motion.frames));
    if (event) {
        const auto at = std::ranges::lower_bound(out.times, *event);
        out.contact = static_cast<std::size_t>(at - out.times.begin());
        if (at == out.times.end() || *at != *event) out.times.insert(at, *event);
    }
    for (std::size_t i = 0; i < 2; ++i)
        if (motion.pose.at(i)) out.bodies.push_back(i);
    for (const double t : out.times)
        for (const std::size_t i : out.bodies) out.poses.push_back(motion.pose.at(i)(t));
    return out;
}

std::string sweep_page(const std::array<PlacedBody, 2>& bodies, const PageMotion& motion,
                       const ShownContact& contact) {
    PageScene scene = scene_of(bodies);
    scene.title = fmt::format("{} moves to {}", bodies[1].name, bodies[0].name);
    scene.summary = contact.summary;
    scene.timeline = timeline_of(motion, contact.time);
    if (contact.time) {
        std::array<PosePlace, 2> poses{identity_pose, identity_pose};
        for (std::size_t i = 0; i < 2; ++i)
            if (motion.pose.at(i)) poses.at(i) = motion.pose.at(i)(*contact.time);
        for (const ContactWitness& w : contact.witnesses) {
            if (scene.findings.size() == most_page_findings) {
                ++scene.more_findings;
                continue;
            }
            scene.findings.push_back(witness_finding(w, bodies, poses));
            scene.findings.back().frame = scene.timeline->contact;
        }
    }
    return page_text(scene);
}

}  // namespace trisect::app
