// SPDX-License-Identifier: Apache-2.0
//
// GlbDocument: the two chunks of a GLB file.
// Access to the JSON in the first is checked.
#pragma once

#include <trisect/brep/io/formats/input_text.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

/// A value of the document and what it is called in messages, such as "meshes[2].primitives[0]".
struct GlbValue {
    const nlohmann::json* json = nullptr;
    std::string path;
};

class GlbDocument {
public:
    /// \throw InputError, LimitError, UnsupportedError
    explicit GlbDocument(const InputText& source);

    [[nodiscard]] GlbValue root() const { return {&json_, "the document"}; }
    [[nodiscard]] std::string_view binary() const { return binary_; }

    /// A member that may be missing. \throw InputError when it is of another type
    [[nodiscard]] std::optional<GlbValue> object(const GlbValue& in, const char* name) const;
    /// Empty when it is missing.
    [[nodiscard]] std::vector<GlbValue> array(const GlbValue& in, const char* name) const;
    [[nodiscard]] std::string text(const GlbValue& in, const char* name) const;
    /// An index or a count from 0.
    [[nodiscard]] std::optional<std::uint64_t> count(const GlbValue& in, const char* name) const;
    [[nodiscard]] std::uint64_t required_count(const GlbValue& in, const char* name) const;
    /// As many numbers as the array of defaults has, which are taken when it is missing.
    [[nodiscard]] std::vector<double> numbers(const GlbValue& in, const char* name,
                                              std::vector<double> defaults) const;
    [[nodiscard]] bool has(const GlbValue& in, const char* name) const;

    /// Value number `index` of an array of the root. \throw InputError when there is none
    [[nodiscard]] GlbValue at(const char* array, std::uint64_t index, const GlbValue& user) const;

    [[noreturn]] void fail(const GlbValue& value, const std::string& message) const;
    [[noreturn]] void refuse(const GlbValue& value, const std::string& message) const;
    [[nodiscard]] const InputText& source() const { return source_; }

private:
    void parse(std::string_view text);

    const InputText& source_;
    nlohmann::json json_;
    std::string_view binary_;
};

}  // namespace trisect::detail
