// SPDX-License-Identifier: Apache-2.0
//
// Pages of milled stocks: one HTML file each, self-contained.
#pragma once

#include <string>

#include "mill_film.h"
#include "mill_job.h"
#include "mill_run.h"

namespace trisect::app {

/// A page that shows the stock, the tool, the holder and the fixtures over time. It loads nothing
/// and needs WebGL. Coordinates of the stock are shown on a grid of 65,536 steps along each side of
/// its box.
[[nodiscard]] std::string page_text(const MillJob& job, const MillRun& run, const MillFilm& film);

/// The page without its data: what stands before and after them.
extern const char* const mill_page_before_facts;
extern const char* const mill_page_before_data;
extern const char* const mill_page_end;

}  // namespace trisect::app
