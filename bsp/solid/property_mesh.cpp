// SPDX-License-Identifier: Apache-2.0
//
// Faces are not joined across the faces of operands, so that the name of a triangle's face says
// where its corners are to be looked up. Weights are ratios of areas in the coordinate plane in
// which the face is largest, in extended precision where the machine has it.
#include <trisect/bsp/property_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <trisect/kernel/error.h>

namespace trisect {
namespace {

using Weight = long double;
using Weights = std::array<Weight, 3>;
using Corners = std::array<std::size_t, 3>;  ///< positions in PolygonMesh::corners

std::array<Weight, 3> normal_of(const Point3d& a, const Point3d& b, const Point3d& c) {
    std::array<Weight, 3> u{};
    std::array<Weight, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = Weight{b[k]} - a[k];
        v[k] = Weight{c[k]} - a[k];
    }
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Weight dot(const std::array<Weight, 3>& a, const std::array<Weight, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A face of an operand, in which one of the result lies.
class SourceFace {
public:
    SourceFace(const PropertyOperand& operand, std::uint32_t face)
        : mesh_(*operand.mesh), begin_(mesh_.face_begin[face]), end_(mesh_.face_begin[face + 1]) {}

    [[nodiscard]] const Point3d& point(std::size_t corner) const {
        return mesh_.points[mesh_.corners[corner]];
    }

    /// The sum of the normals of the fan.
    [[nodiscard]] std::array<Weight, 3> normal() const {
        std::array<Weight, 3> out{};
        for (std::size_t i = begin_ + 1; i + 1 < end_; ++i) {
            const auto n = normal_of(point(begin_), point(i), point(i + 1));
            for (std::size_t k = 0; k < 3; ++k) out[k] += n[k];
        }
        return out;
    }

    [[nodiscard]] std::optional<std::size_t> corner_at(const Point3d& p) const {
        for (std::size_t i = begin_; i < end_; ++i)
            if (point(i) == p) return i;
        return std::nullopt;
    }

    /// The triangle of the fan that has the point, or misses it least.
    [[nodiscard]] std::pair<Corners, Weights> place_of(const Point3d& p) const {
        std::pair<Corners, Weights> best{{begin_, begin_, begin_}, {1, 0, 0}};
        Weight most = -std::numeric_limits<Weight>::infinity();
        for (std::size_t i = begin_ + 1; i + 1 < end_; ++i) {
            const Corners corners{begin_, i, i + 1};
            const auto weights = weights_in(corners, p);
            if (!weights) continue;
            const Weight least = *std::min_element(weights->begin(), weights->end());
            if (least > most) {
                most = least;
                best = {corners, *weights};
            }
        }
        for (Weight& w : best.second) w = std::max(w, Weight{0});
        return best;
    }

private:
    [[nodiscard]] std::optional<Weights> weights_in(const Corners& c, const Point3d& p) const {
        const auto n = normal_of(point(c[0]), point(c[1]), point(c[2]));
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
        if (n[axis] == 0) return std::nullopt;
        Weights out{};
        for (std::size_t k = 0; k < 3; ++k)
            out[k] = normal_of(p, point(c[(k + 1) % 3]), point(c[(k + 2) % 3]))[axis] / n[axis];
        return out;
    }

    const PolygonMesh& mesh_;
    std::size_t begin_;
    std::size_t end_;
};

class PropertyWriter {
public:
    PropertyWriter(std::span<const PropertyOperand> operands, PropertyMesh& out) : out_(out) {
        for (const PropertyOperand& operand : operands) check(operand);
        unite_channels(operands);
        for (const PropertyOperand& operand : operands) add(operand);
    }

    void write() {
        out_.properties.values.reserve(out_.mesh.corners.size() * out_.properties.width);
        for (std::size_t f = 0; f < out_.mesh.face_count(); ++f) face(f);
    }

private:
    static void check(const PropertyOperand& operand) {
        const bool fits = operand.mesh != nullptr &&
                          (operand.properties == nullptr ||
                           operand.properties->values.size() ==
                               operand.properties->width * operand.mesh->corners.size());
        if (!fits) throw UsageError("to_property_mesh: properties do not fit their mesh");
    }

    /// Numbers with names come under the names of all operands, others stay in their columns.
    void unite_channels(std::span<const PropertyOperand> operands) {
        std::vector<const CornerProperties*> all;
        bool has_channels = false;
        for (const PropertyOperand& operand : operands) {
            if (operand.properties == nullptr || operand.properties->width == 0) continue;
            all.push_back(operand.properties);
            has_channels = has_channels || !operand.properties->channels.empty();
            out_.properties.width = std::max(out_.properties.width, operand.properties->width);
        }
        if (!has_channels) return;
        out_.properties.channels = united_channels(all);
        out_.properties.width = 0;
        for (const PropertyChannel& channel : out_.properties.channels) {
            const std::size_t first = out_.properties.width;
            out_.properties.width += channel.width;
            if (channel.meaning != PropertyMeaning::Normal) continue;
            for (std::size_t i = first; i < out_.properties.width; ++i) normals_.push_back(i);
        }
        missing_ = absent_number;
    }

    void add(const PropertyOperand& operand) {
        PropertyOperand own = operand;
        if (operand.properties != nullptr && !out_.properties.channels.empty()) {
            united_.push_back(under_channels(*operand.properties, out_.properties.channels,
                                             operand.mesh->corners.size()));
            own.properties = &united_.back();
        }
        if (!operands_.emplace(operand.source_id, own).second)
            throw UsageError("to_property_mesh: an operand is named twice");
    }

    void face(std::size_t f) {
        const FaceSource source = out_.source[f];
        const auto corners = out_.mesh.face(f);
        const auto it = operands_.find(source.operand);
        if (it == operands_.end() || source.face >= it->second.mesh->face_count()) {
            out_.is_turned_over.push_back(false);
            const std::size_t more = corners.size() * out_.properties.width;
            out_.properties.values.resize(out_.properties.values.size() + more, missing_);
            return;
        }
        const SourceFace from(it->second, source.face);
        const SourceFace own({0, &out_.mesh, nullptr}, static_cast<std::uint32_t>(f));
        out_.is_turned_over.push_back(dot(own.normal(), from.normal()) < 0);
        for (const std::uint32_t c : corners) corner(it->second, from, out_.mesh.points[c]);
        if (out_.is_turned_over.back()) turn_normals(corners.size());
    }

    /// Of so many last corners.
    void turn_normals(std::size_t corners) {
        const std::size_t width = out_.properties.width;
        const std::size_t end = out_.properties.values.size();
        for (std::size_t k = 1; k <= corners; ++k)
            for (const std::size_t column : normals_) {
                double& x = out_.properties.values[end - k * width + column];
                x = -x;
            }
    }

    void corner(const PropertyOperand& operand, const SourceFace& face, const Point3d& p) {
        std::vector<double>& values = out_.properties.values;
        const std::size_t first = values.size();
        values.resize(first + out_.properties.width, missing_);
        if (operand.properties == nullptr) return;
        const CornerProperties& from = *operand.properties;
        if (const auto same = face.corner_at(p)) {
            std::copy_n(from.at(*same).begin(), from.width,
                        values.begin() + static_cast<std::ptrdiff_t>(first));
            return;
        }
        const auto [corners, weights] = face.place_of(p);
        const Weight sum = weights[0] + weights[1] + weights[2];
        for (std::size_t i = 0; i < from.width; ++i) {
            Weight value = 0;
            double least = std::numeric_limits<double>::infinity();
            double most = -least;
            for (std::size_t k = 0; k < 3; ++k) {
                const double v = from.at(corners[k])[i];
                value += weights[k] / sum * v;
                least = std::min(least, v);
                most = std::max(most, v);
            }
            values[first + i] = std::isnan(value)
                                    ? absent_number
                                    : std::clamp(static_cast<double>(value), least, most);
        }
    }

    std::map<std::uint32_t, PropertyOperand> operands_;
    std::deque<CornerProperties> united_;
    std::vector<std::size_t> normals_;  ///< columns
    double missing_ = 0;
    PropertyMesh& out_;
};

}  // namespace

PropertyMesh with_properties(PolygonMesh faces, std::vector<FaceSource> source,
                             std::span<const PropertyOperand> operands) {
    PropertyMesh out;
    PropertyWriter writer(operands, out);
    out.mesh = std::move(faces);
    out.source = std::move(source);
    writer.write();
    return out;
}

PropertyMesh to_property_mesh(const Solid& solid, std::span<const PropertyOperand> operands) {
    MeshMap map;
    PolygonMesh mesh = to_polygon_mesh(solid.to_brep({.maximal_faces = false}), {}, &map);
    return with_properties(std::move(mesh), std::move(map.source), operands);
}

}  // namespace trisect
