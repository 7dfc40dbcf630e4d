// SPDX-License-Identifier: Apache-2.0
//
// StepText: the entities of an exchange file of ISO 10303-21 by their numbers.
// One pass finds where each begins and that its brackets and strings end; what an entity holds is
// read when it is asked for. So most of a file, which is about looks, costs the pass alone.
#pragma once

#include <trisect/brep/io/formats/input_text.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::detail {

/// One value of an entity: a number, a word, a reference, or a list of values.
struct StepValue {
    enum class Kind : std::uint8_t {
        Omitted,      ///< $
        Derived,      ///< *
        Number,       ///< whole or with a point
        Text,         ///< without its quotes, as it is in the file
        Enumeration,  ///< without its dots
        Binary,
        Reference,
        List,
        Typed  ///< KEYWORD(values)
    };
    Kind kind = Kind::Omitted;
    const char* at = nullptr;
    std::string_view text;  ///< of Text, Enumeration and Typed
    double number = 0;
    std::uint64_t id = 0;  ///< of Reference
    std::vector<StepValue> items;
};

/// KEYWORD(values). A complex entity has several.
struct StepPart {
    std::string_view keyword;
    std::vector<StepValue> values;
};

using StepKind = StepValue::Kind;

struct StepEntity {
    std::uint64_t id = 0;
    const char* at = nullptr;
    std::vector<StepPart> parts;

    /// The part of that keyword, or nothing.
    [[nodiscard]] const StepPart* part(std::string_view keyword) const;
    [[nodiscard]] bool is(std::string_view keyword) const { return part(keyword) != nullptr; }
    /// All keywords, with blanks between them.
    [[nodiscard]] std::string keywords() const;
};

class StepText {
public:
    /// Finds all entities. \throw InputError for malformed text and for a number that two entities
    /// have, LimitError, UnsupportedError for sections that refer to other files.
    explicit StepText(const InputText& source);

    [[nodiscard]] std::size_t entity_count() const noexcept { return entries_.size(); }
    /// The keyword of the entity in that place of the order of numbers; empty for a complex one.
    [[nodiscard]] std::string_view keyword(std::size_t index) const;
    [[nodiscard]] std::uint64_t id(std::size_t index) const { return entries_[index].id; }

    /// The place of an entity in the order of numbers; `from` is where the reference stands.
    /// \throw InputError when there is no such entity.
    [[nodiscard]] std::size_t place_of(std::uint64_t id, const char* from) const;
    [[nodiscard]] StepEntity entity(std::uint64_t id, const char* from) const;

    /// The value number `index` of a part, of that kind. \throw InputError
    [[nodiscard]] const StepValue& value(const StepEntity& entity, const StepPart& part,
                                         std::size_t index, StepKind kind) const;
    [[nodiscard]] StepEntity referred(const StepEntity& entity, const StepPart& part,
                                      std::size_t index) const;
    /// An enumeration .T. or .F.
    [[nodiscard]] bool flag(const StepEntity& entity, const StepPart& part,
                            std::size_t index) const;
    /// A text, decoded to UTF-8; empty where it is omitted.
    [[nodiscard]] std::string name(const StepPart& part, std::size_t index) const;

    /// Fails about an entity: "#12 LINE: ..." at its place.
    [[noreturn]] void fail(const StepEntity& entity, const std::string& message) const;
    [[noreturn]] void fail_limit(const StepEntity& entity, const std::string& message) const;
    [[noreturn]] void refuse(const StepEntity& entity, const std::string& message) const;

    [[nodiscard]] const InputText& source() const noexcept { return source_; }

private:
    struct Entry {
        std::uint64_t id = 0;
        const char* at = nullptr;
    };
    const InputText& source_;
    std::vector<Entry> entries_;
};

/// "#12 LINE"
[[nodiscard]] std::string shown_entity(const StepEntity& entity);

}  // namespace trisect::detail
