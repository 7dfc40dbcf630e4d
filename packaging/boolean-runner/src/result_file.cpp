// SPDX-License-Identifier: Apache-2.0
#include "result_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace runner {

ResultFile::ResultFile(std::string path, const nlohmann::json& request) : path_(std::move(path)) {
    document_["kind"] = request.value("kind", "boolean-benchmark");
    document_["version"] = request.value("version", 1);
    document_["id"] = request.value("id", "");
    document_["runs"] = nlohmann::json::array();
}

void ResultFile::add(nlohmann::json result) {
    document_["runs"].push_back(std::move(result));
    if (std::chrono::steady_clock::now() - written_ > std::chrono::seconds(10)) write();
}

void ResultFile::write() {
    const std::string temporary = path_ + ".tmp";
    {
        std::ofstream file(temporary);
        file << document_.dump(2) << '\n';
        if (!file.flush()) throw std::runtime_error("cannot write " + temporary);
    }
    std::filesystem::rename(temporary, path_);
    written_ = std::chrono::steady_clock::now();
}

}  // namespace runner
