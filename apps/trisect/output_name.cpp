// SPDX-License-Identifier: Apache-2.0
#include "output_name.h"

#include <trisect/brep/io/output_file.h>
#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

namespace trisect::app {
namespace {

namespace fs = std::filesystem;

// One output and what tells whether another one is the same.
struct Output {
    std::string name;    // in messages
    fs::path path;       // without links; empty for the standard output
    struct stat status;  // where it is open or there
    bool is_there = false;
};

Output standard_output() {
    Output out{"the standard output", {}, {}};
    out.is_there = ::fstat(STDOUT_FILENO, &out.status) == 0;
    return out;
}

Output output_named(const std::string& name) {
    if (name == "-") return standard_output();
    const fs::path target = output_target(name);
    std::error_code error;
    const fs::path folder =
        fs::weakly_canonical(target.has_parent_path() ? target.parent_path() : ".", error);
    Output out{name, folder / target.filename(), {}};
    out.is_there = ::stat(name.c_str(), &out.status) == 0;
    return out;
}

// Nobody misses what is written there.
bool is_null_device(const struct stat& status) {
    struct stat null {};
    return S_ISCHR(status.st_mode) && ::stat("/dev/null", &null) == 0 &&
           status.st_rdev == null.st_rdev;
}

bool are_same(const Output& a, const Output& b) {
    if (a.is_there != b.is_there) return false;
    if (!a.is_there) return !a.path.empty() && a.path == b.path;
    return a.status.st_dev == b.status.st_dev && a.status.st_ino == b.status.st_ino &&
           !is_null_device(a.status);
}

}  // namespace

void check_outputs(const Session& session, std::initializer_list<std::string> names,
                   Answer answer) {
    std::vector<Output> outputs;
    for (const std::string& name : names)
        if (!name.empty()) outputs.push_back(output_named(name));
    const bool is_named = std::find(names.begin(), names.end(), "-") != names.end();
    if (session.options().json || (answer == Answer::Printed && !is_named))
        outputs.push_back(standard_output());
    for (std::size_t i = 0; i < outputs.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (are_same(outputs[i], outputs[j]))
                throw UsageError(
                    fmt::format("{} and {} are the same file: one would replace the other",
                                outputs[j].name, outputs[i].name));
}

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
