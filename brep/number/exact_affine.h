// SPDX-License-Identifier: Apache-2.0
//
// ExactAffine: an affine map of space in fractions, and its rounding of points.
#pragma once

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/point3d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace trisect::detail {

/// p -> M p + t, the rows of the 3x4 matrix (M | t) as fractions. Value type.
class ExactAffine {
public:
    /// The identity.
    ExactAffine();
    /// Row by row, each number exactly the given double.
    [[nodiscard]] static ExactAffine from_rows(const std::array<double, 12>& rows);
    /// Scale, then the rotation by a quaternion (x, y, z, w) of any length but 0, then translation.
    [[nodiscard]] static ExactAffine from_parts(const std::array<double, 3>& scale,
                                                const std::array<double, 4>& quaternion,
                                                const std::array<double, 3>& translation);

    /// First this one, then the other.
    [[nodiscard]] ExactAffine then(const ExactAffine& next) const;
    [[nodiscard]] bool is_identity() const;
    /// Sign of det M.
    [[nodiscard]] int orientation() const;

    /// The numbers, correctly rounded.
    [[nodiscard]] std::array<double, 12> rows() const;

    struct Image {
        Point3d point{};
        double move = 0;  ///< largest change of a coordinate by rounding; 0 only if there is none

        void note(double change) { move = std::max(move, std::fabs(change)); }
    };
    /// The doubles nearest to the coordinates of the image.
    /// \throw LimitError beyond the range of doubles
    [[nodiscard]] Image apply(const Point3d& p) const;

private:
    [[nodiscard]] const ExactRational& at(std::size_t row, std::size_t column) const {
        return rows_[4 * row + column];
    }
    [[nodiscard]] bool apply_in_doubles(const Point3d& p, Image& image) const;
    [[nodiscard]] bool apply_in_pairs(const Point3d& p, Image& image) const;
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

}  // namespace trisect::detail
