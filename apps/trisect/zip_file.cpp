// SPDX-License-Identifier: Apache-2.0
#include "zip_file.h"

#include <trisect/kernel/error.h>

#include <zlib.h>

#include <limits>

namespace trisect::app {
namespace {

constexpr std::uint32_t most_files = 65534;        // without the records of ZIP64
constexpr std::uint32_t version = 20;              // 2.0
constexpr std::uint32_t first_day = (1 << 5) | 1;  // 1 January 1980

void put(std::string& out, std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>((value >> (8 * i)) & 0xffU);
}

// What both kinds of entries have.
void put_entry(std::string& out, std::uint32_t checksum, std::uint32_t size,
               const std::string& name) {
    put(out, 0, 2);  // stored
    put(out, 0, 2);  // time
    put(out, first_day, 2);
    put(out, checksum, 4);
    put(out, size, 4);
    put(out, size, 4);
    put(out, static_cast<std::uint32_t>(name.size()), 2);
    put(out, 0, 2);
}

// ZIP64: the end of the directory with larger numbers, and where that is.
void put_large_end(std::string& out, std::uint32_t count, std::uint32_t size, std::uint32_t at) {
    constexpr std::uint32_t large_version = 45;  // 4.5
    const auto put_large = [&out](std::uint32_t value) {
        put(out, value, 4);
        put(out, 0, 4);
    };
    const auto here = static_cast<std::uint32_t>(out.size());
    put(out, 0x06064b50, 4);
    put_large(44);  // bytes of what follows
    put(out, large_version, 2);
    put(out, large_version, 2);
    put_large(0);  // disks
    put_large(count);
    put_large(count);
    put_large(size);
    put_large(at);
    put(out, 0x07064b50, 4);
    put(out, 0, 4);
    put_large(here);
    put(out, 1, 4);
}

}  // namespace

void ZipFile::add(const std::string& name, std::string_view bytes) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (bytes_.size() + directory_.size() + bytes.size() + 1000 > most)
        throw LimitError("a zip file has no more than 4 GiB");
    const auto size = static_cast<std::uint32_t>(bytes.size());
    const auto checksum =
        static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), size));
    const auto at = static_cast<std::uint32_t>(bytes_.size());
    put(bytes_, 0x04034b50, 4);
    put(bytes_, version, 2);
    put(bytes_, 0, 2);
    put_entry(bytes_, checksum, size, name);
    bytes_ += name;
    bytes_ += bytes;
    put(directory_, 0x02014b50, 4);
    put(directory_, version, 2);
    put(directory_, version, 2);
    put(directory_, 0, 2);
    put_entry(directory_, checksum, size, name);
    put(directory_, 0, 2);  // comment
    put(directory_, 0, 4);  // disk, attributes
    put(directory_, 0, 4);
    put(directory_, at, 4);
    directory_ += name;
    ++count_;
}

std::string ZipFile::finish() {
    const auto at = static_cast<std::uint32_t>(bytes_.size());
    std::string out = std::move(bytes_);
    out += directory_;
    const auto size = static_cast<std::uint32_t>(directory_.size());
    const bool is_large = count_ > most_files;
    if (is_large) put_large_end(out, count_, size, at);
    put(out, 0x06054b50, 4);
    put(out, 0, 4);  // disks
    put(out, is_large ? 0xffff : count_, 2);
    put(out, is_large ? 0xffff : count_, 2);
    put(out, size, 4);
    put(out, at, 4);
    put(out, 0, 2);
    return out;
}

}  // namespace trisect::app
