// SPDX-License-Identifier: Apache-2.0
//
// The plane of a hit is exact, so whether two triangles are one face or meet in an edge is not a
// matter of angles: planes are grouped by normals in lowest terms, and compared exactly in a group.
#include "render_index_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace trisect::app {
namespace {

/// A plane with what tells quickly that two planes differ.
struct Candidate {
    std::array<Plane::Coefficient, 3> direction{};  ///< the normal in lowest terms
    double distance = 0;                            ///< of the origin, rounded
    const Plane* plane = nullptr;
    std::uint32_t look = 0;
};

Candidate candidate_of(const Plane& plane, std::uint32_t look) {
    Candidate c;
    c.direction = plane.direction();
    const double length =
        std::hypot(plane.approx_normal(0), plane.approx_normal(1), plane.approx_normal(2));
    c.distance = plane.approx_offset() / length;
    c.plane = &plane;
    c.look = look;
    return c;
}

Eigen::Vector3f unit_normal(const Plane& plane) {
    return Eigen::Vector3d(plane.approx_normal(0), plane.approx_normal(1), plane.approx_normal(2))
        .normalized()
        .cast<float>();
}

/// Numbers the planes, equal ones alike.
void number_planes(std::vector<Candidate>& candidates, std::vector<Look>& looks) {
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tie(a.direction, a.distance, a.look) <
               std::tie(b.direction, b.distance, b.look);
    });
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        // Equal planes have nearly equal distances, so they are neighbours.
        const bool is_new = i == 0 || candidates[i].direction != candidates[i - 1].direction ||
                            !is_same_plane(*candidates[i].plane, *candidates[i - 1].plane);
        if (is_new) ++number;
        looks[candidates[i].look].plane = number;
    }
}

}  // namespace

std::size_t IndexScene::Hash::operator()(const Key& key) const {
    std::uint64_t h = key.operand;
    const auto mix = [&h](std::uint64_t word) {
        h = (h ^ word) * 0x9e3779b97f4a7c15U;
        h ^= h >> 29;
    };
    for (int k = 0; k < 3; ++k) {
        mix(key.plane.normal(k).limb(0));
        mix(key.plane.normal(k).limb(1));
    }
    mix(key.plane.offset().limb(0));
    return h;
}

IndexScene::IndexScene(BrepIndex index, const QueriedSet& set, double diameter)
    : IndexScene(
          std::move(index), [&set](std::uint32_t source) { return set.operand_number(source); },
          diameter) {}

IndexScene::IndexScene(BrepIndex index, ColorOf color, double diameter)
    : index_(std::move(index)), color_(std::move(color)), diameter_(diameter) {}

SurfaceHit IndexScene::first_hit(const ViewRay& ray) const {
    const auto hit =
        index_.first_hit(Ray{{ray.origin.x(), ray.origin.y(), ray.origin.z()},
                             {ray.direction.x(), ray.direction.y(), ray.direction.z()}});
    if (!hit) return {};
    const Key key{hit->place.faces[0].operand, hit->plane};
    const double t = hit->enter.approximate();
    const auto known = numbers_.find(key);
    if (known != numbers_.end()) return {known->second, t};
    // Two threads may meet a new plane at once: the number of the one that comes second is lost.
    const auto [entry, is_new] = numbers_.insert({key, next_++});
    return {entry->second, t};
}

std::vector<Look> IndexScene::looks() const {
    std::vector<Look> looks(next_);
    std::vector<Candidate> candidates;
    candidates.reserve(numbers_.size());
    for (const auto& [key, number] : numbers_) {
        Look& look = looks[number];
        look.normal = unit_normal(key.plane);
        const auto operand = color_(key.operand);
        look.color = static_cast<std::uint16_t>(operand.value_or(0));
        look.is_section = !operand.has_value();
        candidates.push_back(candidate_of(key.plane, number));
    }
    number_planes(candidates, looks);
    return looks;
}

}  // namespace trisect::app
