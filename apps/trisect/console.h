// SPDX-License-Identifier: Apache-2.0
//
// Console: the two output streams of the command, and their final document.
//
// Results go to the standard output, everything else to the standard error. With --json the
// standard output holds exactly one document whatever happens: two threads may want to print it,
// the one that works and the one that watches the clock and the signals, so the right to end the
// program is claimed once.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <string_view>

namespace trisect::app {

class Console {
public:
    /// Anything of stderr that --quiet suppresses. A new line is added.
    void note(std::string_view text);
    /// Shown also when quiet.
    void complain(std::string_view text);
    /// Writes to the standard output. \throw Error (Input) when the reader is gone.
    void print(std::string_view text);

    /// True for the first caller only; from then on the others have nothing to say any more.
    [[nodiscard]] bool claim_end() { return !ended_.exchange(true); }

    void set_quiet(bool quiet) { quiet_ = quiet; }
    [[nodiscard]] bool is_quiet() const { return quiet_; }

    /// Draws or replaces the progress line; an empty text takes it away.
    void show_progress(const std::string& line);

private:
    void write_error_line(std::string_view text);

    std::mutex mutex_;
    std::atomic<bool> ended_ = false;
    std::atomic<bool> quiet_ = false;
    bool progress_shown_ = false;
};

}  // namespace trisect::app
