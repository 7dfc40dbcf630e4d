// SPDX-License-Identifier: Apache-2.0
//
// CoordinatingRank: rank 0.
// It orders the work of all ranks, its own as well, and writes the report.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coordinator.h"
#include "rank_clash_command.h"
#include "rank_station.h"
#include "ranks.h"
#include "trisect/session.h"

namespace trisect::app {

/// A run that fails or is stopped leaves what was found until then, and the cells that it did not
/// come to, in a report of its own, and the journals of all ranks.
class CoordinatingRank {
public:
    /// \param is_open set to false when no other rank waits any more
    CoordinatingRank(Session& session, const RankClashOptions& options, const RankBegin& begin,
                     bool& is_open);

    /// \throw what ended the run
    [[nodiscard]] Outcome run();

private:
    struct Rank {
        bool is_ready = false;
        std::size_t has = 0;  ///< orders
        std::size_t tasks = 0;
        double seconds = 0;
        RankEnd end;
        bool has_ended = false;
    };

    void begin();
    void read_manifest();
    void read_whole_manifest();
    void read_files();
    void divide();
    /// Until it is so, or the run is over.
    void attend(const std::function<bool()>& is_done);
    [[nodiscard]] bool take_messages();
    void accept(std::size_t rank, RankAnswer&& answer);
    void accept_result(std::size_t rank, RankResult&& result);
    [[nodiscard]] bool give_all();
    void send_to_all(Ranks::Tag tag, const std::string& bytes);
    [[nodiscard]] RegionPlan plan_regions();
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
    RankStation station_;
    std::vector<Rank> all_;
    std::vector<ManifestSummary> summaries_;
    std::vector<PartSurvey> surveys_;  // by rank
    std::size_t surveys_left_;
    std::vector<TileSurvey> tiles_;
    ClashManifest manifest_;  // with the parts of clashes
    RankStart start_;
    std::optional<Coordinator> coordinator_;
};

}  // namespace trisect::app
