// SPDX-License-Identifier: Apache-2.0
#include "folder_lock.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <trisect/kernel/error.h>

namespace trisect::app {

namespace {

constexpr std::chrono::milliseconds between_looks{20};

// The run that had the lock may have removed the folder at its end.
bool is_there(int file, const std::string& name) {
    struct stat own {};
    struct stat named {};
    return ::fstat(file, &own) == 0 && ::stat(name.c_str(), &named) == 0 &&
           own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

bool is_held_by_another(int failed) { return failed == EWOULDBLOCK || failed == EINTR; }

Error held(const std::string& folder) {
    return Error(ErrorCode::Input, folder + ": another run is at work there");
}

Error no_file(const std::string& name) {
    return Error(ErrorCode::Input, name + ": cannot be opened: " + std::strerror(errno));
}

}  // namespace

void make_folder(const std::string& name) {
    std::error_code failed;
    std::filesystem::create_directories(name, failed);
    if (failed) throw Error(ErrorCode::Input, name + ": cannot be made: " + failed.message());
}

std::string lock_name(const std::string& folder) { return folder + "/job.lock"; }

FolderLock::FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
}

FolderLock::~FolderLock() { close(); }

void FolderLock::close() noexcept {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
}

void FolderLock::take(const std::string& folder, double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    const std::string name = lock_name(folder);
    for (;; std::this_thread::sleep_for(between_looks)) {
        close();
        make_folder(folder);
        file_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file_ < 0 && errno != ENOENT) throw no_file(name);
        if (file_ >= 0) {
            const int failed = ::flock(file_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
            if (!is_held_by_another(failed) && is_there(file_, name)) return;
        }
        if (Clock::now() > end) {
            close();
            throw held(folder);
        }
    }
}

void FolderLock::share() const {
    if (file_ >= 0) (void)::flock(file_, LOCK_SH);
}

void FolderLock::join(const std::string& folder) {
    close();
    const std::string name = lock_name(folder);
    file_ = ::open(name.c_str(), O_RDWR | O_CLOEXEC);
    if (file_ < 0) throw no_file(name);
    if (::flock(file_, LOCK_SH | LOCK_NB) == 0 || !is_held_by_another(errno)) return;
    close();
    throw held(folder);
}

}  // namespace trisect::app
