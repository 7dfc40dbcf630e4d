// SPDX-License-Identifier: Apache-2.0
//
// VecView: elements of an array that belongs to somebody else.
#pragma once

#include <cstddef>
#include <vector>

// NOLINTBEGIN(readability-identifier-naming): names are those of another library
namespace manifold {

template <class T>
class VecView {
public:
    VecView() = default;
    VecView(T* data, std::size_t size) : data_(data), size_(size) {}
    VecView(std::vector<T>& v)  // NOLINT(google-explicit-constructor): as in their programs
        : data_(v.data()), size_(v.size()) {}

    T& operator[](std::size_t i) const { return data_[i]; }
    [[nodiscard]] T* begin() const { return data_; }
    [[nodiscard]] T* end() const { return data_ + size_; }
    [[nodiscard]] T* data() const { return data_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }

private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace manifold
// NOLINTEND(readability-identifier-naming)
