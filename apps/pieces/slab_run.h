// SPDX-License-Identifier: Apache-2.0
//
// SlabRun: a boolean of operands larger than memory, slab by slab.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <trisect/bsp/expression.h>

#include "folder_lock.h"
#include "piece_join.h"
#include "slab_plan.h"

namespace trisect::app {

/// The steps of one job, for one process or many that see one folder.
///
///   1. begin() and gather() once; then, where no plan was taken over, survey() every share, and
///      decide() once: one pass over the operands decides the walls.
///   2. distribute() every share: a second pass writes the triangles near each slab.
///   3. evaluate() every slab, in any order: it becomes a piece.
///   4. joining() makes one mesh of all pieces, in steps of its own.
///
/// Pieces depend on the plan alone, whoever makes them, and the mesh on the pieces.
class SlabRun {
public:
    explicit SlabRun(SlabOptions options);

    /// Makes the folder, or takes over the plan of a run that was interrupted, if wanted. Waits
    /// for what is left of that run.
    /// \throw Error (Usage) where the folder is another one's; (Input) where a run is at work there
    void begin();
    /// In the other processes of the run, once one of them has begun.
    void join_folder();
    [[nodiscard]] bool has_plan() const;
    /// Operands that cannot be read in pieces, unless they were gathered already.
    void gather() const;
    void survey(std::size_t share, std::size_t shares) const;
    void decide(std::size_t shares);
    /// The steps until here, in one process.
    void plan();
    /// The plan that another process made.
    void take_plan();
    [[nodiscard]] const SlabPlan& current_plan() const { return plan_; }
    [[nodiscard]] std::size_t count() const { return plan_.slabs.count(); }
    /// Slabs by their load, the largest first.
    [[nodiscard]] std::vector<std::size_t> order() const;

    /// Whether triangles were distributed already, in how many shares.
    [[nodiscard]] std::size_t distributed() const;
    /// False where a corner is on a wall: then move_walls() and begin again.
    [[nodiscard]] bool distribute(std::size_t share, std::size_t shares);
    void move_walls();
    void note_distributed(std::size_t shares);

    [[nodiscard]] bool is_done(std::size_t slab) const;
    /// \throw Error of the operation; the slab is named
    void evaluate(std::size_t slab, std::size_t shares, const EvaluateOptions& options);

    [[nodiscard]] PieceJoin joining() const;
    /// All steps of it, in one process.
    JoinedMesh join() const;
    /// Removes the folder, which only has files of this job, if begin() had it.
    void clean() const;

private:
    void begin_anew();
    [[nodiscard]] std::string path(const char* kind, std::size_t slab) const;
    [[nodiscard]] std::string scratch(std::size_t slab, std::size_t operand,
                                      std::size_t share) const;
    [[nodiscard]] Solid operand_in(std::size_t slab, std::size_t operand, std::size_t shares) const;
    [[nodiscard]] Expression formula_of(const std::vector<Solid>& operands) const;

    SlabOptions options_;
    std::string job_;
    SlabPlan plan_;
    FolderLock lock_;
};

}  // namespace trisect::app
