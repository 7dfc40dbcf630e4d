// SPDX-License-Identifier: Apache-2.0
//
// SceneBodies: bodies of a scene, their hierarchy and their poses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/interference_scene.h>
#include <trisect/bsp/interference/scene/body_bounds.h>

namespace trisect::detail {

struct SceneBody {
    InterferenceModel model;           ///< unless it is a solid
    std::optional<Solid> solid;        ///< free of self-intersection
    std::optional<BodyBounds> bounds;  ///< none for the empty solid
    Pose pose;
    /// Another number after every change of the pose; never the same for two bodies.
    std::uint64_t placement = 0;
    CollisionFilter filter;

    /// Of a link: its carrier, and pose = pose of the carrier * mount * motion.
    std::optional<std::uint32_t> carrier;
    bool meets_carrier = true;
    Joint joint;
    Ratio value;
    Pose mount;
    Pose local;                        ///< mount * motion
    std::uint32_t joints_below = 0;    ///< down to the body that stands by itself
    std::vector<std::uint32_t> links;  ///< those that it carries
};

/// Bodies by slots. All functions that name a body throw UsageError for names of none, and change
/// nothing when they throw.
class SceneBodies {
public:
    BodyId add(const InterferenceModel& model, const Pose& pose, const CollisionFilter& filter);
    BodyId add_link(BodyId carrier, const InterferenceModel& model, const Joint& joint,
                    const LinkOptions& options);
    BodyId add(const Solid& solid, const Pose& pose, const CollisionFilter& filter);
    BodyId add_link(BodyId carrier, const Solid& solid, const Joint& joint,
                    const LinkOptions& options);
    /// The body is that solid from now on.
    void replace(BodyId body, const Solid& solid);
    void remove(BodyId body);
    void set_pose(BodyId body, const Pose& pose);
    void set_joints(std::span<const Scene::JointValue> values);
    void set_filter(BodyId body, const CollisionFilter& filter);
    void ignore(BodyId a, BodyId b, bool ignored);

    [[nodiscard]] bool contains(BodyId body) const;
    [[nodiscard]] const SceneBody& at(BodyId body) const { return slots_[slot(body)].body; }
    /// \throw UsageError for a body that nothing carries.
    [[nodiscard]] const SceneBody& link(BodyId link) const { return slots_[link_slot(link)].body; }
    [[nodiscard]] std::vector<BodyId> all() const;
    [[nodiscard]] std::size_t size() const { return size_; }

    /// By slot, for what names no bodies.
    [[nodiscard]] std::size_t slot_count() const { return slots_.size(); }
    [[nodiscard]] bool is_used(std::uint32_t slot) const { return slots_[slot].used; }
    [[nodiscard]] const SceneBody& body(std::uint32_t slot) const { return slots_[slot].body; }
    [[nodiscard]] BodyId id(std::uint32_t slot) const { return {slot, slots_[slot].generation}; }

    /// Whether filters let the pair pass.
    [[nodiscard]] bool may_meet(std::uint32_t a, std::uint32_t b) const;

private:
    struct Slot {
        bool used = false;
        std::uint32_t generation = 0;
        SceneBody body;
    };
    using Placed = std::vector<std::pair<std::uint32_t, Pose>>;

    [[nodiscard]] std::uint32_t slot(BodyId body) const;
    [[nodiscard]] std::uint32_t link_slot(BodyId link) const;
    BodyId put(SceneBody body);
    BodyId put_link(BodyId carrier, SceneBody body, const Joint& joint, const LinkOptions& options);
    static void take(SceneBody& body, const Solid& solid);
    [[nodiscard]] std::vector<std::uint32_t> carriers_first(std::vector<std::uint32_t> roots) const;
    void take_over(const Placed& placed);

    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> ignored_;  // smaller slot first
    std::size_t size_ = 0;
    std::uint64_t placements_ = 0;
};

}  // namespace trisect::detail
