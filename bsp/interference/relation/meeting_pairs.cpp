// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/relation/meeting_pairs.h>

#include <algorithm>
#include <tuple>

namespace trisect::detail {

BoundaryEntity entity_of(const InterferenceModelData& model, std::uint32_t triangle,
                         Feature feature) {
    const ModelTriangle& t = model.triangles[triangle];
    if (feature.is_corner()) return model.place[t.vertex[feature.index()].index];
    if (feature.is_side()) {
        const EdgeId e = t.edge[feature.index()];
        if (e.is_valid()) {
            const auto copies = model.brep.copies(e);
            return copies.empty() ? e : *std::ranges::min_element(copies);
        }
    }
    return t.face;
}

Feature feature_between(Feature p, Feature q) {
    for (std::size_t i = 0; i < 3; ++i)
        if (p.is_on_side(i) && q.is_on_side(i)) return Feature::side(i);
    return Feature::interior();
}

std::vector<Contact> contacts_of(const PosedModels& models, const std::vector<MeetingPair>& pairs) {
    std::vector<Contact> all;
    for (const MeetingPair& pair : pairs) {
        const TriangleContact& c = pair.contact;
        const auto note = [&](Feature a, Feature b, std::uint8_t dimension) {
            all.push_back({entity_of(models.a, pair.a, a), entity_of(models.b, pair.b, b),
                           dimension, dimension == 2 && c.opposite});
        };
        for (const MeetingPoint& p : c.corners()) note(p.a, p.b, 0);
        for (std::size_t i = 0; i < c.count; ++i)
            for (std::size_t j = i + 1; j < c.count; ++j) {
                // Corners of a polygon are neighbours where a side of one triangle carries both.
                const Feature a = feature_between(c.points[i].a, c.points[j].a);
                const Feature b = feature_between(c.points[i].b, c.points[j].b);
                if (c.count == 2 || a.is_side() || b.is_side()) note(a, b, 1);
            }
        if (c.count > 2) note(Feature::interior(), Feature::interior(), 2);
    }
    // Of each pair of entities the largest dimension.
    std::ranges::sort(all, [](const Contact& x, const Contact& y) {
        return std::tie(x.a, x.b, y.dimension) < std::tie(y.a, y.b, x.dimension);
    });
    const auto same_pair = [](const Contact& x, const Contact& y) {
        return x.a == y.a && x.b == y.b;
    };
    all.erase(std::unique(all.begin(), all.end(), same_pair), all.end());
    return all;
}

}  // namespace trisect::detail
