// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/native/native_mapping.h>

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
    throw InputError(FilePlace{path.string(), 0, 0, 0},
                     "cannot read: " + std::generic_category().message(error));
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path, errno);
    struct stat status {};
    int error = 0;
    if (::fstat(descriptor, &status) != 0)
        error = errno;
    else if (!S_ISREG(status.st_mode))
        error = S_ISDIR(status.st_mode) ? EISDIR : ESPIPE;
    if (error == 0 && status.st_size > 0) {
        size_ = static_cast<std::size_t>(status.st_size);
        data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
        if (data_ == MAP_FAILED) error = errno;
    }
    ::close(descriptor);
    if (error != 0) fail(path, error);
}

MappedFile::~MappedFile() {
    if (size_ != 0) ::munmap(data_, size_);
}

}  // namespace trisect::detail
