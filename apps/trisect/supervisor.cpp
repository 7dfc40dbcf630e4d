// SPDX-License-Identifier: Apache-2.0
//
// Signals are blocked everywhere and fetched by one thread (sigtimedwait): that thread may lock,
// allocate and print, none of which a signal handler may do.
#include "supervisor.h"

#include <trisect/brep/io/output_file.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include <pthread.h>
#include <unistd.h>

namespace trisect::app {
namespace {

using namespace std::chrono_literals;

constexpr int wake_signal = SIGUSR1;
constexpr auto progress_delay = 500ms;
constexpr auto progress_interval = 100ms;
constexpr auto patience = 2s;  // between asking and ending

sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int s : {SIGINT, SIGTERM, SIGHUP, wake_signal}) sigaddset(&set, s);
    return set;
}

bool may_draw(const CommonOptions& options) {
    if (options.progress == Progress::None || ::isatty(STDERR_FILENO) == 0) return false;
    if (options.progress == Progress::Bar) return true;
    const char* terminal = std::getenv("TERM");
    return !options.quiet && terminal != nullptr && std::string_view(terminal) != "dumb";
}

bool wants_color() {
    const char* no_color = std::getenv("NO_COLOR");
    return no_color == nullptr || *no_color == '\0';
}

/// The next watched signal, or 0 when the time is over.
int wait_for_signal(const sigset_t& set, std::optional<std::chrono::nanoseconds> time) {
    if (!time) return sigwaitinfo(&set, nullptr);
    const auto left = std::max(*time, 0ns);
    timespec limit{};
    limit.tv_sec = static_cast<time_t>(left / 1s);
    limit.tv_nsec = static_cast<long>((left % 1s).count());
    const int signal = sigtimedwait(&set, nullptr, &limit);
    return signal < 0 && errno == EAGAIN ? 0 : signal;
}

}  // namespace

Supervisor::Supervisor(Console& console, const CommonOptions& options, FatalHandler fatal)
    : console_(console),
      fatal_(fatal),
      json_(options.json),
      draws_(may_draw(options)),
      max_seconds_(options.max_seconds) {
    if (max_seconds_ > 0) {
        // The parser admits no more than a thousand years: this cannot overflow.
        deadline_ = start_ + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(std::min(max_seconds_, 1e9)));
    }
    const sigset_t set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    thread_ = std::thread([this] { watch(); });
}

Supervisor::~Supervisor() {
    pthread_kill(thread_.native_handle(), wake_signal);
    thread_.join();
    console_.show_progress("");
}

void Supervisor::enter_stage(const std::string& name, int index, int count) {
    const std::lock_guard lock(mutex_);
    stage_ = name;
    detail_.clear();
    stage_index_ = index;
    stage_count_ = count;
}

void Supervisor::show_detail(std::string detail) {
    const std::lock_guard lock(mutex_);
    detail_ = std::move(detail);
}

void Supervisor::push_end_action(std::function<void()> action) {
    const std::lock_guard lock(mutex_);
    end_actions_.push_back(std::move(action));
}

void Supervisor::pop_end_action() {
    const std::lock_guard lock(mutex_);
    if (!end_actions_.empty()) end_actions_.pop_back();  // they may have been done
}

void Supervisor::watch_output(const std::filesystem::path& target) {
    const std::filesystem::path real = output_target(target);
    const std::lock_guard lock(mutex_);
    folder_ = real.has_parent_path() ? real.parent_path() : ".";
}

std::optional<Supervisor::Clock::duration> Supervisor::time_to_next_event() const {
    std::optional<Clock::duration> time;
    const auto now = Clock::now();
    if (deadline_) time = *deadline_ - now;
    if (draws_) {
        const auto first = start_ + progress_delay - now;
        const auto next = std::max<Clock::duration>(first, progress_interval);
        time = time ? std::min(*time, next) : next;
    }
    return time;
}

void Supervisor::watch() {
    const sigset_t set = watched_signals();
    for (;;) {
        const int signal = wait_for_signal(set, time_to_next_event());
        if (signal == wake_signal) return;
        const auto now = Clock::now();
        std::optional<Reason> reason;
        if (signal > 0) {
            reason = Reason{static_cast<int>(ErrorCode::Cancelled), "cancelled"};
        } else if (deadline_ && now >= *deadline_) {
            reason = Reason{static_cast<int>(ErrorCode::Limit),
                            fmt::format("not finished after {} s (--max-seconds)", max_seconds_)};
        }
        if (reason) {
            if (!ask_to_stop(*reason)) return end_process(*reason);
            deadline_ = now + patience;
            continue;
        }
        if (draws_ && now >= start_ + progress_delay) draw();
    }
}

void Supervisor::draw() {
    const std::lock_guard lock(mutex_);
    constexpr int width = 24;
    const int done = width * stage_index_ / std::max(stage_count_, 1);
    const std::string bar = std::string(static_cast<std::size_t>(done), '=') +
                            std::string(static_cast<std::size_t>(width - done), ' ');
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    const std::string_view on = wants_color() ? "\033[36m" : "";
    const std::string_view off = wants_color() ? "\033[0m" : "";
    console_.show_progress(fmt::format("[{}{}{}] {:.1f} s  {}{}{}", on, bar, off, elapsed.count(),
                                       stage_, detail_.empty() ? "" : ": ", detail_));
}

std::optional<Failure> Supervisor::reason_to_stop() {
    const std::lock_guard lock(mutex_);
    if (!reason_) return std::nullopt;
    return Failure{reason_->code, reason_->message, {}, {}};
}

bool Supervisor::ask_to_stop(const Reason& reason) {
    const std::lock_guard lock(mutex_);
    if (reason_ || !interruptible_) return false;
    reason_ = reason;
    stop_ = true;
    return true;
}

void Supervisor::end_process(const Reason& given) {
    const Reason reason = [&] {
        const std::lock_guard lock(mutex_);
        return reason_.value_or(given);  // what it was asked to stop for
    }();
    // The other thread may have come to its end first; then there is nothing to stop any more.
    if (!console_.claim_end()) return;
    remove_temporary_output();
    console_.show_progress("");
    fatal_(console_, json_, reason.code, reason.message);
}

void Supervisor::remove_temporary_output() {
    const std::lock_guard lock(mutex_);
    while (!end_actions_.empty()) {
        end_actions_.back()();
        end_actions_.pop_back();
    }
    if (folder_.empty()) return;
    // The names that write_file gives to files that are not complete.
    const std::string prefix = fmt::format(".trisect-{}-", ::getpid());
    std::error_code error;
    for (std::filesystem::directory_iterator it(folder_, error), end; !error && it != end;
         it.increment(error)) {
        if (it->path().filename().string().rfind(prefix, 0) == 0) {
            std::error_code ignored;
            std::filesystem::remove(it->path(), ignored);
        }
    }
}

}  // namespace trisect::app
