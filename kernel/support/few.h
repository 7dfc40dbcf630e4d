// SPDX-License-Identifier: Apache-2.0
//
// Few: a vector with in-place storage for its first elements.
// It holds the corners of polygons under construction.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <type_traits>
#include <vector>

namespace trisect::detail {

/// Up to `Inline` elements without an allocation; more move to the heap. Regular value type.
template <class T, std::size_t Inline = 8>
class Few {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    Few() = default;
    Few(std::initializer_list<T> values) {
        for (const T& v : values) push_back(v);
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] T* data() { return many_.empty() ? few_.data() : many_.data(); }
    [[nodiscard]] const T* data() const { return many_.empty() ? few_.data() : many_.data(); }
    [[nodiscard]] T* begin() { return data(); }
    [[nodiscard]] T* end() { return data() + size_; }
    [[nodiscard]] const T* begin() const { return data(); }
    [[nodiscard]] const T* end() const { return data() + size_; }
    [[nodiscard]] T& operator[](std::size_t i) { return data()[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data()[i]; }

    void push_back(const T& v) {
        if (size_ < Inline) {
            few_[size_] = v;
        } else {
            if (size_ == Inline) many_.assign(few_.begin(), few_.end());
            many_.push_back(v);
        }
        ++size_;
    }
    void clear() {
        size_ = 0;
        many_.clear();
    }

    friend bool operator==(const Few& a, const Few& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

private:
    std::size_t size_ = 0;
    std::array<T, Inline> few_{};
    std::vector<T> many_;  // all elements once there are more than Inline
};

}  // namespace trisect::detail
