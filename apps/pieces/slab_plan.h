// SPDX-License-Identifier: Apache-2.0
//
// SlabPlan: the division of space for one boolean, and its job.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <trisect/bsp/solid.h>

#include "slabs.h"
#include "survey.h"
#include "triangle_stream.h"

namespace trisect::app {

struct SlabOptions {
    std::string operation;  ///< union, intersection or difference
    std::vector<std::string> inputs;
    std::string output;
    std::string folder;        ///< for scratch files; it must not be there, or be of this job
    std::uint64_t memory = 0;  ///< bytes of a process; 0: as much as there is for one slab
    std::uint64_t slabs = 0;   ///< at least so many
    Embedding embedding = Embedding::Check;
    bool resume = false;
    std::string natives;  ///< a folder for native files of all slabs; empty: none
};

[[nodiscard]] bool is_slab_operation(const std::string& operation);
/// Whether files that can be read in pieces are too large for the memory.
[[nodiscard]] bool needs_slabs(const SlabOptions& options);

/// What is decided once.
struct SlabPlan {
    Slabs slabs;
    std::vector<std::uint64_t> triangles;  ///< of the operands
};

/// Which job a plan is for: the operation and the files, as they are on the disk now.
/// \throw Error (Input) where a file is missing
[[nodiscard]] std::string job_of(const SlabOptions& options);

/// Where the corners of an operand are that cannot be read in pieces.
[[nodiscard]] std::string gathered_name(const SlabOptions& options, std::size_t operand);
/// Of its own file, or of the gathered one if there is one.
[[nodiscard]] std::unique_ptr<TriangleStream> open_operand(const SlabOptions& options,
                                                           std::size_t operand);

/// One pass over a share of every operand.
/// \throw InputError, UnsupportedError; Error (InvalidSolid) for coordinates that are not finite
[[nodiscard]] std::vector<Survey> survey_share(const SlabOptions& options, std::size_t share,
                                               std::size_t shares);
/// \param surveys of all shares
/// \throw LimitError; Error (InvalidSolid) for an operand inside out
[[nodiscard]] SlabPlan make_plan(const SlabOptions& options, const std::vector<Survey>& surveys);

void write_plan(const std::string& name, const SlabPlan& plan, const std::string& job);
/// Nothing where there is none for this job.
[[nodiscard]] std::optional<SlabPlan> read_plan(const std::string& name, const std::string& job);

}  // namespace trisect::app
