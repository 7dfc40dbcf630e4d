// SPDX-License-Identifier: Apache-2.0
#include "rank_clash_command.h"

#include "coordinating_rank.h"
#include "manifest_reading.h"
#include "open_mpi.h"
#include "rank_station.h"
#include "rank_steps.h"
#include "trisect/clash_command.h"
#include "trisect/clash_output.h"
#include "trisect/values.h"

namespace trisect::app {

void RankClashCommand::declare(CLI::App& app) {
    CLI::App& command = add_clash_options(app, options_.clash);
    command
        .add_option_function<std::string>(
            "--cache",
            [this](const std::string& text) { options_.most_bytes = parse_bytes(text, "--cache"); },
            "most memory for models of parts that a rank keeps (default: 1G)")
        ->type_name("BYTES[KMGT]");
    command
        .add_option("--costs", options_.costs, "a table of what each piece of work cost, as CSV")
        ->type_name("FILE");
}

Outcome RankClashCommand::run(Session& session, const std::string&) const {
    check_clash_outputs(session, options_.clash);  // every rank sees the same
    RankSteps steps;
    steps.note(RankSteps::Began);
    const auto place = has_begun_mpi() ? std::nullopt : place_before_mpi();
    ManifestReading reading(options_.clash.manifest, place);
    begin_mpi();
    is_open_ = true;
    steps.note(RankSteps::Joined);
    Outcome out;
    if (Ranks::rank() == 0)
        out = CoordinatingRank(session, options_, {reading, steps}, is_open_).run();
    else
        serve(session, options_, {reading, steps});
    is_open_ = false;
    return out;
}

}  // namespace trisect::app
