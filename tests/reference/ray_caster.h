// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers by rays in random directions.
//
// Degenerate rays are not resolved but avoided: a ray that meets any edge or corner is thrown away
// and another random direction, from another point, is tried.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "facet.h"
#include "rational.h"

namespace reference {

// What a ray from a point crosses: winding numbers just before its start and just behind it. They
// differ by the facets that contain the start.
struct RayCount {
    std::vector<int> before;
    std::vector<int> behind;
};

// All facets seen along one direction d, that is mapped by (x, y, z) -> (x dz - z dx, y dz - z dy).
// A line in this direction is a point there.
class View {
public:
    // Nothing if the direction is parallel to some facet.
    static std::optional<View> along(const IntegerPoint& direction,
                                     const std::vector<Facet>& facets);

    const IntegerPoint& direction() const { return direction_; }

    // Nothing if the line through the point meets the edge of a facet, or if the point lies on a
    // facet outside of the given group.
    std::optional<RayCount> count(const Point3& point, const std::vector<Facet>& facets,
                                  std::size_t operand_count,
                                  std::optional<std::size_t> group) const;

private:
    using Edge = std::array<Integer, 3>;  // a u + b v + c
    struct Image {
        int climb;  // sign of normal . direction: the ray leaves the operand (1) or enters it (-1)
        std::array<Integer, 2> low;
        std::array<Integer, 2> high;
        std::array<Edge, 3> edges;  // positive on the inner side
    };

    Image image_of(const Facet& facet, int climb) const;
    // 1 inside, 0 on an edge, -1 outside of the triangle's image.
    static int place_in(const Image& image, const std::array<Integer, 2>& at, const Integer& w);

    IntegerPoint direction_;
    std::vector<Image> images_;
};

// splitmix64 (Steele, Lea, Flood 2014): enough for directions that must merely be varied.
class Varied {
public:
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    long between(long low, long high) {
        return low + static_cast<long>(next() % static_cast<std::uint64_t>(high - low + 1));
    }

private:
    std::uint64_t state_ = 1;
};

// Counts along random directions; views are kept, since most questions are answered by the first.
class RayCaster {
public:
    RayCaster(const std::vector<Facet>& facets, std::size_t operand_count)
        : facets_(facets), operand_count_(operand_count) {}

    const View& view(std::size_t attempt) {
        while (views_.size() <= attempt) {
            const IntegerPoint direction{Integer(varied_.between(-4001, 4001)),
                                         Integer(varied_.between(-4001, 4001)),
                                         Integer(varied_.between(1, 4001))};
            if (auto view = View::along(direction, facets_)) {
                views_.push_back(std::move(*view));
            }
        }
        return views_[attempt];
    }

    std::optional<RayCount> count(const Point3& point, std::size_t attempt,
                                  std::optional<std::size_t> group) {
        return view(attempt).count(point, facets_, operand_count_, group);
    }

    // Positive weights of a convex combination: equal ones first, then random ones.
    std::vector<unsigned> weights(std::size_t attempt) {
        std::vector<unsigned> result{1};
        if (attempt > 0) {
            result.resize(16);
            for (unsigned& weight : result) {
                weight = static_cast<unsigned>(varied_.between(1, 1000));
            }
        }
        return result;
    }

private:
    const std::vector<Facet>& facets_;
    std::size_t operand_count_;
    Varied varied_;
    std::vector<View> views_;
};

}  // namespace reference
