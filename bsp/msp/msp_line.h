// SPDX-License-Identifier: Apache-2.0
//
// MspLine: the order of boundary features on a cutting line in a plane.
// It is the heart of the index: here it is decided what lies on a line and on both sides of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/msp/msp_geometry.h>

namespace trisect::detail::msp {

/// A line as the common points of two planes, of which the first is the plane of the region that
/// the line cuts. Directed: from lexicographically smaller to larger points. Left is the left-hand
/// side as seen from above the plane, looking along the line.
struct LineFrame {
    PlaneIndex plane = 0;  ///< of the region
    PlaneIndex cut = 0;    ///< meets it in the line
    int axis = 0;          ///< the first one along which the direction is not 0; there it is > 0
    int sign = 1;          ///< of component `axis` of n_plane × n_cut
    [[nodiscard]] bool left_is_below() const { return sign > 0; }
};
[[nodiscard]] LineFrame line_frame(const MspGeometry& geometry, PlaneIndex plane, PlaneIndex cut);

/// Part of a polygon that ends or passes at a line: its half-plane, seen along the line. The
/// polygon goes from the line in the direction sense · (n × t), n its normal, t the line's
/// direction; sense 0 means both, a polygon that the line cuts through.
struct Contact {
    PlaneIndex plane = 0;
    int sense = 0;
    /// 1 or -1: the polygon touches the region's plane from above or below with its edge; 0: it
    /// lies in that plane or crosses it.
    int elevation = 0;
    Label face;
    Label own;  ///< what points of the contact are: an edge, or within the face
};

/// A contact between two points of a line. `a` is the lexicographically smaller end. Dead ends lie
/// on the border of the region.
struct Segment {
    PlaneIndex line = 0;  ///< meets the plane of the region in the segment's line
    BorderPoint a;
    BorderPoint b;
    Contact contact;
};

/// A segment that leaves a point of the line to the left.
struct Ray {
    PointIndex at = 0;
    PlaneIndex line = 0;
    Contact contact;
};

/// Data that an MspLine collects before it decides.
struct LineContents {
    std::vector<Segment> along;       ///< on the line
    std::vector<Ray> rays;            ///< leave it to the left
    std::vector<BorderPoint> points;  ///< on it, not dead; ends of `along` need not be repeated
    void clear() {
        along.clear();
        rays.clear();
        points.clear();
    }
};

/// A line in a region, divided by points.
class MspLine {
public:
    struct Stop {
        PointIndex point = 0;
        Label label;
    };

    /// Whom to believe about what lies beside the line; see the .cpp.
    enum class Evidence : std::uint8_t {
        Around,   ///< no one; `around` is on both sides
        Settled,  ///< contacts that settle it; there is one
        All       ///< all contacts; there is one
    };

    MspLine(const MspGeometry& geometry, const LineFrame& frame, const LineContents& contents,
            Evidence evidence, Label around);

    /// Points at which something changes, in order, and what lies between them: one entry more.
    [[nodiscard]] std::span<const Stop> stops() const { return stops_; }
    [[nodiscard]] std::span<const Label> between() const { return between_; }
    /// What the region is along the line, on either side, if nothing else is there.
    [[nodiscard]] Label left() const { return left_; }
    [[nodiscard]] Label right() const { return right_; }

private:
    struct Interval {
        bool is_covered = false;  // by a contact, which has the label
        bool is_told = false;     // by contacts, what is to the left and right
        Label label;
        Label left;
        Label right;
    };
    void sort_places(const LineContents& contents);
    void cover(const LineContents& contents);
    void look_around(const LineContents& contents);
    [[nodiscard]] Label beyond(std::size_t place, const Interval& known, bool forward) const;
    void drop_needless_stops();
    [[nodiscard]] std::size_t place_of(PointIndex p) const;
    [[nodiscard]] bool tell(std::span<const Contact> contacts) const;
    [[nodiscard]] Label beside(const LineFrame& line, std::span<const Contact> contacts,
                               int side) const;

    const MspGeometry& geometry_;
    LineFrame frame_;
    Evidence evidence_;
    struct Place {
        PointIndex point = 0;
        Label label;
        bool is_dead = false;
        bool has_label = false;
    };
    std::vector<Place> places_;                      // all, dead ones too, in order
    std::vector<Interval> intervals_;                // before, between and after them
    std::vector<std::pair<std::size_t, Ray>> rays_;  // by place, sorted
    std::vector<Stop> stops_;
    std::vector<Label> between_;
    Label left_;
    Label right_;
};

}  // namespace trisect::detail::msp
