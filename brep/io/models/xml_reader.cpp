// SPDX-License-Identifier: Apache-2.0
//
// Exceptions must not pass through expat, which is C: they are kept, the parser is stopped, and
// they are thrown again behind it.
#include <trisect/brep/io/models/xml_reader.h>

#include <trisect/brep/io/formats/decimal.h>

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <memory>
#include <string>

namespace trisect::detail {
namespace {

constexpr char separator = '\n';  // stands in no URI and in no name

struct Name {
    std::string_view space;
    std::string_view local;
};

Name split(std::string_view expanded) {
    const std::size_t at = expanded.find(separator);
    if (at == std::string_view::npos) return {{}, expanded};
    return {expanded.substr(0, at), expanded.substr(at + 1)};
}

struct FreeParser {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};
using ParserPointer = std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser>;

class Reader {
public:
    Reader(const InputText& source, XmlHandler& handler)
        : source_(source), handler_(handler), parser_(XML_ParserCreateNS(nullptr, separator)) {
        if (parser_ == nullptr) throw std::bad_alloc();
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), begin, end);
        XML_SetCharacterDataHandler(parser_.get(), text);
        XML_SetStartDoctypeDeclHandler(parser_.get(), doctype);
        XML_SetStartNamespaceDeclHandler(parser_.get(), declare);
        XML_SetUnknownEncodingHandler(parser_.get(), encoding, nullptr);
    }

    void read() {
        constexpr std::size_t most = 1U << 20;
        const std::string_view bytes = source_.bytes();
        std::size_t at = 0;
        do {
            const std::size_t size = std::min(most, bytes.size() - at);
            const bool is_last = at + size == bytes.size();
            const XML_Status status = XML_Parse(parser_.get(), bytes.data() + at,
                                                static_cast<int>(size), is_last ? 1 : 0);
            if (failure_ != nullptr) std::rethrow_exception(failure_);
            if (status != XML_STATUS_OK) fail();
            at += size;
        } while (at < bytes.size());
    }

private:
    [[nodiscard]] const char* here() const {
        const auto index = XML_GetCurrentByteIndex(parser_.get());
        const auto size = static_cast<XML_Index>(source_.bytes().size());
        return source_.begin() + std::clamp<XML_Index>(index, 0, size);
    }

    [[noreturn]] void fail() const {
        source_.fail(here(),
                     std::string("no XML: ") + XML_ErrorString(XML_GetErrorCode(parser_.get())));
    }

    /// Does the work of one event, unless an earlier one failed.
    template <class Work>
    static void guarded(void* self, Work&& work) {
        auto& reader = *static_cast<Reader*>(self);
        if (reader.failure_ != nullptr) return;
        try {
            work(reader);
        } catch (...) {
            reader.failure_ = std::current_exception();
            XML_StopParser(reader.parser_.get(), XML_FALSE);
        }
    }

    static void XMLCALL begin(void* self, const XML_Char* name, const XML_Char** attributes) {
        guarded(self, [&](Reader& r) {
            const char* const at = r.here();
            if (++r.depth_ > r.source_.limits().nesting) {
                r.source_.fail_limit(
                    at, "elements nest deeper than " + std::to_string(r.source_.limits().nesting));
            }
            r.handler_.begin(XmlElement(name, attributes, at));
        });
    }
    static void XMLCALL end(void* self, const XML_Char*) {
        guarded(self, [](Reader& r) {
            --r.depth_;
            r.handler_.end();
        });
    }
    static void XMLCALL text(void* self, const XML_Char* piece, int size) {
        guarded(self, [&](Reader& r) { r.handler_.text({piece, static_cast<std::size_t>(size)}); });
    }
    static void XMLCALL declare(void* self, const XML_Char* prefix, const XML_Char* uri) {
        guarded(self, [&](Reader& r) {
            r.handler_.declare(prefix != nullptr ? prefix : "", uri != nullptr ? uri : "");
        });
    }
    /// ASCII by that name; expat has another one for it.
    static int XMLCALL encoding(void*, const XML_Char* name, XML_Encoding* info) {
        const std::string_view given(name);
        if (given != "ASCII" && given != "ascii") return XML_STATUS_ERROR;
        for (int i = 0; i < 256; ++i) info->map[i] = i < 128 ? i : -1;
        info->data = nullptr;
        info->convert = nullptr;
        info->release = nullptr;
        return XML_STATUS_OK;
    }
    static void XMLCALL doctype(void* self, const XML_Char*, const XML_Char*, const XML_Char*,
                                int) {
        guarded(self, [](Reader& r) {
            r.source_.fail(r.here(), "a document type declaration, which is refused");
        });
    }

