// SPDX-License-Identifier: Apache-2.0
//
// Changes of programs in OpenSCAD's evaluated form that mostly keep them well-formed.
#pragma once

#include <array>
#include <cctype>
#include <cstddef>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// From the name of a node to its semicolon or closing brace.
struct NodeSpan {
    std::size_t begin = 0;
    std::size_t size = 0;
};

class CsgMutation {
public:
    CsgMutation(std::string text, unsigned seed) : text_(std::move(text)), random_(seed) {
        find_spans();
    }

    /// The changed program.
    std::string result() {
        if (nodes_.empty() || below(3) == 0) {
            change_number();
            return std::move(text_);
        }
        const NodeSpan node = nodes_[below(nodes_.size())];
        const std::string own = text_.substr(node.begin, node.size);
        const NodeSpan other = nodes_[below(nodes_.size())];
        const std::string others = text_.substr(other.begin, other.size);
        std::string now;
        switch (below(5)) {
            case 0:  // left out
                break;
            case 1:
                now = own + others;
                break;
            case 2:
                now = others;
                break;
            case 3:
                now = std::string(wraps[below(wraps.size())]) + "{" + own + others + "}";
                break;
            default:
                now = std::string(1, "#%*!"[below(4)]) + own;
                break;
        }
        text_.replace(node.begin, node.size, now);
        return std::move(text_);
    }

private:
    static constexpr std::array<std::string_view, 12> wraps{
        "union()",
        "difference()",
        "intersection()",
        "hull()",
        "minkowski()",
        "multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]])",
        "multmatrix([[0.8,-0.6,0,0],[0.6,0.8,0,0],[0,0,1,0],[0,0,0,1]])",
        "linear_extrude(height=2,twist=30,slices=2,scale=[1,0.5])",
        "rotate_extrude(angle=90,$fn=5)",
        "offset(r=-0.5,$fn=6)",
        "projection(cut=false)",
        "resize(newsize=[1,2,0],auto=[false,false,true])"};
    static constexpr std::array<std::string_view, 16> numbers{
        "0", "1",    "-1",    "2",   "0.5",   "1e-9", "1e9",   "3",
        "7", "1e17", "1e308", "inf", "undef", "360",  "0.001", "5e-324"};

    std::size_t below(std::size_t n) { return random_() % n; }

    static bool is_word(char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
    }

    /// Behind the quoted text, or the bracket and its partner, at `at`.
    std::size_t behind(std::size_t at) const {
        int depth = 0;
        for (; at < text_.size(); ++at) {
            const char c = text_[at];
            if (c == '"') {
                while (++at < text_.size() && text_[at] != '"')
                    if (text_[at] == '\\') ++at;
            }
            if (c == '(' || c == '{' || c == '[') ++depth;
            if (c == ')' || c == '}' || c == ']') --depth;
            if (depth <= 0) return at + 1;
        }
        return text_.size();
    }

    void find_spans() {
        for (std::size_t i = 0; i < text_.size();) {
            const char c = text_[i];
            if (c == '"') {
                i = behind(i);
                continue;
            }
            if (!is_word(c)) {
                ++i;
                continue;
            }
            const std::size_t begin = i;
            while (i < text_.size() && is_word(text_[i])) ++i;
            if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-')
                numbers_.push_back({begin, i - begin});
            else if (i < text_.size() && text_[i] == '(')
                add_node(begin, i);
        }
    }
    void add_node(std::size_t begin, std::size_t bracket) {
        std::size_t end = behind(bracket);
        while (end < text_.size() && std::isspace(static_cast<unsigned char>(text_[end])) != 0)
            ++end;
        if (end < text_.size()) end = text_[end] == '{' ? behind(end) : end + 1;
        nodes_.push_back({begin, end - begin});
    }

    void change_number() {
        if (numbers_.empty()) return;
        const NodeSpan old = numbers_[below(numbers_.size())];
        const NodeSpan other = numbers_[below(numbers_.size())];
        text_.replace(old.begin, old.size,
                      below(2) == 0 ? std::string(numbers[below(numbers.size())])
                                    : text_.substr(other.begin, other.size));
    }

    std::string text_;
    std::minstd_rand random_;
    std::vector<NodeSpan> nodes_;
    std::vector<NodeSpan> numbers_;
};

}  // namespace fuzz
