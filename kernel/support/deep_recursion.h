// SPDX-License-Identifier: Apache-2.0
//
// Recursion that continues on a new stack when one is exhausted.
//
// Trees are as deep as a chain of cuts made them, and formulas as their writer nested them; the
// stack of a thread is eight megabytes, or 256 KiB in a pool of another library. Depth alone does
// not determine bytes. So recursive functions check how much stack is left, one comparison, and
// when it runs out they go on in a thread of their own, with a new stack, while this one waits.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

namespace trisect::detail {

/// The address below which the stack of this thread counts as used up; null: not known yet.
inline constinit thread_local const std::byte* stack_reserve_of_thread = nullptr;

/// Finds it. Where the system does not report it, no address is below it.
[[nodiscard]] const std::byte* find_stack_reserve() noexcept;

/// Less than 128 KiB are left: enough for all that does not recurse.
[[nodiscard]] inline bool stack_runs_out() noexcept {
    const std::byte* reserve = stack_reserve_of_thread;
    if (reserve == nullptr) reserve = find_stack_reserve();
    const void* here = __builtin_frame_address(0);
    return std::less<>()(here, static_cast<const void*>(reserve));
}

/// Runs `call` in a thread with a stack of eight megabytes and waits for it. What it throws is
/// thrown here; the predicates that it counts are counted here; the StopScope of this thread holds
/// there.
/// \throw LimitError when there is no memory for a stack.
void run_on_new_stack(const std::function<void()>& call);

/// f(), on this stack or on a new one.
template <class F>
auto with_enough_stack(F&& f) -> std::invoke_result_t<F> {
    if (!stack_runs_out()) [[likely]]
        return std::forward<F>(f)();
    using Result = std::invoke_result_t<F>;
    if constexpr (std::is_void_v<Result>) {
        run_on_new_stack([&f] { f(); });
    } else {
        std::optional<Result> result;
        run_on_new_stack([&] { result.emplace(f()); });
        return *std::move(result);
    }
}

}  // namespace trisect::detail
