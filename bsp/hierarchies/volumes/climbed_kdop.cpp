// SPDX-License-Identifier: Apache-2.0
//
// k-DOPs whose slabs follow a turn by climbing (Klosowski, Held, Mitchell, Sowizral and Zikan
// 1998): each volume of B keeps the hull of what is below it, and the slab of d about the image is
// found by going from the corner that was extreme at the last pose to neighbours that are farther
// along M^T d, until none is. The slabs are as tight as fitted ones. Its authors climbed at the
// root and turned the corners of the k-DOP itself below; here every volume has its hull, which
// shows what climbing everywhere would bring and cost (kdop_turn.cpp turns slabs instead).
//
// Climbing ends at the extreme corner for certain only in exact arithmetic: on a flat hull doubles
// may stop where rounding hides the next ascent. So corners are on a grid (frame_hull.h) and the
// direction is rounded to integers, 25 + 31 bits and a sum of three; all comparisons are exact, and
// a corner none of whose neighbours is farther is extreme, since a convex set is within the cone of
// the edges at any of its corners.
//
// Errors. M^T d = s D + r with D integer, s a power of two. A true point is z = g v + e with v in
// the hull, g the grid's unit and |e_k| <= g / 2 + error. So d · M z <= s g max D·v + 2 |r|_1 +
// |M^T d|_1 max |e_k|, |z_k| <= 2; to that come 3 m_error |z|_1 and what the translation adds, as
// in kdop_turn.cpp. D·v has 58 bits, its double is off by 2^-53 of it.

#include <cmath>
#include <cstdint>
#include <memory>

#include <trisect/bsp/hierarchies/volumes/frame_hull.h>
#include <trisect/bsp/hierarchies/volumes/kdop.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchy.h>

namespace trisect::hierarchies {

namespace {

using detail::Vector3;
using Integer3 = std::array<std::int64_t, 3>;

template <std::size_t K>
class ClimbedHull {
public:
    ClimbedHull(std::span<const Vector3> corners, double error)
        : error_(0.5 * frame_hull_unit + error) {
        const ConvexPolytope hull = frame_hull(corners);
        for (const LatticePoint& v : hull.vertices())
            corner_.push_back({static_cast<std::int32_t>(v.x.to_integer()),
                               static_cast<std::int32_t>(v.y.to_integer()),
                               static_cast<std::int32_t>(v.z.to_integer())});
        first_.push_back(0);
        for (std::size_t v = 0; v < corner_.size(); ++v) {
            for (const ConvexPolytope::Spoke& s : hull.spokes(v)) neighbour_.push_back(s.vertex);
            first_.push_back(static_cast<std::uint32_t>(neighbour_.size()));
        }
    }

    // The largest d · v, from where the last search for this slab ended.
    [[nodiscard]] std::int64_t climb(std::size_t slab, const Integer3& d) {
        std::uint32_t at = last_[slab];
        std::int64_t height = along(at, d);
        for (bool higher = true; higher;) {
            higher = false;
            const std::uint32_t from = at;
            for (std::uint32_t i = first_[from]; i < first_[from + 1]; ++i)
                if (const std::int64_t h = along(neighbour_[i], d); h > height) {
                    height = h;
                    at = neighbour_[i];
                    higher = true;
                }
        }
        last_[slab] = at;
        return height;
    }
    /// How far a coordinate of a point may be from the hull.
    [[nodiscard]] double error() const { return error_; }

private:
    [[nodiscard]] std::int64_t along(std::uint32_t v, const Integer3& d) const {
        return d[0] * corner_[v][0] + d[1] * corner_[v][1] + d[2] * corner_[v][2];
    }

    std::vector<std::array<std::int32_t, 3>> corner_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> neighbour_;
    std::array<std::uint32_t, K> last_{};
    double error_;
};

template <std::size_t K>
struct ClimbedKind {
    struct Volume {
        KDop<K> slabs;
        std::unique_ptr<ClimbedHull<K>> hull;
    };
    using Moved = KDop<K>;

    class Pose {
    public:
        explicit Pose(const FrameMap& map) {
            for (std::size_t i = 0; i < K; ++i) direction_[i] = direction(i, map);
        }
        [[nodiscard]] Moved moved(const Volume& v) const {
            Moved r;
            for (std::size_t i = 0; i < K; ++i) {
                const Direction& d = direction_[i];
                const auto height = static_cast<double>(v.hull->climb(i, d.pulled));
                r.h[i] = float_above(height * d.unit + v.hull->error() * d.length + d.shift);
            }
            return r;
        }
        [[nodiscard]] static bool meet(const Volume& a, const Moved& b) { return a.slabs.meets(b); }
        [[nodiscard]] static double gap(const Volume& a, const Moved& b) { return a.slabs.gap(b); }

    private:
        struct Direction {
            Integer3 pulled{};
            double unit = 0;    ///< of the hull's coordinates times those of `pulled`
            double length = 0;  ///< |M^T d|_1, rounded up
            double shift = 0;   ///< what the translation adds, and errors
        };
        static Direction direction(std::size_t i, const FrameMap& map) {
            const std::array<int, 3>& axis = KDop<K>::directions[i % (K / 2)];
            const double sign = i < K / 2 ? 1 : -1;
            Vector3 pulled{};
            Direction r;
            double translation = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                for (std::size_t j = 0; j < 3; ++j) pulled[k] += sign * axis[j] * map.m[j][k];
                r.shift += sign * axis[k] * map.t[k];
                translation += std::abs(map.t[k]);
            }
            double largest = 0;
            for (const double v : pulled) largest = std::max(largest, std::abs(v));
            int exponent = 0;
            std::frexp(std::max(largest, 0x1p-500), &exponent);
            const double unit = std::ldexp(1.0, exponent - 31);
            double left = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double whole = std::nearbyint(pulled[k] / unit);
                r.pulled[k] = static_cast<std::int64_t>(whole);
                left += std::abs(pulled[k] - whole * unit);
                r.length += std::abs(pulled[k]);
            }
            r.unit = unit * frame_hull_unit;
            r.length = 1.001 * r.length + 3.01 * map.m_error;
            r.shift += 2.01 * left + 0x1p-46 * (r.length + map.stretch + translation) +
                       18.1 * map.m_error + 3.01 * map.t_error;
            return r;
        }
        std::array<Direction, K> direction_;
    };

    static constexpr bool has_unite = false;
    static Volume fit(std::span<const Vector3> corners, double error) {
        Volume r;
        r.slabs.add(corners, error);
        r.hull = std::make_unique<ClimbedHull<K>>(corners, error);
        return r;
    }
    static float size(const Volume& v) { return v.slabs.size(); }
    static float size(const Moved& v) { return v.size(); }
};

}  // namespace

std::unique_ptr<PairStructure> make_climbed_kdop18_tree(const InterferenceModel& a,
                                                        const InterferenceModel& b) {
    return std::make_unique<VolumeHierarchy<ClimbedKind<18>>>(a, b, TreeOptions{}, "kdop18-climb");
}

}  // namespace trisect::hierarchies
