// SPDX-License-Identifier: Apache-2.0
#include "gdml_solids.h"

#include <trisect/bsp/solid_transform.h>

#include <algorithm>
#include <utility>

namespace trisect::app {
namespace {

std::array<double, 12> numbers_of(const AffineMap& map) {
    std::array<double, 12> out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 4; ++k) out[4 * i + k] = map.rows[i][k];
    return out;
}

Solid solid_of(const PolygonMesh& mesh) {
    return Solid::from_mesh(mesh, {.embedding = Embedding::Check});
}

GdmlSolid solid_of(const GdmlShape& shape, const EvaluateOptions& options) {
    GdmlSolid out;
    out.deviation = shape.deviation;
    out.is_round = shape.is_round;
    Expression formula = solid_of(shape.mesh);
    if (shape.hole.face_count() != 0) formula = formula - solid_of(shape.hole);
    for (const auto& cut : shape.cuts) formula = formula & Solid::half_space(cut);
    const bool is_plain = shape.hole.face_count() == 0 && shape.cuts.empty();
    out.solid = is_plain ? solid_of(shape.mesh) : evaluate(formula, options);
    return out;
}

bool is_boolean(const GdmlElement& e) {
    return e.name == "union" || e.name == "subtraction" || e.name == "intersection";
}

}  // namespace

GdmlSolids::GdmlSolids(const GdmlSource& source) : source_(source) {
    for (const GdmlElement& section : source.document.root().children) {
        if (section.name != "solids") continue;
        for (const GdmlElement& e : section.children) {
            const std::string* name = e.find("name");
            if (name == nullptr) continue;
            const auto number = static_cast<std::uint32_t>(elements_.size());
            if (!numbers_.try_emplace(*name, number).second) {
                // Surfaces have names of their own.
                if (e.name.ends_with("surface")) continue;
                source.document.fail(e, "two solids with the name '" + *name + "'");
            }
            elements_.push_back(&e);
            names_.push_back(*name);
        }
    }
}

std::optional<std::uint32_t> GdmlSolids::find(const std::string& name) const {
    const auto at = numbers_.find(name);
    return at == numbers_.end() ? std::nullopt : std::optional(at->second);
}

/// Solids are made of earlier ones, as in all that reads GDML; so nothing is made of itself.
GdmlSolids::Operand GdmlSolids::operand(std::uint32_t of, const GdmlElement& reference,
                                        const AffineMap& map) const {
    const std::string& name = source_.document.required(reference, "ref");
    const auto number = find(name);
    if (!number || *number >= of)
        source_.document.fail(reference, "no solid before this one is called '" + name + "'");
    return {*number, map};
}

AffineMap GdmlSolids::placement(const GdmlElement& element, const char* position,
                                const char* rotation) const {
    return compose(AffineMap::translation(source_.values.position(element, position)),
                   gdml_rotation(source_.values.rotation(element, rotation)));
}

std::vector<GdmlSolids::Operand> GdmlSolids::operands(std::uint32_t solid) const {
    const GdmlElement& e = *elements_[solid];
    const auto child = [&](const GdmlElement& of, const char* name) -> const GdmlElement& {
        const GdmlElement* found = of.child(name);
        if (found == nullptr) source_.document.fail(of, "<" + of.name + "> without <" + name + ">");
        return *found;
    };
    std::vector<Operand> out;
    if (is_boolean(e)) {
        out.push_back(
            operand(solid, child(e, "first"), placement(e, "firstposition", "firstrotation")));
        out.push_back(operand(solid, child(e, "second"), placement(e, "position", "rotation")));
    } else if (e.name == "multiUnion") {
        for (const GdmlElement& node : e.children)
            if (node.name == "multiUnionNode")
                out.push_back(
                    operand(solid, child(node, "solid"), placement(node, "position", "rotation")));
    } else if (e.name == "scaledSolid") {
        const GdmlElement& reference = child(e, "solidref");
        out.push_back(operand(solid, reference, AffineMap::scaling(source_.values.scale(e))));
    }
    return out;
}

std::vector<bool> GdmlSolids::needed(std::span<const std::uint32_t> wanted) const {
    std::vector<bool> out(size());
    for (const std::uint32_t s : wanted) out[s] = true;
    for (std::uint32_t s = static_cast<std::uint32_t>(size()); s-- > 0;) {
        if (!out[s]) continue;
        try {
            for (const Operand& o : operands(s)) out[o.solid] = true;
        } catch (const Error&) {
            continue;  // said when the solid is made
        }
    }
    return out;
}

std::vector<GdmlSolid> GdmlSolids::make(std::span<const std::uint32_t> wanted,
                                        const EvaluateOptions& options) const {
    const std::vector<bool> is_needed = needed(wanted);
    std::vector<GdmlSolid> out(size());
    for (std::uint32_t s = 0; s < size(); ++s) {
        if (!is_needed[s]) continue;
        try {
            out[s] = made(s, out, options);
        } catch (const Error& e) {
            if (e.code() == ErrorCode::Cancelled || e.code() == ErrorCode::Internal) throw;
            out[s].failure = e.what();
            out[s].code = e.code();
        }
    }
    return out;
}

GdmlSolid GdmlSolids::made(std::uint32_t solid, const std::vector<GdmlSolid>& earlier,
                           const EvaluateOptions& options) const {
    const GdmlElement& e = *elements_[solid];
    if (const auto shape = flat_gdml_shape(source_, e)) return solid_of(*shape, options);
    if (const auto shape = round_gdml_shape(source_, e)) return solid_of(*shape, options);
    const std::vector<Operand> parts = operands(solid);
    if (parts.empty()) source_.document.fail_unsupported(e, "<" + e.name + "> is not supported");
    for (const Operand& o : parts)
        if (earlier[o.solid].code) return earlier[o.solid];
    return combined(e, parts, earlier, options);
}

GdmlSolid GdmlSolids::combined(const GdmlElement& element, const std::vector<Operand>& operands,
                               const std::vector<GdmlSolid>& earlier,
                               const EvaluateOptions& options) const {
    GdmlSolid out;
    std::vector<Solid> solids;
    for (const Operand& o : operands) {
        const GdmlSolid& part = earlier[o.solid];
        double deviation = part.deviation;
        if (o.map == AffineMap()) {
            solids.push_back(part.solid);
        } else {
            solids.push_back(part.solid.is_empty()
                                 ? Solid()
                                 : transformed(part.solid, Pose::from_doubles(numbers_of(o.map))));
            if (is_rounded(o.map)) deviation += rounding_of_corners;
        }
        if (element.name == "scaledSolid") {
            const Point3d factors = source_.values.scale(element);
            deviation *=
                std::max({std::abs(factors[0]), std::abs(factors[1]), std::abs(factors[2])});
        }
        out.deviation = std::max(out.deviation, deviation);
        out.is_round = out.is_round || part.is_round;
    }
    if (element.name == "subtraction")
        out.solid = evaluate(solids[0] - solids[1], options);
    else if (element.name == "intersection")
        out.solid = evaluate(solids[0] & solids[1], options);
    else
        out.solid = evaluate(Expression::any_of(solids), options);
    return out;
}

}  // namespace trisect::app
