// SPDX-License-Identifier: Apache-2.0
//
// RankClashCommand: `clash` on many ranks.
#pragma once

#include <cstdint>
#include <string>

#include "trisect/options.h"
#include "trisect/outcome.h"
#include "trisect/sub_command.h"

namespace trisect::app {

struct RankClashOptions {
    ClashOptions clash;
    std::uint64_t most_bytes = std::uint64_t{1} << 30;  ///< of models that a rank keeps
    std::string costs;                                  ///< a table for them; empty: none
};

class RankClashCommand final : public SubCommand {
public:
    void declare(CLI::App& app) override;
    [[nodiscard]] Outcome run(Session& session, const std::string& name) const override;
    /// Other ranks may still wait for this one.
    [[nodiscard]] bool is_open() const { return is_open_; }

private:
    RankClashOptions options_;
    mutable bool is_open_ = false;
};

}  // namespace trisect::app
