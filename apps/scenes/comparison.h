// SPDX-License-Identifier: Apache-2.0
//
// Costs of structures on a sequence of poses.
// They are counted, predicted by the cost function and measured.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>

namespace scenes {

/// What is asked of every frame.
enum class Question : std::uint8_t {
    Meet,     ///< boundaries_meet: stops at the first pair
    Faces,    ///< meeting_faces: all pairs
    Distance  ///< distance: the closest pair, by doubles
};
[[nodiscard]] const char* to_string(Question question);

/// Seconds for one unit of each counter.
struct UnitCosts {
    double update = 0;          ///< Cu
    double volume_test = 0;     ///< Cbv
    double primitive_test = 0;  ///< Cp: of a pair that is seen to be apart, or farther than others
    double closest_test = 0;    ///< more than that where closest points are computed
    double exact_test = 0;
    double frame = 0;  ///< what a pose costs whatever happens

    [[nodiscard]] double predict(const trisect::hierarchies::CostCounters& n,
                                 std::size_t frames) const;
};

/// Unit costs of a kind of structure for a question on this machine, from poses of two tori of
/// 1,600 and 5,120 triangles at many distances: those of pairs of triangles from pairs that are
/// played back without a structure, the others by least squares of relative errors, none of them
/// negative. Half a second. In calibration.cpp.
[[nodiscard]] UnitCosts calibrate(trisect::hierarchies::StructureKind kind, Question question);

struct QuestionCost {
    Question question{};
    trisect::hierarchies::CostCounters counters;  ///< of all frames
    double predicted = 0;                         ///< seconds of all frames
    double measured = 0;                          ///< the least of some rounds
};

struct StructureCost {
    trisect::hierarchies::StructureKind kind{};
    std::string name;
    trisect::hierarchies::BuildReport build;
    std::vector<QuestionCost> questions;
};

/// What all structures agree on.
struct Answers {
    std::map<std::string, std::size_t> relations;  ///< how many frames have each
    std::size_t meeting_frames = 0;
    std::size_t face_pairs = 0;  ///< of all frames
    double least_distance = 0;   ///< upper bound, over all frames
};

struct Comparison {
    std::size_t frames = 0;
    Answers answers;
    std::vector<StructureCost> structures;
    /// "" or the first disagreement of two structures: a defect of the library.
    std::string disagreement;
};

struct ComparisonOptions {
    std::vector<trisect::hierarchies::StructureKind> kinds;  ///< empty: all but AllPairs
    std::vector<Question> questions{Question::Faces, Question::Distance};
    double seconds_per_cell = 0.3;  ///< how long rounds are repeated
    bool predict = true;            ///< calibrates
};

/// B under the poses against A, which stays where it was modelled. \pre neither is empty
[[nodiscard]] Comparison compare(const trisect::InterferenceModel& a,
                                 const trisect::InterferenceModel& b,
                                 std::span<const trisect::Pose> poses,
                                 const ComparisonOptions& options = {});

/// As a table in Markdown: a row for each structure and question.
[[nodiscard]] std::string table_of(const Comparison& comparison);

/// Bars: what the cost function says, in its parts, and a mark for the measured time.
[[nodiscard]] std::string chart_of(const Comparison& comparison, const std::string& title);

}  // namespace scenes
