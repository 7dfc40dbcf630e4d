// SPDX-License-Identifier: Apache-2.0
//
// ManifestReading: a rank reads its shares of a manifest while MPI begins.
#pragma once

#include <future>
#include <optional>
#include <string>

#include "open_mpi.h"
#include "part_source.h"

namespace trisect::app {

/// MPI_Init mostly waits for mpirun. Where the rank is known before, a second thread reads
/// meanwhile.
class ManifestReading {
public:
    /// Begins where a place is given, \pre which is that of Ranks.
    ManifestReading(const std::string& manifest, std::optional<RankPlace> place);

    /// \pre MPI has begun; once. \throw what reading did
    [[nodiscard]] PartSource take();

private:
    std::string manifest_;
    std::future<PartSource> read_;
};

}  // namespace trisect::app
