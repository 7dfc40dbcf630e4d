// SPDX-License-Identifier: Apache-2.0
//
// Many points at once. A point alone waits for memory most of its time: slot, brick, leaf, planes,
// corners of the mesh, one after the other. Here every step is done for 32 points before the next
// one, and prefetches the memory of the next one. Points in cells without polygons need no more
// than what fits into a small cache and are found at once; the others are sorted by leaf first, so
// that neighbours come after each other. On several threads, too, all of them are sorted together:
// were each part sorted by itself, every thread would walk through the whole tree.

#include <algorithm>
#include <bit>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/index/index_counters.h>
#include <trisect/bsp/query/points/index_in_leaf.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

using Points = std::span<const std::array<double, 3>>;
using Answer = PointInLeaf::Answer;

// What is wanted of points: where they are.
struct ToLocations {
    std::span<Location> results;

    void off(std::uint32_t number, bool inside) const {
        results[number] = inside ? Location::Inside : Location::Outside;
    }
    // `rank` of the normals of the polygons, or 0 when it is not known.
    void on(std::uint32_t number, const IndexPoint&, std::vector<PolygonId>& on, int rank) const {
        results[number] = rank == 1   ? Location::OnFace
                          : rank == 2 ? Location::OnEdge
                          : rank == 3 ? Location::OnVertex
                                      : location_on(on);
    }
};

// Or also what they are on.
struct ToPlaces {
    const FoundPoint& found;

    void off(std::uint32_t number, bool inside) const {
        found(number, inside ? Location::Inside : Location::Outside, nullptr, none);
    }
    void on(std::uint32_t number, const IndexPoint& p, std::vector<PolygonId>& on, int) const {
        found(number, Location::OnFace, &p, on);
    }
    static inline thread_local std::vector<PolygonId> none;
};

struct PointOfLeaf {
    std::uint32_t leaf;
    std::uint32_t point;
};

// Numbers of the points of all lists, by leaf: a counting sort by the leading bits of the leaf.
std::vector<std::uint32_t> in_order_of_leaves(const std::vector<std::vector<PointOfLeaf>>& lists) {
    std::size_t count = 0;
    std::uint32_t last = 0;
    for (const auto& list : lists) {
        count += list.size();
        for (const auto& [leaf, point] : list) last = std::max(last, leaf);
    }
    const auto width = [](std::size_t v) { return static_cast<int>(std::bit_width(v)); };
    const int wanted = std::min(14, width(count));
    const auto shift = static_cast<unsigned>(std::max(width(last) - wanted, 0));
    std::vector<std::uint32_t> begin((std::size_t{last} >> shift) + 2, 0);
    for (const auto& list : lists)
        for (const auto& [leaf, point] : list) ++begin[(leaf >> shift) + 1];
    for (std::size_t b = 1; b < begin.size(); ++b) begin[b] += begin[b - 1];
    std::vector<std::uint32_t> order(count);
    for (const auto& list : lists)
        for (const auto& [leaf, point] : list) order[begin[leaf >> shift]++] = point;
    return order;
}

// Points of a solid whose tree is one leaf, with a grid.
template <class Sink>
class Batch {
public:
    static constexpr std::size_t together = 32;

    Batch(const IndexBase& index, const IndexedLeaf& leaf, Points points, const Sink& sink)
        : index_(index),
          leaf_(leaf),
          grid_(*leaf.grid()),
          turned_(index.root().complemented),
          beyond_(index.is_inside_beyond()),
          lattice_(index.lattice()),
          points_(points),
          sink_(sink) {}

    // Points from begin on: those in cells without polygons are found at once, in their own order;
    // the others are left in `mixed`, with their leaves.
    void find_empty(std::size_t begin, std::size_t end, std::vector<PointOfLeaf>& mixed) {
        std::uint64_t empty = 0;
        Descent& d = all_[0];
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            descend(d, i);
            if (d.state == State::Known) {
                ++empty;
                sink_.off(i, d.inside);
            } else {
                mixed.push_back({d.state == State::Mixed ? d.cell.leaf : 0, i});
            }
        }
        index_counters().empty += empty;
    }

    // The others, in the order of their leaves.
    void find_mixed(std::span<const std::uint32_t> order) {
        for (std::size_t i = 0; i < order.size(); i += together) {
            const std::size_t end = std::min(i + together, order.size());
            for (std::size_t j = end; j < std::min(end + together, order.size()); ++j) {
                __builtin_prefetch(points_[order[j]].data());
                __builtin_prefetch(points_[order[j]].data() + 2);
            }
            locate(order.subspan(i, end - i));
        }
    }

