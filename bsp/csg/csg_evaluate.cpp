// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_evaluate.h>

#include <trisect/bsp/csg/csg_evaluator.h>
#include <trisect/bsp/csg/csg_kept.h>
#include <trisect/bsp/csg/csg_program.h>

namespace trisect {

Solid evaluate_csg(const CsgTree& tree, const CsgOptions& options, CsgReport* report) {
    CsgReport own;
    CsgReport& out = report == nullptr ? own : *report;
    out = CsgReport();
    out.nodes = tree.nodes.size();
    const detail::CsgProgram program(tree);
    out.is_flat = program.dimension() == 2;
    detail::CsgKept kept;
    Solid solid = detail::CsgEvaluator(program, options, out, kept).run();
    out.colors = kept.colors();
    out.color_of_source = kept.color_of_source();
    return solid;
}

}  // namespace trisect
