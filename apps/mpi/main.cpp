// SPDX-License-Identifier: Apache-2.0
//
// trisect-mpi: sub-commands of trisect on many processes. The first speaks for all.
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <trisect/kernel/error.h>

#include "launcher_watch.h"
#include "open_mpi.h"
#include "rank_clash_command.h"
#include "rank_slab_command.h"
#include "ranks.h"
#include "trisect/command_line.h"

namespace {

// As many processes as processors are usual, so each has one thread unless it is told otherwise.
std::vector<std::string> arguments_of(int argc, char** argv, bool is_first) {
    std::vector<std::string> out(argv, argv + argc);
    bool has_threads = false;
    for (const std::string_view a : out) has_threads |= a.starts_with("--threads");
    if (!has_threads) out.insert(out.begin() + 1, {"--threads", "1"});
    if (!is_first) out.insert(out.begin() + 1, "--quiet");
    return out;
}

// What goes wrong on another process is told to the first one.
void be_silent() {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
}

// A process whose mpirun was killed would go on beside the run that takes its place.
void end_with_parent() {
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

// A Supervisor fetches these. MPI has threads, too, which would let them end the process.
void keep_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
    end_with_parent();
    trisect::app::LauncherWatch launcher;
    keep_signals();
    // Clashes are looked for before MPI is needed.
    const auto place = trisect::app::place_before_mpi();
    const bool is_clash = std::find(argv, argv + argc, std::string_view("clash")) != argv + argc;
    if (!place || !is_clash) trisect::app::begin_mpi();
    const bool is_first = (place ? place->rank : trisect::app::Ranks::rank()) == 0;
    std::vector<std::string> arguments = arguments_of(argc, argv, is_first);
    if (!is_first) be_silent();
    std::vector<char*> pointers;
    for (std::string& a : arguments) pointers.push_back(a.data());
    pointers.push_back(nullptr);

    auto clash = std::make_unique<trisect::app::RankClashCommand>();
    const trisect::app::RankClashCommand& command = *clash;
    trisect::app::SubCommands commands;
    commands.push_back(std::move(clash));
    auto slabs = std::make_unique<trisect::app::RankSlabCommand>();
    const trisect::app::RankSlabCommand& booleans = *slabs;
    commands.push_back(std::move(slabs));
    const int code =
        trisect::app::run(static_cast<int>(arguments.size()), pointers.data(), commands);
    if (command.is_open() || booleans.is_open()) {
        // The others cannot end by themselves. The first may still be writing what was found.
        if (!is_first) std::this_thread::sleep_for(std::chrono::seconds(2));
        MPI_Abort(MPI_COMM_WORLD, code);
    }
    if (trisect::app::has_begun_mpi()) MPI_Finalize();
    launcher.end();
    return is_first ? code : 0;
}
