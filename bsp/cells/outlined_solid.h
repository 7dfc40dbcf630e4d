// SPDX-License-Identifier: Apache-2.0
//
// OutlinedSolid: a lazy result with a boundary and no tree yet.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/cells/residual.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect::detail {

/// Facets of a mesh that bound a result as they are.
struct UncrossedFacets {
    const Source* source = nullptr;
    bool flipped = false;
    std::vector<std::uint32_t> facets;  ///< ascending
};

/// What belongs to a SolidState whose tree is one leaf that lists whole facets only: the rest of
/// the boundary. With `crossings` in that state, these are of all facets that are not whole. Enough
/// for to_mesh(), and for to_brep() unless faces need names of their own; all else takes cut().
/// Immutable, safe to use from any thread.
class OutlinedSolid {
public:
    /// `solids` are the slots of the formula, on one lattice.
    OutlinedSolid(NamedOutlines outlines, Residual::Ref formula,
                  std::vector<std::shared_ptr<const SolidState>> solids,
                  const EvaluateOptions& options);
    OutlinedSolid(std::vector<UncrossedFacets> uncrossed, Residual::Ref formula,
                  std::vector<std::shared_ptr<const SolidState>> solids,
                  const EvaluateOptions& options);

    [[nodiscard]] const NamedOutlines& outlines() const { return outlines_; }
    /// Of each operand; the tree has none of them.
    [[nodiscard]] std::span<const UncrossedFacets> uncrossed() const { return uncrossed_; }
    /// The same set with a tree as evaluate_formula() makes it, on first use. Other callers wait
    /// meanwhile. \throw CancelledError by the StopScope of the thread that cuts; nothing is kept
    /// then
    [[nodiscard]] const std::shared_ptr<const SolidState>& cut() const;
    [[nodiscard]] bool is_cut() const;

private:
    NamedOutlines outlines_;
    std::vector<UncrossedFacets> uncrossed_;
    Residual::Ref formula_;
    std::vector<std::shared_ptr<const SolidState>> solids_;
    EvaluateOptions options_;
    mutable std::mutex cutting_;
    mutable std::shared_ptr<const SolidState> cut_;
};

/// For all users but those that only write triangles.
[[nodiscard]] inline const std::shared_ptr<const SolidState>& cut_state(const Solid& solid) {
    const auto& state = solid.state();
    return state->outlined != nullptr ? state->outlined->cut() : state;
}

/// SolidState::far_out of the value of a formula over these.
[[nodiscard]] std::int8_t far_out_of(const Residual& formula,
                                     std::span<const std::shared_ptr<const SolidState>> solids);

/// The value of a formula over so many prisms along one axis that they are too large for a leaf;
/// null for all others, and where work or memory is limited.
[[nodiscard]] std::shared_ptr<const SolidState> outline_prisms(
    const Residual::Ref& formula, const std::vector<std::shared_ptr<const SolidState>>& solids,
    const EvaluateOptions& options, EvaluateStats& stats);

}  // namespace trisect::detail
