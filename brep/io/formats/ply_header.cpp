// SPDX-License-Identifier: Apache-2.0
//
// Reading the header of PLY: one statement a line, ended by `end_header`. Where the binary body
// begins depends on the line end after that word, which is why the header fixes the convention
// (LF, CR LF or CR) at its first line.
#include <trisect/brep/io/formats/ply_header.h>

#include <trisect/brep/io/formats/text_cursor.h>

#include <array>
#include <optional>
#include <utility>

namespace trisect::detail {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 18> type_names{{
    {"char", PlyType::Int8},
    {"int8", PlyType::Int8},
    {"uchar", PlyType::UInt8},
    {"uint8", PlyType::UInt8},
    {"short", PlyType::Int16},
    {"int16", PlyType::Int16},
    {"ushort", PlyType::UInt16},
    {"uint16", PlyType::UInt16},
    {"int", PlyType::Int32},
    {"int32", PlyType::Int32},
    {"uint", PlyType::UInt32},
    {"uint32", PlyType::UInt32},
    {"int64", PlyType::Int64},
    {"uint64", PlyType::UInt64},
    {"float", PlyType::Float32},
    {"float32", PlyType::Float32},
    {"double", PlyType::Float64},
    {"float64", PlyType::Float64},
}};

constexpr std::array<std::pair<std::string_view, PlyEncoding>, 3> encodings{{
    {"ascii", PlyEncoding::Ascii},
    {"binary_little_endian", PlyEncoding::BinaryLittleEndian},
    {"binary_big_endian", PlyEncoding::BinaryBigEndian},
}};

class HeaderReader {
public:
    explicit HeaderReader(const InputText& source) : source_(source), text_(source, TextRules{}) {}

    PlyHeader read() {
        if (!text_.next_line() || text_.word() != "ply") {
            source_.fail(source_.begin(), "a PLY file begins with a line 'ply'");
        }
        text_.expect_line_end();
        for (;;) {
            if (!text_.next_line()) source_.fail(source_.end(), "the file ends inside the header");
            const std::string_view keyword = text_.word();
            if (keyword == "end_header") break;
            statement(keyword);
        }
        text_.expect_line_end();
        if (!has_format_) source_.fail(text_.here(), "the header has no 'format' line");
        header_.body = text_.after_line();
        return std::move(header_);
    }

private:
    void statement(std::string_view keyword) {
        if (keyword == "comment") header_.comments.emplace_back(text_.rest_of_line());
        if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return;
        if (keyword == "format")
            format();
        else if (keyword == "element")
            element(keyword.data());
        else if (keyword == "property")
            property(keyword.data());
        else
            source_.fail(keyword.data(), shown_word(keyword) + " in a PLY header");
        text_.expect_line_end();
    }

    void format() {
        const std::string_view name = needed_word("the encoding");
        has_format_ = false;
        for (const auto& [known, encoding] : encodings) {
            if (name != known) continue;
            header_.encoding = encoding;
            has_format_ = true;
        }
        if (!has_format_) source_.fail(name.data(), shown_word(name) + " is no PLY encoding");
        const std::string_view version = needed_word("the version");
        if (version != "1.0") source_.fail(version.data(), "PLY version " + shown_word(version));
    }

    void element(const char* at) {
        PlyElement element;
        element.name = needed_word("the name of an element");
        element.count = text_.count("the number of entries");
        element.at = at;
        for (const PlyElement& other : header_.elements) {
            if (other.name == element.name) {
                source_.fail(at, "a second element " + shown_word(element.name));
            }
        }
        header_.elements.push_back(std::move(element));
    }

    void property(const char* at) {
        if (header_.elements.empty()) source_.fail(at, "a property before the first element");
        PlyProperty property;
        property.at = at;
        std::string_view word = needed_word("a type");
        property.is_list = word == "list";
        if (property.is_list) {
            word = needed_word("the type of a count");
            property.count_type = type(word);
            if (!is_integer(property.count_type)) {
                source_.fail(word.data(), "a list whose count is not an integer");
            }
            word = needed_word("the type of the items of a list");
        }
        property.type = type(word);
        property.name = needed_word("the name of a property");
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType type(std::string_view word) const {
        for (const auto& [name, value] : type_names) {
            if (word == name) return value;
        }
        source_.fail(word.data(), shown_word(word) + " is no PLY type");
    }

    std::string_view needed_word(const char* what) {
        const std::string_view word = text_.word();
        if (word.empty()) source_.fail(text_.here(), std::string(what) + " is missing");
        return word;
    }

    const InputText& source_;
    TextCursor text_;
    PlyHeader header_;
    bool has_format_ = false;
};

}  // namespace

PlyHeader read_ply_header(const InputText& source) { return HeaderReader(source).read(); }

}  // namespace trisect::detail
