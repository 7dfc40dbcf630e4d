// SPDX-License-Identifier: Apache-2.0
//
// Contents of a whole file in memory.
// It is read, not mapped: a file that another process shortens while it is mapped ends this
// process with a bus error, and a copy costs little beside parsing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace trisect {

class FileBytes {
public:
    FileBytes() = default;
    FileBytes(std::unique_ptr<char[]> data, std::size_t size) noexcept
        : data_(std::move(data)), size_(size) {}
    [[nodiscard]] std::string_view view() const noexcept { return {data_.get(), size_}; }

private:
    std::unique_ptr<char[]> data_;
    std::size_t size_ = 0;
};

/// Reads all of a file (or pipe or device) up to `limit` bytes.
/// Errors: InputError naming the file and the reason of the system; LimitError when it is larger.
[[nodiscard]] FileBytes read_file(const std::filesystem::path& path, std::uint64_t limit);

/// The same from an open descriptor, such as 0 for the standard input, which stays open.
[[nodiscard]] FileBytes read_descriptor(int descriptor, const std::string& name,
                                        std::uint64_t limit);

}  // namespace trisect
