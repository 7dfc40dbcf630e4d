// SPDX-License-Identifier: Apache-2.0

#include "question_runs.h"

#include <algorithm>
#include <ctime>
#include <limits>

namespace scenes {

using namespace trisect;
using namespace trisect::hierarchies;

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

namespace {

void ask(PairStructure& s, Question question, CostCounters& counters) {
    switch (question) {
        case Question::Meet:
            (void)boundaries_meet(s, counters);
            break;
        case Question::Faces:
            (void)meeting_faces(s, counters);
            break;
        case Question::Distance:
            (void)distance(s, counters);
            break;
    }
}

}  // namespace

CostCounters run(PairStructure& s, std::span<const Pose> poses, Question question) {
    CostCounters counters;
    for (const Pose& pose : poses) {
        s.place(Pose(), pose, counters);
        ask(s, question, counters);
    }
    return counters;
}

double least_time(PairStructure& s, std::span<const Pose> poses, Question question,
                  double seconds) {
    double least = std::numeric_limits<double>::infinity();
    double spent = 0;
    for (int round = 0; round < 1000; ++round) {
        if (round >= 2 && !(spent < seconds)) break;
        const double begin = processor_seconds();
        (void)run(s, poses, question);
        const double took = processor_seconds() - begin;
        least = std::min(least, took);
        spent += took;
    }
    return least;
}

}  // namespace scenes
