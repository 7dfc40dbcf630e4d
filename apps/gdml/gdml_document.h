// SPDX-License-Identifier: Apache-2.0
//
// GDML documents as trees of elements.
// Document type declarations are refused, and with them all entities but XML's own.
#pragma once

#include <trisect/brep/io/read_mesh.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trisect::app {

struct GdmlElement {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<GdmlElement> children;
    std::uint64_t offset = 0;  ///< in the file

    /// None: a null pointer.
    [[nodiscard]] const std::string* find(std::string_view attribute) const;
    [[nodiscard]] const GdmlElement* child(std::string_view wanted) const;
    /// Empty where there is none.
    [[nodiscard]] std::string text(std::string_view attribute) const;
};

class GdmlDocument {
public:
    /// The sections define, solids, structure and setup, with loops unrolled (gdml_loops.h);
    /// materials are not kept.
    /// \throw InputError with the place, LimitError
    GdmlDocument(std::string file, std::string bytes, const ReadLimits& limits = {});

    /// \throw InputError where it is not there
    [[nodiscard]] const GdmlElement& section(std::string_view name) const;
    [[nodiscard]] const GdmlElement& root() const { return root_; }
    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] const ReadLimits& limits() const { return limits_; }

    /// A required attribute. \throw InputError
    [[nodiscard]] const std::string& required(const GdmlElement& element,
                                              std::string_view attribute) const;
    [[noreturn]] void fail(const GdmlElement& element, const std::string& what) const;
    [[noreturn]] void fail_limit(const GdmlElement& element, const std::string& what) const;
    [[noreturn]] void fail_unsupported(const GdmlElement& element, const std::string& what) const;

private:
    [[nodiscard]] std::string place(const GdmlElement& element) const;

    std::string file_;
    std::string bytes_;
    ReadLimits limits_;
    GdmlElement root_;
};

}  // namespace trisect::app
