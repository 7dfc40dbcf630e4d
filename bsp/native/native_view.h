// SPDX-License-Identifier: Apache-2.0
//
// NativeView: the bytes of a native file, compared with their checksums.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <trisect/brep/io/formats/binary.h>
#include <trisect/bsp/native/native_layout.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

/// A view of bytes that outlive it. Safe to use from many threads: a block that two of them need
/// first is compared twice.
class NativeView {
public:
    /// Reads the header. \throw InputError for another format or version, a size that is not the
    /// header's, and numbers that no file has
    NativeView(std::string_view bytes, std::string name);

    [[nodiscard]] const NativeHeader& header() const { return header_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::string_view bytes() const { return bytes_; }

    /// Compares all blocks. \throw InputError with the place of a damaged one
    void check_all(std::uint32_t threads) const;
    /// Some records, after their blocks were compared. \pre the section has them
    [[nodiscard]] const char* records(NativeSection section, std::uint64_t first,
                                      std::uint64_t count) const;
    /// Where a record is in the file.
    [[nodiscard]] std::uint64_t place(NativeSection section, std::uint64_t record) const {
        return header_.offset(section) +
               record * native_record_bytes[static_cast<std::size_t>(section)];
    }
    [[noreturn]] void fail(std::uint64_t place, const std::string& what) const {
        throw InputError(FilePlace{name_, 0, 0, place}, what);
    }
    [[noreturn]] void fail(NativeSection section, std::uint64_t record,
                           const std::string& what) const {
        fail(place(section, record), what);
    }

private:
    void read_header();
    void read_counts();
    void check_block(std::size_t block) const;

    std::string_view bytes_;
    std::string name_;
    NativeHeader header_;
    mutable std::unique_ptr<std::atomic<bool>[]> is_checked_;  // by block
};

/// Reads numbers one after the other.
class NativeCursor {
public:
    explicit NativeCursor(const char* at) : at_(at) {}
    template <class T>
    [[nodiscard]] T next() {
        const T value = load<T, false>(at_);
        at_ += sizeof(T);
        return value;
    }
    [[nodiscard]] Box next_box() {
        Box b;
        for (std::int64_t& c : b.lo) c = next<std::int64_t>();
        for (std::int64_t& c : b.hi) c = next<std::int64_t>();
        return b;
    }
    void skip(std::size_t bytes) { at_ += bytes; }

private:
    const char* at_;
};

}  // namespace trisect::detail
