// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <trisect/brep/io/output_file.h>
#include <trisect/kernel/error.h>

namespace trisect::app {
namespace {

constexpr int output_descriptor = 1;
constexpr int error_descriptor = 2;

// A closed standard error is no reason to stop.
void try_write_error(std::string_view text) {
    try {
        write_descriptor(error_descriptor, "standard error", text);
    } catch (const Error&) {
        return;
    }
}

}  // namespace

void Console::write_error_line(std::string_view text) {
    const std::lock_guard lock(mutex_);
    std::string line = progress_shown_ ? "\r\033[K" : "";
    progress_shown_ = false;
    line.append(text);
    if (line.empty() || line.back() != '\n') line += '\n';
    try_write_error(line);
}

void Console::note(std::string_view text) {
    if (!quiet_ && !text.empty()) write_error_line(text);
}

void Console::complain(std::string_view text) { write_error_line(text); }

void Console::print(std::string_view text) {
    if (!text.empty()) write_descriptor(output_descriptor, "standard output", text);
}

void Console::show_progress(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (line.empty() && !progress_shown_) return;
    progress_shown_ = !line.empty();
    try_write_error("\r" + line + "\033[K");
}

}  // namespace trisect::app
