// SPDX-License-Identifier: Apache-2.0
#include "queried_set.h"

#include <algorithm>

#include "choice.h"
#include "commands.h"
#include "formula.h"
#include "mesh_files.h"

namespace trisect::app {

std::optional<std::size_t> QueriedSet::operand_number(std::uint32_t source) const {
    const auto found = std::find_if(operands.begin(), operands.end(), [&](const Operand& operand) {
        return operand.solid.source_id() == source;
    });
    if (found == operands.end()) return std::nullopt;
    return static_cast<std::size_t>(found - operands.begin());
}

void add_query_options(CLI::App& command, QueryOptions& options) {
    command.add_option("A", options.inputs, "mesh files; several are combined by --op")
        ->required()
        ->expected(1, 1 << 20);
    add_word_option(command, "--op", options.operation,
                    {"union", "intersection", "difference", "xor"},
                    "how several inputs are combined");
    add_operand_options(command, options.operands);
}

QueriedSet read_set(Session& session, const QueryOptions& options) {
    QueriedSet set;
    set.operands = session.stage(
        "read", [&] { return read_operands(session, options.inputs, options.operands); });
    if (set.operands.size() == 1 && options.operands.assume_embedded) {
        set.solid = set.operands.front().solid;
        return set;
    }
    const EvaluateOptions evaluation = session.evaluation_options(options.operands);
    set.solid = session.interruptible_stage(
        "evaluate", [&] { return evaluate(formula(options.operation, set.operands), evaluation); });
    return set;
}

void describe_inputs(const QueryOptions& options, const QueriedSet& set, Json& document) {
    document["inputs"] = Json::array();
    for (const Operand& operand : set.operands) document["inputs"].push_back(operand.facts);
    document["op"] = set.operands.size() == 1 ? Json() : Json(options.operation);
    document["embedding"] = options.operands.assume_embedded ? "assumed" : "checked";
}

std::vector<Point3d> corners_of(const Solid& solid) { return solid.to_mesh().points; }

std::optional<Bounds> bounds_of(const std::vector<Point3d>& points) {
    if (points.empty()) return std::nullopt;
    Bounds bounds{points.front(), points.front()};
    for (const Point3d& point : points) {
        for (std::size_t k = 0; k < 3; ++k) {
            bounds.lo[k] = std::min(bounds.lo[k], point[k]);
            bounds.hi[k] = std::max(bounds.hi[k], point[k]);
        }
    }
    return bounds;
}

}  // namespace trisect::app
