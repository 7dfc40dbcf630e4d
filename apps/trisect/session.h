// SPDX-License-Identifier: Apache-2.0
//
// Session: the common context of all sub-commands.
// It has the common options, a place for remarks, and the stages of the work, which are timed and
// shown as progress.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include <trisect/brep/io/output_file.h>
#include <trisect/kernel/stop_scope.h>

#include "console.h"
#include "options.h"
#include "outcome.h"
#include "supervisor.h"

namespace trisect::app {

class Session {
public:
    Session(const CommonOptions& options, Console& console, Supervisor& supervisor)
        : options_(options), console_(console), supervisor_(supervisor) {}

    [[nodiscard]] const CommonOptions& options() const { return options_; }
    [[nodiscard]] Supervisor& supervisor() { return supervisor_; }

    /// Something the user should know; on the standard error unless quiet.
    void note(std::string_view text) { console_.note(text); }
    /// A detail for --verbose.
    void detail(std::string_view text) {
        if (options_.verbose) console_.note(text);
    }

    /// How many stages there will be.
    void plan(int stages) { stage_count_ = stages; }
    /// Does `work` and returns its result; the seconds it took go into `seconds()[name]`.
    template <class Work>
    auto stage(const std::string& name, Work&& work) {
        const Timer timer(*this, name);
        return work();
    }
    /// The same for work that looks at the stop flag of limits().
    template <class Work>
    auto interruptible_stage(const std::string& name, Work&& work) {
        return stage(name, [&] { return supervisor_.interruptibly(work); });
    }
    [[nodiscard]] EvaluateOptions evaluation_options(const OperandOptions& operands) const;
    /// Those of the command line and the supervisor, for one scope around the whole command.
    [[nodiscard]] StopLimits limits() const;
    [[nodiscard]] const Json& seconds() const { return seconds_; }

    /// Writes bytes of a result to the standard output ("-") or completely or not at all to a file.
    void write_output(const std::string& name, std::string_view bytes,
                      OutputSafety safety = OutputSafety::Renamed);

    /// The same for several files: all of them or none.
    void write_outputs(const std::vector<OutputBytes>& files);

private:
    class Timer {
    public:
        Timer(Session& session, const std::string& name) : session_(session), name_(name) {
            session_.supervisor_.enter_stage(name, session_.stage_index_++, session_.stage_count_);
        }
        Timer(const Timer&) = delete;
        Timer& operator=(const Timer&) = delete;
        ~Timer();

    private:
        Session& session_;
        std::string name_;
        std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    };

    const CommonOptions& options_;
    Console& console_;
    Supervisor& supervisor_;
    Json seconds_ = Json::object();
    int stage_index_ = 0;
    int stage_count_ = 1;
};

}  // namespace trisect::app
