// SPDX-License-Identifier: Apache-2.0
//
// Placement: an exact map that puts a mesh in its place.
#pragma once

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/io/read_model.h>

#include <array>
#include <cstddef>

namespace trisect::detail {

/// p -> M p + t, the rows of the 3x4 matrix (M | t) as fractions. Value type.
class Placement {
public:
    /// The identity.
    Placement();
    /// Row by row, each number exactly the given double.
    [[nodiscard]] static Placement from_rows(const std::array<double, 12>& rows);
    /// Scale, then the rotation by a quaternion (x, y, z, w) of any length but 0, then translation.
    [[nodiscard]] static Placement from_parts(const std::array<double, 3>& scale,
                                              const std::array<double, 4>& quaternion,
                                              const std::array<double, 3>& translation);

    /// First this one, then the other.
    [[nodiscard]] Placement then(const Placement& next) const;
    [[nodiscard]] bool is_identity() const;
    /// Sign of det M.
    [[nodiscard]] int orientation() const;

    /// The double nearest to each coordinate of the image; counts what changed by that.
    /// \throw LimitError beyond the range of doubles
    [[nodiscard]] Point3d apply(const Point3d& p, ModelReport& report) const;

private:
    [[nodiscard]] const ExactRational& at(std::size_t row, std::size_t column) const {
        return rows_[4 * row + column];
    }
    [[nodiscard]] bool apply_in_doubles(const Point3d& p, Point3d& image, double& largest) const;
    [[nodiscard]] bool apply_in_pairs(const Point3d& p, Point3d& image, double& largest) const;
    void note_rows();

    std::array<ExactRational, 12> rows_;
    // Rows with one entry, which is a power of two with a sign: factor, column and translation.
    struct SimpleRow {
        double factor = 1;
        double shift = 0;
        std::size_t column = 0;
    };
    std::array<SimpleRow, 3> simple_;
    bool is_simple_ = true;
    // The rows as doubles, and what these lack of them.
    std::array<double, 12> high_{};
    std::array<double, 12> low_{};
};

/// Adds a mesh where the placement puts it, after what the part has.
/// \pre the placement is regular
void add_placed(ModelPart& part, const PolygonMesh& mesh, const Placement& placement,
                ModelReport& report);

}  // namespace trisect::detail
