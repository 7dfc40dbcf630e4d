// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/step/units.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace trisect::detail {
namespace {

using NamedWord = std::pair<std::string_view, std::string_view>;

constexpr std::array<NamedWord, 8> metric_prefixes{{{"", "meter"},
                                                    {"MILLI", "millimeter"},
                                                    {"CENTI", "centimeter"},
                                                    {"DECI", "decimeter"},
                                                    {"MICRO", "micron"},
                                                    {"NANO", "nanometer"},
                                                    {"KILO", "kilometer"},
                                                    {"DECA", "decameter"}}};

struct NamedFactor {
    double factor;
    std::string_view base;
    std::string_view unit;
};

/// As decimals of files: their doubles are those here.
constexpr std::array<NamedFactor, 8> conversions{{{25.4, "millimeter", "inch"},
                                                  {2.54, "centimeter", "inch"},
                                                  {0.0254, "meter", "inch"},
                                                  {304.8, "millimeter", "foot"},
                                                  {30.48, "centimeter", "foot"},
                                                  {0.3048, "meter", "foot"},
                                                  {1, "millimeter", "millimeter"},
                                                  {1, "meter", "meter"}}};

/// The number of a measure, typed or not.
double measure_of(const StepText& text, const StepEntity& entity, const StepPart& part) {
    if (part.values.empty()) text.fail(entity, "has no value");
    const StepValue* v = &part.values[0];
    if (v->kind == StepKind::Typed && v->items.size() == 1) v = &v->items[0];
    if (v->kind != StepKind::Number) text.fail(entity, "a measure expected as value 1");
    return v->number;
}

std::string metric_unit(const StepText& text, const StepEntity& unit, const StepPart& si) {
    const bool has_prefix = !si.values.empty() && si.values[0].kind == StepKind::Enumeration;
    const std::string_view prefix = has_prefix ? si.values[0].text : std::string_view();
    if (text.value(unit, si, 1, StepKind::Enumeration).text != "METRE")
        text.fail(unit, "a unit of length other than the metre");
    for (const auto& [word, name] : metric_prefixes)
        if (word == prefix) return std::string(name);
    text.refuse(unit, "is not known as a unit of length");
}

std::string conversion_unit(const StepText& text, const StepEntity& unit, const StepPart& part) {
    const StepEntity factor = text.referred(unit, part, 1);
    const StepPart* measure = factor.part("LENGTH_MEASURE_WITH_UNIT");
    if (measure == nullptr) measure = factor.part("MEASURE_WITH_UNIT");
    if (measure == nullptr) text.refuse(factor, "is not known as a factor of a unit of length");
    const double number = measure_of(text, factor, *measure);
    const StepEntity base = text.referred(factor, *measure, 1);
    const StepPart* si = base.part("SI_UNIT");
    if (si == nullptr) text.refuse(base, "is not known as the base of a unit of length");
    const std::string base_unit = metric_unit(text, base, *si);
    for (const NamedFactor& c : conversions)
        if (c.factor == number && c.base == base_unit) return std::string(c.unit);
    std::array<char, 32> digits{};
    char* end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    return std::string(digits.data(), end) + " " + base_unit;
}

void read_units(const StepText& text, const StepEntity& context, StepContext& out) {
    const StepPart* part = context.part("GLOBAL_UNIT_ASSIGNED_CONTEXT");
    if (part == nullptr) return;
    const std::size_t index = context.parts.size() > 1 ? 0 : 2;
    for (const StepValue& v : text.value(context, *part, index, StepKind::List).items) {
        if (v.kind != StepKind::Reference) text.fail(context, "a list of units expected");
        const StepEntity unit = text.entity(v.id, v.at);
        const StepPart* si = unit.part("SI_UNIT");
        const bool is_metre = si != nullptr && si->values.size() > 1 &&
                              si->values[1].kind == StepKind::Enumeration &&
                              si->values[1].text == "METRE";
        if (!unit.is("LENGTH_UNIT") && !is_metre) continue;
        const StepPart* conversion = unit.part("CONVERSION_BASED_UNIT");
        if (conversion != nullptr)
            out.unit = conversion_unit(text, unit, *conversion);
        else if (si != nullptr)
            out.unit = metric_unit(text, unit, *si);
    }
}

void read_uncertainty(const StepText& text, const StepEntity& context, StepContext& out) {
    const StepPart* part = context.part("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT");
    if (part == nullptr) return;
    const std::size_t index = context.parts.size() > 1 ? 0 : 2;
    for (const StepValue& v : text.value(context, *part, index, StepKind::List).items) {
        if (v.kind != StepKind::Reference) text.fail(context, "a list of uncertainties expected");
        const StepEntity measure = text.entity(v.id, v.at);
        const StepPart* stated = measure.part("UNCERTAINTY_MEASURE_WITH_UNIT");
        if (stated == nullptr || stated->values.empty()) continue;
        const StepValue& first = stated->values[0];
        const bool is_length =
            first.kind == StepKind::Number ||
            (first.kind == StepKind::Typed && first.text.ends_with("LENGTH_MEASURE"));
        if (is_length)
            out.uncertainty = std::max(out.uncertainty, measure_of(text, measure, *stated));
    }
}

}  // namespace

StepContext step_context(const StepText& text, const StepEntity& context) {
    StepContext out;
    read_units(text, context, out);
    read_uncertainty(text, context, out);
    return out;
}

}  // namespace trisect::detail
