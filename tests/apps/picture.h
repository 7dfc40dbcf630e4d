// SPDX-License-Identifier: Apache-2.0
//
// PNG files as tests look at them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace trisect::test {

/// Decoded pixels, row by row from the top: red, green, blue, alpha.
struct Pixels {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::array<std::uint8_t, 4>> values;
    [[nodiscard]] const std::array<std::uint8_t, 4>& at(std::uint32_t x, std::uint32_t y) const {
        return values[std::size_t{y} * width + x];
    }
};

/// Fails the test when the bytes are no PNG file.
[[nodiscard]] Pixels decoded_png(const std::string& bytes);

}  // namespace trisect::test
