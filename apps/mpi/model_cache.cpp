// SPDX-License-Identifier: Apache-2.0
#include "model_cache.h"

#include <utility>

namespace trisect::app {

ClashFileModel ModelCache::get(const std::string& name) {
    const std::lock_guard lock(mutex_);
    if (const auto at = places_.find(name); at != places_.end()) {
        entries_.splice(entries_.begin(), entries_, at->second);
        return entries_.front().read;
    }
    ++reads_;
    Entry entry{name, read_clash_file(session_, options_, name), 0};
    entry.bytes = bytes_of_a_model + entry.read.file.triangles * bytes_of_a_triangle;
    bytes_ += entry.bytes;
    entries_.push_front(std::move(entry));
    places_[name] = entries_.begin();
    while (bytes_ > most_bytes_ && entries_.size() > 1) {
        bytes_ -= entries_.back().bytes;
        places_.erase(entries_.back().name);
        entries_.pop_back();
    }
    return entries_.front().read;
}

}  // namespace trisect::app
