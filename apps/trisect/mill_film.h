// SPDX-License-Identifier: Apache-2.0
//
// MillFilm: the triangles of a stock at several times.
#pragma once

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace trisect::app {

/// Frames are versions of the stock. A cut changes few triangles, so a triangle is kept once, with
/// the frames from which and before which it is there. Where the film would become larger than it
/// may, every second frame is dropped, and frames after that are taken half as often.
class MillFilm {
public:
    static constexpr std::size_t most_frames = 250;

    struct Triangle {
        std::array<std::uint32_t, 3> corners{};
        std::uint8_t birth = 0;
        std::uint8_t death = 255;  ///< 255: it stays
        bool is_cut = false;       ///< the tool made it
    };

    explicit MillFilm(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    /// Whether the frame of that number, in a sequence from 0, is to be taken.
    [[nodiscard]] bool wants(std::size_t number) const { return number % stride_ == 0; }
    /// The stock after so many steps. `is_cut`: by FaceSource::operand.
    void add(const PolygonMesh& mesh, const MeshMap& map, std::size_t steps,
             const std::function<bool(std::uint32_t)>& is_cut);

    [[nodiscard]] const std::vector<std::size_t>& frames() const { return frames_; }
    [[nodiscard]] const std::vector<Point3d>& points() const { return points_; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
    [[nodiscard]] bool has_dropped() const { return stride_ > 1; }

private:
    struct Hash {
        [[nodiscard]] std::size_t operator()(const std::array<std::uint64_t, 3>& key) const;
    };
    [[nodiscard]] std::uint32_t point(const Point3d& p);
    [[nodiscard]] std::size_t estimated_bytes() const;
    void halve();

    std::size_t most_bytes_;
    std::size_t stride_ = 1;
    std::vector<std::size_t> frames_;
    std::vector<Point3d> points_;
    std::vector<Triangle> triangles_;
    std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, Hash> point_numbers_;
    std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, Hash> alive_;
};

}  // namespace trisect::app
