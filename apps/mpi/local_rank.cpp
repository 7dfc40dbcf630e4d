// SPDX-License-Identifier: Apache-2.0
#include "local_rank.h"

#include <chrono>
#include <utility>

namespace trisect::app {

LocalRank::LocalRank(std::unique_ptr<RankWorker> worker)
    : worker_(std::move(worker)), thread_([this] { work(); }) {}

void LocalRank::stop() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void LocalRank::give(RankTask task) {
    {
        const std::lock_guard lock(mutex_);
        tasks_.push_back(std::move(task));
    }
    changed_.notify_all();
}

std::optional<RankAnswer> LocalRank::take() {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (answers_.empty()) return std::nullopt;
    RankAnswer out = std::move(answers_.front());
    answers_.pop_front();
    return out;
}

void LocalRank::wait(std::chrono::microseconds most) {
    std::unique_lock lock(mutex_);
    answered_.wait_for(lock, most, [this] { return failure_ || !answers_.empty(); });
}

void LocalRank::work() {
    using Clock = std::chrono::steady_clock;
    std::optional<Clock::time_point> waits_from;
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
        if (ends_) return;
        const RankTask task = std::move(tasks_.front());
        tasks_.pop_front();
        if (waits_from) idle_ += std::chrono::duration<double>(Clock::now() - *waits_from).count();
        lock.unlock();
        std::optional<RankAnswer> answer;
        std::exception_ptr failure;
        try {
            answer = worker_->done(task);
        } catch (...) {
            failure = std::current_exception();
        }
        if (task.order.kind == RankOrder::Kind::Tile) waits_from = Clock::now();
        lock.lock();
        failure_ = failure;
        if (answer) answers_.push_back(std::move(*answer));
        answered_.notify_all();
        if (failure) return;
    }
}

}  // namespace trisect::app
