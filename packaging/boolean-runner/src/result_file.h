// SPDX-License-Identifier: Apache-2.0
//
// The result file of a benchmark, as far as it goes.
#pragma once

#include <nlohmann/json.hpp>

#include <chrono>
#include <string>

namespace runner {

/// The envelope and the cases so far. A runner may be killed at any time, so the file is written
/// every ten seconds, under another name first.
class ResultFile {
public:
    ResultFile(std::string path, const nlohmann::json& request);

    void add(nlohmann::json result);
    /// \throw std::runtime_error when the file cannot be written.
    void write();

private:
    std::string path_;
    nlohmann::json document_;
    std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace runner
