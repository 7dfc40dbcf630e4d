// SPDX-License-Identifier: Apache-2.0
//
// Lengths and angles of GDML, and what its section `define` names.
//
// Lengths are decimals, and become whole numbers of steps of 1e-9 mm: there a tenth and two tenths
// are three tenths. What is finer is rounded. Angles are in degrees.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/brep/transform.h>

#include "gdml_document.h"
#include "gdml_expression.h"

namespace trisect::app {

inline constexpr double steps_per_mm = 1e9;

class GdmlValues final : public GdmlNames {
public:
    /// \throw InputError
    explicit GdmlValues(const GdmlDocument& document);

    [[nodiscard]] std::optional<double> value(std::string_view name,
                                              std::span<const double> indices) const override;

    /// The value of an attribute without a unit. \throw InputError
    [[nodiscard]] double number(const GdmlElement& element, std::string_view attribute,
                                std::optional<double> otherwise = std::nullopt) const;
    /// In steps, whole. The unit stands in the attribute `lunit`, or in `unit`; millimetres.
    [[nodiscard]] double length(const GdmlElement& element, std::string_view attribute,
                                std::optional<double> otherwise = std::nullopt) const;
    /// The same where `of` has the unit, as points of an extrusion have it from the extrusion.
    [[nodiscard]] double length(const GdmlElement& element, std::string_view attribute,
                                const GdmlElement& of) const;
    /// In degrees. The unit stands in `aunit`, or in `unit`; radians.
    [[nodiscard]] double angle(const GdmlElement& element, std::string_view attribute,
                               std::optional<double> otherwise = std::nullopt) const;
    /// A count from `least` to `most`.
    [[nodiscard]] std::uint32_t count(const GdmlElement& element, std::string_view attribute,
                                      std::uint32_t least, std::uint32_t most) const;

    /// Of an element with children such as position or positionref; zeros where there are none.
    [[nodiscard]] Point3d position(const GdmlElement& element,
                                   std::string_view name = "position") const;
    [[nodiscard]] Point3d rotation(const GdmlElement& element,
                                   std::string_view name = "rotation") const;
    [[nodiscard]] Point3d scale(const GdmlElement& element) const;
    /// A position that `define` has.
    [[nodiscard]] Point3d named_position(const GdmlElement& element, const std::string& name) const;

private:
    using Vectors = std::map<std::string, Point3d, std::less<>>;
    struct Matrix {
        std::size_t columns = 1;
        std::vector<double> entries;
    };

    void define(const GdmlElement& element);
    [[nodiscard]] double formula(const GdmlElement& element, const std::string& text) const;
    [[nodiscard]] double unit_of(const GdmlElement& element, std::string_view attribute,
                                 const char* usual) const;
    [[nodiscard]] Point3d lengths(const GdmlElement& element) const;
    [[nodiscard]] Point3d angles(const GdmlElement& element) const;
    [[nodiscard]] Point3d numbers(const GdmlElement& element, double otherwise) const;
    [[nodiscard]] std::optional<Matrix> matrix(const GdmlElement& element) const;
    [[nodiscard]] const Point3d& named(const Vectors& vectors, const GdmlElement& element,
                                       const std::string& name) const;

    const GdmlDocument& document_;
    std::map<std::string, double, std::less<>> numbers_;
    std::map<std::string, Matrix, std::less<>> matrices_;
    Vectors positions_;
    Vectors rotations_;
    Vectors scales_;
};

/// Rotations about x, then y, then z, as an exact map where they are quarter turns.
[[nodiscard]] AffineMap gdml_rotation(const Point3d& degrees);
/// The inverse of that.
[[nodiscard]] AffineMap gdml_inverse_rotation(const Point3d& degrees);
/// Whether entries of a map are rounded: it turns by no multiple of 90 degrees.
[[nodiscard]] bool is_rounded(const AffineMap& map);

}  // namespace trisect::app
