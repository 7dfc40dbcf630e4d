// SPDX-License-Identifier: Apache-2.0
//
// The size of the file bounds all counts before anything is multiplied or allocated.

#include <trisect/bsp/native/native_view.h>

#include <algorithm>
#include <utility>

#include <trisect/bsp/native/checksum.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

// As of exact boundaries.
constexpr std::int32_t least_exponent = -1200;
constexpr std::int32_t largest_exponent = 1016;

}  // namespace

NativeView::NativeView(std::string_view bytes, std::string name)
    : bytes_(bytes), name_(std::move(name)) {
    read_header();
    is_checked_ = std::make_unique<std::atomic<bool>[]>(header_.blocks());
    const std::string_view table = bytes_.substr(header_.checksums(), 8 * header_.blocks());
    if (crc64(table) != load<std::uint64_t, false>(table.data() + table.size()))
        fail(header_.checksums(), "the table of checksums is damaged");
}

void NativeView::read_header() {
    if (!bytes_.starts_with(native_magic)) {
        const bool is_start = !bytes_.empty() && native_magic.starts_with(bytes_);
        fail(is_start ? bytes_.size() : 0,
             is_start ? "the file ends within its header" : "this is no native file");
    }
    if (bytes_.size() < native_header_bytes) fail(bytes_.size(), "the file ends within its header");
    NativeCursor from(bytes_.data() + native_place::version);
    header_.version = from.next<std::uint32_t>();
    if (header_.version != native_version)
        fail(native_place::version, "version " + std::to_string(header_.version) +
                                        " of native files; this program reads version " +
                                        std::to_string(native_version));
    if (crc64(bytes_.substr(0, native_place::checksum)) !=
        load<std::uint64_t, false>(bytes_.data() + native_place::checksum))
        fail(native_place::checksum, "the header is damaged");
    if (from.next<std::uint32_t>() != native_header_bytes)
        fail(native_place::header_bytes, "a header of another size");
    const auto file_bytes = from.next<std::uint64_t>();
    if (file_bytes != bytes_.size())
        fail(std::min<std::uint64_t>(bytes_.size(), file_bytes),
             "the file has " + std::to_string(bytes_.size()) + " bytes, and its header says " +
                 std::to_string(file_bytes));
    header_.exponent = from.next<std::int32_t>();
    if (header_.exponent < least_exponent || header_.exponent > largest_exponent)
        fail(native_place::exponent, "a lattice out of range");
    header_.flags = from.next<std::uint32_t>();
    if ((header_.flags & ~NativeFlag::all) != 0) fail(native_place::flags, "an unknown flag");
    header_.far_out = from.next<std::int32_t>();
    if (header_.far_out < -1 || header_.far_out > 1)
        fail(native_place::far_out, "a number that is not -1, 0 or 1");
    header_.source = from.next<std::uint32_t>();
    header_.box = from.next_box();
    header_.polygons = from.next<std::uint64_t>();
    header_.depth = from.next<std::uint64_t>();
    read_counts();
}

void NativeView::read_counts() {
    NativeCursor from(bytes_.data() + native_place::counts);
    for (std::size_t i = 0; i < native_sections; ++i) {
        header_.counts[i] = from.next<std::uint64_t>();
        if (header_.counts[i] > bytes_.size() / native_record_bytes[i])
            fail(native_place::counts + 8 * i, "more records than the file has room for");
    }
    const auto rest =
        bytes_.substr(native_place::zeros, native_place::checksum - native_place::zeros);
    if (rest.find_first_not_of('\0') != std::string_view::npos)
        fail(native_place::zeros, "bytes that are not zero");
    if (header_.file_bytes() != bytes_.size())
        fail(native_place::counts, "the counts do not make up the size of the file");
}

void NativeView::check_block(std::size_t block) const {
    if (is_checked_[block].load(std::memory_order_acquire)) return;
    const std::uint64_t begin = block * native_block_bytes;
    const std::uint64_t size =
        std::min<std::uint64_t>(native_block_bytes, header_.checksums() - begin);
    const auto stored = load<std::uint64_t, false>(bytes_.data() + header_.checksums() + 8 * block);
    if (crc64(bytes_.substr(begin, size)) != stored)
        fail(begin, "the " + std::to_string(size) + " bytes from here on are damaged");
    is_checked_[block].store(true, std::memory_order_release);
}

void NativeView::check_all(std::uint32_t threads) const {
    const ParallelParts parts(header_.blocks(), threads, 16);
    parts.for_each([&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) check_block(i);
    });
}

const char* NativeView::records(NativeSection section, std::uint64_t first,
                                std::uint64_t count) const {
    const std::uint64_t begin = place(section, first);
    const std::uint64_t end = place(section, first + count);
    for (std::uint64_t b = begin / native_block_bytes; b * native_block_bytes < end; ++b)
        check_block(b);
    return bytes_.data() + begin;
}

}  // namespace trisect::detail
