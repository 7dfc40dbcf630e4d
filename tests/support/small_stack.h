// SPDX-License-Identifier: Apache-2.0
//
// A thread with 256 KiB of stack, which is what musl, macOS and thread pools give.
#pragma once

#include <pthread.h>

#include <cstddef>
#include <functional>
#include <string>

namespace trisect::test {

/// Runs `work` there to its end. Returns what it threw, as text, or nothing.
inline std::string run_with_small_stack(const std::function<void()>& work) {
    struct Task {
        const std::function<void()>& work;
        std::string failure;
    } task{work, {}};
    const auto call = [](void* p) -> void* {
        auto& t = *static_cast<Task*>(p);
        try {
            t.work();
        } catch (const std::exception& e) {
            t.failure = e.what();
        }
        return nullptr;
    };
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) return "no attributes";
    pthread_t thread{};
    const bool started = pthread_attr_setstacksize(&attributes, std::size_t{1} << 18) == 0 &&
                         pthread_create(&thread, &attributes, call, &task) == 0;
    pthread_attr_destroy(&attributes);
    if (!started) return "no thread";
    pthread_join(thread, nullptr);
    return task.failure;
}

}  // namespace trisect::test
