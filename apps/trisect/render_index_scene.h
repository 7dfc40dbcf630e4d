// SPDX-License-Identifier: Apache-2.0
//
// IndexScene: a solid as a scene, by the ray queries of its index.
#pragma once

#include <trisect/bsp/brep_index.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include <trisect/kernel/support/concurrent_map.h>

#include "queried_set.h"
#include "render_scene.h"

namespace trisect::app {

class IndexScene final : public Scene {
public:
    /// The number of a colour for FaceSource::operand; none: the face is a section.
    using ColorOf = std::function<std::optional<std::size_t>(std::uint32_t)>;

    /// Faces get the colour of the operand they come from; those that no operand brought are a
    /// section. `set` must outlive the scene.
    IndexScene(BrepIndex index, const QueriedSet& set, double diameter);
    IndexScene(BrepIndex index, ColorOf color, double diameter);

    [[nodiscard]] SurfaceHit first_hit(const ViewRay& ray) const override;
    [[nodiscard]] std::vector<Look> looks() const override;
    [[nodiscard]] double diameter() const override { return diameter_; }

private:
    /// Looks are numbered when they are first seen: a picture shows a part of all faces.
    struct Key {
        std::uint32_t operand = 0;
        Plane plane;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct Hash {
        [[nodiscard]] std::size_t operator()(const Key& key) const;
    };

    BrepIndex index_;
    ColorOf color_;
    double diameter_;
    mutable detail::ConcurrentMap<Key, std::uint32_t, Hash> numbers_;
    mutable std::atomic<std::uint32_t> next_ = 0;
};

}  // namespace trisect::app
