// SPDX-License-Identifier: Apache-2.0
//
// ExactContacts: exact contacts of polygons of two placed solids.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/interference/tree/exact_triangles.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect::detail {

/// A triangle that contains a point, and the feature of it that the point is on.
struct TriangleAt {
    std::uint32_t triangle = 0;
    Feature feature;
};

/// A point that both boundaries contain, with all triangles that contain it.
struct MeetingPlace {
    std::array<double, 3> at{};  ///< in A's lattice, within `error` in each coordinate
    double error = 0;
    std::uint32_t meeting = 0;  ///< two triangles that meet there,
    std::uint8_t point = 0;     ///< in this point of their contact
    std::optional<ExactPlace> exact{};
    std::vector<TriangleAt> a{};
    std::vector<TriangleAt> b{};
};

/// Two triangles that meet.
struct MeetingTriangles {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    TriangleContact contact;
    std::array<std::uint32_t, 6> places{};  ///< of the contact's points
    std::vector<std::uint32_t> others;      ///< further places that both contain
};

/// Where two features meet, by the places of their corners: a corner, a side and a polygon, or two
/// sides.
struct PlaceName {
    enum class Kind : std::uint8_t { CornerOfA, CornerOfB, Sides, SideOfA, SideOfB };
    Kind kind = Kind::CornerOfA;
    std::array<std::uint32_t, 4> parts{};
    friend auto operator<=>(const PlaceName&, const PlaceName&) = default;
};

/// For one question. Polygons come in pairs: all that may have a common point must come before
/// `find_places`.
class ExactContacts {
public:
    /// `poses` must outlive this.
    explicit ExactContacts(const PosedPair& poses) : poses_(poses), test_(poses) {}

    /// Compares two polygons, once for a pair.
    void compare(const PolygonId& a, const PolygonId& b);
    /// Puts together what meets at a point.
    void find_places();

    /// From areas and from the cones at all places; until the relation is decided. A place costs
    /// some microseconds. \pre find_places()
    [[nodiscard]] BoundaryFlags flags();
    /// In ascending order. \pre find_places()
    [[nodiscard]] std::vector<NamedContact> contacts();

private:
    // A point of a contact, with a name: equal names are equal points.
    struct Incidence {
        PlaceName name;
        std::uint32_t meeting = 0;
        std::uint8_t point = 0;
    };

    [[nodiscard]] PlaceName place_name(std::uint32_t meeting, std::uint8_t point);
    [[nodiscard]] MeetingPlace place_at(std::uint32_t meeting, std::uint8_t point);
    [[nodiscard]] std::optional<Approximation> approximate(const MeetingTriangles& m,
                                                           const MeetingPoint& p) const;
    [[nodiscard]] const ExactPlace& exact(MeetingPlace& place) const;
    [[nodiscard]] bool are_same(MeetingPlace& p, MeetingPlace& q) const;
    void unite(const std::vector<Incidence>& all);
    void add_others();
    [[nodiscard]] static bool may_contain(const ExactTriangles::Triangle& t,
                                          const Approximation& at);
    void add_if_there(MeetingTriangles& meeting, std::uint32_t place);
    [[nodiscard]] BoundaryFlags flags_at(const MeetingPlace& place);
    [[nodiscard]] EntityName name_at(MeetingPlace& place, bool of_a) const;
    void add_segments(const MeetingTriangles& m, std::vector<NamedContact>& out);
    void add_segment(const MeetingTriangles& m, std::uint32_t from, std::uint32_t to,
                     std::vector<NamedContact>& out);
    [[nodiscard]] std::vector<PolygonId> common_polygons(std::uint32_t p, std::uint32_t q,
                                                         bool of_a) const;

    const PosedPair& poses_;
    TrianglePairTest test_;
    ExactTriangles a_;
    ExactTriangles b_;
    FlatMap compared_;
    std::vector<MeetingTriangles> meetings_;
    std::vector<MeetingPlace> places_;  // by their first coordinates
    double largest_error_ = 0;
};

}  // namespace trisect::detail
