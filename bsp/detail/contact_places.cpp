// SPDX-License-Identifier: Apache-2.0
//
// Contact vertices: the points of the contact set where something ends or begins. A vertex of one
// solid on anything of the other, or two edges that meet in one point. Every piece of either
// boundary that touches the other one has such a point in its closure, because the contact set is a
// complex of points, segments and polygons. So comparing the cones there finds every flag that
// contacts can set.
//
// A contact vertex is known by its entities: a vertex of A, else a vertex of B, else an edge of
// each. No coordinates are needed to put together what belongs to one, unless a boundary touches
// itself: then another part of it may be at the same point under another name, even in the middle
// of its own contact with the other solid. Models know whether they do (rarely), and then points
// are compared as rationals and all triangles that contain them are collected.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/detail/contact_cones.h>
#include <trisect/bsp/detail/exact_place.h>
#include <trisect/bsp/detail/meeting_pairs.h>

namespace trisect::detail {

namespace {

// The name of a contact vertex.
struct PlaceKey {
    // 0: vertex of A, 1: vertex of B, 2: edge of A and edge of B, 3: edge of A and face of B, 4:
    // face of A and edge of B
    std::uint8_t kind = 0;
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    friend auto operator<=>(const PlaceKey&, const PlaceKey&) = default;
};

struct Incidence {
    PlaceKey key;
    std::uint32_t pair = 0;
    std::uint8_t point = 0;
};

// `edges_in_faces`: also the places where an edge passes through a face.
std::vector<Incidence> incidences_of(const PosedModels& models,
                                     const std::vector<MeetingPair>& pairs, bool edges_in_faces) {
    std::vector<Incidence> all;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
        const MeetingPair& pair = pairs[i];
        for (std::uint8_t k = 0; k < pair.contact.count; ++k) {
            const MeetingPoint& p = pair.contact.points[k];
            const BoundaryEntity a = entity_of(models.a, pair.a, p.a);
            const BoundaryEntity b = entity_of(models.b, pair.b, p.b);
            if (a.is_vertex())
                all.push_back({{0, a.index(), 0}, i, k});
            else if (b.is_vertex())
                all.push_back({{1, b.index(), 0}, i, k});
            else if (a.is_edge() && b.is_edge())
                all.push_back({{2, a.index(), b.index()}, i, k});
            else if (edges_in_faces && a.is_edge())
                all.push_back({{3, a.index(), b.index()}, i, k});
            else if (edges_in_faces && b.is_edge())
                all.push_back({{4, a.index(), b.index()}, i, k});
        }
    }
    std::ranges::sort(all, {}, &Incidence::key);
    return all;
}

// The triangles of both solids at one point.
class ConeParts {
public:
    explicit ConeParts(const PosedModels& models) : models_(models) {}

    void clear() {
        a_.clear();
        b_.clear();
        numbers_a_.clear();
        numbers_b_.clear();
    }
    void add_a(std::uint32_t t, Feature f) { add(models_.a, t, f, a_, numbers_a_); }
    void add_b(std::uint32_t t, Feature f) { add(models_.b, t, f, b_, numbers_b_); }
    [[nodiscard]] BoundaryFlags compare(bool thorough) const {
        return compare_cones(a_, b_, models_.poses, thorough);
    }

private:
    static void add(const InterferenceModelData& model, std::uint32_t t, Feature f,
                    std::vector<ConePart>& parts, std::vector<std::uint32_t>& numbers) {
        if (std::ranges::find(numbers, t) != numbers.end()) return;
        numbers.push_back(t);
        const ModelTriangle& m = model.triangles[t];
        ConePart part{posed_triangle(model, t), {}, f};
        for (std::size_t i = 0; i < 3; ++i) part.place[i] = model.place[m.vertex[i].index].index;
        parts.push_back(part);
    }

    const PosedModels& models_;
    std::vector<ConePart> a_;
    std::vector<ConePart> b_;
    std::vector<std::uint32_t> numbers_a_;
    std::vector<std::uint32_t> numbers_b_;
};

void add_flags_by_name(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                       std::span<const Incidence> all, BoundaryFlags& flags) {
    ConeParts parts(models);
    for (std::size_t i = 0; i < all.size() && !flags.is_decided();) {
        parts.clear();
        const PlaceKey key = all[i].key;
        for (; i < all.size() && all[i].key == key; ++i) {
            const MeetingPair& pair = pairs[all[i].pair];
            const MeetingPoint& p = pair.contact.points[all[i].point];
            parts.add_a(pair.a, p.a);
            parts.add_b(pair.b, p.b);
        }
        flags |= parts.compare(false);
    }
}

void add_flags_by_place(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                        std::span<const Incidence> all, BoundaryFlags& flags) {
    // One exact point for each name, then each different point once.
    std::vector<ExactPlace> places;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0 && all[i].key == all[i - 1].key) continue;
        const MeetingPair& pair = pairs[all[i].pair];
        places.push_back(place_of(models, pair, pair.contact.points[all[i].point]));
    }
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    ConeParts parts(models);
    for (const ExactPlace& place : places) {
        if (flags.is_decided()) return;
        parts.clear();
        const ExactPlace in_b = moved(place, models.poses.to_b);
        for (const MeetingPair& pair : pairs) {
            const auto at_a = feature_at(models.a, pair.a, place);
            if (!at_a) continue;
            const auto at_b = feature_at(models.b, pair.b, in_b);
            if (!at_b) continue;
            parts.add_a(pair.a, *at_a);
            parts.add_b(pair.b, *at_b);
        }
        flags |= parts.compare(true);
    }
}

}  // namespace

void add_flags_at_contacts(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                           BoundaryFlags& flags) {
    // An edge that passes through a face is a crossing, unless the boundary touches itself there.
    const bool by_place = models.a.touches_itself() || models.b.touches_itself();
    const std::vector<Incidence> all = incidences_of(models, pairs, by_place);
    if (by_place)
        add_flags_by_place(models, pairs, all, flags);
    else
        add_flags_by_name(models, pairs, all, flags);
}

}  // namespace trisect::detail
