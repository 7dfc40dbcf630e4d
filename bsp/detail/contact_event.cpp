// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/contact_event.h>

#include <cmath>
#include <utility>

namespace trisect::detail {

EarliestEvents::EarliestEvents(std::optional<RealRoot> after) : after_(std::move(after)) {
    // GMP truncates towards zero.
    if (after_) earliest_ = after_->lower().get_d();
}

void EarliestEvents::add(RealRoot s, const FeaturePair& pair) {
    if (after_ && s.compare(*after_) <= 0) return;
    if (!pairs_.empty()) {
        const auto order = s.compare(time_);
        if (order > 0) return;
        if (order == 0) {
            pairs_.push_back(pair);
            return;
        }
        pairs_.clear();
    }
    time_ = std::move(s);
    pairs_.push_back(pair);
    // GMP truncates towards zero.
    latest_ = std::nextafter(time_.upper().get_d(), 2.0);
}

}  // namespace trisect::detail
