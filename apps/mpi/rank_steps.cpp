// SPDX-License-Identifier: Apache-2.0
#include "rank_steps.h"

#include <ctime>

namespace trisect::app {
namespace {

double seconds_of(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

void RankSteps::note(Step step) {
    times[step] = {seconds_of(CLOCK_MONOTONIC), seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
}

}  // namespace trisect::app
