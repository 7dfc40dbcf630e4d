// SPDX-License-Identifier: Apache-2.0
//
// QueriedSet: the set of a query command, one mesh or several combined.
#pragma once

#include <trisect/brep/measure.h>
#include <trisect/bsp/solid.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <vector>

#include "operand.h"
#include "options.h"
#include "session.h"

namespace trisect::app {

struct QueriedSet {
    Solid solid;
    std::vector<Operand> operands;

    /// Which operand brought a face, by FaceSource::operand; nothing for faces of half-spaces.
    [[nodiscard]] std::optional<std::size_t> operand_number(std::uint32_t source) const;
};

/// A, MORE, --op, and the options of operands.
void add_query_options(CLI::App& command, QueryOptions& options);

/// The stages "read" and "evaluate".
[[nodiscard]] QueriedSet read_set(Session& session, const QueryOptions& options);

/// "inputs", "op" and "embedding", as all documents about a set begin.
void describe_inputs(const QueryOptions& options, const QueriedSet& set, Json& document);

/// The corners of the boundary, correctly rounded. Assembles results of booleans.
[[nodiscard]] std::vector<Point3d> corners_of(const Solid& solid);
/// Nothing when there are no points.
[[nodiscard]] std::optional<Bounds> bounds_of(const std::vector<Point3d>& points);

}  // namespace trisect::app
