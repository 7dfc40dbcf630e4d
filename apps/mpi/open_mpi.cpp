// SPDX-License-Identifier: Apache-2.0
#include "open_mpi.h"

#include <mpi.h>

#include <charconv>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

namespace trisect::app {
namespace {

// Where all ranks are on one machine, messages go through its memory. To look for networks takes
// Open MPI longer than anything else at the start. Only networks need to know of memory that is
// given back, for which Open MPI changes the code of munmap() and others, while threads may be in
// it. What the user has set stays.
void look_for_no_network() {
    if (!place_before_mpi()) return;
    ::setenv("OMPI_MCA_pml", "ob1", 0);
    ::setenv("OMPI_MCA_memory", "^patcher", 0);
}

std::optional<int> number_of(const char* name) {
    const char* text = std::getenv(name);
    int out = 0;
    if (text == nullptr) return std::nullopt;
    const char* const end = text + std::string_view(text).size();
    const auto [at, error] = std::from_chars(text, end, out);
    if (error != std::errc() || at != end || out < 0) return std::nullopt;
    return out;
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

std::optional<RankPlace> place_before_mpi() {
    const auto rank = number_of("OMPI_COMM_WORLD_RANK");
    const auto all = number_of("OMPI_COMM_WORLD_SIZE");
    if (!rank || !all || *rank >= *all || all != number_of("OMPI_COMM_WORLD_LOCAL_SIZE"))
        return std::nullopt;
    return RankPlace{*rank, *all};
}

bool has_begun_mpi() {
    int has_begun = 0;
    MPI_Initialized(&has_begun);
    return has_begun != 0;
}

void begin_mpi() {
    if (has_begun_mpi()) return;
    look_for_no_network();
    look_for_no_graphics();
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    send_at_once();
}

}  // namespace trisect::app
