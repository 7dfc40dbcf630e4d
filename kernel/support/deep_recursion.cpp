// SPDX-License-Identifier: Apache-2.0

#include <trisect/kernel/support/deep_recursion.h>

#include <pthread.h>

#include <cstdint>

#include <trisect/kernel/counters.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::detail {

namespace {

constexpr std::size_t reserve = std::size_t{1} << 17;
constexpr std::size_t new_stack = std::size_t{1} << 23;

struct Call {
    const std::function<void()>& function;
    StopScope* scope;  // of the calling thread, which waits
    std::exception_ptr failure;
    PredicateCounters counters;
};

void* run(void* p) {
    Call& call = *static_cast<Call*>(p);
    stop_scope_of_thread = call.scope;
    try {
        call.function();
    } catch (...) {
        call.failure = std::current_exception();
    }
    call.counters = counters_of_thread<PredicateCounters>;
    return nullptr;
}

}  // namespace

const std::byte* find_stack_reserve() noexcept {
    // Where nothing is known: not null, and below every frame.
    const auto* found = reinterpret_cast<const std::byte*>(std::uintptr_t{1});
#if defined(__EMSCRIPTEN__)
    // The linker puts the stack first, down to address 0 (web/wasm).
    found = reinterpret_cast<const std::byte*>(reserve);
#elif defined(__linux__)
    pthread_attr_t attributes;
    if (pthread_getattr_np(pthread_self(), &attributes) == 0) {
        void* low = nullptr;
        std::size_t size = 0;
        if (pthread_attr_getstack(&attributes, &low, &size) == 0)
            found = static_cast<const std::byte*>(low) + reserve;
        pthread_attr_destroy(&attributes);
    }
#endif
    stack_reserve_of_thread = found;
    return found;
}

void run_on_new_stack(const std::function<void()>& function) {
    Call call{function, stop_scope_of_thread, nullptr, {}};
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) throw LimitError("no memory for a deeper recursion");
    pthread_t thread{};
    const bool started = pthread_attr_setstacksize(&attributes, new_stack) == 0 &&
                         pthread_create(&thread, &attributes, run, &call) == 0;
    pthread_attr_destroy(&attributes);
    if (!started) throw LimitError("no memory for a deeper recursion");
    pthread_join(thread, nullptr);
    counters_of_thread<PredicateCounters> += call.counters;
    if (call.failure) std::rethrow_exception(call.failure);
}

}  // namespace trisect::detail
