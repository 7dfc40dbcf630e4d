// SPDX-License-Identifier: Apache-2.0
//
// Expression: a boolean formula over solids, evaluated lazily.
// Nothing is computed before evaluate(), which works on the whole formula in one pass, without
// intermediate solids.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/solid.h>

namespace trisect {

namespace detail {
struct ExpressionNode;
struct ExpressionAccess;
}  // namespace detail

/// Immutable value; copying shares. Operators follow set notation:
///   a | b union, a & b intersection, a - b difference, a ^ b symmetric difference, ~a complement.
/// All results are regularised: the closure of the interior. A formula that was moved from is that
/// of the empty set.
class Expression {
public:
    Expression(const Solid& solid);  // NOLINT(google-explicit-constructor): a solid is a formula

    friend Expression operator|(const Expression& a, const Expression& b);
    friend Expression operator&(const Expression& a, const Expression& b);
    friend Expression operator-(const Expression& a, const Expression& b);
    friend Expression operator^(const Expression& a, const Expression& b);
    friend Expression operator~(const Expression& a);

    /// The union, or intersection, of any number of formulas in one node.
    [[nodiscard]] static Expression any_of(std::span<const Expression> terms);
    [[nodiscard]] static Expression all_of(std::span<const Expression> terms);
    [[nodiscard]] static Expression any_of(std::initializer_list<Expression> terms);
    [[nodiscard]] static Expression all_of(std::initializer_list<Expression> terms);
    [[nodiscard]] static Expression any_of(std::span<const Solid> solids);
    [[nodiscard]] static Expression all_of(std::span<const Solid> solids);

private:
    friend struct detail::ExpressionAccess;

    explicit Expression(std::shared_ptr<const detail::ExpressionNode> root)
        : root_(std::move(root)) {}

    std::shared_ptr<const detail::ExpressionNode> root_;  // null: the empty set
};

// Declared for the namespace as well, so that operators on plain solids are found.
[[nodiscard]] Expression operator|(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator&(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator-(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator^(const Expression& a, const Expression& b);
[[nodiscard]] Expression operator~(const Expression& a);

/// How evaluate() works; the set that results never depends on it.
struct EvaluateOptions {
    /// A cell with at most this many polygons is resolved instead of refined; with twice as many
    /// where two meshes are compared without a tree.
    std::uint32_t leaf_polygons = 100;
    /// What counts as inside an operand that overlaps itself several times.
    enum class Winding : std::uint8_t { Positive, NonZero } winding = Winding::Positive;
    /// Threads that may take part; 0 means one for every processor. The result does not depend on
    /// it. Small work, and work that a StopScope limits, is done by the calling thread alone.
    std::uint32_t threads = 0;
    /// What happens to operands on lattices that do not fit together, where one is too large for
    /// the unit of another: round the finer ones to the finest common lattice and report it, or
    /// refuse.
    enum class Lattices : std::uint8_t { Round, Refuse } lattices = Lattices::Round;
};

/// What evaluations did, on all their threads (kernel/diagnostics.h). Not counted are trees of
/// results that are made later, when they are first needed.
struct EvaluateCounters {
    std::uint64_t cells = 0;               ///< visited
    std::uint64_t shared_cells = 0;        ///< one operand left: subtree shared
    std::uint64_t constant_cells = 0;      ///< homogeneous result
    std::uint64_t mixed_leaves = 0;        ///< resolved by a local arrangement
    std::uint64_t grid_leaves = 0;         ///< of them, on a grid of bits: all across axes
    std::uint64_t filtered_leaves = 0;     ///< of them, by doubles alone: in general position
    std::uint64_t filtered_fragments = 0;  ///< fragments of earlier results in those
    std::uint64_t prism_leaves = 0;     ///< of them, by segments in a plane: prisms along one axis
    std::uint64_t exact_leaves = 0;     ///< of them, by integers: all others
    std::uint64_t half_space_cuts = 0;  ///< meshes cut as a whole by parallel half-spaces
    /// Two meshes that meet in corners, edges and faces of both alone, so that none is cut.
    std::uint64_t conforming_pairs = 0;
    std::uint64_t halved_cells = 0;   ///< with many operands all over: half the formula each
    std::uint64_t divided_cells = 0;  ///< by a splitter
    /// Cells in which a mesh that meets itself elsewhere became an embedded operand.
    std::uint64_t embedded_cells = 0;
    std::uint64_t listed_polygons = 0;  ///< sum over all visited cells
    std::uint64_t pairs_boxes = 0;      ///< polygon pairs whose boxes overlap, in mixed leaves
    std::uint64_t pairs_touching = 0;   ///< of them, pairs in contact
    std::uint64_t pairs_cutting = 0;    ///< of those, pairs where one cuts the other
    std::uint64_t doubtful_pairs = 0;   ///< of two large meshes: pairs that a filter left open
    /// Polygons of mixed leaves that nothing is in contact with: they pass through as they are.
    std::uint64_t untouched_polygons = 0;
    std::uint64_t pieces = 0;  ///< convex pieces made in mixed leaves, but for cutting put off
    /// Polygons and pieces with winding numbers from a neighbour.
    std::uint64_t linked = 0;
    std::uint64_t traces = 0;          ///< winding numbers found by a segment trace
    std::uint64_t traces_retried = 0;  ///< degenerate segments
    std::uint64_t traces_near = 0;     ///< that started where an earlier one had ended
    std::uint64_t traces_within = 0;   ///< winding numbers carried over within a polygon
    std::uint64_t cuts_undone = 0;     ///< because nothing differed on their two sides

    EvaluateCounters& operator+=(const EvaluateCounters& o);
    EvaluateCounters& operator-=(const EvaluateCounters& o);
    friend bool operator==(const EvaluateCounters&, const EvaluateCounters&) = default;
};

/// What is to be said about one result.
struct EvaluateReport {
    LatticeReport lattice;     ///< of the result, and what moving the operands to it rounded
    std::uint64_t memory = 0;  ///< most bytes held at once, as StopLimits::max_memory counts them
    int depth = 0;             ///< of the cells
};

/// The set that the formula describes. Exact. Never fails for valid operands.
/// Of two meshes, of many that touch or fill one place, of a mesh between parallel half-spaces, and
/// of prisms along one axis, only what a mesh of the result needs is found out; the first call that
/// needs its cells (a query, another operation) divides space then, which may take longer than this
/// call. Solid::refine() does so ahead. Operands of different lattices are moved to the finest one
/// on which all of them fit. That is exact, except for operands of very different size: see
/// EvaluateOptions::lattices and EvaluateReport::lattice. Counts in EvaluateCounters. What limits
/// and cancels it is the StopScope of the calling thread, looked at for every cell and for every
/// polygon of a leaf. Operands whose trees are made now count as well. \throw LimitError when the
/// operands have no common lattice, the formula nests more than 4096 alternating operations, or the
/// work or memory of the scope is spent; CancelledError. Operands stay as they were.
[[nodiscard]] Solid evaluate(const Expression& expression, const EvaluateOptions& options = {},
                             EvaluateReport* report = nullptr);

}  // namespace trisect
