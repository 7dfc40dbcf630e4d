// SPDX-License-Identifier: Apache-2.0
#include "gdml_values.h"

#include <trisect/brep/io/models/xml_reader.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace trisect::app {
namespace {

struct Unit {
    std::string_view name;
    double value;
};
// In millimetres and radians, as formulas have them.
constexpr double degree = std::numbers::pi / 180;
constexpr std::array<Unit, 34> units{{
    {"mm", 1},
    {"millimeter", 1},
    {"millimetre", 1},
    {"cm", 10},
    {"centimeter", 10},
    {"centimetre", 10},
    {"m", 1e3},
    {"meter", 1e3},
    {"metre", 1e3},
    {"km", 1e6},
    {"kilometer", 1e6},
    {"kilometre", 1e6},
    {"um", 1e-3},
    {"micron", 1e-3},
    {"micrometer", 1e-3},
    {"micrometre", 1e-3},
    {"nm", 1e-6},
    {"nanometer", 1e-6},
    {"nanometre", 1e-6},
    {"angstrom", 1e-7},
    {"in", 25.4},
    {"inch", 25.4},
    {"rad", 1},
    {"radian", 1},
    {"mrad", 1e-3},
    {"milliradian", 1e-3},
    {"deg", degree},
    {"degree", degree},
    {"pi", std::numbers::pi},
    {"PI", std::numbers::pi},
    {"halfpi", std::numbers::pi / 2},
    {"HALFPI", std::numbers::pi / 2},
    {"twopi", std::numbers::pi * 2},
    {"TWOPI", std::numbers::pi * 2},
}};

std::optional<double> unit_value(std::string_view name) {
    for (const Unit& unit : units)
        if (unit.name == name) return unit.value;
    return std::nullopt;
}

/// Of angles in radians with all digits of a double: what is so near to a ten-thousandth of a
/// degree is meant to be one.
double degrees_meant(double degrees) {
    const double near = std::nearbyint(degrees * 1e4) / 1e4;
    return std::fabs(near - degrees) < 1e-11 ? near : degrees;
}

}  // namespace

GdmlValues::GdmlValues(const GdmlDocument& document) : document_(document) {
    for (const GdmlElement& section : document.root().children)
        if (section.name == "define")
            for (const GdmlElement& element : section.children) define(element);
}

void GdmlValues::define(const GdmlElement& e) {
    if (e.name == "matrix") {
        // Most are of optical properties, in units that no length has.
        if (auto made = matrix(e))
            matrices_.insert_or_assign(document_.required(e, "name"), std::move(*made));
    } else if (e.name == "position") {
        positions_.insert_or_assign(document_.required(e, "name"), lengths(e));
    } else if (e.name == "rotation") {
        rotations_.insert_or_assign(document_.required(e, "name"), angles(e));
    } else if (e.name == "scale") {
        scales_.insert_or_assign(document_.required(e, "name"), numbers(e, 1));
    } else if (e.name == "constant" || e.name == "variable" || e.name == "expression") {
        numbers_.insert_or_assign(document_.required(e, "name"), number(e, "value"));
    } else if (e.name == "quantity") {
        const std::string unit = e.text("unit");
        const double times = unit.empty() ? 1 : unit_value(unit).value_or(1);
        numbers_.insert_or_assign(document_.required(e, "name"), number(e, "value") * times);
    }
}

std::optional<GdmlValues::Matrix> GdmlValues::matrix(const GdmlElement& e) const {
    Matrix out;
    out.columns = count(e, "coldim", 1, 1U << 20);
    std::string_view rest = document_.required(e, "values");
    try {
        while (!detail::trimmed_word(rest).empty())
            out.entries.push_back(gdml_value(detail::take_word(rest), *this));
    } catch (const GdmlFormulaError&) {
        return std::nullopt;
    }
    return out;
}

std::optional<double> GdmlValues::value(std::string_view name,
                                        std::span<const double> indices) const {
    if (indices.empty()) {
        const auto at = numbers_.find(name);
        return at != numbers_.end() ? std::optional(at->second) : unit_value(name);
    }
    const auto at = matrices_.find(name);
    if (at == matrices_.end() || indices.size() > 2) return std::nullopt;
    const Matrix& m = at->second;
    const double row = indices.size() == 2 ? indices[0] : 1;
    const double column = indices.back();
    const double place = (row - 1) * static_cast<double>(m.columns) + column - 1;
    const bool is_in = row >= 1 && column >= 1 && place < static_cast<double>(m.entries.size());
    if (!is_in || place != std::floor(place)) return std::nullopt;
    return m.entries[static_cast<std::size_t>(place)];
}

double GdmlValues::formula(const GdmlElement& element, const std::string& text) const {
    try {
        return gdml_value(text, *this);
    } catch (const GdmlFormulaError& e) {
        document_.fail(element, "<" + element.name + ">: " + e.what());
    }
}

