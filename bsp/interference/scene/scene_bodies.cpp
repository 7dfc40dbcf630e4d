// SPDX-License-Identifier: Apache-2.0
//
// A pose that does not fit (LimitError) may turn up deep in a chain after the links below it have
// been placed. So new poses are computed beside the old ones and taken over together.
#include <trisect/bsp/interference/scene/scene_bodies.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>

#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {
namespace {

Pose link_pose(const Pose& carrier, const Pose& local, std::uint32_t joints) {
    try {
        return carrier * local;
    } catch (const LimitError& e) {
        throw LimitError("a link " + std::to_string(joints) + (joints == 1 ? " joint" : " joints") +
                         " above the body that stands by itself: " + e.what());
    }
}

/// Numbers, not maps: it is enough to notice most poses that were set again.
bool same_numbers(const Pose& a, const Pose& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            if (a.matrix(i, j) != b.matrix(i, j)) return false;
        if (a.translation(i) != b.translation(i)) return false;
    }
    return a.denominator() == b.denominator();
}

std::pair<std::uint32_t, std::uint32_t> ordered(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

}  // namespace

bool SceneBodies::contains(BodyId body) const {
    return body.index < slots_.size() && slots_[body.index].used &&
           slots_[body.index].generation == body.generation;
}

std::uint32_t SceneBodies::slot(BodyId body) const {
    if (!contains(body)) throw UsageError("the scene has no body of this name");
    return body.index;
}

std::uint32_t SceneBodies::link_slot(BodyId link) const {
    const std::uint32_t s = slot(link);
    if (!slots_[s].body.carrier) throw UsageError("the body is no link");
    return s;
}

std::vector<BodyId> SceneBodies::all() const {
    std::vector<BodyId> out;
    for (std::uint32_t s = 0; s < slots_.size(); ++s)
        if (slots_[s].used) out.push_back(id(s));
    return out;
}

BodyId SceneBodies::put(SceneBody body) {
    if (!body.solid && !body.model.is_empty()) body.bounds.emplace(detail::data_of(body.model));
    body.placement = ++placements_;
    if (free_.empty()) {
        free_.reserve(slots_.size() + 1);  // so that remove() cannot fail
        slots_.emplace_back();
        free_.push_back(static_cast<std::uint32_t>(slots_.size() - 1));
    }
    const std::uint32_t s = free_.back();
    free_.pop_back();
    slots_[s].body = std::move(body);
    slots_[s].used = true;
    ++slots_[s].generation;
    ++size_;
    return id(s);
}

BodyId SceneBodies::add(const InterferenceModel& model, const Pose& pose,
                        const CollisionFilter& filter) {
    SceneBody body;
    body.model = model;
    body.pose = pose;
    body.filter = filter;
    return put(std::move(body));
}

BodyId SceneBodies::add(const Solid& solid, const Pose& pose, const CollisionFilter& filter) {
    SceneBody body;
    take(body, solid);
    body.pose = pose;
    body.filter = filter;
    return put(std::move(body));
}

void SceneBodies::take(SceneBody& body, const Solid& solid) {
    const detail::SolidBoundary boundary(solid);
    std::optional<BodyBounds> bounds;
    if (!boundary.is_empty()) bounds.emplace(boundary);
    body.solid = boundary.base().solid();
    body.bounds = std::move(bounds);
    body.model = InterferenceModel();
}

void SceneBodies::replace(BodyId id, const Solid& solid) {
    SceneBody& body = slots_[slot(id)].body;
    take(body, solid);
    body.placement = ++placements_;
}

BodyId SceneBodies::add_link(BodyId carrier, const InterferenceModel& model, const Joint& joint,
                             const LinkOptions& options) {
    SceneBody body;
    body.model = model;
    return put_link(carrier, std::move(body), joint, options);
}

BodyId SceneBodies::add_link(BodyId carrier, const Solid& solid, const Joint& joint,
                             const LinkOptions& options) {
    SceneBody body;
    take(body, solid);
    return put_link(carrier, std::move(body), joint, options);
}

BodyId SceneBodies::put_link(BodyId carrier, SceneBody body, const Joint& joint,
                             const LinkOptions& options) {
    const std::uint32_t c = slot(carrier);
    body.filter = options.filter;
    body.carrier = c;
    body.meets_carrier = options.meets_carrier;
    body.joint = joint;
    body.mount = options.mount;
    body.local = options.mount * joint.motion({});
    body.joints_below = slots_[c].body.joints_below + 1;
    body.pose = link_pose(slots_[c].body.pose, body.local, body.joints_below);
    std::vector<std::uint32_t>& links = slots_[c].body.links;
    links.reserve(links.size() + 1);
    const BodyId out = put(std::move(body));
    slots_[c].body.links.push_back(out.index);
    return out;
}

