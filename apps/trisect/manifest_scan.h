// SPDX-License-Identifier: Apache-2.0
//
// PartsPlace: the place of the parts in the text of a manifest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pieces/piecewise_file.h"

namespace trisect::app {

/// The list of parts. What lies between is not looked at: where it begins is certain, where it ends
/// and where it can be cut is a guess.
///
/// A wrong guess is found by whoever reads: where "[" S "]" and "[" T "]" are both JSON, so is "["
/// S "," T "]", with the elements of both, and no text is JSON in two ways. So shares are right, if
/// all of them are JSON, and the text around them with an empty list is.
struct PartsPlace {
    std::uint64_t begin = 0;  ///< behind its bracket
    std::uint64_t end = 0;    ///< at the other bracket

    /// From the first byte to before the last one, cut at commas; may be nothing. Reads some bytes
    /// around the cuts. \throw InputError
    [[nodiscard]] std::array<std::uint64_t, 2> share(const InputFile& file, std::size_t i,
                                                     std::size_t shares) const;
};

/// Nothing where there is no list of parts, or several are seen. What the text is worth is for a
/// reader to say. Reads some bytes of both ends of the file. \throw InputError
[[nodiscard]] std::optional<PartsPlace> find_parts(const InputFile& file);

}  // namespace trisect::app
