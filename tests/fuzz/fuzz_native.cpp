// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of native files. The bytes of an input change numbers of a small file, whose checksums
// are made right again, or are the file. What is read must come back from what is written of it,
// and can be used: errors are all that may come of it.
#include <trisect/bsp/expression.h>
#include <trisect/bsp/native/checksum.h>
#include <trisect/bsp/native/native_layout.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "byte_source.h"
#include "grid_solids.h"

namespace {

using trisect::NativeFile;
using trisect::Solid;

void require(bool condition) {
    if (!condition) std::abort();
}

void put_number(std::string& bytes, std::size_t at, std::uint64_t n) {
    std::memcpy(bytes.data() + at, &n, 8);
}

// The file is of one block.
void make_checksums(std::string& bytes) {
    using trisect::detail::crc64;
    const std::string_view view = bytes;
    const std::size_t header = trisect::detail::native_place::checksum;
    put_number(bytes, header, crc64(view.substr(0, header)));
    put_number(bytes, bytes.size() - 16, crc64(view.substr(0, bytes.size() - 16)));
    put_number(bytes, bytes.size() - 8, crc64(view.substr(bytes.size() - 16, 8)));
}

std::string changed_file(fuzz::ByteSource& bytes) {
    const Solid a = fuzz::grid_solid(bytes);
    const Solid b = fuzz::grid_solid(bytes);
    std::string file = native_bytes(bytes.below(2) == 0 ? evaluate(a - b) : evaluate(a | b));
    if (file.size() > 65536) return {};
    for (unsigned n = bytes.below(4); n > 0; --n) {
        const std::size_t at =
            24 + (bytes.below(256) * 256 + bytes.below(256)) % (file.size() - 48);
        if (bytes.below(2) == 0)
            file[at] = static_cast<char>(file[at] ^ static_cast<char>(1U << bytes.below(8)));
        else
            put_number(file, at / 8 * 8, static_cast<std::uint64_t>(bytes.between(-3, 20)));
    }
    make_checksums(file);
    return file;
}

void use(const std::string& bytes) {
    const Solid solid = NativeFile::of_bytes(bytes, "fuzz").solid({.threads = 1});
    const std::string again = native_bytes(solid, {.threads = 1});
    require(native_bytes(NativeFile::of_bytes(again, "again").solid({.threads = 1})) == again);
    (void)solid.to_mesh(1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    try {
        fuzz::ByteSource bytes(data + 1, size - 1);
        use(data[0] % 8 == 0 ? std::string(reinterpret_cast<const char*>(data) + 1, size - 1)
                             : changed_file(bytes));
    } catch (const trisect::Error& e) {
        require(e.code() != trisect::ErrorCode::Usage);
    }
    return 0;
}
