// SPDX-License-Identifier: Apache-2.0
//
// CsgArguments: the arguments of one node by name, with their types checked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <trisect/bsp/csg/csg_tree.h>

namespace trisect::detail {

class CsgArguments {
public:
    CsgArguments(const CsgTree& tree, const CsgNode& node) : tree_(tree), node_(node) {}

    /// Null when it is not there or undef.
    [[nodiscard]] const CsgValue* find(std::string_view name) const;
    /// \throw CsgError (Input) when it is there and no finite number
    [[nodiscard]] double number(std::string_view name, double otherwise) const;
    /// Half of the diameter where there is one. \throw as number() does
    [[nodiscard]] double radius(std::string_view name, std::string_view diameter,
                                double otherwise) const;
    [[nodiscard]] bool truth(std::string_view name, bool otherwise) const;
    [[nodiscard]] std::string text(std::string_view name, std::string_view otherwise) const;
    /// As many truth values; one stands for all of them, and numbers but 0 are true.
    [[nodiscard]] std::vector<bool> truths(std::string_view name, std::size_t count) const;
    /// As many numbers; one number stands for all of them.
    [[nodiscard]] std::vector<double> numbers(std::string_view name, std::size_t count,
                                              double otherwise) const;

    /// \throw CsgError (Input) unless it is a finite number
    [[nodiscard]] double number(const CsgValue& value) const;
    /// A list of at least so many finite numbers.
    [[nodiscard]] std::vector<double> numbers(const CsgValue& value, std::size_t count) const;
    [[nodiscard]] const CsgValue::List& list(const CsgValue& value) const;
    /// Lists of indices below `limit`.
    [[nodiscard]] std::vector<std::vector<std::uint32_t>> index_lists(const CsgValue& value,
                                                                      std::size_t limit) const;
    [[noreturn]] void fail(ErrorCode code, CsgPlace place, const std::string& message) const;
    [[noreturn]] void fail(ErrorCode code, const std::string& message) const {
        fail(code, node_.place, message);
    }

private:
    const CsgTree& tree_;
    const CsgNode& node_;
};

}  // namespace trisect::detail
