// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/csg/csg_parameters.h>
#include <trisect/bsp/csg/json/csg_json.h>
#include <trisect/bsp/csg/json/csg_json_scanner.h>
#include <trisect/bsp/csg/nesting_level.h>

namespace trisect {
namespace {

constexpr std::string_view schema = "trisect.csg/1";
// What a message shows of a name, in bytes.
constexpr std::size_t shown_length = 40;

std::string shown(const std::string& name) { return "'" + name.substr(0, shown_length) + "'"; }

class Reader {
public:
    Reader(std::string_view text, CsgTree& tree, const CsgLimits& limits)
        : scanner_(text, tree.file), tree_(tree), limits_(limits) {}

    void run() {
        bool has_nodes = false;
        const CsgPlace start = scanner_.place();
        read_object([&](const std::string& name, CsgPlace place) {
            if (name == "schema")
                check_schema();
            else if (name == "file")
                source_ = scanner_.read_text();
            else if (name == "nodes")
                has_nodes = read_nodes(tree_.roots);
            else
                refuse_member(name, place);
        });
        if (!scanner_.is_at_end()) scanner_.expected("the end of the text");
        if (!has_nodes) scanner_.fail(start, "the member 'nodes' is missing");
        set_places();
    }

private:
    [[nodiscard]] detail::NestingLevel deeper() {
        return {depth_, limits_.depth, [this](const std::string& message) { exceed(message); }};
    }

    [[noreturn]] void exceed(const std::string& message) {
        throw CsgError(ErrorCode::Limit, tree_.place(scanner_.place()), message);
    }
    [[noreturn]] void refuse_member(const std::string& name, CsgPlace place) const {
        throw CsgError(ErrorCode::Unsupported, tree_.place(place),
                       "there is no member " + shown(name));
    }

    /// `member` reads the value of each.
    template <class Member>
    void read_object(const Member& member) {
        scanner_.take('{');
        if (scanner_.take_if('}')) return;
        std::set<std::string> seen;
        do {
            const CsgPlace place = scanner_.place();
            const std::string name = scanner_.read_text();
            if (!seen.insert(name).second)
                scanner_.fail(place, "the member " + shown(name) + " comes twice");
            scanner_.take(':');
            member(name, place);
        } while (scanner_.take_if(','));
        scanner_.take('}');
    }

    template <class Entry>
    void read_array(const Entry& entry) {
        scanner_.take('[');
        if (scanner_.take_if(']')) return;
        do entry();
        while (scanner_.take_if(','));
        scanner_.take(']');
    }

    void check_schema() {
        const CsgPlace place = scanner_.place();
        const std::string name = scanner_.read_text();
        if (name != schema)
            throw CsgError(ErrorCode::Unsupported, tree_.place(place),
                           "the schema " + shown(name) + " is not known; this reads '" +
                               std::string(schema) + "'");
    }

    bool read_nodes(std::vector<std::uint32_t>& siblings) {
        read_array([&] { read_node(siblings); });
        return true;
    }

    void read_node(std::vector<std::uint32_t>& siblings) {
        const auto level = deeper();
        if (tree_.nodes.size() >= limits_.nodes)
            exceed("more than " + std::to_string(limits_.nodes) + " nodes");
        const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
        siblings.push_back(index);
        tree_.nodes.emplace_back();
        given_.emplace_back();
        CsgNode node;  // children make the vector grow
        node.place = scanner_.place();
        read_object([&](const std::string& name, CsgPlace place) {
            read_member(index, node, name, place);
        });
        if (node.name.empty()) scanner_.fail(node.place, "the member 'node' is missing");
        tree_.nodes[index] = std::move(node);
    }

    void read_member(std::uint32_t index, CsgNode& node, const std::string& name, CsgPlace place) {
        if (name == "node")
            node.name = read_name();
        else if (name == "arguments")
            read_arguments(node);
        else if (name == "values")
            read_array([&] { node.arguments.push_back({"", read_value()}); });
        else if (name == "modifiers")
            node.modifiers = read_modifiers();
        else if (name == "place")
            given_[index] = read_place();
        else if (name == "children")
            read_nodes(node.children);
        else
            refuse_member(name, place);
    }

    std::string read_name() {
        const CsgPlace place = scanner_.place();
        std::string name = scanner_.read_text();
        if (name.empty()) scanner_.fail(place, "a name was expected");
        return name;
    }

    void read_arguments(CsgNode& node) {
        read_object([&](const std::string& name, CsgPlace place) {
            if (name.empty()) scanner_.fail(place, "the name of an argument was expected");
            node.arguments.push_back({name, read_value()});
        });
    }

