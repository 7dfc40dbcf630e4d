// SPDX-License-Identifier: Apache-2.0
//
// Raster images and their bytes as PNG.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace trisect::app {

/// Width and height in pixels.
struct PixelSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    [[nodiscard]] std::size_t count() const { return std::size_t{width} * height; }
    friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// Pixels row by row from the top, four bytes each: sRGB and an alpha that is not multiplied in.
struct Image {
    explicit Image(PixelSize s) : size(s), pixels(s.count()) {}
    PixelSize size;
    std::vector<std::array<std::uint8_t, 4>> pixels;
};

/// The file, complete; without an alpha channel when every pixel is opaque. The same image gives
/// the same bytes. \throw LimitError when there is no memory for it.
[[nodiscard]] std::string png_bytes(const Image& image);

}  // namespace trisect::app
