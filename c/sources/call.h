// SPDX-License-Identifier: Apache-2.0
//
// One call of the C interface: exceptions become a status, limits hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include <trisect-c/trisect.h>

#include <trisect/kernel/error.h>
#include <trisect/kernel/point3d.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect::c {

/// The limits of this thread (trisect_set_limits).
struct ThreadLimits {
    std::uint32_t threads = 0;
    StopLimits stop;
};
[[nodiscard]] ThreadLimits& limits_of_thread() noexcept;

/// The status of the exception that is being handled; keeps its message for this thread.
[[nodiscard]] trisect_status keep_error() noexcept;

/// f(), whose exceptions become a status.
template <class F>
trisect_status call(F&& f) noexcept {
    try {
        const StopLimits& stop = limits_of_thread().stop;
        if (stop.cancel == nullptr && stop.max_work == 0 && stop.max_memory == 0) {
            std::forward<F>(f)();
        } else {
            const StopScope scope(stop);
            std::forward<F>(f)();
        }
        return TRISECT_OK;
    } catch (...) {
        return keep_error();
    }
}

/// \throw UsageError naming the argument when a pointer is null
template <class T>
T& required(T* pointer, const char* name) {
    if (pointer == nullptr) throw UsageError(std::string(name) + " is NULL");
    return *pointer;
}

/// An array; a null pointer is one of length 0. \throw UsageError naming the argument
template <class T>
std::span<const T> array_of(const T* pointer, std::size_t count, const char* name) {
    if (count != 0) (void)required(pointer, name);
    return {pointer, count};
}

/// Three numbers. \throw as above
[[nodiscard]] inline Point3d point_of(const double* numbers, const char* name) {
    (void)required(numbers, name);
    return {numbers[0], numbers[1], numbers[2]};
}

/// Writes a new handle with `value` as its content, or null where make() throws.
/// \throw UsageError for a null pointer, and what make() throws
template <class Handle, class Make>
trisect_status make_handle(Handle** out, const char* name, const Make& make) noexcept {
    if (out != nullptr) *out = nullptr;
    return call([&] {
        Handle*& handle = required(out, name);
        handle = new Handle{make()};
    });
}

}  // namespace trisect::c
