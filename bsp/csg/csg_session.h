// SPDX-License-Identifier: Apache-2.0
//
// CsgSession: a program that is evaluated again after each edit.
#pragma once

#include <memory>

#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/csg/csg_tree.h>
#include <trisect/bsp/edited_formula.h>
#include <trisect/bsp/solid.h>

namespace trisect {

/// Keeps shapes, groups and the last set. Of the next program only shapes whose text is new are
/// made, and the formula is evaluated where these, and those that are gone, lie (EditedFormula). A
/// file that import() or surface() reads is looked at again when its time or size changed.
/// Not to be used by several threads at once.
class CsgSession {
public:
    explicit CsgSession(const CsgOptions& options = {});
    CsgSession(CsgSession&&) noexcept;
    CsgSession& operator=(CsgSession&&) noexcept;
    ~CsgSession();

    /// The set of evaluate_csg(). Remarks are those of nodes that were made anew. \throw as
    /// evaluate_csg(); then the last set is kept
    Solid evaluate(const CsgTree& tree, CsgReport* report = nullptr,
                   ChangeReport* change = nullptr);
    /// Whether a file that the last program read has changed since.
    [[nodiscard]] bool have_files_changed() const;

private:
    struct Kept;
    CsgOptions options_;
    std::unique_ptr<Kept> kept_;
};

}  // namespace trisect
