// SPDX-License-Identifier: Apache-2.0
//
// GlbAttributes: texture coordinates, normals and colours of the vertices of a primitive.
#pragma once

#include <trisect/brep/io/models/glb_accessor.h>
#include <trisect/brep/io/properties/property_collector.h>

#include <optional>

namespace trisect::detail {

class GlbAttributes {
public:
    /// \param uv_set which of the sets of texture coordinates
    /// \throw InputError where there are not as many as vertices; UnsupportedError for sparse or
    /// compressed ones
    GlbAttributes(const GlbDocument& glb, const GlbValue& primitive, std::uint64_t vertices,
                  std::uint64_t uv_set);

    /// What a vertex has becomes that of a corner. \pre the vertex is there
    void collect(std::uint64_t vertex, std::size_t corner, PropertyCollector& properties) const;

private:
    const GlbDocument* glb_;
    std::optional<GlbAccessor> uv_;
    std::optional<GlbAccessor> normal_;
    std::optional<GlbAccessor> color_;
    bool has_opacity_ = false;
};

}  // namespace trisect::detail
