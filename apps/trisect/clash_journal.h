// SPDX-License-Identifier: Apache-2.0
//
// ClashJournal: the finished parts of a run, beside its report.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "outcome.h"

namespace trisect::app {

/// What finished pieces of work gave, by their numbers.
using FinishedPieces = std::map<std::uint64_t, Json>;

/// The pieces of a journal; none where there is no file. What its last line lacks is left out.
/// \throw UsageError for a journal with another key: of another run
[[nodiscard]] FinishedPieces read_clash_journal(const std::string& path, const std::string& key);

/// One line of JSON for each finished piece of work, appended and flushed to the disk at least
/// once a second. A run that was killed goes on from there.
class ClashJournal {
public:
    /// Begins the file anew, with the pieces that are given. `key` is of all that the answers
    /// depend on. \throw Error (Input) when it cannot be written
    ClashJournal(std::string path, const std::string& key, const FinishedPieces& kept);
    ClashJournal(const ClashJournal&) = delete;
    ClashJournal& operator=(const ClashJournal&) = delete;
    ~ClashJournal();

    void add(std::uint64_t piece, const Json& records);
    /// Several entries at once, as entry() makes them.
    void add(const std::string& entries);
    [[nodiscard]] static std::string entry(std::uint64_t piece, const Json& records);
    /// After the report was written.
    void remove();

private:
    std::string path_;
    int descriptor_ = -1;
    std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace trisect::app
