// SPDX-License-Identifier: Apache-2.0
#include "mill_film.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace trisect::app {

std::size_t MillFilm::Hash::operator()(const std::array<std::uint64_t, 3>& key) const {
    std::uint64_t h = 0;
    for (const std::uint64_t word : key) {
        h = (h ^ word) * 0x9e3779b97f4a7c15U;
        h ^= h >> 29;
    }
    return h;
}

std::uint32_t MillFilm::point(const Point3d& p) {
    const std::array<std::uint64_t, 3> key{std::bit_cast<std::uint64_t>(p[0]),
                                           std::bit_cast<std::uint64_t>(p[1]),
                                           std::bit_cast<std::uint64_t>(p[2])};
    const auto [entry, is_new] =
        point_numbers_.emplace(key, static_cast<std::uint32_t>(points_.size()));
    if (is_new) points_.push_back(p);
    return entry->second;
}

void MillFilm::add(const PolygonMesh& mesh, const MeshMap& map, std::size_t steps,
                   const std::function<bool(std::uint32_t)>& is_cut) {
    if (frames_.size() == most_frames) halve();
    const auto frame = static_cast<std::uint8_t>(frames_.size());
    frames_.push_back(steps);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(mesh.points.size());
    for (const Point3d& p : mesh.points) numbers.push_back(point(p));
    decltype(alive_) alive;
    alive.reserve(mesh.face_count());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        std::array<std::uint32_t, 3> c{numbers[face[0]], numbers[face[1]], numbers[face[2]]};
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        const std::array<std::uint64_t, 3> key{c[0], c[1], c[2]};
        const auto known = alive_.find(key);
        if (known != alive_.end()) {
            alive.insert(alive_.extract(known));
            continue;
        }
        alive.emplace(key, static_cast<std::uint32_t>(triangles_.size()));
        triangles_.push_back({c, frame, 255, is_cut(map.source[f].operand)});
    }
    for (const auto& [key, t] : alive_) triangles_[t].death = frame;
    alive_ = std::move(alive);
    while (estimated_bytes() > most_bytes_ && frames_.size() > 2) halve();
}

/// Of the page: some ten bytes a triangle and six a point, before base64.
std::size_t MillFilm::estimated_bytes() const {
    return (triangles_.size() * 10 + points_.size() * 6) * 4 / 3;
}

void MillFilm::halve() {
    stride_ *= 2;
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < frames_.size(); i += 2) frames.push_back(frames_[i]);
    frames_ = std::move(frames);
    const auto later = [](std::uint8_t f) { return static_cast<std::uint8_t>((f + 1) / 2); };
    std::vector<std::uint32_t> numbers(triangles_.size());
    std::vector<Triangle> kept;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        Triangle t = triangles_[i];
        t.birth = later(t.birth);
        if (t.death != 255) t.death = later(t.death);
        numbers[i] = static_cast<std::uint32_t>(kept.size());
        const bool is_seen = t.birth < t.death && t.birth < frames_.size();
        // What was born in a dropped last frame is there from the next one on.
        if (is_seen || t.death == 255) kept.push_back(t);
    }
    triangles_ = std::move(kept);
    for (auto& [key, t] : alive_) t = numbers[t];
}

}  // namespace trisect::app
