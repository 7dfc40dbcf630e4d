// SPDX-License-Identifier: Apache-2.0
//
// RankSlabCommand: union, intersection and difference on many ranks.
#pragma once

#include <string>

#include "trisect/options.h"
#include "trisect/outcome.h"
#include "trisect/sub_command.h"

namespace trisect::app {

/// Every rank distributes a share of the triangles; then whoever is free takes the next slab. The
/// first rank decides the walls and joins the pieces. Pieces and mesh are the same bytes on any
/// number of ranks.
class RankSlabCommand final : public SubCommand {
public:
    void declare(CLI::App& app) override;
    [[nodiscard]] Outcome run(Session& session, const std::string& name) const override;
    /// Other ranks may still wait for this one.
    [[nodiscard]] bool is_open() const { return is_open_; }

private:
    BooleanOptions options_;
    mutable bool is_open_ = false;
};

}  // namespace trisect::app
