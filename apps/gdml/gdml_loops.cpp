// SPDX-License-Identifier: Apache-2.0
#include "gdml_loops.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "gdml_expression.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t most_turns = 1U << 20;  // of elements in loops, and of turns

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Attributes that are names and no formulas.
bool is_name(std::string_view attribute) {
    constexpr std::array<std::string_view, 7> names{"name",  "ref",   "for",    "unit",
                                                    "lunit", "aunit", "formula"};
    return std::ranges::find(names, attribute) != names.end() || attribute.starts_with("vertex");
}

bool has_loop(const GdmlElement& e) {
    return e.name == "loop" || std::ranges::any_of(e.children, has_loop);
}

class Unroller final : public GdmlNames {
public:
    explicit Unroller(const GdmlDocument& document) : document_(document) {}

    [[nodiscard]] std::optional<double> value(std::string_view name,
                                              std::span<const double> indices) const override {
        if (!indices.empty()) return std::nullopt;
        for (auto loop = loops_.rbegin(); loop != loops_.rend(); ++loop)
            if (loop->first == name) return static_cast<double>(loop->second);
        const auto at = numbers_.find(name);
        return at == numbers_.end() ? std::nullopt : std::optional(at->second);
    }

    void unroll(GdmlElement& e) {
        std::vector<GdmlElement> children;
        for (GdmlElement& child : e.children) add(children, child);
        e.children = std::move(children);
    }

private:
    void add(std::vector<GdmlElement>& out, const GdmlElement& e) {
        if (e.name == "loop") {
            repeat(out, e);
            return;
        }
        if (!loops_.empty()) count(e);
        GdmlElement& made = out.emplace_back();
        made.name = e.name;
        made.offset = e.offset;
        for (const auto& [name, text] : e.attributes)
            made.attributes.emplace_back(
                name,
                loops_.empty() ? text : (is_name(name) ? solved(e, text) : substituted(text)));
        std::vector<GdmlElement> children;
        for (const GdmlElement& child : e.children) add(children, child);
        made.children = std::move(children);
        define(made);
    }

    void repeat(std::vector<GdmlElement>& out, const GdmlElement& loop) {
        const std::string& variable = document_.required(loop, "for");
        const std::string* from = loop.find("from");
        const double first = whole(loop, from != nullptr ? *from : variable);
        const double last = whole(loop, document_.required(loop, "to"));
        const double step = whole(loop, document_.required(loop, "step"));
        if (first <= last && step <= 0) document_.fail(loop, "<loop> without end");
        for (double i = first; i <= last; i += step) {
            count(loop);
            loops_.emplace_back(variable, static_cast<std::int64_t>(i));
            for (const GdmlElement& child : loop.children) add(out, child);
            loops_.pop_back();
        }
    }

    void count(const GdmlElement& e) {
        if (++count_ > most_turns) document_.fail_limit(e, "too many elements in loops");
    }

    /// Numbers that bounds may name. What has no value here is refused where it is used.
    void define(const GdmlElement& e) {
        if (e.name != "constant" && e.name != "variable" && e.name != "quantity") return;
        const std::string* name = e.find("name");
        const std::string* text = e.find("value");
        if (name == nullptr || text == nullptr || e.find("unit") != nullptr) return;
        try {
            numbers_.insert_or_assign(*name, gdml_value(*text, *this));
        } catch (const GdmlFormulaError&) {
            numbers_.erase(*name);
        }
    }

    double whole(const GdmlElement& e, std::string_view formula) const {
        try {
            const double value = gdml_value(formula, *this);
            if (value == std::floor(value) && std::fabs(value) < 1e9) return value;
        } catch (const GdmlFormulaError& error) {
            document_.fail(e, "<" + e.name + ">: " + error.what());
        }
        document_.fail(e, "<" + e.name + ">: '" + std::string(formula) + "' is no whole number");
    }

    /// A formula with numbers in place of the variables of loops.
    std::string substituted(const std::string& text) const {
        std::string out;
        for (std::size_t i = 0; i < text.size();) {
            std::size_t end = i;
            while (end < text.size() && is_word(text[end])) ++end;
            if (end == i) {
                out += text[i++];
                continue;
            }
            const std::string word = text.substr(i, end - i);
            const auto loop = std::ranges::find(loops_.rbegin(), loops_.rend(), word,
                                                &std::pair<std::string, std::int64_t>::first);
            out += loop == loops_.rend() ? word : "(" + std::to_string(loop->second) + ")";
            i = end;
        }
        return out;
    }

    /// A name with indices in brackets made a part of it.
    std::string solved(const GdmlElement& e, const std::string& text) const {
        std::string out;
        for (std::size_t i = 0; i < text.size();) {
            if (text[i] != '[') {
                out += text[i++];
                continue;
            }
            const std::size_t close = text.find(']', i);
            if (close == std::string::npos) document_.fail(e, "'[' without ']': " + text);
            for (std::size_t begin = i + 1; begin <= close;) {
                const std::size_t end = std::min(text.find(',', begin), close);
                const double index = whole(e, std::string_view(text).substr(begin, end - begin));
                out += "_" + std::to_string(static_cast<std::int64_t>(index) - 1);
                begin = end + 1;
            }
            i = close + 1;
        }
        return out;
    }

    const GdmlDocument& document_;
    std::map<std::string, double, std::less<>> numbers_;
    std::vector<std::pair<std::string, std::int64_t>> loops_;
    std::uint64_t count_ = 0;
};

}  // namespace

void unroll_gdml_loops(GdmlElement& root, const GdmlDocument& document) {
    if (has_loop(root)) Unroller(document).unroll(root);
}

}  // namespace trisect::app
