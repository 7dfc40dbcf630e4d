// SPDX-License-Identifier: Apache-2.0
//
// Supervisor: a thread for the clock, signals and the progress line.
// Another thread works meanwhile.
//
// An evaluation can be asked to stop: the supervisor sets a flag, the evaluation throws, everything
// is taken down in order, and the command leaves with 5 (out of time) or 6 (interrupted). Other
// library calls cannot be asked. There, at a second signal, or when an evaluation does not answer
// for two seconds, the supervisor ends the process itself: it removes the temporary output, prints
// the error document and leaves with the same codes. Outputs are renamed when complete, so nothing
// half-written remains; a limit that strikes in the instant between the renaming and the end can
// leave a complete file.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "console.h"
#include "failure.h"
#include "options.h"

namespace trisect::app {

/// Ends the process in the way of an error; does not return.
using FatalHandler = void (*)(Console&, bool json, int code, const std::string& message);

class Supervisor {
public:
    /// Blocks the signals in this thread and all threads it starts from now on: construct it first.
    Supervisor(Console& console, const CommonOptions& options, FatalHandler fatal);
    Supervisor(const Supervisor&) = delete;
    Supervisor& operator=(const Supervisor&) = delete;
    /// Stops watching.
    ~Supervisor();

    /// What is being done, for the progress line: step `index` of `count`.
    void enter_stage(const std::string& name, int index, int count);
    /// What of the stage is being done, for the same line; the next stage takes it away.
    void show_detail(std::string detail);
    /// Whether anybody sees it.
    [[nodiscard]] bool draws() const { return draws_; }
    /// Where temporary output may appear.
    void watch_output(const std::filesystem::path& target);

    /// What is to be done in addition when this ends the process itself, by this thread; the last
    /// one first. Use EndGuard.
    void push_end_action(std::function<void()> action);
    void pop_end_action();

    /// Does work that looks at stop_flag() from time to time. \throw CancelledError when the flag
    /// is set at the end of it.
    template <class Work>
    auto interruptibly(Work&& work) {
        interruptible_ = true;
        struct Leave {
            std::atomic<bool>& flag;
            ~Leave() { flag = false; }
        } leave{interruptible_};
        auto result = work();
        if (stop_) throw CancelledError();
        return result;
    }
    [[nodiscard]] const std::atomic<bool>& stop_flag() const { return stop_; }
    /// Why the flag was set.
    [[nodiscard]] std::optional<Failure> reason_to_stop();

private:
    using Clock = std::chrono::steady_clock;

    struct Reason {
        int code;
        std::string message;
    };

    void watch();
    [[nodiscard]] std::optional<Clock::duration> time_to_next_event() const;
    void draw();
    /// True when somebody else will end the command.
    [[nodiscard]] bool ask_to_stop(const Reason& reason);
    void end_process(const Reason& reason);
    void remove_temporary_output();

    Console& console_;
    FatalHandler fatal_;
    bool json_;
    bool draws_;
    std::optional<Clock::time_point> deadline_;
    double max_seconds_;
    Clock::time_point start_ = Clock::now();
    std::atomic<bool> interruptible_ = false;
    std::atomic<bool> stop_ = false;

    std::mutex mutex_;  // guards what follows
    std::string stage_;
    std::string detail_;
    std::vector<std::function<void()>> end_actions_;
    int stage_index_ = 0;
    int stage_count_ = 1;
    std::filesystem::path folder_;
    std::optional<Reason> reason_;

    std::thread thread_;
};

/// What is to be done should the process be ended while this lives.
class EndGuard {
public:
    EndGuard(Supervisor& supervisor, std::function<void()> action) : supervisor_(supervisor) {
        supervisor_.push_end_action(std::move(action));
    }
    EndGuard(const EndGuard&) = delete;
    EndGuard& operator=(const EndGuard&) = delete;
    ~EndGuard() { supervisor_.pop_end_action(); }

private:
    Supervisor& supervisor_;
};

}  // namespace trisect::app
