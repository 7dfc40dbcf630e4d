// SPDX-License-Identifier: Apache-2.0
#include "motion_document.h"

#include <trisect/kernel/error.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

namespace trisect::app {
namespace {

// Not ours (outcome.h), which keeps the order of members and searches them all for each new one: a
// file may have millions.
using Document = nlohmann::json;

// A part of the document and its name in messages.
class Member {
public:
    Member(const Document& json, std::string name, const std::string& file)
        : json_(json), name_(std::move(name)), file_(file) {}

    [[noreturn]] void fail(const std::string& what) const {
        FilePlace place;
        place.file = file_;
        throw InputError(place, name_.empty() ? what : name_ + ": " + what);
    }
    void expect_members(std::initializer_list<const char*> known) const {
        if (!json_.is_object()) fail("must be an object");
        for (const auto& item : json_.items())
            if (std::find(known.begin(), known.end(), item.key()) == known.end())
                fail("'" + item.key() + "' is not known");
    }
    [[nodiscard]] std::optional<Member> find(const char* key) const {
        const auto at = json_.find(key);
        if (at == json_.end()) return std::nullopt;
        return Member(*at, name_.empty() ? key : name_ + "." + key, file_);
    }
    [[nodiscard]] double number() const {
        if (!json_.is_number()) fail("must be a number");
        return json_.get<double>();
    }
    template <std::size_t N>
    [[nodiscard]] std::array<double, N> numbers() const {
        if (!json_.is_array() || json_.size() != N)
            fail("must be " + std::to_string(N) + " numbers");
        std::array<double, N> r{};
        for (std::size_t i = 0; i < N; ++i)
            r[i] = Member(json_[i], name_ + "[" + std::to_string(i) + "]", file_).number();
        return r;
    }
    [[nodiscard]] std::vector<Member> elements() const {
        if (!json_.is_array()) fail("must be a list");
        std::vector<Member> r;
        for (std::size_t i = 0; i < json_.size(); ++i)
            r.emplace_back(json_[i], name_ + "[" + std::to_string(i) + "]", file_);
        return r;
    }
    void read(const char* key, double& value) const {
        if (const auto m = find(key)) value = m->number();
    }
    template <std::size_t N>
    void read(const char* key, std::array<double, N>& value) const {
        if (const auto m = find(key)) value = m->template numbers<N>();
    }
    // Errors of the library get the name of the member.
    template <class Work>
    auto checked(Work&& work) const {
        try {
            return work();
        } catch (const InputError&) {
            throw;
        } catch (const Error& e) {
            fail(e.what());
        }
    }

private:
    const Document& json_;
    std::string name_;
    const std::string& file_;
};

EnclosedMotion through_frames(const Member& list) {
    std::vector<KeyFrame> frames;
    for (const Member& m : list.elements()) {
        m.expect_members({"time", "rotation", "position"});
        KeyFrame& f = frames.emplace_back();
        if (!m.find("time")) m.fail("has no time");
        m.read("time", f.time);
        m.read("rotation", f.rotation);
        m.read("position", f.position);
    }
    return list.checked([&] { return EnclosedMotion::through(frames); });
}

EnclosedMotion turning(const Member& m) {
    m.expect_members({"axis", "angle", "center", "shift", "duration", "pose"});
    ConstantTurn turn;
    double duration = 1;
    m.read("axis", turn.axis);
    m.read("angle", turn.angle);
    m.read("center", turn.center);
    m.read("shift", turn.shift);
    m.read("duration", duration);
    return m.checked([&] {
        const auto pose = m.find("pose");
        const Pose start = pose ? Pose::from_doubles(pose->numbers<12>()) : Pose();
        return EnclosedMotion::turning(start, turn, duration);
    });
}

}  // namespace

EnclosedMotion parse_motion_document(std::string_view text, const std::string& name) {
    const Document document = Document::parse(text, nullptr, false);
    const Member root(document, "", name);
    if (document.is_discarded()) root.fail("is not JSON");
    root.expect_members({"keyframes", "turn"});
    const auto frames = root.find("keyframes");
    const auto turn = root.find("turn");
    if (frames.has_value() == turn.has_value())
        root.fail("a motion has either keyframes or a turn");
    return frames ? through_frames(*frames) : turning(*turn);
}

}  // namespace trisect::app
