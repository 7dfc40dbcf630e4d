// SPDX-License-Identifier: Apache-2.0
#include "matrix_file.h"

#include <trisect/brep/io/file_bytes.h>
#include <trisect/kernel/error.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "values.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t matrix_file_limit = 1U << 20;

/// Words of a text with their places.
class Words {
public:
    Words(std::string_view text, std::string file)
        : text_(text), place_{std::move(file), 1, 1, 0} {}

    /// Empty at the end; `place()` is then where the word began.
    std::string_view next() {
        while (!text_.empty() && is_space(text_.front())) skip();
        std::size_t n = 0;
        while (n < text_.size() && !is_space(text_[n])) ++n;
        const std::string_view word = text_.substr(0, n);
        word_place_ = place_;
        text_.remove_prefix(n);
        place_.column += n;
        return word;
    }
    [[nodiscard]] const FilePlace& place() const { return word_place_; }

private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    void skip() {
        const bool new_line = text_.front() == '\n';
        place_.line += new_line ? 1U : 0U;
        place_.column = new_line ? 1 : place_.column + 1;
        text_.remove_prefix(1);
    }

    std::string_view text_;
    FilePlace place_;
    FilePlace word_place_;
};

double matrix_number(Words& words) {
    const std::string_view word = words.next();
    if (word.empty()) throw InputError(words.place(), "a matrix is twelve numbers, row by row");
    try {
        return parse_number(word, "matrix");
    } catch (const UsageError& e) {
        throw InputError(words.place(), e.what());
    }
}

}  // namespace

std::array<double, 12> parse_matrix(std::string_view text, const std::string& name) {
    Words words(text, name);
    std::array<double, 12> rows{};
    for (double& value : rows) value = matrix_number(words);
    if (!words.next().empty()) throw InputError(words.place(), "more than twelve numbers");
    return rows;
}

std::array<double, 12> read_matrix(const std::string& file) {
    if (file == "-") {
        const std::string name = "standard input";
        return parse_matrix(read_descriptor(0, name, matrix_file_limit).view(), name);
    }
    return parse_matrix(read_file(file, matrix_file_limit).view(), file);
}

}  // namespace trisect::app
