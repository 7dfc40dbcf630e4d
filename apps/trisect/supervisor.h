// SPDX-License-Identifier: Apache-2.0
//
// Supervisor: the thread that watches the clock and the signals while another one works, and draws
// the progress line.
//
// A boolean has no place where one could ask it to stop without slowing it down, and a library call
// may be anywhere. So the supervisor ends the process: it removes the temporary output, prints the
// error document and leaves with 5 (out of time) or 6 (interrupted). Outputs are renamed when
// complete, so nothing half-written remains; a limit that strikes in the instant between the
// renaming and the end can leave a complete file.
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "console.h"
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
    /// Where temporary output may appear.
    void watch_output(const std::filesystem::path& target);

private:
    using Clock = std::chrono::steady_clock;

    void watch();
    [[nodiscard]] std::optional<Clock::duration> time_to_next_event() const;
    void draw();
    void end_process(int code, const std::string& message);
    void remove_temporary_output();

    Console& console_;
    FatalHandler fatal_;
    bool json_;
    bool draws_;
    std::optional<Clock::time_point> deadline_;
    double max_seconds_;
    Clock::time_point start_ = Clock::now();

    std::mutex mutex_;  // guards what follows
    std::string stage_;
    int stage_index_ = 0;
    int stage_count_ = 1;
    std::filesystem::path folder_;

    std::thread thread_;
};

}  // namespace trisect::app
