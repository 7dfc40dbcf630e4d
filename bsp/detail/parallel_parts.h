// SPDX-License-Identifier: Apache-2.0
//
// A range of numbers in consecutive parts, on several threads.
#ifndef TRISECT_BSP_DETAIL_PARALLEL_PARTS_H
#define TRISECT_BSP_DETAIL_PARALLEL_PARTS_H

#include <algorithm>
#include <cstddef>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace trisect::detail {

/// The numbers below `size`, in parts of nearly the same length. A few parts for each thread even
/// out what they take; few numbers are one part. `threads` = 0 takes as many as there are.
class ParallelParts {
public:
    ParallelParts(std::size_t size, unsigned threads)
        : size_(size), threads_(threads), count_(size < 2 * least ? 1 : parts_of(size, threads)) {}

    [[nodiscard]] std::size_t count() const { return count_; }

    /// Calls work(part, begin, end) for each part; in their order if there is one thread.
    template <class Work>
    void for_each(const Work& work) const {
        const auto one = [&](std::size_t part) {
            work(part, size_ * part / count_, size_ * (part + 1) / count_);
        };
        if (count_ == 1) {
            one(0);
            return;
        }
        const auto all = [&] {
            oneapi::tbb::parallel_for(std::size_t{0}, count_, one,
                                      oneapi::tbb::simple_partitioner());
        };
        if (threads_ == 0) {
            all();
        } else {
            oneapi::tbb::task_arena arena(static_cast<int>(threads_));
            arena.execute(all);
        }
    }

private:
    static constexpr std::size_t least = 512;

    static std::size_t parts_of(std::size_t size, unsigned threads) {
        const std::size_t slots =
            threads != 0
                ? threads
                : static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
        return slots == 1 ? 1 : std::clamp(size / least, std::size_t{1}, 8 * slots);
    }

    std::size_t size_;
    unsigned threads_;
    std::size_t count_;
};

}  // namespace trisect::detail

#endif
