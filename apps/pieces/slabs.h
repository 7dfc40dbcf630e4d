// SPDX-License-Identifier: Apache-2.0
//
// Slabs: parts of space of about one load each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "survey.h"

namespace trisect::app {

/// Walls across one axis. Slab i is between walls i - 1 and i; the first and the last one have no
/// end. Walls are odd multiples of a power of two, 2^-30 of the largest coordinate, so that hardly
/// any corner is on one; who finds one there asks for walls beside them.
///
/// A slab takes all triangles that come within `margin` of it.
class Slabs {
public:
    Slabs() = default;
    Slabs(std::size_t axis, std::vector<double> walls, std::vector<std::uint64_t> loads,
          double quantum, double bound)
        : axis_(axis),
          walls_(std::move(walls)),
          loads_(std::move(loads)),
          quantum_(quantum),
          bound_(bound) {}
    /// As few slabs as have at most `most` triangles each, but `least` if that is possible, along
    /// the axis where these are fewest. \throw LimitError where there are none
    static Slabs of(const std::vector<Survey>& operands, std::uint64_t most, std::uint64_t least);

    [[nodiscard]] std::size_t count() const { return walls_.size() + 1; }
    [[nodiscard]] std::size_t axis() const { return axis_; }
    [[nodiscard]] const std::vector<double>& walls() const { return walls_; }
    [[nodiscard]] double low(std::size_t slab) const {
        return slab == 0 ? -std::numeric_limits<double>::infinity() : walls_[slab - 1];
    }
    [[nodiscard]] double high(std::size_t slab) const {
        return slab == walls_.size() ? std::numeric_limits<double>::infinity() : walls_[slab];
    }
    /// A fine power of two, of which walls are odd multiples.
    [[nodiscard]] double quantum() const { return quantum_; }
    [[nodiscard]] double margin() const { return 8 * quantum_; }
    /// A power of two beyond all coordinates.
    [[nodiscard]] double bound() const { return bound_; }
    /// About how many triangles the slab takes.
    [[nodiscard]] std::uint64_t load(std::size_t slab) const { return loads_[slab]; }

    /// The slabs that take a triangle of this reach: from the first to before the second.
    [[nodiscard]] std::array<std::size_t, 2> slabs_at(double low, double high) const;
    [[nodiscard]] bool has_wall_at(double x) const;
    void move_walls();

private:
    std::size_t axis_ = 0;
    std::vector<double> walls_;
    std::vector<std::uint64_t> loads_;
    double quantum_ = 1;
    double bound_ = 1;
};

}  // namespace trisect::app
