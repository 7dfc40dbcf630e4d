// SPDX-License-Identifier: Apache-2.0
#include "limits.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/thread_pool.h>

#include "failure.h"

namespace trisect::app {
namespace {

Console* last_console = nullptr;
bool last_json = false;

[[noreturn]] void on_terminate() {
    Failure failure{static_cast<int>(ErrorCode::Internal), "internal error: terminated", {}, {}};
    if (std::current_exception() != nullptr) failure = current_failure();
    if (last_console->claim_end()) report_failure(*last_console, last_json, failure);
    ::_exit(failure.code);
}

/// Bytes of data that this process has mapped, or 0 where the system does not say.
std::uint64_t mapped_data() {
    std::ifstream statm("/proc/self/statm");
    std::uint64_t pages = 0;
    for (int field = 0; field < 6; ++field) statm >> pages;
    return statm ? pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

/// How many of `threads` there are under a memory limit: their stacks are data too, and may take a
/// quarter of what is left.
std::size_t affordable_threads(std::size_t threads, std::uint64_t max_memory) {
    const std::uint64_t used = mapped_data();
    const std::uint64_t left = max_memory > used ? max_memory - used : 0;
    const std::uint64_t stack = detail::stack_of_a_thread();
    return std::min<std::uint64_t>(threads, 1 + left / (4 * std::max<std::uint64_t>(stack, 1)));
}

/// Large blocks that were freed are used again: making new pages ready takes longer than most work
/// that is done in them.
void keep_freed_blocks() {
#ifdef __GLIBC__
    constexpr int largest = 32 << 20;
    (void)::mallopt(M_MMAP_THRESHOLD, largest);
    (void)::mallopt(M_TRIM_THRESHOLD, 4 * largest);
#endif
}

/// Starts all threads that may work later. oneTBB starts them when there is work, also from its own
/// threads, where a failure would end the process.
void start_threads(std::size_t count) {
    if (count < 2 || !detail::has_threads) return;
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
    std::atomic<std::size_t> here{0};
    const auto wait_for_all = [&] {
        ++here;
        while (here < count && std::chrono::steady_clock::now() < give_up)
            std::this_thread::yield();
    };
    detail::TaskGroup group;
    for (std::size_t i = 1; i < count; ++i) group.run(wait_for_all);
    wait_for_all();
    group.wait();
}

}  // namespace

struct Limits::Threads {
    explicit Threads(std::size_t n) : limit(n) {}
    detail::ThreadLimit limit;
};

Limits::Limits(const CommonOptions& options) {
    std::size_t threads = options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                              : detail::threads_of_machine();
    if (options.max_memory != 0) threads = affordable_threads(threads, options.max_memory);
    if (options.threads > 0 || options.max_memory != 0)
        threads_ = std::make_unique<Threads>(threads);
    if (options.max_memory == 0) {
        keep_freed_blocks();
        return;
    }
    start_threads(threads);
    rlimit limit{};
    if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
    previous_ = limit.rlim_cur;
    limit.rlim_cur = std::min({limit.rlim_cur, limit.rlim_max, rlim_t{options.max_memory}});
    is_set_ = ::setrlimit(RLIMIT_DATA, &limit) == 0;
    if (!is_set_) throw UnsupportedError("--max-memory: the system refuses to set a limit");
}

Limits::~Limits() {
    if (!is_set_) return;
    rlimit limit{};
    if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
    limit.rlim_cur = previous_;
    (void)::setrlimit(RLIMIT_DATA, &limit);
}

void install_terminate_handler(Console& console, bool json) {
    last_console = &console;
    last_json = json;
    std::set_terminate(on_terminate);
}

}  // namespace trisect::app
