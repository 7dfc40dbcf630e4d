// SPDX-License-Identifier: Apache-2.0
//
// Accessors of GLB: numbers in the binary chunk.
#pragma once

#include <trisect/brep/io/models/glb_document.h>
#include <trisect/brep/polygon_mesh.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace trisect::detail {

/// Checked against the binary chunk.
struct GlbAccessor {
    GlbValue value;
    const char* data = nullptr;
    std::uint64_t stride = 0;
    std::uint64_t count = 0;
    std::uint64_t component = 0;  ///< the number of its type
    std::uint64_t view = 0;
    std::uint64_t offset = 0;  ///< in the view
};

/// \param type "SCALAR", "VEC2", "VEC3" or "VEC4"
/// \throw InputError; UnsupportedError for external buffers, compression, and for sparse data
/// unless that is allowed, when it is not looked at
[[nodiscard]] GlbAccessor glb_accessor(const GlbDocument& glb, std::uint64_t index,
                                       const GlbValue& user, const char* type,
                                       bool allows_sparse = false);

/// Points of an accessor of single precision; each must be finite.
[[nodiscard]] std::vector<Point3d> glb_points(const GlbDocument& glb, const GlbAccessor& accessor);

/// The numbers of one entry: floats, or bytes and words as shares of their largest.
void glb_numbers(const GlbDocument& glb, const GlbAccessor& accessor, std::uint64_t index,
                 std::span<double> out);

/// The bytes of a buffer view.
[[nodiscard]] std::string_view glb_view(const GlbDocument& glb, std::uint64_t index,
                                        const GlbValue& user);

/// Whole numbers of 8, 16 or 32 bits.
[[nodiscard]] std::vector<std::uint32_t> glb_indices(const GlbDocument& glb,
                                                     const GlbAccessor& accessor);

}  // namespace trisect::detail
