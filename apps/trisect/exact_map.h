// SPDX-License-Identifier: Apache-2.0
//
// ExactMap: an exact map of space, and its rounding of a mesh.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/brep/number/exact_affine.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <cstddef>
#include <string>

namespace trisect::app {

struct RoundingReport {
    std::size_t moved = 0;  ///< vertices with a rounded coordinate
    double max_move = 0;    ///< largest change of one coordinate by rounding
};

/// x -> M x + t, as the rows of the 3x4 matrix (M | t). Value type.
class ExactMap {
public:
    ExactMap() = default;  ///< the identity

    /// Twelve numbers, row by row, each exactly the given double.
    [[nodiscard]] static ExactMap from_rows(const std::array<double, 12>& rows);
    /// Reads them from a text file. \throw InputError with the place.
    [[nodiscard]] static ExactMap from_file(const std::string& path);
    [[nodiscard]] static ExactMap translation(const std::array<double, 3>& vector);
    [[nodiscard]] static ExactMap scaling(double factor);
    /// Counter-clockwise seen from the tip of the axis. A multiple of 90 degrees about a coordinate
    /// axis is exact; otherwise the coefficients are doubles and the map is a rotation up to their
    /// rounding. \throw UsageError for an axis of length 0.
    [[nodiscard]] static ExactMap rotation(const std::array<double, 4>& axis_and_degrees);

    /// First this map, then the other one.
    [[nodiscard]] ExactMap then(const ExactMap& next) const { return map_.then(next.map_); }
    [[nodiscard]] bool is_identity() const { return map_.is_identity(); }
    /// 1 if orientation is kept, -1 if mirrored, 0 if space is made flat.
    [[nodiscard]] int orientation() const { return map_.orientation(); }
    /// The coefficients, correctly rounded.
    [[nodiscard]] std::array<double, 12> rows() const { return map_.rows(); }

    /// Moves every point to the doubles nearest to its exact image; a mirror turns the faces over,
    /// so that they still face outwards.
    /// \throw UsageError when the map makes space flat, LimitError beyond the range of doubles.
    RoundingReport apply(PolygonMesh& mesh) const;
    /// The same with its properties. Normals stay across their faces and keep their lengths; they
    /// are rounded as doubles are.
    RoundingReport apply(ModelPart& part) const;

private:
    ExactMap(const detail::ExactAffine& map) : map_(map) {}

    detail::ExactAffine map_;
};

}  // namespace trisect::app
