// SPDX-License-Identifier: Apache-2.0
//
// Spares: memory that short-lived objects of a thread leave to the next ones.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace trisect::detail {

/// Up to two T for each thread: arrays that were cleared and keep their room. Memory that goes back
/// to the system and comes again is paid for page by page, which may take longer than what is then
/// put there.
template <class T>
class Spares {
public:
    /// The last one that was given, or a new one.
    [[nodiscard]] static T take() {
        Kept* const kept = of_thread();
        if (kept == nullptr || kept->count == 0) return T();
        return std::exchange(kept->values[--kept->count], T());
    }
    /// Keeps it, if there is room.
    static void give(T&& value) noexcept {
        Kept* const kept = of_thread();
        if (kept != nullptr && kept->count < most) kept->values[kept->count++] = std::move(value);
    }

private:
    static constexpr std::size_t most = 2;  // a question has two bodies
    struct Kept {
        std::array<T, most> values;
        std::size_t count = 0;
        ~Kept() { is_gone = true; }
    };
    // Null when the thread ends: objects that are destroyed later keep nothing.
    [[nodiscard]] static Kept* of_thread() {
        if (is_gone) return nullptr;
        static thread_local Kept kept;
        return &kept;
    }
    static inline constinit thread_local bool is_gone = false;
};

/// A spare T for as long as this lives. T has bytes(), and what takes more than `most_bytes` is not
/// kept. It is as the last user left it.
template <class T>
class Spare {
public:
    Spare() : value_(Spares<T>::take()) {}
    Spare(const Spare&) = delete;
    Spare& operator=(const Spare&) = delete;
    ~Spare() {
        if (value_.bytes() <= most_bytes) Spares<T>::give(std::move(value_));
    }
    [[nodiscard]] T* operator->() { return &value_; }
    [[nodiscard]] const T* operator->() const { return &value_; }
    [[nodiscard]] T& operator*() { return value_; }

private:
    static constexpr std::size_t most_bytes = std::size_t{1} << 20U;
    T value_;
};

}  // namespace trisect::detail
