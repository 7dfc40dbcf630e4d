// SPDX-License-Identifier: Apache-2.0
//
// Parallel loops over consecutive parts of a range of numbers.
// The outcome does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/task_group.h>
#include <trisect/kernel/support/thread_pool.h>

namespace trisect::detail {

/// Returns work(n), n being 1 if `threads` is 1 and 0 otherwise: that many threads, or as many as
/// there are where work() runs, which are at most `threads` unless that is 0. For callers that
/// start several parts one after the other.
template <class Work>
auto on_threads(std::uint32_t threads, const Work& work) {
    if (threads <= 1) return work(threads);
    return in_arena(threads, [&] { return work(std::uint32_t{0}); });
}

/// The numbers below `size`, in parts of nearly the same length, none shorter than `least`. A few
/// parts for each thread even out what they take; few numbers are one part. `threads` = 0 takes as
/// many as there are.
class ParallelParts {
public:
    ParallelParts(std::size_t size, std::uint32_t threads, std::size_t least = 512)
        : size_(size), threads_(threads), count_(parts_of(size, threads, least)) {}

    [[nodiscard]] std::size_t count() const { return count_; }

    /// Calls work(part, begin, end) for each part; in their order if there is one thread. The
    /// calling thread takes part, and does no work of others while it waits. Throws what the first
    /// part that fails throws, and CancelledError when the StopScope of the calling thread was
    /// cancelled before a part began.
    template <class Work>
    void for_each(const Work& work) const {
        const auto one = [&](std::size_t part) {
            work(part, size_ * part / count_, size_ * (part + 1) / count_);
        };
        if (count_ == 1) {
            check_flags(stop_scope_of_thread);
            one(0);
            return;
        }
        on_threads(threads_, [&](std::uint32_t) { share(one); });
    }

private:
    // Each thread takes the next part until there is none.
    template <class One>
    void share(const One& one) const {
        std::atomic<std::size_t> next{0};
        FirstFailure failure;
        const StopScope* const scope = stop_scope_of_thread;
        const auto take_parts = [&] {
            for (std::size_t part = next++; part < count_; part = next++)
                failure.guard(part, [&] {
                    check_flags(scope);
                    one(part);
                });
        };
        isolated([&] {
            TaskGroup group;
            for (std::size_t i = std::min(threads_here(), count_); i > 1; --i)
                group.run(take_parts);
            take_parts();
            group.wait();
        });
        failure.rethrow();
    }

    static std::size_t parts_of(std::size_t size, std::uint32_t threads, std::size_t least) {
        if (threads == 1 || size < 2 * least) return 1;
        const std::size_t slots = threads != 0 ? threads : threads_here();
        return slots == 1 ? 1 : std::clamp(size / least, std::size_t{1}, 8 * slots);
    }

    std::size_t size_;
    std::uint32_t threads_;
    std::size_t count_;
};

/// One part for each thread at most: where a part costs something by itself.
[[nodiscard]] inline ParallelParts parts_by_thread(std::size_t size, std::uint32_t threads,
                                                   std::size_t least) {
    const std::size_t slots = threads != 0 ? threads : threads_here();
    return {size, threads, std::max(least, (size + slots - 1) / slots)};
}

/// Parts of several ranges of numbers, one range after the other; each part is of one range. Long
/// ranges have several parts, and a thread takes several short ranges at a time. `least` and
/// `threads` as in ParallelParts.
class PartsOfRanges {
public:
    struct Part {
        std::size_t range = 0;
        std::size_t begin = 0;
        std::size_t end = 0;
        bool is_whole = true;  ///< all of its range
    };

    /// size_of(range) is the size of each of so many ranges.
    template <class SizeOf>
    PartsOfRanges(std::size_t ranges, const SizeOf& size_of, std::uint32_t threads,
                  std::size_t least) {
        std::size_t all = 0;
        parts_.reserve(ranges);
        for (std::size_t r = 0; r < ranges; ++r) {
            const std::size_t size = size_of(r);
            all += size;
            const std::size_t count = ParallelParts(size, threads, least).count();
            for (std::size_t k = 0; k < count; ++k)
                parts_.push_back({r, size * k / count, size * (k + 1) / count, count == 1});
        }
        threads_ = all < 2 * least ? 1 : threads;
    }

    [[nodiscard]] std::size_t count() const { return parts_.size(); }

    /// Calls work(number, part) for each part, as ParallelParts::for_each() does.
    template <class Work>
    void for_each(const Work& work) const {
        ParallelParts(parts_.size(), threads_, 1)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) work(i, parts_[i]);
            });
    }

private:
    std::vector<Part> parts_;
    std::uint32_t threads_ = 1;
};

}  // namespace trisect::detail
