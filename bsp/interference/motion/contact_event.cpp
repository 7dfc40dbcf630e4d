// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/motion/contact_event.h>

#include <cmath>
#include <iterator>
#include <utility>

namespace trisect::detail {

EarliestEvents::EarliestEvents(std::optional<RealRoot> after, std::size_t times)
    : after_(std::move(after)), times_(times) {
    // GMP truncates towards zero.
    if (after_) earliest_ = after_->lower().get_d();
}

void EarliestEvents::add(RealRoot s, const FeaturePair& pair) {
    if (after_ && s.compare(*after_) <= 0) return;
    // Where it belongs: before all that are not earlier.
    auto at = events_.end();
    while (at != events_.begin()) {
        const auto before = std::prev(at);
        const auto order = s.compare(before->time);
        if (order == 0) {
            before->pairs.push_back(pair);
            return;
        }
        if (order > 0) break;
        at = before;
    }
    if (at == events_.end() && is_full()) return;
    events_.insert(at, {std::move(s), {pair}});
    if (events_.size() > times_) events_.pop_back();
    // GMP truncates towards zero.
    if (is_full()) latest_ = std::nextafter(events_.back().time.upper().get_d(), 2.0);
}

}  // namespace trisect::detail
