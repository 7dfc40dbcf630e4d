// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/glb_accessor.h>

#include <trisect/brep/io/formats/binary.h>
#include <trisect/kernel/stop_scope.h>

#include <cmath>
#include <string_view>

namespace trisect::detail {
namespace {

constexpr std::uint64_t bytes_type = 5121;
constexpr std::uint64_t shorts_type = 5123;
constexpr std::uint64_t words_type = 5125;
constexpr std::uint64_t floats_type = 5126;

std::uint64_t size_of(const GlbDocument& glb, const GlbValue& accessor, std::uint64_t component) {
    switch (component) {
        case 5120:
        case bytes_type:
            return 1;
        case 5122:
        case shorts_type:
            return 2;
        case words_type:
        case floats_type:
            return 4;
        default:
            glb.fail(accessor, "has no type of component " + std::to_string(component));
    }
}

/// The bytes of a view. Sizes are below 2^32 where they are within the chunk, so sums are safe.
std::string_view view_bytes(const GlbDocument& glb, const GlbValue& view) {
    const GlbValue buffer = glb.at("buffers", glb.required_count(view, "buffer"), view);
    if (glb.has(buffer, "uri")) glb.refuse(buffer, "buffers outside the file are not read");
    if (glb.required_count(view, "buffer") != 0) glb.fail(view, "a buffer without data");
    if (const auto extensions = glb.object(view, "extensions");
        extensions && glb.has(*extensions, "EXT_meshopt_compression"))
        glb.refuse(view, "EXT_meshopt_compression is not read");
    const std::uint64_t offset = glb.count(view, "byteOffset").value_or(0);
    const std::uint64_t length = glb.required_count(view, "byteLength");
    const std::uint64_t size = glb.binary().size();
    if (offset > size || length > size - offset) glb.fail(view, "reaches beyond the binary chunk");
    return glb.binary().substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

}  // namespace

GlbAccessor glb_accessor(const GlbDocument& glb, std::uint64_t index, const GlbValue& user,
                         const char* type, bool allows_sparse) {
    GlbAccessor out;
    out.value = glb.at("accessors", index, user);
    const GlbValue& a = out.value;
    if (glb.text(a, "type") != type) glb.fail(a, "is not of the type " + std::string(type));
    if (!allows_sparse && glb.has(a, "sparse")) glb.refuse(a, "sparse accessors are not read");
    if (!glb.has(a, "bufferView")) glb.refuse(a, "accessors without data are not read");
    out.component = glb.required_count(a, "componentType");
    out.count = glb.required_count(a, "count");
    out.view = glb.required_count(a, "bufferView");
    out.offset = glb.count(a, "byteOffset").value_or(0);
    const GlbValue view = glb.at("bufferViews", out.view, a);
    const std::string_view bytes = view_bytes(glb, view);
    const char last = std::string_view(type).back();
    const std::uint64_t element = size_of(glb, a, out.component) *
                                  (last >= '2' && last <= '4' ? std::uint64_t(last - '0') : 1);
    out.stride = glb.count(view, "byteStride").value_or(element);
    if (out.stride < element || out.stride > 255) glb.fail(view, "a byteStride that cannot be");
    const bool fits =
        out.count == 0 || (out.offset <= bytes.size() && element <= bytes.size() - out.offset &&
                           (out.count - 1) <= (bytes.size() - out.offset - element) / out.stride);
    if (!fits) glb.fail(a, "reaches beyond its bufferView");
    if (out.count != 0) out.data = bytes.data() + out.offset;
    return out;
}

std::vector<Point3d> glb_points(const GlbDocument& glb, const GlbAccessor& accessor) {
    if (accessor.component != floats_type) {
        glb.refuse(accessor.value,
                   "positions that are no floats (KHR_mesh_quantization) are not read");
    }
    if (accessor.count > glb.source().limits().vertices) {
        glb.source().fail_limit(accessor.data, "more than " +
                                                   std::to_string(glb.source().limits().vertices) +
                                                   " vertices, the limit for a file");
    }
    std::vector<Point3d> points(static_cast<std::size_t>(accessor.count));
    const char* at = accessor.data;
    for (Point3d& p : points) {
        check_stop();
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = static_cast<double>(load<float, false>(at + 4 * k));
            if (!std::isfinite(p[k])) {
                glb.source().fail(at + 4 * k,
                                  accessor.value.path + ": a coordinate that is not finite");
            }
        }
        at += &p == &points.back() ? 0 : accessor.stride;
    }
    return points;
}

void glb_numbers(const GlbDocument& glb, const GlbAccessor& accessor, std::uint64_t index,
                 std::span<double> out) {
    const char* const at = accessor.data + index * accessor.stride;
    for (std::size_t k = 0; k < out.size(); ++k) {
        if (accessor.component == floats_type) {
            out[k] = static_cast<double>(load<float, false>(at + 4 * k));
            if (!std::isfinite(out[k]))
                glb.source().fail(at + 4 * k,
                                  accessor.value.path + ": a number that is not finite");
        } else if (accessor.component == bytes_type) {
            out[k] = load<std::uint8_t, false>(at + k) / 255.0;
        } else if (accessor.component == shorts_type) {
            out[k] = load<std::uint16_t, false>(at + 2 * k) / 65535.0;
        } else {
            glb.fail(accessor.value, "attributes of this type of component are not read");
        }
    }
}

std::string_view glb_view(const GlbDocument& glb, std::uint64_t index, const GlbValue& user) {
    return view_bytes(glb, glb.at("bufferViews", index, user));
}

std::vector<std::uint32_t> glb_indices(const GlbDocument& glb, const GlbAccessor& accessor) {
    std::vector<std::uint32_t> out(static_cast<std::size_t>(accessor.count));
    if (accessor.component != bytes_type && accessor.component != shorts_type &&
        accessor.component != words_type)
        glb.fail(accessor.value, "indices that are no whole numbers from 0");
    for (std::size_t i = 0; i < out.size(); ++i) {
        const char* const at = accessor.data + i * accessor.stride;
        if (accessor.component == bytes_type)
            out[i] = load<std::uint8_t, false>(at);
        else if (accessor.component == shorts_type)
            out[i] = load<std::uint16_t, false>(at);
        else
            out[i] = load<std::uint32_t, false>(at);
    }
    return out;
}

}  // namespace trisect::detail
