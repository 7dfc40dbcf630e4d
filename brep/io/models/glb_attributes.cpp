// SPDX-License-Identifier: Apache-2.0
//
// glTF has v downward from the upper edge of a picture, so 1 - v is upward: rounded by at most
// 2^-54, and not at all for floats of 2^-29 and more.
#include <trisect/brep/io/models/glb_attributes.h>

#include <array>

namespace trisect::detail {

GlbAttributes::GlbAttributes(const GlbDocument& glb, const GlbValue& primitive,
                             std::uint64_t vertices, std::uint64_t uv_set)
    : glb_(&glb) {
    const auto attributes = glb.object(primitive, "attributes");
    if (!attributes) return;
    const auto accessor = [&](const std::string& name,
                              const char* type) -> std::optional<GlbAccessor> {
        const auto index = glb.count(*attributes, name.c_str());
        if (!index) return std::nullopt;
        GlbAccessor made = glb_accessor(glb, *index, primitive, type);
        if (made.count != vertices)
            glb.fail(primitive, name + " has " + std::to_string(made.count) + " entries for " +
                                    std::to_string(vertices) + " vertices");
        return made;
    };
    uv_ = accessor("TEXCOORD_" + std::to_string(uv_set), "VEC2");
    normal_ = accessor("NORMAL", "VEC3");
    const auto color = glb.count(*attributes, "COLOR_0");
    if (!color) return;
    has_opacity_ = glb.text(glb.at("accessors", *color, primitive), "type") == "VEC4";
    color_ = accessor("COLOR_0", has_opacity_ ? "VEC4" : "VEC3");
}

void GlbAttributes::collect(std::uint64_t vertex, std::size_t corner,
                            PropertyCollector& properties) const {
    const char* const at = glb_->source().begin();
    if (uv_) {
        std::array<double, 2> uv{};
        glb_numbers(*glb_, *uv_, vertex, uv);
        uv[1] = 1 - uv[1];
        properties.set(properties.uv(), corner, uv, at);
    }
    if (normal_) {
        std::array<double, 3> normal{};
        glb_numbers(*glb_, *normal_, vertex, normal);
        properties.set(properties.normal(), corner, normal, at);
    }
    if (color_) {
        std::array<double, 4> color{0, 0, 0, 1};
        glb_numbers(*glb_, *color_, vertex, std::span(color).first(has_opacity_ ? 4 : 3));
        properties.set(properties.linear_color(), corner, color, at);
    }
}

}  // namespace trisect::detail
