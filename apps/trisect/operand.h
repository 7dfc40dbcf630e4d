// SPDX-License-Identifier: Apache-2.0
//
// Operand: an input of a boolean, as a solid with its report.
#pragma once

#include <trisect/brep/io/model.h>
#include <trisect/bsp/solid.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "outcome.h"
#include "session.h"

namespace trisect::app {

struct Operand {
    Solid solid;
    Json facts;  ///< file, faces, triangles, lattice, what import changed
    /// With OperandOptions::properties: of a mesh file one part, whose faces the solid's names are.
    std::shared_ptr<Model> model = nullptr;
};

/// Reads and imports all inputs. The first one that bounds no solid ends the command.
/// \throw OperandError (InvalidSolid) for a boundary that is open or inside out.
[[nodiscard]] std::vector<Operand> read_operands(Session& session,
                                                 std::span<const std::string> names,
                                                 const OperandOptions& options);

/// Without self-intersection, under the limits of the command line.
[[nodiscard]] Solid resolved(const Session& session, const Solid& solid,
                             const OperandOptions& options);

/// "self-intersections resolved" or "assumed free of self-intersection".
[[nodiscard]] std::string embedding_text(const OperandOptions& options);

}  // namespace trisect::app