private:
    enum class State : std::uint8_t { Known, Mixed, Open, Alone };
    struct Descent {
        std::uint32_t number = 0;
        State state = State::Known;
        bool inside = false;
        IndexGrid::Position at;
        IndexedLeaf::Cell cell;
        PointInLeaf in_leaf;
    };

    void descend(Descent& d, std::uint32_t number) const {
        d.number = number;
        d.state = State::Alone;
        std::array<double, 3> p{};
        if (!IndexPoint::to_lattice(points_[number], lattice_, p)) return;
        d.state = State::Known;
        for (std::size_t k = 0; k < 3; ++k)
            if (p[k] > index_.hi()[k] || p[k] < index_.lo()[k]) {
                d.inside = beyond_;
                return;
            }
        if (!grid_.find_position(p, d.at)) {
            d.state = State::Alone;
            return;
        }
        d.cell = leaf_.cell_at(d.at);
        d.inside = d.cell.is_inside() != turned_;
        if (d.cell.is_mixed()) d.state = State::Mixed;
    }

    void locate(std::span<const std::uint32_t> order) {
        count_ = order.size();
        for (std::size_t i = 0; i < count_; ++i) {
            descend(all_[i], order[i]);
            if (all_[i].state == State::Mixed) __builtin_prefetch(&leaf_.leaf(all_[i].cell.leaf));
        }
        for_those(State::Mixed, [&](Descent& d) {
            leaf_.prefetch(leaf_.leaf(d.cell.leaf));
            d.in_leaf.begin(leaf_, turned_, d.cell, d.at, true);
        });
        for_those(State::Mixed, [&](Descent& d) {
            const Answer a = d.in_leaf.decide();
            d.state = a == Answer::Open ? State::Open : State::Known;
            d.inside = (a == Answer::Inside) != turned_;
        });
        fetch_corners();
        for (std::size_t i = 0; i < count_; ++i) finish(all_[i]);
    }

    void finish(Descent& d) {
        if (d.state == State::Known) {
            sink_.off(d.number, d.inside);
            return;
        }
        on_.clear();
        const IndexPoint p = IndexPoint::from_user(points_[d.number], lattice_);
        bool inside = false;
        int rank = 0;
        if (d.state == State::Alone) {
            inside = locate_polygons(index_, p, on_) == Location::Inside;
        } else {
            inside = d.in_leaf.finish(p, on_) != turned_;
            if (!on_.empty()) rank = d.in_leaf.rank();
        }
        if (on_.empty()) {
            sink_.off(d.number, inside);
        } else {
            sink_.on(d.number, p, on_, rank);
        }
    }

    template <class Work>
    void for_those(State state, const Work& work) {
        for (std::size_t i = 0; i < count_; ++i)
            if (all_[i].state == state) work(all_[i]);
    }
    template <class Work>
    void for_wanted(const Work& work) {
        for_those(State::Open, [&](const Descent& d) {
            const auto listed = leaf_.listed(leaf_.leaf(d.cell.leaf));
            for (std::uint64_t left = d.in_leaf.wanted(); left != 0; left &= left - 1)
                work(listed[static_cast<std::size_t>(std::countr_zero(left))]);
        });
    }
    void fetch_corners() {
        const Source* source = leaf_.polygons().only_source();
        if (source == nullptr) return;
        for_those(State::Open, [&](const Descent& d) {
            __builtin_prefetch(leaf_.listed(leaf_.leaf(d.cell.leaf)).data());
        });
        for_wanted([&](IndexedLeaf::Id id) { __builtin_prefetch(&source->mesh().triangles[id]); });
        for_wanted([&](IndexedLeaf::Id id) {
            for (int i = 0; i < 3; ++i) __builtin_prefetch(&source->corner(id, i));
        });
    }

    const IndexBase& index_;
    const IndexedLeaf& leaf_;
    const IndexGrid& grid_;
    const bool turned_;
    const bool beyond_;
    const Lattice lattice_;
    Points points_;
    const Sink& sink_;
    std::array<Descent, together> all_;
    std::size_t count_ = 0;
    std::vector<PolygonId> on_;
};

template <class Sink>
void locate_in_grid(const IndexBase& index, const IndexedLeaf& leaf, Points points,
                    unsigned threads, const Sink& sink) {
    const ParallelParts parts(points.size(), threads);
    std::vector<std::vector<PointOfLeaf>> mixed(parts.count());
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        Batch(index, leaf, points, sink).find_empty(begin, end, mixed[part]);
    });
    const std::vector<std::uint32_t> order = in_order_of_leaves(mixed);
    ParallelParts(order.size(), threads)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            Batch(index, leaf, points, sink)
                .find_mixed(std::span(order).subspan(begin, end - begin));
        });
}

template <class Sink>
void locate_one_by_one(const IndexBase& index, Points points, unsigned threads, const Sink& sink) {
    ParallelParts(points.size(), threads)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            std::vector<PolygonId> on;
            for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
                const IndexPoint p = IndexPoint::from_user(points[i], index.lattice());
                const Location l = locate_polygons(index, p, on);
                if (on.empty()) {
                    sink.off(i, l == Location::Inside);
                } else {
                    sink.on(i, p, on, 0);
                }
            }
        });
}

template <class Sink>
void locate_all(const IndexBase& index, Points points, unsigned threads, const Sink& sink) {
    if (points.size() >= 0xffffffffU) throw LimitError("more than 2^32 points at once");
    const IndexedLeaf* const leaf = index.is_bounded() ? index.only_leaf() : nullptr;
    if (leaf != nullptr && leaf->grid() != nullptr) {
        locate_in_grid(index, *leaf, points, threads, sink);
    } else {
        locate_one_by_one(index, points, threads, sink);
    }
}

}  // namespace

void locate_batch(const IndexBase& index, Points points, unsigned threads,
                  const FoundPoint& found) {
    locate_all(index, points, threads, ToPlaces{found});
}

void classify_batch(const IndexBase& index, Points points, unsigned threads,
                    std::span<Location> results) {
    locate_all(index, points, threads, ToLocations{results});
}

}  // namespace trisect::detail
