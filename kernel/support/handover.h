// SPDX-License-Identifier: Apache-2.0
//
// Handover: the order of oneTBB's tasks, declared to the thread sanitizer.
// The library is not compiled with the sanitizer, so a task seems to race with the thread that
// made it.
#pragma once

#if defined(__SANITIZE_THREAD__)
#define TRISECT_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TRISECT_THREAD_SANITIZER 1
#endif
#endif

#if defined(TRISECT_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#define TRISECT_NOT_BY_THREAD_SANITIZER __attribute__((no_sanitize("thread"), noinline))
#else
#define TRISECT_NOT_BY_THREAD_SANITIZER
#endif

namespace trisect::detail {

/// What happened before give() in one thread happened before take() returns in another. Does
/// nothing outside the sanitizer: the order itself is that of tasks and their waiters.
class Handover {
public:
#if defined(TRISECT_THREAD_SANITIZER)
    void give() { __tsan_release(&place_); }
    void take() { __tsan_acquire(&place_); }

private:
    char place_ = 0;
#else
    void give() {}
    void take() {}
#endif
};

}  // namespace trisect::detail
