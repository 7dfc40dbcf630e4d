// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/bsp/csg/json/csg_json.h>
#include <trisect/bsp/csg/json/csg_json_scanner.h>

namespace trisect {
namespace {

class Writer {
public:
    explicit Writer(const CsgTree& tree) : tree_(tree) {}

    std::string run() {
        out_ = "{\"schema\": \"trisect.csg/1\",\n \"file\": ";
        add_text(tree_.file, {});
        out_ += ",\n \"nodes\": ";
        add_nodes(tree_.roots, 2);
        out_ += "}\n";
        return std::move(out_);
    }

private:
    void add_nodes(const std::vector<std::uint32_t>& nodes, std::size_t depth) {
        out_ += '[';
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            out_ += i == 0 ? "\n" : ",\n";
            out_.append(depth, ' ');
            add_node(tree_.nodes[nodes[i]], depth);
        }
        out_ += ']';
    }

    void add_node(const CsgNode& node, std::size_t depth) {
        out_ += "{\"node\": ";
        add_text(node.name, node.place);
        add_modifiers(node.modifiers);
        out_ += ", \"place\": [" + std::to_string(node.place.line) + ", " +
                std::to_string(node.place.column) + "]";
        add_arguments(node);
        if (!node.children.empty()) {
            out_ += ", \"children\": ";
            add_nodes(node.children, depth + 1);
        }
        out_ += '}';
    }

    void add_modifiers(const CsgModifiers& modifiers) {
        std::string signs;
        if (modifiers.disabled) signs += '*';
        if (modifiers.root) signs += '!';
        if (modifiers.highlight) signs += '#';
        if (modifiers.background) signs += '%';
        if (!signs.empty()) out_ += ", \"modifiers\": \"" + signs + '"';
    }

    /// Those that count: of two with a name the last one.
    static std::vector<const CsgArgument*> named(const CsgNode& node) {
        std::set<std::string_view> seen;
        std::vector<const CsgArgument*> out;
        for (auto a = node.arguments.rbegin(); a != node.arguments.rend(); ++a)
            if (!a->name.empty() && seen.insert(a->name).second) out.push_back(&*a);
        return {out.rbegin(), out.rend()};
    }

    void add_arguments(const CsgNode& node) {
        const std::vector<const CsgArgument*> arguments = named(node);
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            out_ += i == 0 ? ", \"arguments\": {" : ", ";
            add_text(arguments[i]->name, node.place);
            out_ += ": ";
            add_value(arguments[i]->value);
        }
        if (!arguments.empty()) out_ += '}';
        // Nodes that are not known have arguments without names.
        bool is_first = true;
        for (const CsgArgument& a : node.arguments) {
            if (!a.name.empty()) continue;
            out_ += is_first ? ", \"values\": [" : ", ";
            is_first = false;
            add_value(a.value);
        }
        if (!is_first) out_ += ']';
    }

    void add_value(const CsgValue& value) {
        if (value.truth() != nullptr) {
            out_ += *value.truth() ? "true" : "false";
        } else if (value.number() != nullptr) {
            add_number(*value.number());
        } else if (value.text() != nullptr) {
            add_text(*value.text(), value.place);
        } else if (value.list() != nullptr) {
            out_ += '[';
            for (std::size_t i = 0; i < value.list()->size(); ++i) {
                if (i > 0) out_ += ", ";
                add_value((*value.list())[i]);
            }
            out_ += ']';
        } else {
            out_ += "null";
        }
    }

    /// The shortest text that is read as the same double.
    void add_number(double x) {
        if (!std::isfinite(x)) {
            const char* const word = std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
            out_ += std::string("{\"number\": \"") + word + "\"}";
            return;
        }
        std::array<char, 32> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
        out_.append(digits.data(), end);
    }

    void add_text(std::string_view text, CsgPlace place) {
        out_ += '"';
        while (!text.empty()) {
            const std::size_t length = detail::utf8_length(text);
            if (length == 0)
                throw CsgError(ErrorCode::Unsupported, tree_.place(place),
                               "a text that is not UTF-8, which JSON cannot hold");
            add_character(text.substr(0, length));
            text.remove_prefix(length);
        }
        out_ += '"';
    }

    void add_character(std::string_view character) {
        const char c = character[0];
        if (c == '"' || c == '\\') out_ += '\\';
        if (static_cast<unsigned char>(c) >= 0x20) {
            out_ += character;
            return;
        }
        constexpr std::string_view hexadecimal = "0123456789abcdef";
        out_ += "\\u00";
        out_ += hexadecimal[static_cast<unsigned char>(c) / 16];
        out_ += hexadecimal[static_cast<unsigned char>(c) % 16];
    }

    const CsgTree& tree_;
    std::string out_;
};

}  // namespace

std::string csg_json_text(const CsgTree& tree) { return Writer(tree).run(); }

}  // namespace trisect
