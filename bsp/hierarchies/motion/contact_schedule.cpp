// SPDX-License-Identifier: Apache-2.0
//
// A swarm of n bodies has n²/2 pairs and hardly ever a contact. A broad phase looks at all bodies
// in every frame; here a pair that is far apart and slow is not looked at for many frames, and
// frames in which nothing is due cost nothing. It needs bounds on speeds, which a simulation has.
//
// Entries of the heap are never moved: what is scheduled anew gets a new entry and a new stamp, and
// old ones are thrown away when they come up.

#include <trisect/bsp/hierarchies/motion/contact_schedule.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/kernel/error.h>
#include <trisect/kernel/number/infinity.h>

namespace trisect::hierarchies {

using detail::infinity;

namespace {

double up(double v) { return std::nextafter(v, infinity); }
double down(double v) { return std::nextafter(v, -infinity); }

void expect_speed(double v) {
    if (!(v >= 0)) throw UsageError("a speed must be a number that is not negative");
}

struct Later {
    template <class Entry>
    bool operator()(const Entry& a, const Entry& b) const {
        return a.time > b.time;
    }
};

}  // namespace

double speed_bound(const std::array<double, 3>& velocity, double angular_speed, double radius) {
    // Three products, two sums, a root, a product and a sum: below 8 · 2^-53 of the result.
    const double v = std::sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1] +
                               velocity[2] * velocity[2]);
    return up((v + std::abs(angular_speed) * std::abs(radius)) * (1 + 0x1p-49) + 0x1p-500);
}

double displacement_bound(const trisect::detail::BodyBox& box, const Pose& from, const Pose& to) {
    // The difference of two affine maps is one too, and its length is greatest at a corner. Entries
    // are known within 2^-50 of themselves, sums and products add less than 2^-50 of the terms.
    const auto& p = from.approximate();
    const auto& q = to.approximate();
    double most = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        double square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            double v = q[4 * i + 3] - p[4 * i + 3];
            double terms = std::abs(q[4 * i + 3]) + std::abs(p[4 * i + 3]);
            for (std::size_t k = 0; k < 3; ++k) {
                const double x = (corner >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
                v += (q[4 * i + k] - p[4 * i + k]) * x;
                terms += (std::abs(q[4 * i + k]) + std::abs(p[4 * i + k])) * std::abs(x);
            }
            const double size = std::abs(v) + 0x1p-48 * terms;
            square += size * size;
        }
        const double length = up(std::sqrt(square) * (1 + 0x1p-49) + 0x1p-500);
        if (!(length <= most)) most = length;
    }
    return std::isfinite(most) ? most : infinity;
}

ContactSchedule::ContactSchedule(std::span<const double> speeds, double now)
    : speeds_(speeds.begin(), speeds.end()), now_(now) {
    for (const double s : speeds_) expect_speed(s);
    const std::size_t n = speeds_.size();
    pairs_.resize(n < 2 ? 0 : n * (n - 1) / 2);
    heap_.reserve(pairs_.size());
    // Equal times are a heap in any order.
    for (std::uint32_t j = 1; j < n; ++j)
        for (std::uint32_t i = 0; i < j; ++i) heap_.push_back({now, i, j, 0});
}

ContactSchedule::Pair& ContactSchedule::pair(std::uint32_t first, std::uint32_t second) {
    return pairs_[std::size_t{second} * (second - 1) / 2 + first];
}
void ContactSchedule::advance(double now) {
    if (!(now >= now_)) throw UsageError("the time of a schedule runs forwards");
    now_ = now;
}

void ContactSchedule::schedule(std::uint32_t first, std::uint32_t second) {
    Pair& p = pair(first, second);
    ++p.stamp;
    double time = p.tested;
    if (p.distance > 0) {
        const double speed = speeds_[first] + speeds_[second];
        if (speed == 0) return;  // never, until one of them starts
        const double wait = down(p.distance / up(speed));
        if (wait > 0) time = std::max(time, down(p.tested + wait));
    }
    heap_.push_back({time, first, second, p.stamp});
    std::push_heap(heap_.begin(), heap_.end(), Later{});
}

void ContactSchedule::drop_outdated() {
    while (!heap_.empty() &&
           heap_.front().stamp != pair(heap_.front().first, heap_.front().second).stamp) {
        std::pop_heap(heap_.begin(), heap_.end(), Later{});
        heap_.pop_back();
    }
}

double ContactSchedule::next() {
    drop_outdated();
    return heap_.empty() ? infinity : heap_.front().time;
}

std::size_t ContactSchedule::due(double now, Test test) {
    advance(now);
    tested_.clear();
    for (drop_outdated(); !heap_.empty() && heap_.front().time <= now; drop_outdated()) {
        tested_.push_back(heap_.front());
        std::pop_heap(heap_.begin(), heap_.end(), Later{});
        heap_.pop_back();
    }
    // Scheduled again only when all have been taken out: a pair in contact stays due.
    for (std::size_t i = 0; i < tested_.size(); ++i) {
        const Entry& e = tested_[i];
        Pair& p = pair(e.first, e.second);
        p.tested = now;
        p.distance = test(e.first, e.second);
        schedule(e.first, e.second);
    }
    return tested_.size();
}

void ContactSchedule::set_speed(std::uint32_t body, double speed, double now) {
    expect_speed(speed);
    if (body >= speeds_.size()) throw UsageError("a schedule has no such body");
    advance(now);
    for (std::uint32_t other = 0; other < speeds_.size(); ++other) {
        if (other == body) continue;
        const auto [i, j] = std::minmax(body, other);
        Pair& p = pair(i, j);
        const double way = up(up(speeds_[i] + speeds_[j]) * up(now - p.tested));
        const double left = down(p.distance - way);
        p.distance = left > 0 ? left : 0;
        p.tested = now;
    }
    speeds_[body] = speed;
    for (std::uint32_t other = 0; other < speeds_.size(); ++other)
        if (other != body) {
            const auto [i, j] = std::minmax(body, other);
            schedule(i, j);
        }
}

}  // namespace trisect::hierarchies
