// SPDX-License-Identifier: Apache-2.0
//
// Kinds and names of picture files.
#pragma once

#include <trisect/brep/io/model.h>

#include <string>
#include <string_view>

namespace trisect::detail {

/// "image/png", "image/jpeg", "image/webp" by their first bytes; else by the extension; empty: none
/// of them.
[[nodiscard]] std::string media_type_of(std::string_view bytes, std::string_view file);
/// ".png"
[[nodiscard]] std::string extension_of_media(std::string_view media_type);

/// The name without its folder and extension; "model" for none.
[[nodiscard]] std::string stem_of(const std::string& path);

}  // namespace trisect::detail
