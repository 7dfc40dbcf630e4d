// SPDX-License-Identifier: Apache-2.0
//
// Page of two moving solids and their first contact.
#pragma once

#include <trisect/bsp/interference/first_contact.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "interfere_page.h"

namespace trisect::app {

/// How two solids move, for pictures.
struct PageMotion {
    double end = 1;
    std::array<std::function<PosePlace(double)>, 2> pose;  ///< none: it stands still
    std::string unit;                                      ///< "parameter" or "time"
    std::uint64_t frames = 120;
};

/// Moments at equal steps, and one more where something happens, in their order.
[[nodiscard]] PageTimeline timeline_of(const PageMotion& motion, std::optional<double> event);

struct ShownContact {
    std::optional<double> time;
    std::vector<ContactWitness> witnesses;
    std::vector<std::string> summary;  ///< lines: what the command answers
};

[[nodiscard]] std::string sweep_page(const std::array<PlacedBody, 2>& bodies,
                                     const PageMotion& motion, const ShownContact& contact);

}  // namespace trisect::app
