// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_key.h>

namespace trisect::detail {
namespace {

void add_number(std::string& key, double v) {
    key.append(reinterpret_cast<const char*>(&v), sizeof v);
}

void add_value(std::string& key, const CsgValue& value) {
    key += static_cast<char>('0' + value.data.index());
    if (value.truth() != nullptr) key += *value.truth() ? 't' : 'f';
    if (value.number() != nullptr) add_number(key, *value.number());
    if (value.text() != nullptr) {
        add_number(key, static_cast<double>(value.text()->size()));
        key += *value.text();
    }
    if (value.list() != nullptr) {
        for (const CsgValue& v : *value.list()) add_value(key, v);
        key += ']';
    }
}

void add_node(std::string& key, const CsgProgram& program, std::uint32_t n, bool children_only) {
    const CsgNode& node = program.node(n);
    key += node.name;
    key += '(';
    if (!children_only)
        for (const CsgArgument& a : node.arguments) {
            key += a.name;
            key += '=';
            add_value(key, a.value);
        }
    key += '{';
    for (const std::uint32_t c : program.used_children(n)) add_node(key, program, c, false);
    key += '}';
}

}  // namespace

std::string csg_key(const CsgProgram& program, std::uint32_t n, const CsgFrame& frame,
                    bool children_only) {
    std::string key;
    for (const auto& row : frame.map.rows)
        for (const double c : row) add_number(key, c);
    add_number(key, frame.low);
    add_number(key, frame.high);
    if (frame.color != CsgFrame::fixed_color) add_number(key, frame.color);
    add_node(key, program, n, children_only);
    return key;
}

}  // namespace trisect::detail
