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
// of its own contact with the other solid. Models store whether they do (rarely), and then points
// are compared as rationals and all triangles that contain them are collected.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/relation/contact_cones.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

// The name of a contact vertex, in one number: numbers of entities are below 2^30.
class PlaceKey {
public:
    enum Kind : std::uint8_t {
        VertexOfA,
        VertexOfB,
        Edges,
        EdgeOfA,  // and a face of B
        EdgeOfB   // and a face of A
    };
    PlaceKey() = default;
    PlaceKey(Kind kind, std::uint32_t first, std::uint32_t second)
        : code_(std::uint64_t{kind} << 60U | std::uint64_t{first} << 30U | second) {}
    [[nodiscard]] Kind kind() const { return static_cast<Kind>(code_ >> 60U); }
    [[nodiscard]] std::uint32_t first() const {
        return static_cast<std::uint32_t>(code_ >> 30U & 0x3fffffffU);
    }
    friend auto operator<=>(const PlaceKey&, const PlaceKey&) = default;

private:
    std::uint64_t code_ = 0;
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
                all.push_back({{PlaceKey::VertexOfA, a.index(), 0}, i, k});
            else if (b.is_vertex())
                all.push_back({{PlaceKey::VertexOfB, b.index(), 0}, i, k});
            else if (a.is_edge() && b.is_edge())
                all.push_back({{PlaceKey::Edges, a.index(), b.index()}, i, k});
            else if (edges_in_faces && a.is_edge())
                all.push_back({{PlaceKey::EdgeOfA, a.index(), b.index()}, i, k});
            else if (edges_in_faces && b.is_edge())
                all.push_back({{PlaceKey::EdgeOfB, a.index(), b.index()}, i, k});
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
    [[nodiscard]] std::size_t count_a() const { return a_.size(); }
    [[nodiscard]] std::size_t count_b() const { return b_.size(); }
    // Whether both triangles are among them.
    [[nodiscard]] bool has(std::uint32_t a, std::uint32_t b) const {
        return std::ranges::find(numbers_a_, a) != numbers_a_.end() &&
               std::ranges::find(numbers_b_, b) != numbers_b_.end();
    }
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

// Whether the angles of two triangles at a common corner are one: sides of both run along each
// other. Told by the other corners of their intersection.
bool are_angles_equal(const TriangleContact& contact, const MeetingPoint& apex) {
    if (!contact.coplanar || contact.count < 3 || !apex.a.is_corner() || !apex.b.is_corner())
        return false;
    const auto run_along = [&](std::size_t a, std::size_t b) {
        return std::ranges::any_of(contact.corners(), [&](const MeetingPoint& p) {
            return !(p == apex) && p.a.is_on_side(a) && p.b.is_on_side(b);
        });
    };
    const std::size_t a = apex.a.index();
    const std::size_t b = apex.b.index();
    const std::size_t before_a = (a + 2) % 3;
    const std::size_t before_b = (b + 2) % 3;
    return (run_along(a, b) && run_along(before_a, before_b)) ||
           (run_along(a, before_b) && run_along(before_a, b));
}

void add_flags_by_name(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                       std::span<const Incidence> all, BoundaryFlags& flags) {
    ConeParts parts(models);
    for (std::size_t i = 0; i < all.size() && !flags.is_decided();) {
        parts.clear();
        const PlaceKey key = all[i].key;
        std::size_t equal_angles = 0;
        for (; i < all.size() && all[i].key == key; ++i) {
            const MeetingPair& pair = pairs[all[i].pair];
            const MeetingPoint& p = pair.contact.points[all[i].point];
            parts.add_a(pair.a, p.a);
            parts.add_b(pair.b, p.b);
            if (are_angles_equal(pair.contact, p)) ++equal_angles;
        }
        // Equal cones share area and nothing else, which the pairs have shown.
        if (equal_angles == parts.count_a() && equal_angles == parts.count_b()) continue;
        flags |= parts.compare(false);
    }
}

// A contact vertex where a boundary may touch itself: a name, with its coordinates as doubles that
// mostly distinguish different ones, and as rationals where they do not.
struct ContactPlace {
    std::array<double, 3> at{};  // in A's lattice
    double error = 0;
    std::size_t begin = 0;  // incidences
    std::size_t end = 0;
    std::optional<ExactPlace> exact = std::nullopt;
    std::uint32_t same = 0;  // the number of another name of the same point, or its own
};

class ContactPlaces {
public:
    ContactPlaces(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                  std::span<const Incidence> all)
        : models_(models), pairs_(pairs), all_(all) {
        for (std::size_t i = 0; i < all.size();) {
            std::size_t end = i + 1;
            while (end < all.size() && all[end].key == all[i].key) ++end;
            places_.push_back({});
            places_.back().begin = i;
            places_.back().end = end;
            approximate(places_.back());
            i = end;
        }
        std::ranges::sort(places_, {}, [](const ContactPlace& p) { return p.at[0]; });
        for (const ContactPlace& p : places_) largest_error_ = std::max(largest_error_, p.error);
        unite();
        meet_other_pairs();
    }

