// SPDX-License-Identifier: Apache-2.0
#include "xml.h"

#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

namespace trisect::test {
namespace {

bool is_name_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == ':';
}

class Reader {
public:
    explicit Reader(std::string_view text) : text_(text) {}

    bool read_document() {
        while (read_text() && !text_.empty()) {
            if (!read_tag()) return false;
            if (open_.empty()) break;
        }
        const bool only_blanks = text_.find_first_not_of(" \n\t") == std::string_view::npos;
        return elements_ > 0 && open_.empty() && only_blanks;
    }

private:
    bool read_text() {
        while (!text_.empty() && text_.front() != '<') {
            if (text_.front() == '>') return false;
            if (text_.front() == '&' && !is_reference()) return false;
            text_.remove_prefix(1);
        }
        return true;
    }

    [[nodiscard]] bool is_reference() const {
        for (const std::string_view known : {"&amp;", "&lt;", "&gt;", "&quot;"}) {
            if (text_.substr(0, known.size()) == known) return true;
        }
        return false;
    }

    std::string_view read_name() {
        std::size_t n = 0;
        while (n < text_.size() && is_name_letter(text_[n])) ++n;
        const std::string_view name = text_.substr(0, n);
        text_.remove_prefix(n);
        return name;
    }

    bool skip(std::string_view expected) {
        if (text_.substr(0, expected.size()) != expected) return false;
        text_.remove_prefix(expected.size());
        return true;
    }

    void skip_blanks() {
        while (!text_.empty() && std::isspace(static_cast<unsigned char>(text_.front())) != 0) {
            text_.remove_prefix(1);
        }
    }

    bool read_attribute() {
        if (read_name().empty() || !skip("=\"")) return false;
        const std::size_t end = text_.find_first_of("\"<&");
        if (end == std::string_view::npos || text_[end] != '"') return false;
        text_.remove_prefix(end + 1);
        return true;
    }

    bool read_tag() {
        if (skip("</")) {
            if (open_.empty() || read_name() != open_.back()) return false;
            open_.pop_back();
            return skip(">");
        }
        if (!skip("<")) return false;
        const std::string name(read_name());
        if (name.empty()) return false;
        ++elements_;
        for (skip_blanks(); !text_.empty() && is_name_letter(text_.front()); skip_blanks()) {
            if (!read_attribute()) return false;
        }
        if (skip("/>")) return true;
        open_.push_back(name);
        return skip(">");
    }

    std::string_view text_;
    std::vector<std::string> open_;
    int elements_ = 0;
};

}  // namespace

bool is_well_formed_xml(std::string_view text) { return Reader(text).read_document(); }

}  // namespace trisect::test
