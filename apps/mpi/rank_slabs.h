// SPDX-License-Identifier: Apache-2.0
//
// RankSlabs: one rank's part of a boolean in slabs.
#pragma once

#include <functional>
#include <string>

#include "trisect/options.h"
#include "trisect/outcome.h"
#include "trisect/session.h"
#include "trisect/slab_command.h"

namespace trisect::app {

/// Ranks go through the steps together. What fails on one of them is written into the folder; all
/// stop at the end of the step, and the first one speaks.
class RankSlabs {
public:
    RankSlabs(Session& session, const BooleanOptions& options);
    /// The outcome of the first rank; of the others nothing. \throw Error
    [[nodiscard]] Outcome run();

private:
    void step(const char* name, const std::function<void()>& work);
    void survey();
    void distribute();
    void evaluate();
    [[nodiscard]] JoinedMesh join();
    /// Makes a file that nobody else has made.
    [[nodiscard]] bool claim(std::size_t slab) const;
    [[nodiscard]] bool has_failed() const;
    [[nodiscard]] std::string note_name() const;
    void reserve_note() const;
    void note_failure(int code, const std::string& message) const;
    [[noreturn]] void fail();

    Session& session_;
    const BooleanOptions& options_;
    SlabOptions slabs_;
    SlabRun slab_run_;
    std::size_t shares_ = 0;
    bool has_folder_ = false;  ///< of this job: other ranks find there what failed
};

}  // namespace trisect::app
