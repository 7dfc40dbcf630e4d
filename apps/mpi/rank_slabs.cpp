// SPDX-License-Identifier: Apache-2.0
#include "rank_slabs.h"

#include <cerrno>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <string>

#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>

#include <fmt/format.h>

#include <trisect/kernel/error.h>

#include "ranks.h"

namespace trisect::app {

namespace {

// The least of all ranks' numbers, for all of them. A call that blocks would keep processors busy.
int least_of_ranks(int mine) {
    int out = 0;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallreduce(&mine, &out, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD, &request);
    Patience patience;
    for (int is_done = 0; is_done == 0;) {
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        if (is_done == 0) patience.wait();
    }
    return out;
}

constexpr std::size_t note_bytes = 4096;

bool is_first() { return Ranks::rank() == 0; }

}  // namespace

RankSlabs::RankSlabs(Session& session, const BooleanOptions& options)
    : session_(session),
      options_(options),
      slabs_(slab_options(session, options)),
      slab_run_(slabs_) {}

bool RankSlabs::has_failed() const { return std::filesystem::exists(slabs_.folder + "/failed"); }

std::string RankSlabs::note_name() const {
    return fmt::format("{}/failed-{}", slabs_.folder, Ranks::rank());
}

// Its bytes are there before the disk is full.
void RankSlabs::reserve_note() const { std::ofstream(note_name()) << std::string(note_bytes, ' '); }

// The first one is kept.
void RankSlabs::note_failure(int code, const std::string& message) const {
    if (!has_folder_) return;
    std::fstream(note_name(), std::ios::in | std::ios::out) << code << '\n'
                                                            << message.substr(0, note_bytes / 2);
    std::error_code taken;
    std::filesystem::create_hard_link(note_name(), slabs_.folder + "/failed", taken);
}

void RankSlabs::fail() {
    std::ifstream file(slabs_.folder + "/failed");
    int code = static_cast<int>(ErrorCode::Internal);
    file >> code;
    file.ignore();
    std::string message{std::istreambuf_iterator<char>(file), {}};
    message.erase(message.find_last_not_of(' ') + 1);
    if (is_first() && !slabs_.resume) slab_run_.clean();
    throw Error(static_cast<ErrorCode>(code), message.empty() ? "a rank failed" : message);
}

void RankSlabs::step(const char* name, const std::function<void()>& work) {
    bool is_well = false;
    std::exception_ptr own;
    session_.interruptible_stage(name, [&] {
        try {
            work();
            is_well = true;
        } catch (const Error& e) {
            own = std::current_exception();
            note_failure(static_cast<int>(e.code()), e.what());
        } catch (const std::bad_alloc&) {
            own = std::current_exception();
            note_failure(static_cast<int>(ErrorCode::Limit), "out of memory (see --max-memory)");
        }
        return 0;
    });
    if (least_of_ranks(is_well ? 1 : 0) == 1) return;
    if (!has_folder_) {
        if (own != nullptr) std::rethrow_exception(own);
        throw Error(ErrorCode::Internal, "the first rank failed");
    }
    fail();
}

void RankSlabs::survey() {
    step("survey", [&] {
        if (!is_first()) return;
        slab_run_.begin();
        // What an interrupted run left.
        for (const auto& entry : std::filesystem::directory_iterator(slabs_.folder)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("claim-") || name.starts_with("failed"))
                std::filesystem::remove(entry.path());
        }
    });
    has_folder_ = true;
    step("survey", [&] {
        reserve_note();
        is_first() ? slab_run_.gather() : slab_run_.join_folder();
    });
    const auto ranks = static_cast<std::size_t>(Ranks::count());
    step("survey", [&] {
        if (!slab_run_.has_plan()) slab_run_.survey(static_cast<std::size_t>(Ranks::rank()), ranks);
    });
    step("walls", [&] {
        if (is_first() && !slab_run_.has_plan()) slab_run_.decide(ranks);
    });
    step("walls", [&] {
        if (!is_first()) slab_run_.take_plan();
        shares_ = slab_run_.distributed();
    });
}

// Again beside the walls, where a corner is on one.
void RankSlabs::distribute() {
    if (shares_ != 0) return;
    shares_ = static_cast<std::size_t>(Ranks::count());
    const auto share = static_cast<std::size_t>(Ranks::rank());
    while (true) {
        int fits = 0;
        step("distribute", [&] { fits = slab_run_.distribute(share, shares_) ? 1 : 0; });
        if (least_of_ranks(fits) == 1) break;
        step("walls", [&] {
            if (is_first()) slab_run_.move_walls();
        });
        step("walls", [&] {
            if (!is_first()) slab_run_.take_plan();
        });
    }
    step("walls", [&] {
        if (is_first()) slab_run_.note_distributed(shares_);
    });
}

bool RankSlabs::claim(std::size_t slab) const {
    const std::string name = fmt::format("{}/claim-{:05}", slabs_.folder, slab);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
        ::close(descriptor);
        return true;
    }
    if (errno == EEXIST) return false;
    throw Error(ErrorCode::Input, name + ": cannot be written");
}

void RankSlabs::evaluate() {
    EvaluateOptions options = session_.evaluation_options(options_.operands);
    for (const std::size_t slab : slab_run_.order()) {
        if (has_failed()) return;
        if (slab_run_.is_done(slab) || !claim(slab)) continue;
        slab_run_.evaluate(slab, shares_, options);
    }
}

// The same steps as in one process, which are divided by pieces.
JoinedMesh RankSlabs::join() {
    const auto rank = static_cast<std::size_t>(Ranks::rank());
    const auto ranks = static_cast<std::size_t>(Ranks::count());
    const PieceJoin joining = slab_run_.joining();
    JoinedMesh out;
    step("join", [&] {
        for (std::size_t i = rank; i < slab_run_.count(); i += ranks) joining.link(i);
    });
    step("join", [&] {
        if (is_first()) out = joining.begin();
    });
    step("join", [&] { joining.write(rank, ranks); });
    step("join", [&] {
        if (is_first()) joining.finish();
    });
    return out;
}

Outcome RankSlabs::run() {
    session_.plan(4);
    survey();
    distribute();
    step("evaluate", [&] { evaluate(); });
    const JoinedMesh joined = join();
    if (!is_first()) return {};
    slab_run_.clean();
    return slab_outcome(session_, options_, slab_run_.current_plan(), joined);
}

}  // namespace trisect::app
