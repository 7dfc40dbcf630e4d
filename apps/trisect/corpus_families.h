// SPDX-License-Identifier: Apache-2.0
//
// The families of the corpus: scenes in which boxes touch, nest, nearly coincide or repeat.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "box_scene.h"

namespace trisect::app {

[[nodiscard]] std::vector<std::string> corpus_family_names();
/// \throw UsageError for an unknown name.
[[nodiscard]] std::vector<BoxScene> corpus_family(const std::string& name, std::uint64_t seed);

}  // namespace trisect::app
