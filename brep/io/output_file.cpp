// SPDX-License-Identifier: Apache-2.0
//
// Writing with the calls of the system, because streams hide why something failed. The naive way,
// opening the target itself, destroys the user's last good file when the disk is full.
#include <trisect/brep/io/output_file.h>

#include <trisect/kernel/error.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <memory>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

namespace trisect {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& name, int error) {
    throw Error(ErrorCode::Input,
                name + ": cannot write: " + std::generic_category().message(error));
}

/// While it lives, a closed pipe gives EPIPE in this thread and no signal. A library may not change
/// what the program does with the signal, so it is held back and, if it came, taken out again.
class NoPipeSignal {
public:
    NoPipeSignal() noexcept {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigemptyset(&pending);
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    NoPipeSignal(const NoPipeSignal&) = delete;
    NoPipeSignal& operator=(const NoPipeSignal&) = delete;
    ~NoPipeSignal() {
        const timespec at_once{};
        if (!was_pending_) {
            while (sigtimedwait(&pipe_, nullptr, &at_once) < 0 && errno == EINTR) {
            }
        }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

private:
    sigset_t pipe_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

/// Writes all bytes; returns 0 or the error of the system.
int write_all(int descriptor, std::string_view bytes) noexcept {
    constexpr std::size_t most = std::size_t{1} << 30;  // Linux transfers less than 2 GiB at once
    while (!bytes.empty()) {
        const ssize_t n = ::write(descriptor, bytes.data(), std::min(bytes.size(), most));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        if (n == 0) return EIO;  // would loop for ever
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return 0;
}

/// A file under a name of its own that is removed again unless it was renamed.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        static std::atomic<std::uint32_t> serial{0};
        const std::string stem = ".trisect-" + std::to_string(::getpid()) + "-";
        for (int attempt = 0; attempt < 1000; ++attempt) {
            path_ = target.parent_path() / (stem + std::to_string(serial++));
            descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor_ >= 0 || errno != EEXIST) break;
        }
        if (descriptor_ < 0) fail(target.string(), errno);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!gone_) ::unlink(path_.c_str());
        if (!kept_.empty()) ::unlink(kept_.c_str());
    }

    void set_mode(mode_t mode) noexcept { (void)::fchmod(descriptor_, mode & 0777); }

    void write(std::string_view bytes, OutputSafety safety) {
        if (const int error = write_all(descriptor_, bytes)) abandon(error);
        if (safety == OutputSafety::Flushed && ::fsync(descriptor_) != 0) abandon(errno);
        const int closed = ::close(descriptor_);  // a quota or network file system may fail here
        descriptor_ = -1;
        if (closed != 0) abandon(errno);
    }

    void rename_to_target() {
        if (::rename(path_.c_str(), target_.c_str()) != 0) abandon(errno);
        gone_ = true;
    }

    /// A second name of the file that will be replaced, until this ends. Some file systems have
    /// none.
    void keep_target() {
        kept_ = path_;
        kept_ += "-old";
        if (::link(target_.c_str(), kept_.c_str()) != 0) kept_.clear();
    }
    /// Undoes a rename.
    void put_back(bool was_there) noexcept {
        if (!was_there) ::unlink(target_.c_str());
        if (was_there && !kept_.empty() && ::rename(kept_.c_str(), target_.c_str()) == 0)
            kept_.clear();
    }

    /// The name, too. Not all file systems can; the file is there all the same.
    void flush_folder() const noexcept {
        const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
        const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) return;
        (void)::fsync(descriptor);
        ::close(descriptor);
    }

private:
    /// Removes the file before it throws: an uncaught exception runs no destructor.
    [[noreturn]] void abandon(int error) {
        ::unlink(path_.c_str());
        gone_ = true;
        fail(target_.string(), error);
    }

    fs::path target_;
    fs::path path_;
    fs::path kept_;  ///< a second name of the target; empty: none
    int descriptor_ = -1;
    bool gone_ = false;  ///< renamed or removed
};

void write_directly(const fs::path& path, std::string_view bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path.string(), errno);
    const NoPipeSignal quiet;
    int error = write_all(descriptor, bytes);
    if (::close(descriptor) != 0 && error == 0) error = errno;
    if (error != 0) fail(path.string(), error);
}

}  // namespace

// Link by link: what std::filesystem resolves ends before a link to a file that is not there.
fs::path output_target(const fs::path& path) {
    constexpr int most_links = 40;  // as many as Linux follows
    fs::path target = path;
    std::error_code error;
    for (int links = 0; fs::is_symlink(target, error); ++links) {
        if (links == most_links) fail(path.string(), ELOOP);
        const fs::path next = fs::read_symlink(target, error);
        if (error) fail(path.string(), error.value());
        target = target.parent_path() / next;
    }
    return target;
}

void write_descriptor(int descriptor, const std::string& name, std::string_view bytes) {
    const NoPipeSignal quiet;
    if (const int error = write_all(descriptor, bytes)) fail(name, error);
}

// A file that is replaced is flushed in any case: some file systems write the new name before the
// new bytes, and a power failure between these would leave neither file.
void write_file(const fs::path& path, std::string_view bytes, OutputSafety safety) {
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists) safety = OutputSafety::Flushed;
    if (exists && !S_ISREG(status.st_mode)) return write_directly(path, bytes);
    TemporaryFile file(output_target(path));
    if (exists) file.set_mode(status.st_mode);
    file.write(bytes, safety);
    file.rename_to_target();
    if (safety == OutputSafety::Flushed) file.flush_folder();
}

void write_files(std::span<const OutputBytes> files) {
    struct Pending {
        std::unique_ptr<TemporaryFile> file;
        bool is_there = false;
        bool is_flushed = false;
    };
    std::vector<Pending> pending;
    for (const OutputBytes& f : files) {
        struct stat status {};
        const bool is_there = ::stat(f.path.c_str(), &status) == 0;
        if (is_there && !S_ISREG(status.st_mode)) continue;
        const bool is_flushed = is_there || f.safety == OutputSafety::Flushed;
        pending.push_back(
            {std::make_unique<TemporaryFile>(output_target(f.path)), is_there, is_flushed});
        TemporaryFile& file = *pending.back().file;
        if (is_there) file.set_mode(status.st_mode);
        file.write(f.bytes, is_flushed ? OutputSafety::Flushed : OutputSafety::Renamed);
    }
    for (const OutputBytes& f : files) {
        struct stat status {};
        if (::stat(f.path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
            write_directly(f.path, f.bytes);
    }
    for (std::size_t i = 0; i < pending.size(); ++i) {
        try {
            if (pending[i].is_there) pending[i].file->keep_target();
            pending[i].file->rename_to_target();
        } catch (...) {
            while (i-- > 0) pending[i].file->put_back(pending[i].is_there);
            throw;
        }
    }
    for (const Pending& p : pending)
        if (p.is_flushed) p.file->flush_folder();
}

}  // namespace trisect
