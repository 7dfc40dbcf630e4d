// SPDX-License-Identifier: Apache-2.0
//
// An R-tree is a B-tree of boxes: wide nodes, all leaves on one level, made for discs and for
// insertion. Packed at once by sort-tile-recursive its nodes are full and overlap little. It is a
// hierarchy of volumes, but used as the partitions are: B's boxes are queries, one by one.
//
// Boost does not say which inner boxes it looks at. What it does say is which entries of leaves: a
// `satisfies` before `intersects` is evaluated for each of them.
//
// Source: A. Guttman, R-trees: a dynamic index structure for spatial searching (SIGMOD 1984); S.
// Leutenegger, M. Lopez and J. Edgington, STR: a simple and efficient algorithm for R-tree packing
// (ICDE 1997).
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include <trisect/bsp/hierarchies/partitions/partition.h>
#include <trisect/bsp/hierarchies/partitions/partitions.h>

namespace trisect::hierarchies {

namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using TreeEntry = std::pair<TreeBox, std::uint32_t>;
constexpr std::size_t node_size = 8;
using Tree = bgi::rtree<TreeEntry, bgi::rstar<node_size>>;

TreeBox tree_box(const Box& b) {
    return {TreePoint(b.lo[0], b.lo[1], b.lo[2]), TreePoint(b.hi[0], b.hi[1], b.hi[2])};
}

class RTreePartition final : public Partition {
public:
    RTreePartition(const InterferenceModel& a, const InterferenceModel& b) : Partition(a, b) {
        const auto start = std::chrono::steady_clock::now();
        std::vector<TreeEntry> entries;
        entries.reserve(fixed().size());
        for (std::uint32_t i = 0; i < fixed().size(); ++i)
            entries.emplace_back(tree_box(fixed()[i]), i);
        tree_ = Tree(entries);
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string_view name() const override { return "r-tree"; }
    /// Volumes and levels as of full nodes; Boost has no access to them.
    BuildReport build_report() const override {
        BuildReport r;
        r.seconds = seconds_;
        r.volumes = fixed().size();
        r.depth = 1;
        for (std::size_t n = fixed().size(); n > 1; ++r.depth) {
            n = (n + node_size - 1) / node_size;
            r.volumes += n;
        }
        r.bytes = r.volumes * sizeof(TreeEntry) + common_bytes();
        return r;
    }

protected:
    bool find_in_cells(const Box& box, FunctionRef<bool(std::uint32_t)> offer,
                       CostCounters& counters) override {
        const auto count = [&counters](const TreeEntry&) {
            ++counters.volume_tests;
            return true;
        };
        const auto query = bgi::satisfies(count) && bgi::intersects(tree_box(box));
        for (auto it = tree_.qbegin(query); it != tree_.qend(); ++it)
            if (offer(it->second)) return true;
        return false;
    }
    void find_near_cells(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                         CostCounters& counters) override {
        // The few nearest for a limit, then all that are within it. Boost keeps an ordered list of
        // as many as requested, so requesting all in the order of distances is slow.
        constexpr unsigned few = 8;
        for (auto it = tree_.qbegin(bgi::nearest(tree_box(box), few)); it != tree_.qend(); ++it) {
            ++counters.volume_tests;
            limit = offer(it->second);
        }
        if (!(limit >= 0)) return;
        Box wide = box;
        for (std::size_t k = 0; k < 3; ++k) {
            wide.lo[k] = std::nextafter(box.lo[k] - limit, -HUGE_VAL);
            wide.hi[k] = std::nextafter(box.hi[k] + limit, HUGE_VAL);
        }
        const auto query = bgi::satisfies([&](const TreeEntry&) {
                               ++counters.volume_tests;
                               return true;
                           }) &&
                           bgi::intersects(tree_box(wide));
        for (auto it = tree_.qbegin(query); it != tree_.qend(); ++it) (void)offer(it->second);
    }

private:
    Tree tree_;
    double seconds_ = 0;
};

}  // namespace

std::unique_ptr<PairStructure> make_r_tree_partition(const InterferenceModel& a,
                                                     const InterferenceModel& b) {
    return std::make_unique<RTreePartition>(a, b);
}

}  // namespace trisect::hierarchies
