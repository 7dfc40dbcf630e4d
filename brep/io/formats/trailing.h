// SPDX-License-Identifier: Apache-2.0
//
// Data allowed after the end of a binary file: zero bytes and white space.
#pragma once

#include <trisect/brep/io/formats/input_text.h>

#include <string>
#include <string_view>

namespace trisect::detail {

inline void refuse_trailing_bytes(const InputText& source, const char* at, const char* after) {
    constexpr std::string_view padding("\0\t\n\v\f\r ", 7);
    for (; at != source.end(); ++at) {
        if (padding.find(*at) != std::string_view::npos) continue;
        source.fail(at, "more data after " + std::string(after) + " that the header states");
    }
}

}  // namespace trisect::detail
