// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT: as POSIX declares it

namespace trisect::app {
namespace {

constexpr std::size_t most_said = 1'000'000;
constexpr int poll_milliseconds = 50;

[[noreturn]] void fail(const std::string& program, int error) {
    if (error == ENOENT) throw MissingProgram(program + ": there is no such program");
    throw Error(ErrorCode::Input, program + ": cannot be run: " + std::strerror(error));
}

class Pipe {
public:
    explicit Pipe(const std::string& program) {
        if (::pipe2(ends_.data(), O_CLOEXEC) != 0) fail(program, errno);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe() {
        ::close(ends_[0]);
        close_writing();
    }
    [[nodiscard]] int reading() const { return ends_[0]; }
    [[nodiscard]] int writing() const { return ends_[1]; }
    void close_writing() {
        if (ends_[1] >= 0) ::close(ends_[1]);
        ends_[1] = -1;
    }

private:
    std::array<int, 2> ends_{-1, -1};
};

/// What a new process gets: our streams in the pipe, a group of its own, and the signals as they
/// are for others; this process blocks some and ignores one.
class SpawnSettings {
public:
    explicit SpawnSettings(int output) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, output, STDERR_FILENO);
        posix_spawnattr_init(&attributes_);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes_, &none);
        sigset_t pipe;
        sigemptyset(&pipe);
        sigaddset(&pipe, SIGPIPE);
        posix_spawnattr_setsigdefault(&attributes_, &pipe);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(
            &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }

    [[nodiscard]] pid_t spawn(std::vector<std::string> words) const {
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        pid_t child = 0;
        const int error = ::posix_spawnp(&child, arguments[0], &actions_, &attributes_,
                                         arguments.data(), environ);
        if (error != 0) fail(words[0], error);
        return child;
    }

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

/// A process that is killed, with its group, unless it was waited for.
class Child {
public:
    explicit Child(pid_t process) : process_(process) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (process_ == 0) return;
        kill();
        (void)wait();
    }
    /// By any thread.
    void kill() const {
        const pid_t process = process_;
        if (process > 0) ::kill(-process, SIGKILL);
    }
    int wait() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
        process_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    std::atomic<pid_t> process_;
};

/// Until the other end is closed. \throw CancelledError
void read_all(Session& session, int descriptor, std::string& out) {
    std::array<char, 4096> buffer{};
    while (true) {
        if (session.supervisor().stop_flag()) throw CancelledError();
        pollfd entry{descriptor, POLLIN, 0};
        const int ready = ::poll(&entry, 1, poll_milliseconds);
        if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
        const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return;
        const std::size_t room = most_said - std::min(most_said, out.size());
        out.append(buffer.data(), std::min(static_cast<std::size_t>(count), room));
    }
}

}  // namespace

ChildOutcome run_child(Session& session, const std::vector<std::string>& words) {
    Pipe pipe(words[0]);
    Child child(SpawnSettings(pipe.writing()).spawn(words));
    const EndGuard guard(session.supervisor(), [&child] { child.kill(); });
    pipe.close_writing();
    ChildOutcome out;
    read_all(session, pipe.reading(), out.said);
    out.code = child.wait();
    return out;
}

}  // namespace trisect::app
