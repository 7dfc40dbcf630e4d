// SPDX-License-Identifier: Apache-2.0
//
// CsgNodeProgress: the node that is evaluated, and how many are done.
#pragma once

#include <cstdint>
#include <vector>

#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/csg/csg_program.h>

namespace trisect::detail {

/// The program and the options must outlive it. O(nodes) in all.
class CsgNodeProgress {
public:
    CsgNodeProgress(const CsgProgram& program, const CsgOptions& options);

    /// A node, as long as it lives; then it is done, with all below it.
    class Scope {
    public:
        Scope(CsgNodeProgress& progress, std::uint32_t n) : progress_(progress) {
            progress_.enter(n);
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        ~Scope() { progress_.leave(); }

    private:
        CsgNodeProgress& progress_;
    };

    /// What is left is the formula of the whole program.
    void begin_formula();

private:
    void enter(std::uint32_t n);
    void leave();
    void finish(std::uint32_t n);
    void say() const;

    const CsgProgram& program_;
    const CsgOptions& options_;
    std::vector<std::uint32_t> open_;  // from the root down
    std::vector<bool> is_done_;
    std::size_t done_ = 0;
    std::size_t count_ = 0;
};

}  // namespace trisect::detail
