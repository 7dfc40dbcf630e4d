// SPDX-License-Identifier: Apache-2.0
//
// The start of MPI, without what Open MPI would wait for.
#pragma once

#include <optional>

namespace trisect::app {

struct RankPlace {
    int rank = 0;
    int count = 1;
};

/// What mpirun says of this process where all ranks are on one machine: MPI may then begin later,
/// beside other threads. Nothing elsewhere.
[[nodiscard]] std::optional<RankPlace> place_before_mpi();
[[nodiscard]] bool has_begun_mpi();

/// MPI for calls of this thread alone, unless it has begun. Which networks there are is left to
/// Open MPI.
void begin_mpi();

}  // namespace trisect::app
