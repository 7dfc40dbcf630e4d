// SPDX-License-Identifier: Apache-2.0
#include "open_mpi.h"

#include <mpi.h>

#include <cstdlib>
#include <string_view>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

namespace trisect::app {
namespace {

// Where all ranks are on one machine, messages go through its memory. To look for networks takes
// Open MPI longer than anything else at the start. What the user has set stays.
void look_for_no_network() {
    const char* all = std::getenv("OMPI_COMM_WORLD_SIZE");
    const char* here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
    if (all == nullptr || here == nullptr || std::string_view(all) != here) return;
    ::setenv("OMPI_MCA_pml", "ob1", 0);
}

// hwloc, by which Open MPI learns where it is, would ask ten X servers for graphics cards.
void look_for_no_graphics() {
    ::setenv("HWLOC_COMPONENTS", "-gl,-opencl,-cuda,-nvml,-rsmi,-levelzero", 0);
}

// The last messages to mpirun are short. The system would keep one back until the one before is
// acknowledged, 40 ms later.
void send_at_once() {
    constexpr int most_descriptors = 256;  // MPI has some twenty
    for (int descriptor = STDERR_FILENO + 1; descriptor < most_descriptors; ++descriptor) {
        sockaddr_storage peer{};
        socklen_t size = sizeof peer;
        if (::getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) != 0 ||
            (peer.ss_family != AF_INET && peer.ss_family != AF_INET6))
            continue;
        const int yes = 1;
        (void)::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    }
}

}  // namespace

void begin_mpi(int argc, char** argv) {
    look_for_no_network();
    look_for_no_graphics();
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    send_at_once();
}

}  // namespace trisect::app
