// SPDX-License-Identifier: Apache-2.0
#include "piecewise_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <trisect/kernel/error.h>

namespace trisect::app {

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;

std::string system_reason() { return std::strerror(errno); }

[[noreturn]] void fail_to_write(const std::string& name) {
    throw Error(ErrorCode::Input, name + ": cannot be written: " + system_reason());
}

}  // namespace

InputFile::InputFile(std::string name) : name_(std::move(name)) {
    descriptor_ = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat facts {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &facts) != 0)
        throw Error(ErrorCode::Input, name_ + ": " + system_reason());
    if (!S_ISREG(facts.st_mode)) throw Error(ErrorCode::Input, name_ + ": is no file");
    size_ = static_cast<std::uint64_t>(facts.st_size);
}

InputFile::~InputFile() {
    if (mapping_ != nullptr) ::munmap(mapping_, size_);
    ::close(descriptor_);
}

void InputFile::read(std::uint64_t offset, std::span<char> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = ::pread(descriptor_, bytes.data() + done, bytes.size() - done,
                                  static_cast<off_t>(offset + done));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw Error(ErrorCode::Input, name_ + ": " + system_reason());
        if (n == 0) throw InputError({name_, 0, 0, offset + done}, "the file ends here");
        done += static_cast<std::size_t>(n);
    }
}

const char* InputFile::mapped() const {
    if (mapping_ == nullptr) {
        void* const at = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, descriptor_, 0);
        if (at == MAP_FAILED) throw Error(ErrorCode::Limit, name_ + ": " + system_reason());
        mapping_ = at;
    }
    return static_cast<const char*>(mapping_);
}

void InputFile::release() const {
    if (mapping_ != nullptr) (void)::madvise(mapping_, size_, MADV_DONTNEED);
}

OutputStream::OutputStream(std::string name)
    : name_(std::move(name)), temporary_(name_ + ".part-" + std::to_string(::getpid())) {
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail();
}

OutputStream::~OutputStream() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
}

void OutputStream::fail() const { fail_to_write(name_); }

void OutputStream::write(const void* bytes, std::size_t count) {
    buffer_.append(static_cast<const char*>(bytes), count);
    if (buffer_.size() >= buffer_bytes) flush();
}

void OutputStream::flush() {
    std::size_t done = 0;
    while (done < buffer_.size()) {
        const ssize_t n = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail();
        done += static_cast<std::size_t>(n);
    }
    buffer_.clear();
}

void OutputStream::finish() {
    flush();
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail();
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0 || ::rename(temporary_.c_str(), name_.c_str()) != 0) {
        const int kept = errno;
        ::unlink(temporary_.c_str());
        errno = kept;
        fail();
    }
}

OutputPart::OutputPart(std::string name, std::uint64_t offset)
    : name_(std::move(name)), offset_(offset) {
    descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail_to_write(name_);
}

OutputPart::~OutputPart() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputPart::write(const void* bytes, std::size_t count) {
    buffer_.append(static_cast<const char*>(bytes), count);
    if (buffer_.size() >= buffer_bytes) flush();
}

void OutputPart::flush() {
    std::size_t done = 0;
    while (done < buffer_.size()) {
        const ssize_t n = ::pwrite(descriptor_, buffer_.data() + done, buffer_.size() - done,
                                   static_cast<off_t>(offset_));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail_to_write(name_);
        done += static_cast<std::size_t>(n);
        offset_ += static_cast<std::uint64_t>(n);
    }
    buffer_.clear();
}

void OutputPart::finish() {
    flush();
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail_to_write(name_);
    if (::close(std::exchange(descriptor_, -1)) != 0) fail_to_write(name_);
}

void make_file(const std::string& name, std::uint64_t size) {
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) fail_to_write(name);
    const int resized = ::ftruncate(descriptor, static_cast<off_t>(size));
    if (::close(descriptor) != 0 || resized != 0) fail_to_write(name);
}

void rename_file(const std::string& from, const std::string& to) {
    if (::rename(from.c_str(), to.c_str()) != 0) fail_to_write(to);
}

}  // namespace trisect::app
