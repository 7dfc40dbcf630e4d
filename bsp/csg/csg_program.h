// SPDX-License-Identifier: Apache-2.0
//
// CsgProgram: the nodes of a tree that count.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <trisect/bsp/csg/csg_arguments.h>
#include <trisect/bsp/csg/csg_kind.h>
#include <trisect/bsp/csg/csg_tree.h>

namespace trisect::detail {

/// The tree must outlive it.
class CsgProgram {
public:
    /// \throw CsgError (Unsupported) for a node that counts and is not known
    explicit CsgProgram(const CsgTree& tree);

    [[nodiscard]] const CsgNode& node(std::uint32_t n) const { return tree_.nodes[n]; }
    [[nodiscard]] std::size_t node_count() const { return tree_.nodes.size(); }
    /// Nodes that count, parents first.
    [[nodiscard]] std::vector<std::uint32_t> used_nodes() const { return used_below(roots_); }
    [[nodiscard]] CsgKind kind(std::uint32_t n) const { return csg_kind(node(n).name); }
    [[nodiscard]] CsgArguments arguments(std::uint32_t n) const { return {tree_, node(n)}; }
    /// FILE:LINE:COLUMN: NAME
    [[nodiscard]] std::string place(std::uint32_t n) const;

    /// That of the program's file.
    [[nodiscard]] std::filesystem::path folder() const {
        return std::filesystem::path(tree_.file).parent_path();
    }

    /// "!" makes its node the whole program, without what is around it.
    [[nodiscard]] const std::vector<std::uint32_t>& roots() const { return roots_; }
    /// 2 or 3; that of the first child that has one; 0 when nothing is there.
    [[nodiscard]] int dimension(std::uint32_t n) const { return dimensions_[n]; }
    [[nodiscard]] int dimension() const { return dimension_of(roots_); }
    /// Nodes that are not left out by a modifier.
    [[nodiscard]] std::vector<std::uint32_t> used(const std::vector<std::uint32_t>& nodes) const;
    [[nodiscard]] std::vector<std::uint32_t> used_children(std::uint32_t n) const {
        return used(node(n).children);
    }

private:
    [[nodiscard]] bool is_used(std::uint32_t n) const {
        return !node(n).modifiers.disabled && !node(n).modifiers.background;
    }
    [[nodiscard]] std::vector<std::uint32_t> used_below(std::vector<std::uint32_t> pending) const;
    [[nodiscard]] std::vector<std::uint32_t> chosen_roots() const;
    [[nodiscard]] int dimension_of(const std::vector<std::uint32_t>& children) const;
    void refuse_unknown() const;
    void find_dimensions();

    const CsgTree& tree_;
    std::vector<std::uint32_t> roots_;
    std::vector<int> dimensions_;
};

}  // namespace trisect::detail
