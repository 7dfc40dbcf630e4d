// SPDX-License-Identifier: Apache-2.0
#include "manifest_reading.h"

#include "ranks.h"

namespace trisect::app {
namespace {

PartSource read(const std::string& manifest, RankPlace place) {
    PartSource out;
    out.read(manifest, static_cast<std::size_t>(place.rank), static_cast<std::size_t>(place.count));
    return out;
}

}  // namespace

ManifestReading::ManifestReading(const std::string& manifest, std::optional<RankPlace> place)
    : manifest_(manifest) {
    if (place) read_ = std::async(std::launch::async, read, manifest, *place);
}

PartSource ManifestReading::take() {
    if (read_.valid()) return read_.get();
    return read(manifest_, {Ranks::rank(), Ranks::count()});
}

}  // namespace trisect::app
