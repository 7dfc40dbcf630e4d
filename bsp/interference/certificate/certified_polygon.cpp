// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/certified_polygon.h>

#include <algorithm>

namespace trisect::detail::certified {

std::vector<Polygon> beside(const std::vector<Polygon>& polygons, const SeparatingPlane& plane,
                            int side) {
    std::vector<Polygon> r;
    for (const Polygon& p : polygons) {
        std::vector<ExactRational> values;
        for (const ExactPoint& v : p) values.push_back(value_at(plane, v));
        if (std::ranges::none_of(values,
                                 [side](const ExactRational& v) { return v.sign() == side; }))
            continue;
        Polygon& q = r.emplace_back();
        for (std::size_t i = 0; i < p.size(); ++i) {
            const std::size_t j = (i + 1) % p.size();
            if (values[i].sign() != -side) q.push_back(p[i]);
            if (values[i].sign() * values[j].sign() >= 0) continue;
            const ExactRational t = values[i] / (values[i] - values[j]);
            const ExactPoint d = minus(p[j], p[i]);
            q.push_back({p[i][0] + t * d[0], p[i][1] + t * d[1], p[i][2] + t * d[2]});
        }
    }
    return r;
}

}  // namespace trisect::detail::certified
