// SPDX-License-Identifier: Apache-2.0
//
// PartsPlace: the place of the parts in the text of a manifest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pieces/piecewise_file.h"

namespace trisect::app {

/// The list of parts, which is cut at commas between parts.
struct PartsPlace {
    std::uint64_t begin = 0;  ///< behind its bracket
    std::uint64_t end = 0;    ///< at the other bracket
    std::vector<std::uint64_t> cuts;

    /// From the first byte to before the last one; nothing where there are fewer cuts than that.
    [[nodiscard]] std::array<std::uint64_t, 2> share(std::size_t i, std::size_t shares) const;
};

/// One pass that knows of brackets and strings only; nothing where it finds no list of parts, or
/// several. What the text is worth is for a reader to say.
[[nodiscard]] std::optional<PartsPlace> find_parts(const InputFile& file);

}  // namespace trisect::app
