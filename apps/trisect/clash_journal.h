// SPDX-License-Identifier: Apache-2.0
//
// ClashJournal: the finished parts of a run, beside its report.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

#include "outcome.h"

namespace trisect::app {

/// One line of JSON for each finished piece of work, appended and flushed to the disk at least
/// once a second. A run that was killed goes on from there; what the last line lacks is done again.
class ClashJournal {
public:
    /// `key` is of all that the answers depend on. With `resume` the pieces of a journal with the
    /// same key are kept; another one is an error, none is a fresh start.
    /// \throw UsageError for a journal of another run; Error (Input) when it cannot be written
    ClashJournal(std::string path, const std::string& key, bool resume);
    ClashJournal(const ClashJournal&) = delete;
    ClashJournal& operator=(const ClashJournal&) = delete;
    ~ClashJournal();

    /// Null where it is still to be done.
    [[nodiscard]] const Json* done(std::size_t piece) const;
    void add(std::size_t piece, Json records);
    /// After the report was written.
    void remove();

private:
    void read(const std::string& key);
    void append(const std::string& line);

    std::string path_;
    int descriptor_ = -1;
    std::map<std::size_t, Json> done_;
    std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace trisect::app
