// SPDX-License-Identifier: Apache-2.0
//
// DxfGroups: pairs of a code and a value of a DXF file.
#pragma once

#include <cstdint>
#include <string_view>

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/formats/text_cursor.h>

namespace trisect::detail {

class DxfGroups {
public:
    explicit DxfGroups(const InputText& source) : source_(source), cursor_(source, TextRules()) {}

    /// False at the end of the file. \throw InputError unless the code is an integer
    bool next();
    [[nodiscard]] std::int64_t code() const { return code_; }
    /// Without white space at its ends.
    [[nodiscard]] std::string_view value() const { return value_; }
    /// \throw InputError unless it is a finite number
    [[nodiscard]] double number() const;
    [[nodiscard]] std::int64_t integer() const;
    /// Where the value is.
    [[nodiscard]] const char* at() const { return value_.data(); }

private:
    const InputText& source_;
    TextCursor cursor_;
    std::int64_t code_ = 0;
    std::string_view value_;
};

}  // namespace trisect::detail
