// SPDX-License-Identifier: Apache-2.0
//
// Reports of clashes: JSON, CSV and BCF 2.1.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "clash_manifest.h"
#include "clash_text.h"
#include "outcome.h"

namespace trisect::app {

/// All that a report says: nothing of time, threads or machine.
struct ClashReport {
    std::string manifest;          ///< name of the file
    std::string shard;             ///< "2/8", or empty
    Json run;                      ///< of a shard: what all of them have in common
    Json geometry;                 ///< of GDML: what was compared, and what is proved
    std::vector<Json> clashes;     ///< in order of pairs, then sets
    std::vector<ClashText> texts;  ///< the same, instead of documents
    std::vector<Json> missing;     ///< files that could not be used, with their parts
    std::vector<Json> unanswered;  ///< pairs without an answer
    std::vector<Json> undone;      ///< cells of space that a run did not come to

    [[nodiscard]] std::size_t count() const { return clashes.size() + texts.size(); }
    /// \param read where it is, if it was written as a text
    [[nodiscard]] const Json& clash(std::size_t i, Json& read) const {
        if (texts.empty()) return clashes[i];
        return read = Json::parse(texts[i].text);
    }
    [[nodiscard]] bool is_complete() const {
        return missing.empty() && unanswered.empty() && undone.empty();
    }
};

/// The PNG file of a clash, by its place in the report; empty: none.
using ClashPicture = std::function<std::string(std::size_t)>;

/// All but the clashes.
[[nodiscard]] Json clash_head_json(const ClashManifest& manifest, const ClashReport& report);
[[nodiscard]] std::string clash_json(const ClashManifest& manifest, const ClashReport& report);
/// A line for each clash.
[[nodiscard]] std::string clash_csv(const ClashManifest& manifest, const ClashReport& report);
/// A topic for each clash: a zip file.
[[nodiscard]] std::string clash_bcf(const ClashManifest& manifest, const ClashReport& report,
                                    const ClashPicture& picture);

/// What stands in a list of clashes: "pipe 7 and beam 2: overlapping".
[[nodiscard]] std::string clash_title(const ClashManifest& manifest, const Json& clash);

}  // namespace trisect::app
