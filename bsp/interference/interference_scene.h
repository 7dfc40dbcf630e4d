// SPDX-License-Identifier: Apache-2.0
//
// Scene: many moving solids, some of them jointed, and their interferences.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/joint.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// A body of a scene. Names of removed bodies are never used again.
struct BodyId {
    std::uint32_t index = 0;       ///< small; used again for later bodies
    std::uint32_t generation = 0;  ///< of the bodies with this index; 0 names none
    friend auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// Two bodies are compared only if each is in a group of the other one's mask.
struct CollisionFilter {
    std::uint32_t groups = 1;  ///< one bit a group
    std::uint32_t looks_at = ~std::uint32_t{0};
    friend bool operator==(const CollisionFilter&, const CollisionFilter&) = default;
};

struct LinkOptions {
    /// Where the frame of the joint is in the coordinates of the body that carries the link.
    Pose mount;
    CollisionFilter filter;
    /// Whether to compare the link and the body that carries it. Parts that share a pin or a groove
    /// touch all the time.
    bool meets_carrier = false;
};

/// How pairs of boxes that meet are found. The answers are the same.
enum class SceneBroadPhase : std::uint8_t {
    SweepAndPrune,     ///< faster up to some ten thousand bodies, see bench/results
    BoxTree,           ///< an R-tree
    HashGrid,          ///< a uniform grid: bodies of similar size (scene/broad_phases.h)
    HierarchicalGrid,  ///< grids of all sizes
    Octree,            ///< a loose one
    KdTree,
    ChainBoxes  ///< a tree in the order of adding: long chains (scene/chain_boxes.h)
};

struct SceneOptions {
    SceneBroadPhase broad_phase = SceneBroadPhase::SweepAndPrune;
};

struct SceneQueryOptions {
    /// Also where they touch and cross, with the faces, edges and vertices of both.
    bool contacts = false;
    /// How many threads may take part; 0 means one for every processor.
    std::uint32_t threads = 0;
};

/// Two bodies that are not disjoint.
struct ScenePair {
    BodyId a;
    BodyId b;                                ///< its index is greater
    Relation relation = Relation::Disjoint;  ///< of a to b: Inside means that a is inside b
    std::vector<Contact> contacts;           ///< where requested; `a` is the first solid
    /// The same, instead, where one of the bodies is a Solid.
    std::vector<NamedContact> named_contacts;
};

/// What queries of scenes did (kernel/diagnostics.h).
struct SceneCounters {
    std::size_t bodies = 0;
    std::size_t boxes_met = 0;    ///< pairs of boxes that meet
    std::size_t filtered = 0;     ///< of these, pairs that filters leave out
    std::size_t kept = 0;         ///< neither has moved: the answer of the last query
    std::size_t asked = 0;        ///< decided exactly, anew
    std::size_t interfering = 0;  ///< pairs returned
    double broad_seconds = 0;     ///< boxes and their pairs
    double exact_seconds = 0;     ///< relations and contacts

    SceneCounters& operator+=(const SceneCounters& o);
    SceneCounters& operator-=(const SceneCounters& o);
};

/// Bodies, each a model or a solid under a pose. A solid needs no model to be made, and goes on as
/// what a cut leaves of it (replace): what is known about pairs with it is kept.
///
/// A pose is exact (Pose); so every relation returned is that of the solids as they are placed, for
/// flush parts too. Boxes around the bodies, rounded outwards, only exclude pairs.
///
/// A link is a body that another one carries through a joint: its pose is the product of the
/// carrier's pose, the mount and the motion of the joint, exactly. So along a chain bits add up:
/// about 2 b for a joint turned by a quaternion of b bits, and a LimitError when a pose no longer
/// fits. Links carry links; no limit on their number but that.
///
/// Not copied; one that was moved from can only be assigned to or ended. One thread may call at a
/// time; `interfering` uses several by itself. Every function that names a body throws UsageError
/// when there is none of that name. What throws changes nothing.
class Scene {
public:
    explicit Scene(const SceneOptions& options = {});
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    /// The empty solid is allowed and interferes with nothing. O(n) in the vertices of the model,
    /// which is shared.
    BodyId add(const InterferenceModel& model, const Pose& pose = {},
               const CollisionFilter& filter = {});
    /// A link with the value 0 of its joint. \throw LimitError, with the number of joints below
    /// it, when its pose does not fit.
    BodyId add_link(BodyId carrier, const InterferenceModel& model, const Joint& joint,
                    const LinkOptions& options = {});
    /// Bodies that are solids, on their own trees (solid_interference.h). \throw as the functions
    /// above; UnsupportedError when the solid is unbounded.
    BodyId add(const Solid& solid, const Pose& pose = {}, const CollisionFilter& filter = {});
    BodyId add_link(BodyId carrier, const Solid& solid, const Joint& joint,
                    const LinkOptions& options = {});
    /// Puts a solid in the place of a body's, or of its model. Costs what is new in the solid.
    void replace(BodyId body, const Solid& solid);
    /// \throw UsageError when it carries a link.
    void remove(BodyId body);

    /// Moves a body and all that it carries. \throw UsageError for a link, LimitError as add_link.
    void set_pose(BodyId body, const Pose& pose);
    struct JointValue {
        BodyId link;
        Ratio value;
    };
    /// \throw UsageError for what is no link and for values that its joint cannot have.
    void set_joint(BodyId link, Ratio value);
    /// All at once: each pose is computed once. A link may be named once.
    void set_joints(std::span<const JointValue> values);

    void set_filter(BodyId body, const CollisionFilter& filter);
    /// Excludes these two from now on, or includes them again.
    void ignore(BodyId a, BodyId b, bool ignored = true);

    [[nodiscard]] bool contains(BodyId body) const;
    [[nodiscard]] std::size_t size() const;
    /// In the order of their indices.
    [[nodiscard]] std::vector<BodyId> bodies() const;
    /// \throw UsageError for a body that is a solid.
    [[nodiscard]] const InterferenceModel& model(BodyId body) const;
    [[nodiscard]] const Solid& solid(BodyId body) const;
    [[nodiscard]] const Pose& pose(BodyId body) const;
    [[nodiscard]] const Joint& joint(BodyId link) const;
    [[nodiscard]] Ratio joint_value(BodyId link) const;

    /// All pairs that filters let pass and that are not disjoint, ordered by the indices of their
    /// bodies; touching pairs included. Depends on the bodies and their poses alone: not on
    /// earlier queries, on the broad phase or the number of threads. Keeps for each pair of boxes
    /// that meet what makes the next query fast when little has moved.
    /// \throw LimitError when a pair of poses needs too many bits for the exact predicates.
    [[nodiscard]] std::vector<ScenePair> interfering(const SceneQueryOptions& options = {});

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace trisect
