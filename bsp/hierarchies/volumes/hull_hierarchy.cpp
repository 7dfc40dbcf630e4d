// SPDX-License-Identifier: Apache-2.0
//
// Convex hulls as volumes of the common tree, those of the triangles below with a bounded number of
// corners (small_hull.h). The tightest convex volume and the dearest test; `convex-parts` has the
// hulls of all vertices and tracked features instead, over parts that are convex themselves.
//
// A volume of B remembers the direction that separated it last: the next volume of A that it is
// compared with is the brother of that one, as a rule, and parted by nearly the same direction.

#include <trisect/bsp/hierarchies/volumes/small_hull.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>
#include <trisect/bsp/hierarchies/volumes/volume_hierarchy.h>

namespace trisect::hierarchies {

namespace {

struct HullKind {
    using Volume = SmallHull;
    struct Moved {
        SmallHull hull;
        mutable detail::Vector3 direction{};  ///< from the last volume of A; 0 at first
    };
    class Pose {
    public:
        explicit Pose(const FrameMap& map) : map_(map) {}
        [[nodiscard]] Moved moved(const Volume& v) const { return {v.moved(map_), {}}; }
        [[nodiscard]] static bool meet(const Volume& a, const Moved& b) {
            return !(gap_of(a, b.hull, GapEffort::Sign, b.direction) > 0);
        }
        [[nodiscard]] static double gap(const Volume& a, const Moved& b) {
            return gap_of(a, b.hull, GapEffort::Value, b.direction);
        }

    private:
        FrameMap map_;
    };
    static constexpr bool has_unite = false;
    static Volume fit(std::span<const detail::Vector3> corners, double error) {
        return SmallHull::around(corners, error);
    }
    static float size(const Volume& v) { return v.size(); }
    static float size(const Moved& v) { return v.hull.size(); }
};

}  // namespace

std::unique_ptr<PairStructure> make_hull_volumes(const InterferenceModel& a,
                                                 const InterferenceModel& b) {
    return std::make_unique<VolumeHierarchy<HullKind>>(a, b, TreeOptions{}, "hull");
}

}  // namespace trisect::hierarchies
