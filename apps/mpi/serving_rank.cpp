// SPDX-License-Identifier: Apache-2.0
#include "serving_rank.h"

#include <trisect/kernel/error.h>

#include <fmt/format.h>

#include <optional>

#include "rank_worker.h"
#include "ranks.h"
#include "trisect/failure.h"

namespace trisect::app {
namespace {

RankResult failed() {
    const Failure failure = current_failure();
    RankResult out;
    out.kind = RankResult::Kind::Failure;
    out.code = failure.code;
    out.message = failure.message;
    return out;
}

class ServingRank {
public:
    ServingRank(Session& session, const RankClashOptions& options)
        : session_(session), options_(options) {}

    void serve() {
        send_shares();
        while (true) {
            const Ranks::Message message = next();
            if (message.tag == Ranks::Start) {
                begin(rank_start_of(message.bytes));
                continue;
            }
            const RankTask task = rank_task_of(message.bytes);
            if (task.kind == RankTask::Kind::End) break;
            answer(worker_->done(task));
        }
        RankResult end;
        if (worker_) end = worker_->ended();
        end.kind = RankResult::Kind::End;
        end.received = ranks_.bytes();
        answer(end);
        while (!ranks_.has_sent_all()) patience_.wait();
    }

private:
    void send_shares() {
        const auto ranks = static_cast<std::size_t>(Ranks::count());
        const SharedManifest manifest(options_.clash.manifest, ranks);
        for (auto i = static_cast<std::size_t>(Ranks::rank()); i < manifest.shares(); i += ranks)
            ranks_.send(0, Ranks::Manifest, bytes_of(SharedParts{i, manifest.read(i)}));
        if (manifest.shares() == 0)
            ranks_.send(0, Ranks::Manifest, bytes_of(SharedParts{no_share, {}}));
    }
    void begin(const RankStart& start) {
        try {
            worker_.emplace(session_, options_.clash, options_.most_bytes, start,
                            rank_journal(options_, Ranks::rank()), FinishedPieces());
        } catch (...) {
            return answer(failed());  // asks for no task
        }
        for (int i = 0; i < tasks_ahead; ++i) answer({});
    }
    void answer(const RankResult& result) { ranks_.send(0, Ranks::Result, bytes_of(result)); }

    [[nodiscard]] Ranks::Message next() {
        patience_.reset();
        while (true) {
            if (auto message = ranks_.receive()) return std::move(*message);
            if (session_.supervisor().stop_flag()) throw CancelledError();
            patience_.wait();
        }
    }

    Session& session_;
    const RankClashOptions& options_;
    Ranks ranks_;
    Patience patience_;
    std::optional<RankWorker> worker_;
};

}  // namespace

void serve(Session& session, const RankClashOptions& options) {
    session.interruptible_stage("pairs", [&] {
        ServingRank(session, options).serve();
        return 0;
    });
}

std::string rank_journal(const RankClashOptions& options, int rank) {
    return fmt::format("{}.journal.{}", options.clash.outputs.front(), rank);
}

}  // namespace trisect::app
