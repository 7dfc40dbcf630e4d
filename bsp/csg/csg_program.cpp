// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_program.h>

#include <trisect/bsp/csg/csg_import.h>

namespace trisect::detail {

CsgProgram::CsgProgram(const CsgTree& tree) : tree_(tree), roots_(chosen_roots()) {
    refuse_unknown();
    find_dimensions();
}

std::string CsgProgram::place(std::uint32_t n) const {
    return tree_.place(node(n).place).to_string() + ": " + node(n).name;
}

std::vector<std::uint32_t> CsgProgram::used(const std::vector<std::uint32_t>& nodes) const {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t n : nodes)
        if (is_used(n)) out.push_back(n);
    return out;
}

/// Parents first.
std::vector<std::uint32_t> CsgProgram::used_below(std::vector<std::uint32_t> pending) const {
    std::vector<std::uint32_t> out;
    while (!pending.empty()) {
        const std::uint32_t n = pending.back();
        pending.pop_back();
        if (!is_used(n)) continue;
        out.push_back(n);
        pending.insert(pending.end(), node(n).children.rbegin(), node(n).children.rend());
    }
    return out;
}

std::vector<std::uint32_t> CsgProgram::chosen_roots() const {
    for (const std::uint32_t n : used_below(tree_.roots))
        if (node(n).modifiers.root) return {n};
    return tree_.roots;
}

void CsgProgram::refuse_unknown() const {
    for (const std::uint32_t n : used_below(roots_))
        if (kind(n) == CsgKind::Unknown)
            throw CsgError(ErrorCode::Unsupported, tree_.place(node(n).place),
                           node(n).name.substr(0, 40) + "() is not supported");
}

void CsgProgram::find_dimensions() {
    dimensions_.assign(tree_.nodes.size(), 0);
    for (auto n = static_cast<std::uint32_t>(tree_.nodes.size()); n-- > 0;) {
        dimensions_[n] = csg_dimension(kind(n));
        if (kind(n) == CsgKind::Import) dimensions_[n] = is_flat_import(arguments(n)) ? 2 : 3;
        if (dimensions_[n] == 0) dimensions_[n] = dimension_of(node(n).children);
    }
}

int CsgProgram::dimension_of(const std::vector<std::uint32_t>& children) const {
    for (const std::uint32_t n : children)
        if (is_used(n) && dimensions_[n] != 0) return dimensions_[n];
    return 0;
}

}  // namespace trisect::detail
