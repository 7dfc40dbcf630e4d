// SPDX-License-Identifier: Apache-2.0
//
// The streams of the child are files, not pipes: nothing can block because nobody reads.
#include "process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace trisect::test {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporary_file() {
    File file(std::tmpfile(), &std::fclose);
    if (!file) throw std::runtime_error("no temporary file");
    return file;
}

File named_file(const std::string& path) {
    File file(std::fopen(path.c_str(), "w+"), &std::fclose);
    if (!file) throw std::runtime_error("cannot make " + path);
    return file;
}

std::string content_of(const File& file) {
    std::string text;
    std::rewind(file.get());
    char buffer[4096];
    std::size_t n = 0;
    while ((n = std::fread(buffer, 1, sizeof buffer, file.get())) > 0) text.append(buffer, n);
    return text;
}

struct Streams {
    int in;
    int out;
    int err;
};

[[noreturn]] void become_command(const std::vector<std::string>& arguments, const Streams& streams,
                                 const Surroundings& surroundings) {
    ::dup2(streams.in, 0);
    ::dup2(streams.out, 1);
    ::dup2(streams.err, 2);
    for (const auto& [name, value] : surroundings.environment) {
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), TRISECT_COMMAND);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(TRISECT_COMMAND, argv.data());
    std::_Exit(127);
}

pid_t start(const std::vector<std::string>& arguments, const Streams& streams,
            const Surroundings& surroundings) {
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) become_command(arguments, streams, surroundings);
    return child;
}

Finished wait_for(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    Finished result;
    if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

}  // namespace

nlohmann::json Finished::json() const {
    nlohmann::json document = nlohmann::json::parse(out, nullptr, false);
    EXPECT_FALSE(document.is_discarded()) << "not one JSON document: " << out << err;
    EXPECT_TRUE(document.contains("schema")) << out;
    return document;
}

Finished trisect(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
    const File in = temporary_file();
    const File out =
        surroundings.output_file.empty() ? temporary_file() : named_file(surroundings.output_file);
    const File err = temporary_file();
    std::fwrite(surroundings.input.data(), 1, surroundings.input.size(), in.get());
    std::rewind(in.get());
    Finished result = wait_for(start(
        arguments, {::fileno(in.get()), ::fileno(out.get()), ::fileno(err.get())}, surroundings));
    result.out = content_of(out);
    result.err = content_of(err);
    return result;
}

struct Waiting::State {
    File out = temporary_file();
    File err = temporary_file();
    int pipe_end = -1;
    pid_t child = -1;
};

Waiting::Waiting(const std::vector<std::string>& arguments) : state_(new State) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    state_->pipe_end = ends[1];
    state_->child =
        start(arguments, {ends[0], ::fileno(state_->out.get()), ::fileno(state_->err.get())}, {});
    ::close(ends[0]);
}

Waiting::~Waiting() {
    if (state_->child > 0) {
        ::kill(state_->child, SIGKILL);
        (void)wait_for(state_->child);
    }
    ::close(state_->pipe_end);
    delete state_;
}

void Waiting::send_signal(int signal) const { ::kill(state_->child, signal); }

Finished Waiting::finish() {
    Finished result = wait_for(state_->child);
    state_->child = -1;
    result.out = content_of(state_->out);
    result.err = content_of(state_->err);
    return result;
}

Finished trisect_into_closed_pipe(const std::vector<std::string>& arguments) {
    const File in = temporary_file();
    const File err = temporary_file();
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    ::close(ends[0]);
    Finished result =
        wait_for(start(arguments, {::fileno(in.get()), ends[1], ::fileno(err.get())}, {}));
    ::close(ends[1]);
    result.err = content_of(err);
    return result;
}

}  // namespace trisect::test
