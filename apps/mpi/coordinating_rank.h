// SPDX-License-Identifier: Apache-2.0
//
// CoordinatingRank: rank 0.
// It reads the manifest, hands out the work, and writes the report.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coordinator.h"
#include "local_rank.h"
#include "rank_clash_command.h"
#include "ranks.h"
#include "serving_rank.h"
#include "trisect/session.h"

namespace trisect::app {

/// It does tasks as well, on a second thread. A run that fails or is stopped leaves what was found
/// until then, and the cells that it did not come to, in a report of its own, and the journals of
/// all ranks.
class CoordinatingRank {
public:
    /// \param is_open set to false when no other rank waits any more
    CoordinatingRank(Session& session, const RankClashOptions& options, bool& is_open);

    /// \throw what ended the run
    [[nodiscard]] Outcome run();

private:
    struct Rank {
        int asks_for = 0;  ///< tasks
        std::size_t tasks = 0;
        double seconds = 0;
        RankResult end;
        bool has_ended = false;
    };

    void begin();
    [[nodiscard]] ClashManifest read_manifest();
    void hand_out();
    [[nodiscard]] bool accept_all();
    void accept(std::size_t rank, RankResult&& result);
    [[nodiscard]] bool give_all();
    void show_progress();
    void end_ranks(std::optional<double> seconds);
    void write(const ClashReport& report);
    void write_partial() noexcept;
    [[nodiscard]] std::string partial_name() const;
    [[nodiscard]] std::vector<std::string> journals() const;
    [[nodiscard]] Outcome outcome(const ClashReport& report) const;

    Session& session_;
    const RankClashOptions& options_;
    bool& is_open_;
    Ranks ranks_;
    std::vector<Rank> all_;
    ClashManifest manifest_;
    std::optional<Coordinator> coordinator_;
    std::unique_ptr<LocalRank> local_;
};

}  // namespace trisect::app
