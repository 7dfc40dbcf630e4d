// SPDX-License-Identifier: Apache-2.0
//
// The trees of the modeller as structures for interference: B's triangles are pushed down A's tree,
// cut at its planes, and meet the triangles of A on the planes that they touch. In the classic tree
// of Thibault and Naylor a plane has a list of them; in Vanecek's tree, the Brep-Index, a tree in
// the plane says which face is there.
//
// What no other structure here knows is where inside and outside are. So deep penetration is seen
// at once: as soon as one vertex of B is certainly inside of A and another one certainly outside,
// the solids overlap, and not one pair of triangles has been compared. Where all vertices are
// outside, a part of a triangle that comes to an inner leaf does as well. This is the early accept
// of the Brep-Index.
//
// The distance is a side line: regions have no boxes, only the planes on the way to them bound how
// near they can be.
//
// Source: W. Thibault and B. Naylor, Set operations on polyhedra using binary space partitioning
// trees (SIGGRAPH 1987); G. Vanecek, Brep-Index (IJCGA 1(3), 1991); W. Bouma and G. Vanecek,
// Collision detection and analysis in a physically based simulation (Eurographics Workshop on
// Animation and Simulation, 1991).

#include <chrono>
#include <string_view>
#include <utility>

#include <trisect/bsp/hierarchies/partition.h>
#include <trisect/bsp/hierarchies/partitions.h>
#include <trisect/bsp/hierarchies/plane_tree.h>

namespace trisect::hierarchies {

namespace {

class PlaneTreePartition final : public Partition {
public:
    using Make = PlaneTree (*)(const detail::InterferenceModelData&);

    PlaneTreePartition(std::string_view name, Make make, const InterferenceModel& a,
                       const InterferenceModel& b)
        : Partition(a, b), name_(name) {
        const auto start = std::chrono::steady_clock::now();
        tree_ = make(a.data());
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string_view name() const override { return name_; }
    BuildReport build_report() const override {
        return {seconds_, tree_.bytes() + common_bytes(), tree_.node_count(), tree_.depth()};
    }

protected:
    bool find_for(std::uint32_t b, FunctionRef<bool(std::uint32_t)> offer,
                  CostCounters& counters) override {
        const auto go_on = [](bool, const RoughPolygon&) { return false; };
        return tree_.push(polygon(b), offer, go_on, counters);
    }
    bool find_in_cells(const Box&, FunctionRef<bool(std::uint32_t)>, CostCounters&) override {
        return false;  // find_for has the triangle
    }
    void find_near_cells(const Box& box, double limit, FunctionRef<double(std::uint32_t)> offer,
                         CostCounters& counters) override {
        tree_.find_near(box, limit, offer, counters);
    }

    std::optional<Relation> find_early_relation(CostCounters& counters) override {
        ++counters.volume_tests;
        // Of a boundary that is not embedded, the tree's inside means nothing.
        if (tree_.stray_count() != 0 || !fixed().bounds().meets(moved().bounds()))
            return std::nullopt;
        bool inside = false;
        bool outside = false;
        // Neighbours in the list are neighbours on the surface: look here and there first.
        const std::size_t n = data_b().positions.size();
        for (std::size_t step = std::max<std::size_t>(1, n / 16), from = 0; from < step; ++from)
            for (std::size_t v = from; v < n; v += step) {
                const auto where = tree_.is_inside(moved().corner(v), moved().error(), counters);
                if (!where) continue;
                (*where ? inside : outside) = true;
                if (inside && outside) return Relation::Overlapping;
            }
        if (!outside) return std::nullopt;
        const auto never = [](std::uint32_t) { return false; };
        const auto is_witness = [&](bool in, const RoughPolygon& part) {
            return in && tree_.is_inside(part.middle(), part.error, counters).value_or(false);
        };
        for (std::uint32_t b = 0; b < moved().size(); ++b)
            if (moved()[b].meets(fixed().bounds()) &&
                tree_.push(polygon(b), never, is_witness, counters))
                return Relation::Overlapping;
        return std::nullopt;
    }

private:
    [[nodiscard]] RoughPolygon polygon(std::uint32_t b) const {
        const auto& v = data_b().triangles[b].vertex;
        return RoughPolygon::triangle(moved().corner(v[0].index), moved().corner(v[1].index),
                                      moved().corner(v[2].index), moved().error());
    }

    std::string_view name_;
    PlaneTree tree_;
    double seconds_ = 0;
};

}  // namespace

std::unique_ptr<PairStructure> make_bsp_partition(const InterferenceModel& a,
                                                  const InterferenceModel& b) {
    return std::make_unique<PlaneTreePartition>("bsp", PlaneTree::classic, a, b);
}

std::unique_ptr<PairStructure> make_msp_partition(const InterferenceModel& a,
                                                  const InterferenceModel& b) {
    return std::make_unique<PlaneTreePartition>("msp", PlaneTree::multidimensional, a, b);
}

}  // namespace trisect::hierarchies
