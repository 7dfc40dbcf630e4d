// SPDX-License-Identifier: Apache-2.0
//
// libpng's simplified interface: it writes to memory and reports errors by its result, so that no
// longjmp passes through our frames.
#include "png_file.h"

#include <trisect/kernel/error.h>

#include <png.h>

#include <algorithm>
#include <string_view>

namespace trisect::app {
namespace {

bool is_opaque(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(),
                       [](const auto& pixel) { return pixel[3] == 255; });
}

std::vector<std::uint8_t> without_alpha(const Image& image) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const auto& pixel : image.pixels) {
        bytes.insert(bytes.end(), pixel.begin(), pixel.begin() + 3);
    }
    return bytes;
}

[[noreturn]] void fail(png_image& header) {
    const std::string reason = header.message;
    png_image_free(&header);
    throw LimitError("cannot write the PNG image: " + reason);
}

}  // namespace

std::string png_bytes(const Image& image) {
    const bool opaque = is_opaque(image);
    const std::vector<std::uint8_t> rgb =
        opaque ? without_alpha(image) : std::vector<std::uint8_t>();
    const void* pixels = opaque ? static_cast<const void*>(rgb.data()) : image.pixels.data();

    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = image.size.width;
    header.height = image.size.height;
    header.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    // An upper bound first: asking for the exact size would compress everything twice.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels, 0, nullptr) == 0) {
        fail(header);
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace trisect::app
