// SPDX-License-Identifier: Apache-2.0
//
// DxfPairs: group codes and values of a DXF file.
// Each pair is two lines.
#pragma once

#include <trisect/brep/io/formats/input_text.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace trisect::detail {

/// Comments (code 999) are passed over. Values are without blanks around them.
class DxfPairs {
public:
    explicit DxfPairs(const InputText& source);

    /// Moves to the next pair. \throw InputError at the end of the file, which EOF must come before
    void next();

    [[nodiscard]] int code() const noexcept { return code_; }
    [[nodiscard]] std::string_view value() const noexcept { return value_; }
    [[nodiscard]] bool is(int code, std::string_view value) const noexcept {
        return code_ == code && value_ == value;
    }
    /// The value as a finite number. \throw InputError
    [[nodiscard]] double real() const;
    /// The value as a whole number. \throw InputError
    [[nodiscard]] std::int64_t integer() const;
    /// Where the value stands.
    [[nodiscard]] const char* at() const noexcept { return value_.data(); }
    [[nodiscard]] const InputText& source() const noexcept { return source_; }
    /// \throw InputError when anything but white space follows
    void expect_end();
    [[noreturn]] void fail(const std::string& message) const { source_.fail(at(), message); }

private:
    [[nodiscard]] std::string_view line();

    const InputText& source_;
    const char* here_;
    int code_ = 0;
    std::string_view value_;
};

}  // namespace trisect::detail
