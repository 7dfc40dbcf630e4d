// SPDX-License-Identifier: Apache-2.0
//
// ZipFile: files in one zip archive.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace trisect::app {

/// Stored without compression: pictures are compressed already, and equal contents give equal
/// bytes. The time of each file is the first that the format has. Up to 4 GiB; 65,535 files and
/// more make it one of ZIP64.
class ZipFile {
public:
    /// \throw LimitError when the archive becomes too large
    void add(const std::string& name, std::string_view bytes);
    [[nodiscard]] std::string finish();

private:
    std::string bytes_;
    std::string directory_;
    std::uint32_t count_ = 0;
};

}  // namespace trisect::app
