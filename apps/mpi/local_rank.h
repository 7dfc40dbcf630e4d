// SPDX-License-Identifier: Apache-2.0
//
// LocalRank: a second thread of a rank, which does its tasks.
// The first one takes and answers messages meanwhile.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "rank_worker.h"

namespace trisect::app {

class LocalRank {
public:
    explicit LocalRank(std::unique_ptr<RankWorker> worker);
    LocalRank(const LocalRank&) = delete;
    LocalRank& operator=(const LocalRank&) = delete;
    ~LocalRank() { stop(); }
    /// Waits for the task that is being done, and drops all others.
    void stop();

    void give(RankTask task);
    /// Null if nothing is finished. \throw CancelledError when the thread was stopped
    [[nodiscard]] std::optional<RankAnswer> take();
    /// Until take() has something to say, and no longer than that.
    void wait(std::chrono::microseconds most);
    /// After stop().
    [[nodiscard]] RankWorker& worker() { return *worker_; }
    /// After stop(): seconds on the clock that it waited between its first tile and its last.
    [[nodiscard]] double idle() const { return idle_; }

private:
    void work();

    std::unique_ptr<RankWorker> worker_;
    std::mutex mutex_;  // guards what follows
    std::condition_variable changed_;
    std::condition_variable answered_;
    std::deque<RankTask> tasks_;
    std::deque<RankAnswer> answers_;
    std::exception_ptr failure_;
    bool ends_ = false;
    double idle_ = 0;
    std::thread thread_;
};

}  // namespace trisect::app