    // visit(parts) for each point, until it returns true.
    template <class Visit>
    void for_each(Visit&& visit) {
        ConeParts parts(models_);
        for (std::uint32_t i = 0; i < places_.size(); ++i) {
            if (places_[i].same != i) continue;
            parts.clear();
            for (std::uint32_t j = i; j < places_.size() && is_near(i, j); ++j)
                if (places_[j].same == i) add_incidences(places_[j], parts);
            for (; other_ < others_.size() && others_[other_].place == i; ++other_)
                add_if_there(places_[i], pairs_[others_[other_].pair], parts);
            if (visit(parts)) return;
        }
    }

private:
    struct Other {
        std::uint32_t place = 0;
        std::uint32_t pair = 0;
    };

    void approximate(ContactPlace& p) {
        const PlaceKey& key = all_[p.begin].key;
        const RelativePose& to_a = models_.poses.to_a;
        std::optional<Approximation> known;
        if (key.kind() == PlaceKey::VertexOfA)
            known = models_.a.brep.point(VertexId(key.first())).approximation();
        else if (key.kind() == PlaceKey::VertexOfB && to_a.has_doubles())
            known = to_a.move(models_.b.brep.point(VertexId(key.first())).approximation());
        if (known) {
            p.at = known->c;
            p.error = known->error;
            return;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            p.at[k] = exact(p).c[k].to_double();
            p.error = std::max(p.error, std::nextafter(unit_roundoff * std::abs(p.at[k]), 1.0));
        }
    }
    const ExactPlace& exact(ContactPlace& p) {
        if (!p.exact) {
            const MeetingPair& pair = pairs_[all_[p.begin].pair];
            p.exact = place_of(models_, pair, pair.contact.points[all_[p.begin].point]);
        }
        return *p.exact;
    }

    // Whether a later place may be the same point, or one behind it may.
    [[nodiscard]] bool is_near(std::uint32_t i, std::uint32_t j) const {
        return places_[j].at[0] - places_[i].at[0] <= 2.001 * largest_error_;
    }
    bool are_same(ContactPlace& p, ContactPlace& q) {
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(p.at[k] - q.at[k]) > 1.001 * (p.error + q.error)) return false;
        return exact(p) == exact(q);
    }
    void unite() {
        for (std::uint32_t i = 0; i < places_.size(); ++i) places_[i].same = i;
        for (std::uint32_t i = 0; i < places_.size(); ++i) {
            if (places_[i].same != i) continue;
            for (std::uint32_t j = i + 1; j < places_.size() && is_near(i, j); ++j)
                if (places_[j].same == j && are_same(places_[i], places_[j])) places_[j].same = i;
        }
    }

    // Pairs that may contain a place without being known to: by the boxes of their triangles in A.
    void meet_other_pairs() {
        // The last term takes the roundings.
        const double slack =
            1.001 * (models_.a.position_error + largest_error_) + 0x1p-50 * models_.a.largest;
        for (std::uint32_t n = 0; n < pairs_.size(); ++n) {
            const ModelTriangle& t = models_.a.triangles[pairs_[n].a];
            std::array<double, 3> lo{};
            std::array<double, 3> hi{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto c = [&](std::size_t i) { return models_.a.position(t.vertex[i])[k]; };
                lo[k] = std::min({c(0), c(1), c(2)}) - slack;
                hi[k] = std::max({c(0), c(1), c(2)}) + slack;
            }
            const auto first = std::ranges::lower_bound(
                places_, lo[0], {}, [](const ContactPlace& p) { return p.at[0]; });
            for (auto p = first; p != places_.end() && p->at[0] <= hi[0]; ++p) {
                const auto number = static_cast<std::uint32_t>(p - places_.begin());
                if (p->same == number && p->at[1] >= lo[1] && p->at[1] <= hi[1] &&
                    p->at[2] >= lo[2] && p->at[2] <= hi[2])
                    others_.push_back({number, n});
            }
        }
        std::ranges::stable_sort(others_, {}, &Other::place);
    }

    void add_incidences(const ContactPlace& p, ConeParts& parts) const {
        for (std::size_t i = p.begin; i < p.end; ++i) {
            const MeetingPair& pair = pairs_[all_[i].pair];
            const MeetingPoint& point = pair.contact.points[all_[i].point];
            parts.add_a(pair.a, point.a);
            parts.add_b(pair.b, point.b);
        }
    }
    void add_if_there(ContactPlace& p, const MeetingPair& pair, ConeParts& parts) {
        if (parts.has(pair.a, pair.b)) return;
        const auto at_a = feature_at(models_.a, pair.a, exact(p));
        if (!at_a) return;
        const auto at_b = feature_at(models_.b, pair.b, moved(exact(p), models_.poses.to_b));
        if (!at_b) return;
        parts.add_a(pair.a, *at_a);
        parts.add_b(pair.b, *at_b);
    }

    const PosedModels& models_;
    const std::vector<MeetingPair>& pairs_;
    std::span<const Incidence> all_;
    std::vector<ContactPlace> places_;  // by their first coordinate
    double largest_error_ = 0;
    std::vector<Other> others_;  // by place
    std::size_t other_ = 0;
};

void add_flags_by_place(const PosedModels& models, const std::vector<MeetingPair>& pairs,
                        std::span<const Incidence> all, BoundaryFlags& flags) {
    ContactPlaces(models, pairs, all).for_each([&flags](const ConeParts& parts) {
        flags |= parts.compare(true);
        return flags.is_decided();
    });
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
