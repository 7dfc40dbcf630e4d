// SPDX-License-Identifier: Apache-2.0
#include "limits.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <exception>

#include <sys/resource.h>
#include <unistd.h>

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

}  // namespace

struct Limits::Threads {
    explicit Threads(int n)
        : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n)) {}
    tbb::global_control control;
};

Limits::Limits(const CommonOptions& options) {
    if (options.threads > 0) threads_ = std::make_unique<Threads>(options.threads);
    if (options.max_memory == 0) return;
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
