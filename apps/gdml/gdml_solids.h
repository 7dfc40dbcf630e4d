// SPDX-License-Identifier: Apache-2.0
//
// Solids of GDML: shapes, and booleans of earlier ones.
#pragma once

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "gdml_shape.h"

namespace trisect::app {

/// A solid in steps of 1e-9 mm.
struct GdmlSolid {
    Solid solid;
    double deviation = 0;   ///< of facets from the surface that is meant, in steps
    bool is_round = false;  ///< some of them stand for round surfaces
    std::string failure;    ///< why there is none
    std::optional<ErrorCode> code = std::nullopt;  ///< of the failure
};

class GdmlSolids {
public:
    /// \throw InputError for two solids of one name
    explicit GdmlSolids(const GdmlSource& source);

    [[nodiscard]] std::size_t size() const { return elements_.size(); }
    [[nodiscard]] const std::string& name(std::uint32_t solid) const { return names_[solid]; }
    [[nodiscard]] const GdmlElement& element(std::uint32_t solid) const {
        return *elements_[solid];
    }
    [[nodiscard]] std::optional<std::uint32_t> find(const std::string& name) const;

    /// Those that are wanted, and what they are made of; the others stay empty. A solid that cannot
    /// be made says why, as do those that are made of it. \throw CancelledError
    [[nodiscard]] std::vector<GdmlSolid> make(std::span<const std::uint32_t> wanted,
                                              const EvaluateOptions& options = {}) const;

private:
    struct Operand {
        std::uint32_t solid = 0;
        AffineMap map;
    };

    [[nodiscard]] std::vector<bool> needed(std::span<const std::uint32_t> wanted) const;
    [[nodiscard]] std::vector<Operand> operands(std::uint32_t solid) const;
    [[nodiscard]] Operand operand(std::uint32_t of, const GdmlElement& reference,
                                  const AffineMap& map) const;
    [[nodiscard]] AffineMap placement(const GdmlElement& element, const char* position,
                                      const char* rotation) const;
    [[nodiscard]] GdmlSolid made(std::uint32_t solid, const std::vector<GdmlSolid>& earlier,
                                 const EvaluateOptions& options) const;
    [[nodiscard]] GdmlSolid combined(const GdmlElement& element,
                                     const std::vector<Operand>& operands,
                                     const std::vector<GdmlSolid>& earlier,
                                     const EvaluateOptions& options) const;

    GdmlSource source_;
    std::vector<const GdmlElement*> elements_;
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

}  // namespace trisect::app
