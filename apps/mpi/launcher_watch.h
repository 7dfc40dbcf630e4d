// SPDX-License-Identifier: Apache-2.0
//
// LauncherWatch: ends an mpirun that waits for itself.
#pragma once

#include <string_view>

#include <sys/types.h>

namespace trisect::app {

/// Where a rank is killed while MPI begins, mpirun (Open MPI 4.1.4 with PMIx 4.2.2) may end all
/// ranks and then wait for ever, in PMIx_server_finalize, for a lock that a thread held which is no
/// more. Nobody fetches the ranks then, and whoever waits for mpirun waits, too. No option of Open
/// MPI changes that.
///
/// So one rank of each machine has a process that does nothing until the rank has ended without
/// saying so. If its mpirun then waits for a lock for some seconds, with no process of its own
/// left, it is killed. An mpirun that still writes, waits for other machines, or was stopped does
/// not wait for a lock. Linux only; elsewhere this does nothing.
class LauncherWatch {
public:
    /// \pre no other thread is there
    LauncherWatch();
    LauncherWatch(const LauncherWatch&) = delete;
    LauncherWatch& operator=(const LauncherWatch&) = delete;
    ~LauncherWatch() = default;

    /// This rank ends by itself.
    void end();

private:
    int pipe_ = -1;
    pid_t process_ = -1;
};

/// Programs that start ranks, by the name that the system has of them.
[[nodiscard]] bool is_launcher(std::string_view name);

}  // namespace trisect::app
