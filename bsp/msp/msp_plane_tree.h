// SPDX-License-Identifier: Apache-2.0
//
// PlaneTreeBuilder: construction of the tree of dimension 2 in a plane.
// It is the on side of the plane: a convex open region, the part of the boundary that lies in it,
// and the tree that distinguishes them.
#pragma once

#include <vector>

#include <trisect/bsp/msp/msp_choice.h>
#include <trisect/bsp/msp/msp_geometry.h>
#include <trisect/bsp/msp/msp_groups.h>
#include <trisect/bsp/msp/msp_line.h>
#include <trisect/bsp/msp/msp_nodes.h>

namespace trisect::detail::msp {

/// A point of the region that is not the end of a segment: a corner that touches the plane.
struct LonePoint {
    BorderPoint place;
    PlaneIndex line = 0;  ///< meets the plane in a line through the point
};

struct PlaneContents {
    std::vector<Segment> segments;
    std::vector<LonePoint> points;
    Label around;  ///< what the region is where there are no segments
};

class PlaneTreeBuilder {
public:
    PlaneTreeBuilder(MspGeometry& geometry, NodeList& nodes, const MspOptions& options)
        : geometry_(geometry), nodes_(nodes), options_(options) {}

    void build(PlaneIndex plane, PlaneContents&& contents, const Slot& slot);

private:
    struct Region {
        Groups segments;  ///< of polygons that lie in the plane or cross it
        Groups touching;  ///< of polygons that only touch it
        std::vector<LonePoint> points;
        Label around;
        Slot slot;
    };
    class Items;

    void add(Region& region, ItemIndex i) const;
    void part(Groups& list, Groups Region::*kind, const LineFrame& line, Region& below,
              Region& above);
    [[nodiscard]] PlaneIndex choose_line(const Region& region) const;
    void refine(Region&& region);
    void send(ItemIndex i, const LineFrame& line, Region& below, Region& above);
    void add_line(const LineFrame& line, const MspLine& contents, const Slot& slot);
    void push(Region&& region);

    MspGeometry& geometry_;
    NodeList& nodes_;
    const MspOptions& options_;
    PlaneIndex plane_ = 0;
    std::vector<Segment> segments_;
    std::vector<Region> pending_;
    LineContents on_line_;
    std::size_t turn_ = 0;  // counts cuts
};

}  // namespace trisect::detail::msp
