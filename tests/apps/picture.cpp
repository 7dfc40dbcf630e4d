// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include <gtest/gtest.h>

#include <png.h>

namespace trisect::test {

Pixels decoded_png(const std::string& bytes) {
    Pixels pixels;
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) {
        ADD_FAILURE() << "not a PNG file: " << header.message;
        return pixels;
    }
    header.format = PNG_FORMAT_RGBA;
    pixels.width = header.width;
    pixels.height = header.height;
    pixels.values.resize(std::size_t{header.width} * header.height);
    if (png_image_finish_read(&header, nullptr, pixels.values.data(), 0, nullptr) == 0) {
        ADD_FAILURE() << "broken PNG file: " << header.message;
    }
    return pixels;
}

}  // namespace trisect::test
