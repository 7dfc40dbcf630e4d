// SPDX-License-Identifier: Apache-2.0
//
// A vertex of the difference lies on a boundary; the points beside it do not. The search goes from
// the inside of a face at the vertex into the difference, closer and closer to the vertex, until
// the point is far enough from a boundary. Then it is moved to a coarse lattice if it stays a
// witness there, since "2 1/2" says more than a fraction of two hundred digits.
#include <trisect/bsp/verify/difference_witness.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <trisect/brep/measure/interior_point.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/infinity.h>

namespace trisect::detail {

namespace {

constexpr std::size_t blamed_limit = 32;

class WitnessSearch {
public:
    WitnessSearch(const WitnessQuestion& question, const DifferenceRadius& radius)
        : q_(question), radius_(radius), unit_(std::ldexp(1.0, question.lattice.exponent)) {}

    std::optional<Witness> run() const {
        const double within = q_.options.within.value_or(0);
        const double wanted =
            q_.options.within ? within : std::min(0.75 * radius_.lower * unit_, 1e300);
        const InteriorPoints inside(*radius_.piece);
        std::optional<Witness> best;
        for (unsigned shrink = 1; shrink <= 42; shrink += shrink < 6 ? 1 : 6) {
            const std::optional<Witness> found = examined(inside.near(radius_.vertex, shrink));
            // A point on no face is farther than 0 from all of them, whatever is certified.
            if (!found || (within > 0 && reach(*found) <= within)) continue;
            if (!best || reach(*found) > reach(*best)) best = found;
            if (reach(*best) > wanted) break;
        }
        if (!best) return best;
        best = simplified(*best, std::max(within, std::min(wanted, 0.9 * reach(*best))));
        best->faces = faces_around();
        return best;
    }

private:
    static double reach(const Witness& w) {
        return std::max(w.distance_to_exact, w.distance_to_result);
    }

    [[nodiscard]] std::optional<Witness> examined(const ExactPoint& point) const {
        std::optional<Witness> w = counted(point);
        if (w && w->in_exact == w->in_result)
            throw Error(ErrorCode::Internal,
                        "internal error: winding numbers do not confirm a point of the difference");
        return w;
    }

    /// Nothing when the point lies on a face of one of the meshes.
    [[nodiscard]] std::optional<Witness> counted(const ExactPoint& point) const {
        Witness w;
        w.point = point;
        for (const ImportedMesh& m : q_.meshes) {
            const auto winding = winding_number(m.mesh, point);
            if (!winding) return std::nullopt;
            w.winding.push_back(*winding);
        }
        w.in_exact = is_in_exact(w.winding);
        w.in_result = is_inside(w.winding.back());
        const GridPoint at = to_grid(point, q_.lattice);
        w.distance_to_exact = distance(q_.exact, at);
        w.distance_to_result = distance(q_.result, at);
        w.holds_as_given = holds_as_given(at);
        return w;
    }

    [[nodiscard]] bool is_inside(int winding) const {
        return q_.options.evaluate.winding == EvaluateOptions::Winding::Positive ? winding > 0
                                                                                 : winding != 0;
    }

    [[nodiscard]] bool is_in_exact(const std::vector<int>& winding) const {
        std::size_t in = 0;
        const std::size_t operands = winding.size() - 1;
        for (std::size_t i = 0; i < operands; ++i)
            if (is_inside(winding[i])) ++in;
        switch (q_.operation) {
            case BooleanOperation::Union:
                return in > 0;
            case BooleanOperation::Intersection:
                return in == operands;
            case BooleanOperation::Difference:
                return in == 1 && is_inside(winding[0]);
            default:
                return in % 2 == 1;
        }
    }

    /// Certified from below, in the user's units.
    [[nodiscard]] double distance(const GridTriangles& surface, const GridPoint& at) const {
        return surface.empty() ? infinity : surface.nearest(at).lower * unit_;
    }

    /// Whether no mesh, moved back to where it was given, sweeps over the point.
    [[nodiscard]] bool holds_as_given(const GridPoint& at) const {
        for (std::size_t i = 0; i < q_.meshes.size(); ++i) {
            if (q_.moved[i] == 0) continue;
            const double limit = q_.moved[i] / unit_ * surely_more;
            for (const auto& t : q_.meshes[i].mesh.triangles) {
                const auto& p = q_.meshes[i].mesh.points;
                const GridTriangle triangle(to_grid(p[t[0]]), to_grid(p[t[1]]), to_grid(p[t[2]]));
                if (triangle.upper_distance(at, limit + 8 * grid_error) <= limit + 4 * grid_error)
                    return false;
            }
        }
        return true;
    }

    [[nodiscard]] ExactPoint rounded(const ExactPoint& point, int exponent) const {
        ExactPoint out;
        for (std::size_t k = 0; k < 3; ++k) {
            const double units = point[k].scaled(-exponent).to_double();
            out[k] = ExactRational::from_double(std::nearbyint(units)).scaled(exponent);
        }
        return out;
    }

    /// On the coarsest lattice on which a nearby point is a witness farther than `least`.
    [[nodiscard]] Witness simplified(const Witness& found, double least) const {
        const double extent =
            std::max({std::fabs(found.point[0].to_double()), std::fabs(found.point[1].to_double()),
                      std::fabs(found.point[2].to_double()), unit_});
        const int top = std::ilogb(extent);
        for (int exponent = top - 2; exponent > top - 50; exponent -= 4) {
            const std::optional<Witness> w = counted(rounded(found.point, exponent));
            if (w && w->in_exact != w->in_result && w->in_exact == found.in_exact &&
                reach(*w) > least)
                return *w;
        }
        return found;
    }

    [[nodiscard]] std::optional<BlamedFace> blamed(FaceId f) const {
        const FaceSource source = radius_.piece->source(f);
        for (std::size_t i = 0; i < q_.solids.size(); ++i)
            if (q_.solids[i].source_id() == source.operand)
                return BlamedFace{static_cast<std::uint32_t>(i), source.face};
        return std::nullopt;
    }

    /// Those at the vertex first, then the others of its shell.
    [[nodiscard]] std::vector<BlamedFace> faces_around() const {
        const Brep& brep = *radius_.piece;
        std::vector<BlamedFace> out;
        std::set<BlamedFace> seen;
        const auto add = [&](FaceId f) {
            const auto face = blamed(f);
            if (face && out.size() < blamed_limit && seen.insert(*face).second)
                out.push_back(*face);
        };
        for (const HalfedgeId h : brep.outgoing_halfedges(radius_.vertex)) add(brep.face(h));
        const FaceId first = brep.face(brep.outgoing(radius_.vertex));
        for (const FaceId f : brep.faces(brep.shell(first))) add(f);
        return out;
    }

    const WitnessQuestion& q_;
    const DifferenceRadius& radius_;
    double unit_;
};

}  // namespace

std::optional<Witness> find_witness(const WitnessQuestion& question,
                                    const DifferenceRadius& radius) {
    return WitnessSearch(question, radius).run();
}

}  // namespace trisect::detail
