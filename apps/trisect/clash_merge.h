// SPDX-License-Identifier: Apache-2.0
//
// Reports of shards, made into one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "clash_report.h"

namespace trisect::app {

/// One of several runs that share the work: "2/8" is number 1 of 8.
struct ClashShard {
    std::size_t number = 0;
    std::size_t count = 1;
};

/// Empty text: all. \throw UsageError
[[nodiscard]] ClashShard parse_shard(const std::string& text);

/// What one run of all shards reports. The names are of JSON reports of the shards of one run, in
/// any order. \throw UsageError where a shard is missing, there twice, or of another manifest or
/// other options; InputError for what is no report
[[nodiscard]] ClashReport merged_report(const ClashManifest& manifest,
                                        const std::vector<std::string>& shards);

/// In the order of pairs, as reports have them. Those of a pair stay in their order.
void sort_clashes(const ClashManifest& manifest, std::vector<Json>& records);

}  // namespace trisect::app
