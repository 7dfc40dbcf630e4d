// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_region.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <trisect/bsp/csg/csg_parts.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_transform.h>

namespace trisect::detail {
namespace {

Expression odd_of(std::vector<Expression> terms) {
    if (terms.empty()) return Solid();
    while (terms.size() > 1) {
        std::vector<Expression> pairs;
        for (std::size_t i = 0; i + 1 < terms.size(); i += 2)
            pairs.push_back(terms[i] ^ terms[i + 1]);
        if (terms.size() % 2 == 1) pairs.push_back(terms.back());
        terms = std::move(pairs);
    }
    return terms[0];
}

Expression any_of_terms(const std::vector<Expression>& terms) {
    if (terms.empty()) return Solid();
    return terms.size() == 1 ? terms[0] : Expression::any_of(terms);
}

/// Nothing where the frame tilts the shape.
std::optional<Expression> flat_shape(const DrawingShape& shape, const CsgFrame& frame) {
    const auto region = [&](const std::vector<Outline>& outlines, OutlineRule rule) {
        return flat_prism(outlines, rule, frame.low, frame.high, frame.map);
    };
    const auto outlined = region(shape.outlines, OutlineRule::Odd);
    if (!outlined) return std::nullopt;
    std::vector<Expression> terms{*outlined};
    for (const std::vector<Outline>& stroke : shape.strokes) {
        std::vector<Expression> pieces;
        for (const Outline& piece : stroke) pieces.emplace_back(*region({piece}, OutlineRule::Odd));
        if (!pieces.empty()) terms.push_back(any_of_terms(pieces));
    }
    return odd_of(std::move(terms));
}

/// Where the frame tilts it: the region is resolved before that, and its corners are rounded once.
/// Pieces that touch are operands of their own.
Expression tilted_shape(const DrawingShape& shape, const CsgFrame& frame) {
    const auto flat = flat_shape(shape, {AffineMap(), frame.low, frame.high});
    const Solid resolved = evaluate(*flat);
    const auto region = flat_outlines(resolved);
    if (!region) return resolved.is_empty() ? resolved : transformed(resolved, frame.map);
    const PolygonMesh mesh = region->is_exact
                                 ? transformed(resolved.to_mesh(), frame.map)
                                 : transformed_mesh(resolved.to_exact_mesh(), frame.map);
    if (auto parts = union_of_parts(mesh)) return *std::move(parts);
    if (!region->is_exact) return transformed(resolved, frame.map);
    return Solid::from_mesh(mesh, {.embedding = Embedding::Check});
}

}  // namespace

Expression drawing_prism(Drawing drawing, const CsgFrame& frame) {
    std::vector<Expression> shapes;
    for (const DrawingShape& shape : drawing.shapes) {
        const auto known = flat_shape(shape, frame);
        shapes.push_back(known ? *known : tilted_shape(shape, frame));
    }
    return any_of_terms(shapes);
}

}  // namespace trisect::detail
