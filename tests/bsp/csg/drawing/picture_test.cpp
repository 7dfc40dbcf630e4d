// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/drawing/picture.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>
#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

namespace trisect::detail {
namespace {

std::string png_of(std::uint32_t width, std::uint32_t height, std::uint32_t format,
                   const std::vector<std::uint8_t>& pixels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
    std::string out(size, '\0');
    png_image_write_to_memory(&image, out.data(), &size, 0, pixels.data(), 0, nullptr);
    return out;
}

TEST(Picture, BrightnessOfColours) {
    const std::string gray = png_of(3, 2, PNG_FORMAT_GRAY, {50, 100, 150, 200, 255, 10});
    const auto rows = png_brightness(gray, "f", 100);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_NEAR(rows[0][1], 100, 1e-12);
    EXPECT_NEAR(rows[1][2], 10, 1e-12);
    const auto red = png_brightness(png_of(1, 1, PNG_FORMAT_RGBA, {255, 0, 0, 128}), "f", 100);
    EXPECT_NEAR(red[0][0], 255 * 0.2126, 1e-12);
}

TEST(Picture, MalformedAndLargePicturesAreRefused) {
    const std::string bytes = png_of(3, 2, PNG_FORMAT_GRAY, {50, 100, 150, 200, 255, 10});
    EXPECT_THROW((void)png_brightness(bytes, "f", 5), LimitError);
    for (std::size_t n = 0; n < bytes.size(); ++n)
        EXPECT_THROW((void)png_brightness(bytes.substr(0, n), "f", 100), InputError) << n;
    std::string wrong = bytes;
    char& changed = wrong[wrong.find("IDAT") + 6];
    changed = static_cast<char>(changed ^ 1);
    EXPECT_THROW((void)png_brightness(wrong, "f", 100), InputError);
}

}  // namespace
}  // namespace trisect::detail
