// SPDX-License-Identifier: Apache-2.0
#include "ray_caster.h"

#include <algorithm>

namespace reference {
namespace {

// A point as integers (x w, y w, z w) and w > 0.
struct HomogeneousPoint {
    IntegerPoint scaled;
    Integer w;

    explicit HomogeneousPoint(const Point3& p)
        : w(lcm(lcm(p[0].get_den(), p[1].get_den()), p[2].get_den())) {
        for (std::size_t i = 0; i < 3; ++i) {
            scaled[i] = p[i] * w;
        }
    }
};

int side_of(const OrientedPlane& plane, const HomogeneousPoint& p) {
    return sign(Integer(plane.normal[0] * p.scaled[0] + plane.normal[1] * p.scaled[1] +
                        plane.normal[2] * p.scaled[2] + plane.offset * p.w));
}

}  // namespace

std::optional<View> View::along(const IntegerPoint& direction, const std::vector<Facet>& facets) {
    View view;
    view.direction_ = direction;
    for (const Facet& facet : facets) {
        const auto& n = facet.plane.normal;
        const Integer slope = n[0] * direction[0] + n[1] * direction[1] + n[2] * direction[2];
        if (slope == 0) {
            return std::nullopt;
        }
        view.images_.push_back(view.image_of(facet, sign(slope)));
    }
    return view;
}

std::optional<RayCount> View::count(const Point3& point, const std::vector<Facet>& facets,
                                    std::size_t operand_count,
                                    std::optional<std::size_t> group) const {
    const HomogeneousPoint p(point);
    const std::array<Integer, 2> at{p.scaled[0] * direction_[2] - p.scaled[2] * direction_[0],
                                    p.scaled[1] * direction_[2] - p.scaled[2] * direction_[1]};
    std::array<Integer, 2> floor;
    std::array<Integer, 2> ceiling;
    for (std::size_t i = 0; i < 2; ++i) {
        mpz_fdiv_q(floor[i].get_mpz_t(), at[i].get_mpz_t(), p.w.get_mpz_t());
        mpz_cdiv_q(ceiling[i].get_mpz_t(), at[i].get_mpz_t(), p.w.get_mpz_t());
    }
    RayCount result{std::vector<int>(operand_count), std::vector<int>(operand_count)};
    for (std::size_t i = 0; i < facets.size(); ++i) {
        const Image& image = images_[i];
        if (floor[0] < image.low[0] || ceiling[0] > image.high[0] || floor[1] < image.low[1] ||
            ceiling[1] > image.high[1]) {
            continue;
        }
        const int place = place_in(image, at, p.w);
        if (place < 0) {
            continue;
        }
        // The ray meets the facet's plane ahead of the point if it climbs from below.
        const int side = side_of(facets[i].plane, p);
        if (place == 0 || (side == 0 && facets[i].group != group)) {
            return std::nullopt;
        }
        if (side == 0 || side != image.climb) {
            result.behind[facets[i].operand] += image.climb;
        }
        if (side != 0 && side != image.climb) {
            result.before[facets[i].operand] += image.climb;
        }
    }
    return result;
}

View::Image View::image_of(const Facet& facet, int climb) const {
    Image image{climb, {}, {}, {}};
    std::array<std::array<Integer, 2>, 3> flat;
    for (std::size_t i = 0; i < 3; ++i) {
        const IntegerPoint& c = facet.corners[i];
        flat[i] = {c[0] * direction_[2] - c[2] * direction_[0],
                   c[1] * direction_[2] - c[2] * direction_[1]};
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
        image.low[axis] = std::min({flat[0][axis], flat[1][axis], flat[2][axis]});
        image.high[axis] = std::max({flat[0][axis], flat[1][axis], flat[2][axis]});
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& p = flat[i];
        const auto& q = flat[(i + 1) % 3];
        const auto& opposite = flat[(i + 2) % 3];
        Edge line{p[1] - q[1], q[0] - p[0], p[0] * q[1] - p[1] * q[0]};
        if (line[0] * opposite[0] + line[1] * opposite[1] + line[2] < 0) {
            line = {-line[0], -line[1], -line[2]};
        }
        image.edges[i] = line;
    }
    return image;
}

int View::place_in(const Image& image, const std::array<Integer, 2>& at, const Integer& w) {
    int place = 1;
    for (const Edge& edge : image.edges) {
        const Integer value = edge[0] * at[0] + edge[1] * at[1] + edge[2] * w;
        place = std::min(place, sign(value));
    }
    return place;
}

}  // namespace reference
