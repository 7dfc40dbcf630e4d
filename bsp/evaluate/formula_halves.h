// SPDX-License-Identifier: Apache-2.0
//
// Halves of a formula that are evaluated one after the other.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/bsp/cells/residual.h>

namespace trisect::detail {

/// A formula is `kind` of two terms, or the complement of that. No slot is in both terms, and of
/// the slots each has about half.
struct FormulaHalves {
    Residual::Kind kind = Residual::Kind::And;
    bool negated = false;
    std::array<Residual::Ref, 2> terms;

    /// The formula over two slots that stand for the terms.
    [[nodiscard]] Residual::Ref joined(std::int32_t first, std::int32_t second) const;
};

/// Nothing for a slot or a constant, and where every choice has slots in both halves. Terms keep
/// their order, so that of coincident facets the same one represents both.
[[nodiscard]] std::optional<FormulaHalves> halves_of(const Residual& formula);

}  // namespace trisect::detail
