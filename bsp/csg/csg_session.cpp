// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_session.h>

#include <trisect/bsp/csg/csg_evaluator.h>
#include <trisect/bsp/csg/csg_kept.h>
#include <trisect/bsp/csg/csg_program.h>

namespace trisect {

struct CsgSession::Kept {
    detail::CsgKept made{true};
    EditedFormula formula;

    explicit Kept(const EvaluateOptions& options) : formula(options) {}
};

CsgSession::CsgSession(const CsgOptions& options)
    : options_(options), kept_(std::make_unique<Kept>(options.evaluate)) {}
CsgSession::CsgSession(CsgSession&&) noexcept = default;
CsgSession& CsgSession::operator=(CsgSession&&) noexcept = default;
CsgSession::~CsgSession() = default;

Solid CsgSession::evaluate(const CsgTree& tree, CsgReport* report, ChangeReport* change) {
    CsgReport own;
    CsgReport& out = report == nullptr ? own : *report;
    out = CsgReport();
    out.nodes = tree.nodes.size();
    const detail::CsgProgram program(tree);
    out.is_flat = program.dimension() == 2;
    kept_->made.begin();
    const Expression formula = detail::CsgEvaluator(program, options_, out, kept_->made).formula();
    ++out.evaluations;
    out.colors = kept_->made.colors();
    out.color_of_source = kept_->made.color_of_source();
    return kept_->formula.evaluate(formula, change);
}

bool CsgSession::have_files_changed() const { return kept_->made.have_files_changed(); }

}  // namespace trisect
