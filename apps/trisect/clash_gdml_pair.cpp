// SPDX-License-Identifier: Apache-2.0
#include "clash_gdml_pair.h"

#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_overlap.h>
#include <trisect/bsp/solid_measure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gdml/gdml_values.h"

namespace trisect::app {
namespace {

using Numbers = std::array<double, 12>;

bool is_good(GdmlRule rule, Relation relation) {
    if (rule == GdmlRule::Apart) return !interiors_meet(relation);
    return relation == Relation::Inside || relation == Relation::Equal;
}

/// The pose with all points moved.
Pose moved(const Pose& pose, const Point3d& by) {
    Numbers numbers = pose.approximate();
    for (std::size_t k = 0; k < 3; ++k) numbers[4 * k + 3] += by[k];
    return Pose::from_doubles(numbers);
}

/// The pose of the solid shrunk towards the middle of its box, no point moving farther than
/// `distance`.
std::optional<Pose> shrunk(const GdmlPart& part, double distance) {
    const auto box = bounds(part.placed.model.solid());
    double reach = 0;
    Point3d middle{};
    for (std::size_t k = 0; k < 3; ++k) {
        middle[k] = box->lo[k] + (box->hi[k] - box->lo[k]) / 2;
        reach = std::hypot(reach, (box->hi[k] - box->lo[k]) / 2);
    }
    if (!(reach > distance)) return std::nullopt;
    const double factor = 1 - distance / reach;
    Numbers numbers = part.placed.pose.approximate();
    for (std::size_t i = 0; i < 3; ++i) {
        double kept = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            kept += numbers[4 * i + k] * middle[k];
            numbers[4 * i + k] *= factor;
        }
        numbers[4 * i + 3] += kept * (1 - factor);
    }
    return Pose::from_doubles(numbers);
}

/// Where a may be put instead, no farther away than `distance`: along the axes of all three frames,
/// and away from b.
std::vector<Pose> moves(const GdmlPart& a, const GdmlPart& b, double distance) {
    std::vector<Point3d> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Point3d away{};
    for (std::size_t k = 0; k < 3; ++k)
        away[k] =
            (a.placed.box.lo[k] + a.placed.box.hi[k]) - (b.placed.box.lo[k] + b.placed.box.hi[k]);
    directions.push_back(away);
    for (const GdmlPart* part : {&a, &b}) {
        const Numbers& m = part->placed.pose.approximate();
        for (std::size_t k = 0; k < 3; ++k) directions.push_back({m[k], m[4 + k], m[8 + k]});
    }
    std::vector<Pose> out;
    for (const Point3d& d : directions) {
        const double length = std::hypot(d[0], d[1], d[2]);
        if (!(length > 0)) continue;
        for (const double sign : {1.0, -1.0}) {
            const double by = sign * distance / length;
            out.push_back(moved(a.placed.pose, {by * d[0], by * d[1], by * d[2]}));
        }
    }
    return out;
}

bool is_within_deviation(GdmlRule rule, const GdmlPart& a, const GdmlPart& b) {
    const double distance = a.deviation + b.deviation;
    if (distance == 0) return false;
    const auto is_good_at = [&](const Pose& pose_a, const Pose& pose_b) {
        return is_good(rule, interfere(a.placed.model, pose_a, b.placed.model, pose_b).relation);
    };
    const auto a_shrunk = shrunk(a, distance);
    if (!a_shrunk || is_good_at(*a_shrunk, b.placed.pose)) return true;
    if (rule == GdmlRule::Apart) {
        const auto b_shrunk = shrunk(b, distance);
        if (!b_shrunk || is_good_at(a.placed.pose, *b_shrunk)) return true;
    }
    return std::ranges::any_of(moves(a, b, distance),
                               [&](const Pose& pose) { return is_good_at(pose, b.placed.pose); });
}

ExactRational cubic_millimetres(const ExactRational& cubic_steps) {
    static const ExactRational unit = ExactRational(1) / ExactRational::from_double(steps_per_mm);
    return cubic_steps * unit * unit * unit;
}

/// Of the matrix of a pose, as a factor of volumes.
ExactRational determinant(const Pose& pose) {
    const Numbers& numbers = pose.approximate();
    const auto m = [&](std::size_t i, std::size_t k) {
        return ExactRational::from_double(numbers[4 * i + k]);
    };
    const ExactRational out = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
                              m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
                              m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
    return out.sign() < 0 ? -out : out;
}

Json volume_json(GdmlRule rule, const PlacedPart& a, const PlacedPart& b) {
    const Overlap common = overlap(a.model, a.pose, b.model, b.pose);
    ExactRational volume = common.volume;
    if (rule == GdmlRule::Within)
        volume = exact_volume(a.model.solid()) * determinant(a.pose) - volume;
    volume = cubic_millimetres(volume);
    Json out;
    out["value"] = volume.to_double();
    out["exact"] = volume.to_string();
    out["is_exact"] = common.is_exact;
    return out;
}

Json clash_json_of(GdmlRule rule, Relation relation, const GdmlPart& a, const GdmlPart& b,
                   bool volumes) {
    Json out;
    out["a"] = a.placed.id;
    out["b"] = b.placed.id;
    out["relation"] = to_string(relation);
    Json point = Json::array();
    double diagonal = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        double lo = a.placed.box.lo[k];
        double hi = a.placed.box.hi[k];
        if (rule == GdmlRule::Apart) {
            lo = std::max(lo, b.placed.box.lo[k]);
            hi = std::min(hi, b.placed.box.hi[k]);
        }
        point.push_back((lo + (hi - lo) / 2) / steps_per_mm);
        diagonal = std::hypot(diagonal, hi - lo);
    }
    out["point"] = std::move(point);
    out["size"] = diagonal / steps_per_mm;
    out["deviation"] = (a.deviation + b.deviation) / steps_per_mm;
    out["within_deviation"] = is_within_deviation(rule, a, b);
    if (volumes) out["volume"] = volume_json(rule, a.placed, b.placed);
    return out;
}

}  // namespace

GdmlFinding compare_gdml_parts(GdmlRule rule, const GdmlPart& a, const GdmlPart& b, bool volumes) {
    GdmlFinding out;
    const PlacedPart& p = a.placed;
    const PlacedPart& q = b.placed;
    const Relation relation = interfere(p.model, p.pose, q.model, q.pose).relation;
    if (!is_good(rule, relation)) {
        out.clash = clash_json_of(rule, relation, a, b, volumes);
        return out;
    }
    const double distance = a.deviation + b.deviation;
    if (distance == 0) return out;
    const bool is_near = are_nearer_than(p.model, p.pose, q.model, q.pose, distance);
    out.proof = is_near ? GdmlFinding::Proof::Facets : GdmlFinding::Proof::Beyond;
    return out;
}

}  // namespace trisect::app
