// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <utility>

#include <trisect/bsp/csg/csg_lexer.h>
#include <trisect/bsp/csg/csg_parameters.h>
#include <trisect/bsp/csg/csg_tree.h>
#include <trisect/bsp/csg/nesting_level.h>

namespace trisect {
namespace {

using detail::CsgLexer;
using detail::CsgToken;

class Parser {
public:
    Parser(std::string_view text, CsgTree& tree, const CsgLimits& limits)
        : lexer_(text, tree.file), tree_(tree), limits_(limits) {}

    void run() {
        while (lexer_.token().kind != CsgToken::Kind::End) read_child(tree_.roots);
    }

private:
    [[nodiscard]] detail::NestingLevel deeper() {
        return {depth_, limits_.depth, [this](const std::string& message) { exceed(message); }};
    }

    [[noreturn]] void exceed(const std::string& message) const {
        throw CsgError(ErrorCode::Limit, tree_.place(lexer_.token().place), message);
    }
    [[noreturn]] void expected(const std::string& what) const {
        lexer_.fail(lexer_.token().place, what + " was expected, not " + lexer_.description());
    }
    void take(char sign) {
        if (!lexer_.is(sign)) expected(std::string("'") + sign + "'");
        lexer_.advance();
    }
    bool take_if(char sign) {
        if (!lexer_.is(sign)) return false;
        lexer_.advance();
        return true;
    }

    // A node, a block without a name, or nothing.
    void read_child(std::vector<std::uint32_t>& siblings) {
        if (take_if(';')) return;
        const auto level = deeper();
        if (lexer_.is('{')) return read_block(siblings);
        read_node(siblings);
    }

    void read_block(std::vector<std::uint32_t>& siblings) {
        const CsgPlace start = lexer_.token().place;
        take('{');
        while (!lexer_.is('}')) {
            if (lexer_.token().kind == CsgToken::Kind::End)
                lexer_.fail(start, "a block that does not end");
            read_child(siblings);
        }
        take('}');
    }

    CsgModifiers read_modifiers() {
        CsgModifiers out;
        for (;; lexer_.advance()) {
            if (lexer_.is('*'))
                out.disabled = true;
            else if (lexer_.is('!'))
                out.root = true;
            else if (lexer_.is('#'))
                out.highlight = true;
            else if (lexer_.is('%'))
                out.background = true;
            else
                return out;
        }
    }

    void read_node(std::vector<std::uint32_t>& siblings) {
        CsgNode node;
        node.modifiers = read_modifiers();
        if (lexer_.token().kind != CsgToken::Kind::Name) expected("the name of a node");
        node.place = lexer_.token().place;
        node.name = lexer_.token().text;
        lexer_.advance();
        if (!lexer_.is('('))
            expected("'(' after '" + node.name.substr(0, 40) +
                     "' (what is read is OpenSCAD's evaluated form: openscad -o FILE.csg)");
        read_arguments(node);
        if (tree_.nodes.size() >= limits_.nodes)
            exceed("more than " + std::to_string(limits_.nodes) + " nodes");
        const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
        siblings.push_back(index);
        tree_.nodes.push_back(std::move(node));
        std::vector<std::uint32_t> children;
        read_child(children);
        tree_.nodes[index].children = std::move(children);
    }

    void read_arguments(CsgNode& node) {
        take('(');
        while (!lexer_.is(')')) {
            node.arguments.push_back(read_argument());
            if (!lexer_.is(')')) take(',');
        }
        take(')');
    }

    CsgArgument read_argument() {
        CsgArgument out;
        if (lexer_.token().kind == CsgToken::Kind::Name && !is_constant(lexer_.token().text)) {
            out.name = lexer_.token().text;
            lexer_.advance();
            take('=');
        }
        out.value = read_value();
        return out;
    }

    static bool is_constant(const std::string& name) {
        return name == "true" || name == "false" || name == "undef" || name == "inf" ||
               name == "nan";
    }

    CsgValue read_value() {
        const auto level = deeper();
        if (++values_ > limits_.values)
            exceed("more than " + std::to_string(limits_.values) + " values");
        CsgValue out;
        out.place = lexer_.token().place;
        if (lexer_.is('[')) {
            out.data = read_list();
            return out;
        }
        const CsgToken& token = lexer_.token();
        if (token.kind == CsgToken::Kind::Number)
            out.data = token.number;
        else if (token.kind == CsgToken::Kind::Text)
            out.data = token.text;
        else if (token.kind == CsgToken::Kind::Name)
            read_constant(out);
        else
            expected("a value");
        lexer_.advance();
        return out;
    }

    void read_constant(CsgValue& out) const {
        const std::string& name = lexer_.token().text;
        if (!is_constant(name)) expected("a value");
        if (name == "true" || name == "false") out.data = name == "true";
        if (name == "inf") out.data = std::numeric_limits<double>::infinity();
        if (name == "nan") out.data = std::numeric_limits<double>::quiet_NaN();
    }

    CsgValue::List read_list() {
        CsgValue::List out;
        take('[');
        while (!lexer_.is(']')) {
            out.push_back(read_value());
            if (!lexer_.is(']')) take(',');
        }
        take(']');
        return out;
    }

    CsgLexer lexer_;
    CsgTree& tree_;
    const CsgLimits& limits_;
    std::uint32_t depth_ = 0;
    std::size_t values_ = 0;
};

}  // namespace

CsgTree parse_csg(std::string_view text, std::string file, const CsgLimits& limits) {
    CsgTree tree;
    tree.file = std::move(file);
    Parser(text, tree, limits).run();
    detail::name_csg_arguments(tree);
    return tree;
}

}  // namespace trisect
