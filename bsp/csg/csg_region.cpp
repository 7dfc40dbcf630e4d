// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_region.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/extrusion.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/solid.h>

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

/// Nothing when it has no area.
std::optional<PolygonMesh> prism(const Outline& outline, const CsgFrame& frame) {
    try {
        return transformed(make_extrusion(outline, {}, frame.low, frame.high), frame.map);
    } catch (const UsageError&) {
        return std::nullopt;
    }
}

/// A simple polygon is a prism; any other one is an odd number of the triangles of a fan.
Expression even_odd(const Outline& outline, const CsgFrame& frame) {
    if (const auto mesh = prism(outline, frame)) {
        ImportedMesh imported = import_mesh(*mesh);
        if (is_embedded(imported.mesh)) return Solid::from_import(std::move(imported));
    }
    std::vector<Expression> triangles;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        if (const auto mesh = prism({outline[0], outline[i], outline[i + 1]}, frame))
            triangles.emplace_back(Solid::from_mesh(*mesh, {.embedding = Embedding::Check}));
    return odd_of(triangles);
}

std::vector<Expression> prisms_of(std::vector<Outline> paths, const CsgFrame& frame) {
    std::vector<Expression> terms;
    for (Outline& outline : paths) {
        outline.erase(std::unique(outline.begin(), outline.end()), outline.end());
        while (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
        if (outline.size() >= 3) terms.push_back(even_odd(outline, frame));
    }
    return terms;
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

/// Where the frame tilts it: the region is resolved before that, if that takes no rounding.
std::optional<Expression> tilted_shape(const DrawingShape& shape, const CsgFrame& frame) {
    const auto flat = flat_shape(shape, {AffineMap(), frame.low, frame.high});
    const Solid resolved = evaluate(*flat);
    const auto region = flat_outlines(resolved);
    if (!region) return Solid();
    if (!region->is_exact) return std::nullopt;
    return Solid::from_mesh(transformed(resolved.to_mesh(), frame.map),
                            {.embedding = Embedding::Check});
}

}  // namespace

Expression drawing_prism(Drawing drawing, const CsgFrame& frame) {
    std::vector<Expression> shapes;
    for (DrawingShape& shape : drawing.shapes) {
        auto known = flat_shape(shape, frame);
        if (!known) known = tilted_shape(shape, frame);
        if (known) {
            shapes.push_back(*std::move(known));
            continue;
        }
        std::vector<Expression> terms = prisms_of(std::move(shape.outlines), frame);
        for (std::vector<Outline>& stroke : shape.strokes)
            terms.push_back(any_of_terms(prisms_of(std::move(stroke), frame)));
        shapes.push_back(odd_of(std::move(terms)));
    }
    return any_of_terms(shapes);
}

}  // namespace trisect::detail
