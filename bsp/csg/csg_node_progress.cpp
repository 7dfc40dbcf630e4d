// SPDX-License-Identifier: Apache-2.0
#include <trisect/bsp/csg/csg_node_progress.h>

namespace trisect::detail {

CsgNodeProgress::CsgNodeProgress(const CsgProgram& program, const CsgOptions& options)
    : program_(program), options_(options) {
    if (!options_.on_progress) return;
    is_done_.assign(program_.node_count(), false);
    count_ = program_.used_nodes().size();
}

void CsgNodeProgress::say() const {
    const CsgNode* const node = open_.empty() ? nullptr : &program_.node(open_.back());
    options_.on_progress({node, done_, count_});
}

void CsgNodeProgress::enter(std::uint32_t n) {
    if (!options_.on_progress) return;
    open_.push_back(n);
    say();
}

void CsgNodeProgress::leave() {
    if (!options_.on_progress) return;
    finish(open_.back());
    open_.pop_back();
    if (!open_.empty()) say();
}

/// Below what is done all is done already, so that no node is looked at twice.
void CsgNodeProgress::finish(std::uint32_t n) {
    std::vector<std::uint32_t> pending{n};
    while (!pending.empty()) {
        const std::uint32_t at = pending.back();
        pending.pop_back();
        if (is_done_[at]) continue;
        is_done_[at] = true;
        ++done_;
        for (const std::uint32_t c : program_.used_children(at)) pending.push_back(c);
    }
}

void CsgNodeProgress::begin_formula() {
    if (!options_.on_progress) return;
    open_.clear();
    done_ = count_;
    say();
}

}  // namespace trisect::detail
