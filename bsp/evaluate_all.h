// SPDX-License-Identifier: Apache-2.0
//
// evaluate_all: several formulas over the same solids, evaluated together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// What evaluate_all() and split() did, on the calling thread (kernel/diagnostics.h).
struct EvaluateAllCounters {
    std::uint64_t results = 0;  ///< solids that were returned
    /// Times that operands were compared or gone through from the beginning. As many as results
    /// where nothing was shared.
    std::uint64_t evaluations = 0;

    EvaluateAllCounters& operator+=(const EvaluateAllCounters& o) {
        results += o.results;
        evaluations += o.evaluations;
        return *this;
    }
    EvaluateAllCounters& operator-=(const EvaluateAllCounters& o) {
        results -= o.results;
        evaluations -= o.evaluations;
        return *this;
    }
    friend bool operator==(const EvaluateAllCounters&, const EvaluateAllCounters&) = default;
};

/// The sets that the formulas describe, in their order: each the one that evaluate() makes of its
/// formula, with the same names of faces and the same mesh.
///
/// Formulas that name the same two meshes in the same order (`a & b`, `a - b`, `~a & b`, `a | b`)
/// share one comparison of these, which is most of an evaluation; meshes as they were imported, of
/// 16 facets or more, without an index. Where some of them touch, or have parts of planes in
/// common, formulas share it if the first one's infinitesimal move of the second mesh serves the
/// others, and else the search for facets that come near. All other formulas are evaluated one by
/// one; EvaluateAllCounters has how many that were. Costs no more than evaluating one by one.
///
/// `reports`, if not null, has one report for each formula; those that share an evaluation have the
/// same one. \throw as evaluate()
[[nodiscard]] std::vector<Solid> evaluate_all(std::span<const Expression> formulas,
                                              const EvaluateOptions& options = {},
                                              std::vector<EvaluateReport>* reports = nullptr);

}  // namespace trisect
