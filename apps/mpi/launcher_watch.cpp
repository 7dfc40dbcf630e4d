// SPDX-License-Identifier: Apache-2.0
#include "launcher_watch.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>

#ifdef __linux__
#include <dirent.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#endif

namespace trisect::app {

bool is_launcher(std::string_view name) {
    constexpr std::array<std::string_view, 6> names{"mpirun", "mpiexec", "orterun",
                                                    "orted",  "prterun", "prted"};
    return std::ranges::find(names, name) != names.end();
}

#ifdef __linux__
namespace {

constexpr int looks = 10;  // one after the other, that find the same
constexpr timespec between_looks{0, 500'000'000};

// Of a process that the descriptor's folder in /proc is of: not of another one that has its number
// later.
std::string text_of(int folder, const char* name) {
    std::string out;
    const int file = ::openat(folder, name, O_RDONLY | O_CLOEXEC);
    if (file < 0) return out;
    std::array<char, 1024> some{};
    const ssize_t n = ::read(file, some.data(), some.size());
    if (n > 0) out.assign(some.data(), static_cast<std::size_t>(n));
    ::close(file);
    return out;
}

struct ProcessState {
    std::string name;
    char state = 'Z';
    pid_t parent = 0;
};

// "123 (name) S 45 ...": a name may have anything.
std::optional<ProcessState> state_of(int folder) {
    const std::string text = text_of(folder, "stat");
    const std::size_t begin = text.find('(');
    const std::size_t end = text.rfind(')');
    if (begin == std::string::npos || end == std::string::npos || text.size() < end + 5)
        return std::nullopt;
    ProcessState out{text.substr(begin + 1, end - begin - 1), text[end + 2], 0};
    std::from_chars(text.data() + end + 4, text.data() + text.size(), out.parent);
    return out;
}

bool has_living_child(pid_t parent) {
    DIR* const all = ::opendir("/proc");
    if (all == nullptr) return true;
    bool found = false;
    while (const dirent* const entry = found ? nullptr : ::readdir(all)) {
        if (entry->d_name[0] < '0' || entry->d_name[0] > '9') continue;
        const int folder = ::openat(::dirfd(all), entry->d_name, O_PATH | O_DIRECTORY | O_CLOEXEC);
        if (folder < 0) continue;
        const auto state = state_of(folder);
        ::close(folder);
        found = state && state->parent == parent && state->state != 'Z';
    }
    ::closedir(all);
    return found;
}

void close_all_but(int kept, int other) {
    const long most = ::sysconf(_SC_OPEN_MAX);
    for (int i = 0; i < std::min(most, 1024L); ++i)
        if (i != kept && i != other) ::close(i);
}

// The rank has nothing open yet that would matter, and no thread.
[[noreturn]] void watch(pid_t launcher, int folder, int from_rank) {
    ::setsid();  // mpirun ends the groups of its ranks
    close_all_but(folder, from_rank);
    char word = 0;
    if (::read(from_rank, &word, 1) == 1) ::_exit(0);
    for (int same = 0; same < looks;) {
        ::nanosleep(&between_looks, nullptr);
        const auto state = state_of(folder);
        if (!state || state->state == 'Z') ::_exit(0);
        const bool waits_for_lock =
            state->state == 'S' && text_of(folder, "wchan").starts_with("futex");
        same = waits_for_lock && !has_living_child(launcher) ? same + 1 : 0;
    }
    ::kill(launcher, SIGKILL);
    ::_exit(0);
}

bool is_first_here() {
    const char* const rank = std::getenv("OMPI_COMM_WORLD_LOCAL_RANK");
    return rank == nullptr || std::string_view(rank) == "0";
}

}  // namespace

LauncherWatch::LauncherWatch() {
    const pid_t launcher = ::getppid();
    if (launcher <= 1 || !is_first_here()) return;
    const int folder =
        ::open(("/proc/" + std::to_string(launcher)).c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    const auto state = state_of(folder);
    std::array<int, 2> ends{-1, -1};
    if (state && is_launcher(state->name) && ::pipe2(ends.data(), O_CLOEXEC) == 0) {
        process_ = ::fork();
        if (process_ == 0) {
            ::close(ends[1]);
            watch(launcher, folder, ends[0]);
        }
        ::close(ends[0]);
        pipe_ = ends[1];
    }
    ::close(folder);
}

void LauncherWatch::end() {
    if (process_ < 0) return;
    const char word = 'e';
    (void)!::write(pipe_, &word, 1);
    ::close(pipe_);
    (void)::waitpid(process_, nullptr, 0);
    process_ = -1;
}
#else
LauncherWatch::LauncherWatch() = default;
void LauncherWatch::end() {}
#endif

}  // namespace trisect::app
