// SPDX-License-Identifier: Apache-2.0
//
// FeatureWalk: the closest features of two convex polytopes, by local search.
// It starts from features that were close before.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/hierarchies/convex/common_frame.h>
#include <trisect/bsp/hierarchies/convex/convex_polytope.h>

namespace trisect::hierarchies {

/// A feature of A and one of B. The default names the first vertices.
struct FeaturePair {
    PolytopeFeature a;
    PolytopeFeature b;
    friend constexpr auto operator<=>(const FeaturePair&, const FeaturePair&) = default;
};

/// Where a walk ended.
struct WalkEnd {
    /// Disjoint polytopes: the closest points are in the relative interiors of these, which are two
    /// vertices, a vertex and an edge, two edges or a vertex and a face. Others may be equally
    /// close where faces or edges are parallel: smallest_pair() chooses.
    /// Polytopes that meet: features that have a point in common; for a vertex inside a body, the
    /// vertex and the face from which the walk found it.
    FeaturePair pair;
    bool meet = false;  ///< the sets have a common point; exact
    /// They meet, and all that is known is that the vertex of the pair is in the other body.
    bool inside = false;
    std::uint32_t steps = 0;
};

/// What walks did, added up.
struct WalkCounts {
    std::uint64_t walks = 0;
    std::uint64_t steps = 0;        ///< changes of the pair
    std::uint64_t signs = 0;        ///< signs decided
    std::uint64_t exact_signs = 0;  ///< of these, by integers
};

/// One walk over two placed polytopes. Exact: all decisions that doubles with bounds leave open are
/// made in integers. For one thread; polytopes and frame must outlive it.
///
/// Source: Lin and Canny, A fast algorithm for incremental distance calculation (ICRA 1991), with
/// the states of Mirtich, V-Clip (ACM TOG 17(3), 1998); why it ends, feature_walk.cpp.
///
/// Cost: a step looks at the edges of a vertex, the two faces of an edge or, where it enters a
/// face, at the face's outline. Where little has moved there are none or a few steps. Where a
/// vertex is behind the face that it was close to, all faces are looked at once.
class FeatureWalk {
public:
    /// \pre neither is empty.
    FeatureWalk(const ConvexPolytope& a, const ConvexPolytope& b, const CommonFrame& frame,
                WalkCounts* counts = nullptr);

    /// From any features. \pre they exist.
    const WalkEnd& run(const FeaturePair& start = {});

    [[nodiscard]] const WalkEnd& closest() const { return closest_; }

    /// lower <= distance <= upper, of the frame; both 0 for sets that meet. \pre run
    struct Bounds {
        double lower = 0;
        double upper = 0;
    };
    [[nodiscard]] Bounds bounds() const;
    /// Exactly, of the frame. \pre run
    [[nodiscard]] ExactRational squared_distance() const;
    /// The smallest pair of features, A's first, whose distance is that of the polytopes: does not
    /// depend on the start. Of polytopes that meet it is what the walk found. \pre run
    [[nodiscard]] FeaturePair smallest_pair();

private:
    using Body = CommonFrame::Body;
    struct Place {
        Body body;
        std::uint32_t vertex;
    };
    struct Part {
        Body body;
        PolytopeFeature feature;
    };
    // Features with the closest points of their closures in their relative interiors.
    struct State {
        PolytopeFeature a;
        PolytopeFeature b;
        // Of two edges, or a vertex and a face: the way from A's point to B's (from the face's to
        // the vertex's) along the normal that the formulas make, 0 when they meet.
        int sense = 0;
        bool crossing = false;  // an edge through a face
    };
    struct Doubles;
    struct Integers;

    [[nodiscard]] const ConvexPolytope& polytope(Body b) const { return b == Body::A ? *a_ : *b_; }
    [[nodiscard]] std::array<Place, 2> ends(const Part& edge) const;
    [[nodiscard]] int outward(Body body) const { return frame_->is_mirror(body) ? -1 : 1; }
    template <class F>
    [[nodiscard]] int sign(const F& f) const;
    template <class F>
    [[nodiscard]] int decide(const detail::Ball& about, const F& f) const;
    template <class N>
    struct LinePair;
    template <class At>
    [[nodiscard]] auto lines(const Part& e, const Part& f, const At& at) const;
    template <class At>
    [[nodiscard]] auto normal_of(const Part& face, const At& at) const;
    template <class At>
    [[nodiscard]] auto way(const State& s, const At& at) const;
    template <class At>
    [[nodiscard]] auto squared(const State& s, const At& at) const;

    [[nodiscard]] const CommonFrame::Exact& exact_frame() const {
        return frame_->exact(a_->is_whole() && b_->is_whole());
    }
    void push(Part x, Part y, int sense = 0, bool crossing = false);
    void closest_points(const Part& x, const Part& y);
    void of_vertices(const Place& p, const Place& q);
    void of_vertex_and_edge(const Place& p, const Part& edge);
    void of_edges(const Part& e, const Part& f);
    void of_vertex_and_face(const Place& p, const Part& face);
    void of_edge_and_face(const Part& edge, const Part& face);
    [[nodiscard]] int side_of_face(const Place& p, const Part& face) const;
    [[nodiscard]] bool passes_through(const std::array<Place, 2>& e, const Part& face) const;

    [[nodiscard]] bool meets(const State& s) const;
    [[nodiscard]] bool is_less(const State& s, const State& t) const;
    [[nodiscard]] State nearest_found() const;
    [[nodiscard]] State nearest_below(const State& limit) const;

    enum class Rise : std::uint8_t { None, Found, Inside };
    Rise rise(Body body);
    Rise rise_from_vertex(const Part& x);
    Rise rise_from_edge(const Part& x);
    Rise rise_from_face(const Part& x);
    [[nodiscard]] int towards(Body body, const Place& from, const Place& to) const;
    [[nodiscard]] std::vector<PolytopeFeature> support(Body body) const;

    const ConvexPolytope* a_;
    const ConvexPolytope* b_;
    const CommonFrame* frame_;
    WalkCounts* counts_;
    State state_;
    WalkEnd closest_;
    std::vector<State> found_;
};

}  // namespace trisect::hierarchies