    CsgModifiers read_modifiers() {
        const CsgPlace place = scanner_.place();
        CsgModifiers out;
        for (const char c : scanner_.read_text()) {
            bool* const flag = c == '*'   ? &out.disabled
                               : c == '!' ? &out.root
                               : c == '#' ? &out.highlight
                               : c == '%' ? &out.background
                                          : nullptr;
            if (flag == nullptr || *flag)
                scanner_.fail(place, "modifiers are of * ! # %, each once");
            *flag = true;
        }
        return out;
    }

    CsgPlace read_place() {
        const CsgPlace start = scanner_.place();
        std::vector<std::uint32_t> numbers;
        read_array([&] {
            const CsgPlace place = scanner_.place();
            const double n = scanner_.read_number();
            if (!(n >= 1) || n > std::numeric_limits<std::uint32_t>::max() || n != std::floor(n) ||
                numbers.size() == 2)
                scanner_.fail(place, "a place is a line and a column, which count from 1");
            numbers.push_back(static_cast<std::uint32_t>(n));
        });
        if (numbers.size() != 2) scanner_.fail(start, "a place is a line and a column");
        return {numbers[0], numbers[1]};
    }

    CsgValue read_value() {
        const auto level = deeper();
        if (++values_ > limits_.values)
            exceed("more than " + std::to_string(limits_.values) + " values");
        CsgValue out;
        out.place = scanner_.place();
        const char c = scanner_.next();
        if (c == '[') {
            CsgValue::List list;
            read_array([&] { list.push_back(read_value()); });
            out.data = std::move(list);
        } else if (c == '"') {
            out.data = scanner_.read_text();
        } else if (c == '{') {
            out.data = read_special();
        } else if (c == '-' || (c >= '0' && c <= '9')) {
            out.data = scanner_.read_number();
        } else if (scanner_.take_if("true")) {
            out.data = true;
        } else if (scanner_.take_if("false")) {
            out.data = false;
        } else if (!scanner_.take_if("null")) {
            scanner_.expected("a value");
        }
        return out;
    }

    /// What JSON has no word for: {"number": "inf"}.
    double read_special() {
        const CsgPlace start = scanner_.place();
        std::optional<double> out;
        read_object([&](const std::string& name, CsgPlace place) {
            if (name != "number") refuse_member(name, place);
            const CsgPlace at = scanner_.place();
            const std::string word = scanner_.read_text();
            if (word == "inf" || word == "-inf")
                out = (word == "inf" ? 1 : -1) * std::numeric_limits<double>::infinity();
            else if (word == "nan")
                out = std::numeric_limits<double>::quiet_NaN();
            else
                scanner_.fail(at, "inf, -inf or nan was expected");
        });
        if (!out) scanner_.fail(start, "the member 'number' is missing");
        return *out;
    }

    static void set_place(std::vector<CsgArgument>& arguments, CsgPlace place) {
        std::vector<CsgValue*> pending;
        for (CsgArgument& a : arguments) pending.push_back(&a.value);
        while (!pending.empty()) {
            CsgValue* const value = pending.back();
            pending.pop_back();
            value->place = place;
            if (auto* const list = std::get_if<CsgValue::List>(&value->data))
                for (CsgValue& v : *list) pending.push_back(&v);
        }
    }

    /// Places are those of the text that the program was made of, or of this one.
    void set_places() {
        for (std::size_t n = 0; n < tree_.nodes.size(); ++n) {
            CsgNode& node = tree_.nodes[n];
            if (given_[n].has_value() != source_.has_value())
                scanner_.fail(node.place, source_
                                              ? "a node without 'place' in a program with 'file'"
                                              : "a 'place' in a program without 'file'");
            if (!source_) continue;
            node.place = *given_[n];
            set_place(node.arguments, node.place);
        }
        if (source_)
            tree_.file = (std::filesystem::path(tree_.file).parent_path() / *source_).string();
    }

    detail::CsgJsonScanner scanner_;
    CsgTree& tree_;
    const CsgLimits& limits_;
    std::optional<std::string> source_;
    std::vector<std::optional<CsgPlace>> given_;  // by node
    std::uint32_t depth_ = 0;
    std::size_t values_ = 0;
};

}  // namespace

CsgTree parse_csg_json(std::string_view text, std::string file, const CsgLimits& limits) {
    CsgTree tree;
    tree.file = std::move(file);
    Reader(text, tree, limits).run();
    detail::name_csg_arguments(tree);
    return tree;
}

}  // namespace trisect
