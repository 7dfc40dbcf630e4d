// SPDX-License-Identifier: Apache-2.0
//
// Running the command as a program.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace trisect::test {

struct Finished {
    int code = -1;   ///< exit code; -1 when a signal ended the process
    int signal = 0;  ///< that signal
    std::string out;
    std::string err;
    /// The one document on the standard output. Fails the test when it is not exactly one.
    [[nodiscard]] nlohmann::json json() const;
};

struct Surroundings {
    std::string input{};                                             ///< standard input
    std::vector<std::pair<std::string, std::string>> environment{};  ///< variables to set
    /// The standard output goes to a new file of this name, if there is one.
    std::string output_file{};
};

/// Runs `trisect arguments...` and waits for it.
[[nodiscard]] Finished trisect(const std::vector<std::string>& arguments,
                               const Surroundings& surroundings = {});

/// A running command whose standard input is an open pipe, so that it waits.
class Waiting {
public:
    explicit Waiting(const std::vector<std::string>& arguments);
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;
    ~Waiting();

    void send_signal(int signal) const;
    [[nodiscard]] Finished finish();

private:
    struct State;
    State* state_;
};

/// Runs a command whose standard output is a pipe that nobody reads.
[[nodiscard]] Finished trisect_into_closed_pipe(const std::vector<std::string>& arguments);

}  // namespace trisect::test
