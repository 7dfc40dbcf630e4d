// SPDX-License-Identifier: Apache-2.0
//
// Every point has an enclosure, its doubles with their error. Enclosures of equal points overlap
// along all three axes. So: sort along an axis and cut where a gap shows; enclosures that chain
// together stay in one group. Go on with the next axis within each group, until no axis cuts.
//
// A sweep along one axis alone compares every pair that overlaps there, which on models with axis
// parallel faces, where a tenth of all vertices may share one x, is quadratic.

#include <trisect/bsp/detail/near_points.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace trisect::detail {

namespace {

struct Range {
    double low = 0;
    double high = 0;
    PointId point = -1;
};

class Groups {
public:
    Groups(const Workbench& bench, const std::function<void(std::span<const PointId>)>& visit)
        : bench_(bench), visit_(visit), ranges_(bench.point_count()) {
        for (std::size_t i = 0; i < ranges_.size(); ++i) ranges_[i].point = static_cast<PointId>(i);
    }

    void run() { part(ranges_, 0, 0); }

private:
    // `uncut`: how many axes before this one left the group as it is.
    void part(std::span<Range> group, std::size_t axis, int uncut);
    void measure(std::span<Range> group, std::size_t axis) const;
    void emit(std::span<const Range> group);

    const Workbench& bench_;
    const std::function<void(std::span<const PointId>)>& visit_;
    std::vector<Range> ranges_;
    std::vector<PointId> points_;
};

// Somewhat wider than the error bound, for the rounding of its ends.
void Groups::measure(std::span<Range> group, std::size_t axis) const {
    for (Range& r : group) {
        const Approximation& a = bench_.approximation(r.point);
        const double reach = 1.0000001 * a.error + 0x1p-50 * std::fabs(a.c[axis]);
        r.low = a.c[axis] - reach;
        r.high = a.c[axis] + reach;
    }
    std::sort(group.begin(), group.end(), [](const Range& a, const Range& b) {
        return std::tie(a.low, a.point) < std::tie(b.low, b.point);
    });
}

void Groups::part(std::span<Range> group, std::size_t axis, int uncut) {
    if (group.size() < 2) return;
    if (uncut == 3) return emit(group);
    measure(group, axis);
    for (std::size_t begin = 0; begin < group.size();) {
        double high = group[begin].high;
        std::size_t end = begin + 1;
        for (; end < group.size() && group[end].low <= high; ++end)
            high = std::max(high, group[end].high);
        const bool whole = end - begin == group.size();
        part(group.subspan(begin, end - begin), (axis + 1) % 3, whole ? uncut + 1 : 1);
        begin = end;
    }
}

void Groups::emit(std::span<const Range> group) {
    points_.clear();
    for (const Range& r : group) points_.push_back(r.point);
    std::sort(points_.begin(), points_.end());
    visit_(points_);
}

}  // namespace

void for_each_near_group(const Workbench& bench,
                         const std::function<void(std::span<const PointId>)>& visit) {
    Groups(bench, visit).run();
}

}  // namespace trisect::detail
