// SPDX-License-Identifier: Apache-2.0
//
// XML as events, over expat.
// Document type declarations are refused, so there are no entities but the five of XML itself.
#pragma once

#include <trisect/brep/io/formats/input_text.h>

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace trisect::detail {

/// One start tag, while its event lasts. Names have their namespaces apart.
class XmlElement {
public:
    XmlElement(const char* expanded_name, const char** attributes, const char* at);

    std::string_view space;  ///< URI; empty: none
    std::string_view name;
    const char* at;  ///< in the text

    /// The value of an attribute without namespace, or of one in a namespace.
    [[nodiscard]] std::optional<std::string_view> attribute(std::string_view wanted) const;
    [[nodiscard]] std::optional<std::string_view> attribute(std::string_view in_space,
                                                            std::string_view wanted) const;
    /// All of them, by names without their namespaces, in the order of the text.
    [[nodiscard]] std::vector<std::pair<std::string_view, std::string_view>> attributes() const;
    /// \throw InputError at the element when it is not there
    [[nodiscard]] std::string_view required(const InputText& source, std::string_view wanted) const;

private:
    const char** attributes_;
};

class XmlHandler {
public:
    virtual ~XmlHandler() = default;
    virtual void begin(const XmlElement& element) = 0;
    virtual void end() = 0;
    virtual void text(std::string_view /*piece*/) {}
    /// A prefix is bound; comes before the element that binds it.
    virtual void declare(std::string_view /*prefix*/, std::string_view /*uri*/) {}
};

/// \throw InputError for text that is not well formed or has a document type declaration,
/// LimitError for elements that nest deeper than the limit, and whatever the handler throws.
void read_xml(const InputText& source, XmlHandler& handler);

/// A number that fills the word, white space around it aside; finite. \throw InputError at `at`
[[nodiscard]] double xml_real(const InputText& source, std::string_view word, const char* what,
                              const char* at);
/// A count or an index from 0.
[[nodiscard]] std::uint64_t xml_count(const InputText& source, std::string_view word,
                                      const char* what, const char* at);
/// Without white space at its ends.
[[nodiscard]] std::string_view trimmed_word(std::string_view word);
/// The first word, which is taken away; empty at the end.
[[nodiscard]] std::string_view take_word(std::string_view& words);

}  // namespace trisect::detail
