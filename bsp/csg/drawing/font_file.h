// SPDX-License-Identifier: Apache-2.0
//
// The file of a font that fontconfig finds.
#pragma once

#include <string>

namespace trisect::detail {

struct FontFile {
    std::string path;
    int face = 0;
    std::string family;
    bool has_family = true;  ///< whether that is a family that was asked for
};

/// The scalable font that matches a pattern best, among the system's and those in the folders of
/// the variable OPENSCAD_FONT_PATH. May be called by several threads.
/// \throw UnsupportedError where there is none
[[nodiscard]] FontFile find_font(const std::string& pattern);

}  // namespace trisect::detail
