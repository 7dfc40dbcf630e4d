// SPDX-License-Identifier: Apache-2.0
//
// RankSteps: the times at which a rank was done with what.
#pragma once

#include <array>
#include <cstddef>

namespace trisect::app {

struct RankSteps {
    /// In order. A rank that has no regions, or a run that ends early, leaves some out.
    enum Step : std::size_t {
        Began,     ///< the process
        Joined,    ///< MPI
        Read,      ///< its shares of the manifest
        Compared,  ///< hashes of identities
        Started,   ///< it knows all files and groups
        Surveyed,  ///< its parts: all files are known
        Routed,    ///< its parts
        Divided,   ///< its regions into tiles
        Ended,     ///< nothing was left
        count
    };
    static constexpr std::array<const char*, count> names{
        "began", "joined", "read", "compared", "started", "surveyed", "routed", "divided", "ended"};

    struct Time {
        double clock = 0;      ///< seconds of a clock that all ranks of one machine have in common
        double processor = 0;  ///< of all threads, since the process began
    };
    std::array<Time, count> times{};

    void note(Step step);
};

}  // namespace trisect::app
