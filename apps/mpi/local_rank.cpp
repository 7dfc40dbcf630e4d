// SPDX-License-Identifier: Apache-2.0
#include "local_rank.h"

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

std::optional<RankResult> LocalRank::take() {
    const std::lock_guard lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
    if (results_.empty()) return std::nullopt;
    RankResult out = std::move(results_.front());
    results_.pop_front();
    return out;
}

void LocalRank::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ends_ || !tasks_.empty(); });
        if (ends_) return;
        const RankTask task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        std::optional<RankResult> result;
        std::exception_ptr failure;
        try {
            result = worker_->done(task);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        if (failure) {
            failure_ = failure;
            return;
        }
        results_.push_back(std::move(*result));
    }
}

}  // namespace trisect::app
