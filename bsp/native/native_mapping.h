// SPDX-License-Identifier: Apache-2.0
//
// Mapped file: its bytes as memory, read-only.
#pragma once

#include <filesystem>
#include <string_view>

namespace trisect::detail {

class MappedFile {
public:
    /// \throw InputError naming the file and the reason of the system
    explicit MappedFile(const std::filesystem::path& path);
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    ~MappedFile();

    [[nodiscard]] std::string_view bytes() const {
        return {static_cast<const char*>(data_), size_};
    }

private:
    void* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace trisect::detail
