// SPDX-License-Identifier: Apache-2.0
//
// Brightness of the points of a picture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

/// Rows of a PNG picture from the top down, from 0 to 255: 0.2126 of red, 0.7152 of green and
/// 0.0722 of blue. Of 16 bits the upper eight count, transparency does not. \throw InputError for
/// bytes that are no such picture, LimitError for more than `most` points, before any memory is
/// taken for them; UnsupportedError in a build without libpng
[[nodiscard]] std::vector<std::vector<double>> png_brightness(std::string_view bytes,
                                                              const std::string& name,
                                                              std::size_t most);

}  // namespace trisect::detail
