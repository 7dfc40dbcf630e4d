// SPDX-License-Identifier: Apache-2.0
//
// Reading until the system says the end. The size that the system reports beforehand is a hint
// only: it is zero for pipes and wrong for files that grow. It sizes the first buffer, never
// beyond the limit; after that the buffer doubles as bytes really arrive.
#include <trisect/brep/io/file_bytes.h>

#include <trisect/kernel/error.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace trisect {
namespace {

[[noreturn]] void fail(const std::string& name, std::uint64_t offset, int error) {
    throw InputError(FilePlace{name, 0, 0, offset},
                     "cannot read: " + std::generic_category().message(error));
}

[[noreturn]] void too_large(const std::string& name, std::uint64_t limit) {
    throw LimitError(name + ": more than " + std::to_string(limit) +
                     " bytes, the limit for a file");
}

/// Closes on every way out.
class Descriptor {
public:
    explicit Descriptor(int value) noexcept : value_(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    [[nodiscard]] int get() const noexcept { return value_; }

private:
    int value_;
};

std::uint64_t size_hint(int descriptor) noexcept {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return 0;
    return static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
}

/// A buffer that grows without touching the bytes it has not received.
class Buffer {
public:
    explicit Buffer(std::size_t capacity)
        : data_(std::make_unique_for_overwrite<char[]>(capacity)), capacity_(capacity) {}
    void grow() {
        auto larger = std::make_unique_for_overwrite<char[]>(capacity_ * 2);
        std::memcpy(larger.get(), data_.get(), size_);
        data_ = std::move(larger);
        capacity_ *= 2;
    }
    [[nodiscard]] char* free_space() noexcept { return data_.get() + size_; }
    [[nodiscard]] std::size_t free_size() const noexcept { return capacity_ - size_; }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    void add(std::size_t bytes) noexcept { size_ += bytes; }
    [[nodiscard]] FileBytes take() { return {std::move(data_), size_}; }

private:
    std::unique_ptr<char[]> data_;
    std::size_t capacity_;
    std::size_t size_ = 0;
};

}  // namespace

FileBytes read_descriptor(int descriptor, const std::string& name, std::uint64_t limit) {
    const std::uint64_t hint = size_hint(descriptor);
    if (hint > limit) too_large(name, limit);
    // One byte more than the hint, so that the read that meets the end needs no larger buffer.
    Buffer buffer(static_cast<std::size_t>(std::max<std::uint64_t>(hint, 65535) + 1));
    for (;;) {
        if (buffer.free_size() == 0) buffer.grow();
        const ssize_t got = ::read(descriptor, buffer.free_space(), buffer.free_size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(name, buffer.size(), errno);
        if (got == 0) return buffer.take();
        buffer.add(static_cast<std::size_t>(got));
        if (buffer.size() > limit) too_large(name, limit);
    }
}

FileBytes read_file(const std::filesystem::path& path, std::uint64_t limit) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) fail(path.string(), 0, errno);
    return read_descriptor(file.get(), path.string(), limit);
}

}  // namespace trisect
