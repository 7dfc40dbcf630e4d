// SPDX-License-Identifier: Apache-2.0
#include "output_name.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace trisect::app {

void check_output_name(const Session& session, const std::string& name,
                       std::string_view extension) {
    if (name.empty()) return;
    if (name == "-") {
        if (!session.options().json) return;
        throw UsageError("--json and '-o -' both want the standard output");
    }
    std::string found = std::filesystem::path(name).extension().string();
    std::transform(found.begin(), found.end(), found.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (found.empty() || found == extension) return;
    throw UsageError(fmt::format("{}: the output is written as {}", name, extension));
}

}  // namespace trisect::app
