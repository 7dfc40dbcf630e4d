// SPDX-License-Identifier: Apache-2.0
//
// RankStation: the work of every rank, the coordinating one as well.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "local_rank.h"
#include "manifest_reading.h"
#include "part_source.h"
#include "part_store.h"
#include "rank_clash_command.h"
#include "ranks.h"
#include "trisect/clash_journal.h"
#include "trisect/session.h"

namespace trisect::app {

/// What a rank has before messages.
struct RankBegin {
    ManifestReading& reading;
    RankSteps steps;
};

/// Answers messages, one after the other; what it has to do then is done by a second thread, so
/// that other ranks that need a tile need not wait.
///
///   1. It reads shares of the manifest. Hashes of identities go to the ranks that compare them,
///      and what else the coordinating rank needs of all of them.
///   2. It reads files, as ordered. When all boxes are known, it says where its parts are.
///   3. When space is divided into regions, its parts go to the ranks that have these, and it
///      divides its own regions into tiles.
///   4. It does slices of tiles, as ordered: of its own, and of ranks that have more left.
class RankStation {
public:
    RankStation(Session& session, const RankClashOptions& options, const RankBegin& begin,
                Ranks& ranks);

    /// The first step.
    void begin();
    /// Until the start.
    [[nodiscard]] const SharedManifest& manifest() const { return source_.manifest(); }
    /// All parts, on the first rank, where they are not divided.
    void take_parts(std::vector<ClashPart> parts) { source_.take(std::move(parts)); }
    /// Pieces of earlier runs, on the first rank, for its journal.
    void take_over(FinishedPieces done) { kept_ = std::move(done); }
    /// False: the message is for a coordinator. What fails is a result. \throw CancelledError
    [[nodiscard]] bool take(const Ranks::Message& message);
    /// Sends what is done. \throw CancelledError
    bool send_results();
    [[nodiscard]] bool has_ended() const { return has_ended_; }
    /// Drops what is left to do.
    void stop();
    /// For a while, or until a task is done.
    void wait(Patience& patience) const;

private:
    void handle(const Ranks::Message& message);
    void take_task(RankTask task);
    [[nodiscard]] bool has_kept(const RankOrder& order) const;
    void compare(const std::string& hashes);
    void start(const std::string& bytes);
    void obey(const RankOrder& order);
    void survey(const std::string& files);
    void route(const std::string& regions);
    void add_parts(const std::string& bytes);
    void divide_if_all_are_here();
    void end();
    void answer(const RankAnswer& answer);
    void answer(RankResult&& result);

    Session& session_;
    const RankClashOptions& options_;
    Ranks& ranks_;
    std::size_t own_;
    std::size_t count_;

    ManifestReading& reading_;
    RankSteps steps_;
    PartSource source_;
    std::size_t compared_ = 0;
    std::vector<std::uint64_t> hashes_;
    FinishedPieces kept_;
    std::optional<RankStart> start_;
    std::unique_ptr<LocalRank> local_;
    std::vector<ClashFile> files_;
    std::optional<RegionPlan> plan_;
    std::vector<std::string> early_;  // parts from ranks that had the regions first
    std::size_t sources_left_ = 0;
    std::optional<PartStore> store_;
    RankTask kept_tile_;       // the last one of another rank that came alone
    std::uint64_t boxes_ = 0;  // computed
    bool has_ended_ = false;
};

/// The journal of a rank, beside the first output.
[[nodiscard]] std::string rank_journal(const RankClashOptions& options, int rank);

/// All that a rank other than the coordinating one does. \throw CancelledError
void serve(Session& session, const RankClashOptions& options, const RankBegin& begin);

}  // namespace trisect::app
