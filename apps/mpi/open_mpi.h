// SPDX-License-Identifier: Apache-2.0
//
// The start of MPI, without what Open MPI would wait for.
#pragma once

namespace trisect::app {

/// MPI for calls of this thread alone. Which networks there are is left to Open MPI.
void begin_mpi(int argc, char** argv);

}  // namespace trisect::app
