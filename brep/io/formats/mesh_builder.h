// SPDX-License-Identifier: Apache-2.0
//
// MeshBuilder: checked insertion of vertices and corners by the readers.
// Limits and indices are checked here. Every index passes add_corner exactly once.
//
// A corner may name a vertex that comes later in the file (OBJ with faces first, PLY with the face
// element first). Such a corner can only be judged at the end, so its place is kept; only those
// that reach further than all before them matter, because if one of the others is out of range,
// then so is the first one that reached as far.
#pragma once

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace trisect::detail {

class MeshBuilder {
public:
    /// `index_base` is the number that the format gives to the first vertex.
    MeshBuilder(const InputText& source, unsigned index_base)
        : source_(source),
          index_base_(index_base),
          vertex_limit_(std::min<std::uint64_t>(source.limits().vertices, 0xFFFF'FFFEU)),
          sink_(source.sink()) {
        start_face();
    }

    /// Room for counts that the caller has bounded by the size of the file.
    void reserve(std::uint64_t points, std::uint64_t faces, std::uint64_t corners) {
        points = std::min(points, vertex_limit_);
        faces = std::min(faces, source_.limits().faces);
        if (sink_ != nullptr) return;
        mesh_.points.reserve(static_cast<std::size_t>(points));
        mesh_.face_begin.reserve(static_cast<std::size_t>(faces + 1));
        mesh_.corners.reserve(static_cast<std::size_t>(corners));
    }

    [[nodiscard]] std::uint64_t point_count() const noexcept {
        return points_before_ + mesh_.points.size();
    }
    [[nodiscard]] std::uint64_t face_count() const noexcept {
        return faces_before_ + mesh_.face_count();
    }
    /// Those that no sink has taken.
    [[nodiscard]] std::vector<Point3d>& points() noexcept { return mesh_.points; }

    void add_point(const Point3d& point, const char* at) {
        if (sink_ != nullptr && mesh_.points.size() >= points_of_a_piece) hand_over();
        mesh_.points.push_back(point);
        check_point_count(at);
    }
    /// To be called after a point was added to points().
    void check_point_count(const char* at) const {
        check_stop();
        if (point_count() > vertex_limit_) {
            source_.fail_limit(at, "more than " + std::to_string(vertex_limit_) +
                                       " vertices, the limit for a file");
        }
    }

    /// Adds vertex `index`, counted from 0, to the face being built.
    void add_corner(std::uint64_t index, const char* at) {
        if (index >= point_count()) note_ahead(index, at);
        if (mesh_.corners.size() >= corner_stop_) corner_limit(at);
        mesh_.corners.push_back(static_cast<std::uint32_t>(index));
    }

    /// Ends the face; `at` is where it stands.
    void end_face(const char* at) {
        check_stop();
        const std::size_t n = mesh_.corners.size() - mesh_.face_begin.back();
        if (n < 3) {
            source_.fail(at, "a face with " + std::to_string(n) +
                                 (n == 1 ? " corner" : " corners") + "; it needs at least three");
        }
        if (face_count() >= source_.limits().faces) {
            source_.fail_limit(at, "more than " + std::to_string(source_.limits().faces) +
                                       " faces, the limit for a file");
        }
        mesh_.face_begin.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
        if (sink_ != nullptr && mesh_.corners.size() >= corners_of_a_piece) hand_over();
        start_face();
    }

    /// Hands out the mesh after the last check, or what is left of it to the sink.
    [[nodiscard]] PolygonMesh finish() {
        for (const auto& [index, at] : ahead_) {
            if (index >= point_count()) out_of_range(index, at);
        }
        if (sink_ != nullptr) hand_over();
        return std::move(mesh_);
    }

private:
    static constexpr std::size_t points_of_a_piece = std::size_t{1} << 14;
    static constexpr std::size_t corners_of_a_piece = 3 * points_of_a_piece;

    // Corners of a face that is being built stay.
    void hand_over() {
        const std::size_t whole = mesh_.face_begin.back();
        const std::vector<std::uint32_t> begun(
            mesh_.corners.begin() + static_cast<std::ptrdiff_t>(whole), mesh_.corners.end());
        mesh_.corners.resize(whole);
        sink_->take(mesh_);
        points_before_ += mesh_.points.size();
        faces_before_ += mesh_.face_count();
        mesh_.points.clear();
        mesh_.corners = begun;
        mesh_.face_begin.assign(1, 0);
    }

    void start_face() noexcept {
        corner_stop_ = std::min<std::uint64_t>(mesh_.corners.size() + source_.limits().loop_corners,
                                               0xFFFF'FFFFU);
    }

    void note_ahead(std::uint64_t index, const char* at) {
        if (index >= vertex_limit_) out_of_range(index, at);
        if (ahead_.empty() || index > ahead_.back().first) ahead_.emplace_back(index, at);
    }

    [[noreturn]] void out_of_range(std::uint64_t index, const char* at) const {
        const std::string shown = index <= UINT64_MAX - index_base_
                                      ? std::to_string(index + index_base_)
                                      : std::to_string(index);
        source_.fail(at, "vertex " + shown + " (counted from " + std::to_string(index_base_) +
                             ") does not exist; the file has " + std::to_string(point_count()) +
                             " vertices" + (index >= vertex_limit_ ? " so far" : ""));
    }

    [[noreturn]] void corner_limit(const char* at) const {
        const std::size_t n = mesh_.corners.size() - mesh_.face_begin.back();
        if (n >= source_.limits().loop_corners) {
            source_.fail_limit(at, "a face with more than " +
                                       std::to_string(source_.limits().loop_corners) +
                                       " corners, the limit for a face");
        }
        source_.fail_limit(at, "more than 2^32 - 1 corners in all");
    }

    const InputText& source_;
    PolygonMesh mesh_;
    unsigned index_base_;
    std::uint64_t vertex_limit_;
    MeshSink* sink_;
    std::uint64_t points_before_ = 0;  // which the sink has
    std::uint64_t faces_before_ = 0;
    std::uint64_t corner_stop_ = 0;
    std::vector<std::pair<std::uint64_t, const char*>> ahead_;
};

}  // namespace trisect::detail