    const InputText& source_;
    XmlHandler& handler_;
    ParserPointer parser_;
    std::exception_ptr failure_;
    std::uint64_t depth_ = 0;
};

constexpr std::string_view blanks = " \t\r\n";

}  // namespace

XmlElement::XmlElement(const char* expanded_name, const char** attributes, const char* place)
    : at(place), attributes_(attributes) {
    const Name split_name = split(expanded_name);
    space = split_name.space;
    name = split_name.local;
}

std::optional<std::string_view> XmlElement::attribute(std::string_view wanted) const {
    for (const char** a = attributes_; *a != nullptr; a += 2)
        if (wanted == *a) return a[1];
    return std::nullopt;
}

std::optional<std::string_view> XmlElement::attribute(std::string_view in_space,
                                                      std::string_view wanted) const {
    for (const char** a = attributes_; *a != nullptr; a += 2) {
        const Name split_name = split(*a);
        if (split_name.space == in_space && split_name.local == wanted) return a[1];
    }
    return std::nullopt;
}

std::vector<std::pair<std::string_view, std::string_view>> XmlElement::attributes() const {
    std::vector<std::pair<std::string_view, std::string_view>> out;
    for (const char** a = attributes_; *a != nullptr; a += 2)
        out.emplace_back(split(*a).local, a[1]);
    return out;
}

std::string_view XmlElement::required(const InputText& source, std::string_view wanted) const {
    const auto value = attribute(wanted);
    if (!value) {
        source.fail(at, "<" + std::string(name) + "> without the attribute " + std::string(wanted));
    }
    return *value;
}

void read_xml(const InputText& source, XmlHandler& handler) { Reader(source, handler).read(); }

std::string_view trimmed_word(std::string_view word) {
    const std::size_t first = word.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return word.substr(first, word.find_last_not_of(blanks) - first + 1);
}

std::string_view take_word(std::string_view& words) {
    words = trimmed_word(words);
    const std::size_t size = std::min(words.find_first_of(blanks), words.size());
    const std::string_view word = words.substr(0, size);
    words.remove_prefix(size);
    return word;
}

double xml_real(const InputText& source, std::string_view word, const char* what, const char* at) {
    std::string_view digits = trimmed_word(word);
    if (digits.size() > source.limits().literal_characters) {
        source.fail_limit(at, "a number of more than " +
                                  std::to_string(source.limits().literal_characters) +
                                  " characters");
    }
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
    double value = 0;
    const char* const last = digits.data() + digits.size();
    const auto [stop, error] = nearest_double(digits.data(), last, value);
    const auto fail = [&](const char* why) {
        source.fail(at, shown_word(trimmed_word(word)) + ", read as " + what + ", " + why);
    };
    if (error == std::errc::result_out_of_range) fail("is too large for a double");
    if (error != std::errc{} || stop != last) fail("is not a number");
    if (!std::isfinite(value)) fail("is not finite");
    return value;
}

std::uint64_t xml_count(const InputText& source, std::string_view word, const char* what,
                        const char* at) {
    const std::string_view digits = trimmed_word(word);
    std::uint64_t value = 0;
    const char* const last = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), last, value);
    if (error != std::errc{} || stop != last)
        source.fail(at, shown_word(digits) + ", read as " + what + ", is not an index");
    return value;
}

}  // namespace trisect::detail