double GdmlValues::number(const GdmlElement& element, std::string_view attribute,
                          std::optional<double> otherwise) const {
    const std::string* text = element.find(attribute);
    if (text == nullptr && otherwise) return *otherwise;
    return formula(element, document_.required(element, attribute));
}

double GdmlValues::unit_of(const GdmlElement& element, std::string_view attribute,
                           const char* usual) const {
    const std::string* unit = element.find(attribute);
    if (unit == nullptr) unit = element.find("unit");
    const std::string name = unit != nullptr && !unit->empty() ? *unit : usual;
    const auto value = unit_value(name);
    if (!value) document_.fail(element, "no unit: '" + name + "'");
    return *value;
}

double GdmlValues::length(const GdmlElement& element, std::string_view attribute,
                          const GdmlElement& of) const {
    return std::nearbyint(number(element, attribute) * unit_of(of, "lunit", "mm") * steps_per_mm);
}

double GdmlValues::length(const GdmlElement& element, std::string_view attribute,
                          std::optional<double> otherwise) const {
    if (element.find(attribute) == nullptr && otherwise) return *otherwise;
    return length(element, attribute, element);
}

double GdmlValues::angle(const GdmlElement& element, std::string_view attribute,
                         std::optional<double> otherwise) const {
    if (element.find(attribute) == nullptr && otherwise) return *otherwise;
    const double unit = unit_of(element, "aunit", "rad");
    const double in_degrees = unit == degree ? 1 : unit / degree;
    return degrees_meant(number(element, attribute) * in_degrees);
}

std::uint32_t GdmlValues::count(const GdmlElement& element, std::string_view attribute,
                                std::uint32_t least, std::uint32_t most) const {
    const double value = number(element, attribute);
    if (!(value >= least && value <= most) || value != std::floor(value))
        document_.fail(element, "no count: " + std::string(attribute));
    return static_cast<std::uint32_t>(value);
}

Point3d GdmlValues::lengths(const GdmlElement& e) const {
    return {length(e, "x", 0), length(e, "y", 0), length(e, "z", 0)};
}

Point3d GdmlValues::angles(const GdmlElement& e) const {
    return {angle(e, "x", 0), angle(e, "y", 0), angle(e, "z", 0)};
}

Point3d GdmlValues::numbers(const GdmlElement& e, double otherwise) const {
    return {number(e, "x", otherwise), number(e, "y", otherwise), number(e, "z", otherwise)};
}

const Point3d& GdmlValues::named(const Vectors& vectors, const GdmlElement& element,
                                 const std::string& name) const {
    const auto at = vectors.find(name);
    if (at == vectors.end())
        document_.fail(element, "<" + element.name + ">: '" + name + "' is not defined");
    return at->second;
}

Point3d GdmlValues::named_position(const GdmlElement& element, const std::string& name) const {
    return named(positions_, element, name);
}

Point3d GdmlValues::position(const GdmlElement& element, std::string_view name) const {
    if (const GdmlElement* e = element.child(name)) return lengths(*e);
    const GdmlElement* ref = element.child(std::string(name) + "ref");
    return ref != nullptr ? named(positions_, *ref, document_.required(*ref, "ref")) : Point3d{};
}

Point3d GdmlValues::rotation(const GdmlElement& element, std::string_view name) const {
    if (const GdmlElement* e = element.child(name)) return angles(*e);
    const GdmlElement* ref = element.child(std::string(name) + "ref");
    return ref != nullptr ? named(rotations_, *ref, document_.required(*ref, "ref")) : Point3d{};
}

Point3d GdmlValues::scale(const GdmlElement& element) const {
    if (const GdmlElement* e = element.child("scale")) return numbers(*e, 1);
    const GdmlElement* ref = element.child("scaleref");
    return ref != nullptr ? named(scales_, *ref, document_.required(*ref, "ref"))
                          : Point3d{1, 1, 1};
}

AffineMap gdml_rotation(const Point3d& degrees) {
    const AffineMap x = AffineMap::rotation({1, 0, 0}, degrees[0]);
    const AffineMap y = AffineMap::rotation({0, 1, 0}, degrees[1]);
    const AffineMap z = AffineMap::rotation({0, 0, 1}, degrees[2]);
    return compose(z, compose(y, x));
}

AffineMap gdml_inverse_rotation(const Point3d& degrees) {
    const AffineMap x = AffineMap::rotation({1, 0, 0}, -degrees[0]);
    const AffineMap y = AffineMap::rotation({0, 1, 0}, -degrees[1]);
    const AffineMap z = AffineMap::rotation({0, 0, 1}, -degrees[2]);
    return compose(x, compose(y, z));
}

bool is_rounded(const AffineMap& map) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (map.rows[i][k] != std::nearbyint(map.rows[i][k])) return true;
    return false;
}

}  // namespace trisect::app