void SceneBodies::remove(BodyId id) {
    const std::uint32_t s = slot(id);
    const SceneBody& body = slots_[s].body;
    if (!body.links.empty()) throw UsageError("the body carries links; remove them first");
    if (body.carrier) std::erase(slots_[*body.carrier].body.links, s);
    std::erase_if(ignored_, [s](const auto& pair) { return pair.first == s || pair.second == s; });
    slots_[s].body = {};
    slots_[s].used = false;
    free_.push_back(s);
    --size_;
}

/// The roots and all that they carry, each once, behind its carrier.
std::vector<std::uint32_t> SceneBodies::carriers_first(std::vector<std::uint32_t> roots) const {
    std::vector<std::uint32_t> order = std::move(roots);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::vector<std::uint32_t>& links = slots_[order[i]].body.links;
        order.insert(order.end(), links.begin(), links.end());
    }
    // A root that another root carries came up twice.
    std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
        return std::pair(slots_[a].body.joints_below, a) <
               std::pair(slots_[b].body.joints_below, b);
    });
    order.erase(std::unique(order.begin(), order.end()), order.end());
    return order;
}

void SceneBodies::take_over(const Placed& placed) {
    for (const auto& [s, pose] : placed) {
        SceneBody& body = slots_[s].body;
        if (same_numbers(body.pose, pose)) continue;
        body.pose = pose;
        body.placement = ++placements_;
    }
}

void SceneBodies::set_pose(BodyId id, const Pose& pose) {
    const std::uint32_t root = slot(id);
    if (slots_[root].body.carrier)
        throw UsageError("the body is a link: its pose follows from its joint");
    std::map<std::uint32_t, std::size_t> at;
    Placed placed;
    for (const std::uint32_t s : carriers_first({root})) {
        const SceneBody& body = slots_[s].body;
        at[s] = placed.size();
        placed.emplace_back(s, s == root ? pose
                                         : link_pose(placed[at[*body.carrier]].second, body.local,
                                                     body.joints_below));
    }
    take_over(placed);
}

void SceneBodies::set_joints(std::span<const Scene::JointValue> values) {
    std::map<std::uint32_t, Pose> locals;
    std::vector<std::uint32_t> roots;
    for (const Scene::JointValue& v : values) {
        const std::uint32_t s = link_slot(v.link);
        const SceneBody& body = slots_[s].body;
        if (!locals.emplace(s, body.mount * body.joint.motion(v.value)).second)
            throw UsageError("a joint is given two values");
        roots.push_back(s);
    }
    std::map<std::uint32_t, std::size_t> at;
    Placed placed;
    for (const std::uint32_t s : carriers_first(std::move(roots))) {
        const SceneBody& body = slots_[s].body;
        const auto below = at.find(*body.carrier);
        const Pose& carrier =
            below == at.end() ? slots_[*body.carrier].body.pose : placed[below->second].second;
        const auto local = locals.find(s);
        at[s] = placed.size();
        placed.emplace_back(s,
                            link_pose(carrier, local == locals.end() ? body.local : local->second,
                                      body.joints_below));
    }
    take_over(placed);
    for (const Scene::JointValue& v : values) {
        slots_[v.link.index].body.value = v.value;
        slots_[v.link.index].body.local = locals.at(v.link.index);
    }
}

void SceneBodies::set_filter(BodyId id, const CollisionFilter& filter) {
    slots_[slot(id)].body.filter = filter;
}

void SceneBodies::ignore(BodyId a, BodyId b, bool ignored) {
    const auto pair = ordered(slot(a), slot(b));
    if (ignored) {
        ignored_.insert(pair);
    } else {
        ignored_.erase(pair);
    }
}

bool SceneBodies::may_meet(std::uint32_t a, std::uint32_t b) const {
    const SceneBody& u = slots_[a].body;
    const SceneBody& v = slots_[b].body;
    if ((u.filter.groups & v.filter.looks_at) == 0 || (v.filter.groups & u.filter.looks_at) == 0)
        return false;
    if (u.carrier == b && !u.meets_carrier) return false;
    if (v.carrier == a && !v.meets_carrier) return false;
    return ignored_.empty() || ignored_.count(ordered(a, b)) == 0;
}

}  // namespace trisect::detail
