// SPDX-License-Identifier: Apache-2.0
//
// Zip archives in memory, over libzip.
// Nothing is ever unpacked onto a disk.
#pragma once

#include <trisect/brep/io/read_mesh.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trisect::detail {

/// Reads entries by name. Refused are archives with more entries than the limit, two entries of one
/// name (letters of either case), encrypted entries, other packing than "stored" and "deflated",
/// and entries that unpack to more bytes, or to a larger multiple of what they take, than the
/// limits allow; which is counted while they are unpacked.
class ZipArchive {
public:
    /// `bytes` must outlive this. \throw InputError, LimitError
    ZipArchive(std::string_view bytes, std::string name, const ReadLimits& limits);
    ~ZipArchive();
    ZipArchive(const ZipArchive&) = delete;
    ZipArchive& operator=(const ZipArchive&) = delete;

    /// The contents of an entry, whose letters may be of either case; nothing when it is not there.
    /// \throw InputError, LimitError
    [[nodiscard]] std::optional<std::string> read(std::string_view entry);
    /// In the order of the archive.
    [[nodiscard]] const std::vector<std::string>& entries() const { return entries_; }
    /// "archive/entry", as places in an entry are called.
    [[nodiscard]] std::string name_of(std::string_view entry) const;

private:
    struct Handle;
    void list_entries();
    [[noreturn]] void fail(std::string_view entry, const std::string& message) const;

    std::string name_;
    ReadLimits limits_;
    std::uint64_t size_;  ///< of the archive
    std::unique_ptr<Handle> handle_;
    std::vector<std::string> entries_;
    std::uint64_t unpacked_ = 0;  ///< bytes so far
};

/// An archive of these entries, deflated. Equal entries give equal bytes.
[[nodiscard]] std::string zip_bytes(
    const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace trisect::detail
