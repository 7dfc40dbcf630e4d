// SPDX-License-Identifier: Apache-2.0
//
// Piece: the result of a boolean in one slab, as a file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/kernel/point3d.h>

namespace trisect::app {

/// An exact point by its coordinates as fractions in lowest terms: equal names are equal points.
using PointName = std::string;

/// A wall as one side of it sees it.
struct WallOutline {
    std::vector<PointName> names;                     ///< of the first points of the piece
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< of the boundary, by numbers of points
};

/// The boundary in a slab, without the walls. Points on the lower wall come first, then those on
/// the upper one.
struct Piece {
    WallOutline lower;
    WallOutline upper;
    std::vector<Point3d> points;  ///< rounded once
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// What is left of a mesh that was cut by walls: the triangles of the operand `window` are the
/// walls. \pre the mesh is closed
[[nodiscard]] Piece piece_of(const ExactMesh& mesh, std::uint32_t window, std::size_t axis,
                             double middle);

/// Complete or not at all.
void write_piece(const std::string& name, const Piece& piece);

/// A piece on the disk, whose points and triangles are read when they are needed.
class PieceFile {
public:
    /// \throw InputError for a file that is damaged
    explicit PieceFile(std::string name);

    [[nodiscard]] std::uint64_t point_count() const { return points_; }
    [[nodiscard]] std::uint64_t triangle_count() const { return triangles_; }
    [[nodiscard]] WallOutline lower() const;
    [[nodiscard]] WallOutline upper() const;
    [[nodiscard]] std::vector<Point3d> points(std::uint64_t begin, std::uint64_t end) const;
    [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles(std::uint64_t begin,
                                                                      std::uint64_t end) const;

private:
    [[nodiscard]] WallOutline outline(std::size_t which) const;

    std::string name_;
    std::uint64_t points_ = 0;
    std::uint64_t triangles_ = 0;
    std::array<std::uint64_t, 2> outline_bytes_{};
};

}  // namespace trisect::app
