// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/step/text.h>

#include <trisect/brep/io/formats/decimal.h>
#include <trisect/brep/io/models/step/string.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace trisect::detail {
namespace {

constexpr bool is_step_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_step_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr bool is_step_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '!';
}
constexpr bool is_step_word(char c) { return is_step_letter(c) || is_step_digit(c) || c == '-'; }

/// Characters, blanks and comments of the clear text.
class StepCursor {
public:
    StepCursor(const InputText& source, const char* at) : source_(source), here_(at) {}

    [[nodiscard]] const char* here() const { return here_; }
    [[nodiscard]] const InputText& source() const { return source_; }
    [[nodiscard]] bool at_end() const { return here_ == source_.end(); }
    [[noreturn]] void fail(const std::string& message) const { source_.fail(here_, message); }

    /// The next character after blanks and comments; 0 at the end of the file.
    char peek() {
        for (;;) {
            while (!at_end() && is_step_space(*here_)) ++here_;
            if (source_.end() - here_ < 2 || here_[0] != '/' || here_[1] != '*') break;
            const std::string_view rest(here_ + 2,
                                        static_cast<std::size_t>(source_.end() - here_ - 2));
            const std::size_t close = rest.find("*/");
            if (close == std::string_view::npos) fail("a comment without an end");
            here_ += close + 4;
        }
        return at_end() ? '\0' : *here_;
    }
    bool take(char c) {
        if (at_end() || peek() != c || at_end()) return false;
        ++here_;
        return true;
    }
    void expect(char c) {
        if (take(c)) return;
        if (at_end()) fail(std::string("the file ends where '") + c + "' is expected");
        fail(std::string("'") + c + "' expected, not " + shown_word({here_, 1}));
    }

    std::string_view keyword() {
        const char c = peek();
        const char* first = here_;
        if (is_step_letter(c))
            while (!at_end() && is_step_word(*here_)) ++here_;
        return {first, static_cast<std::size_t>(here_ - first)};
    }

    /// The digits behind a '#' that was taken.
    std::uint64_t entity_number() {
        std::uint64_t id = 0;
        const auto [stop, error] = std::from_chars(here_, source_.end(), id);
        if (error == std::errc::result_out_of_range) fail("the number of an entity is too large");
        if (error != std::errc{}) fail("'#' without a number");
        here_ = stop;
        return id;
    }

    /// What is between quotes; two of them are one that does not end it.
    std::string_view quoted(char quote) {
        const char* first = ++here_;
        for (;;) {
            const auto rest = static_cast<std::size_t>(source_.end() - here_);
            const std::size_t end = std::string_view(here_, rest).find(quote);
            if (end == std::string_view::npos) {
                here_ = first - 1;
                fail("a text without an end");
            }
            here_ += end + 1;
            if (quote != '\'' || at_end() || *here_ != quote) break;
            ++here_;
        }
        return {first, static_cast<std::size_t>(here_ - 1 - first)};
    }

    double number() {
        const char* first = here_ + (*here_ == '+' ? 1 : 0);
        double value = 0;
        const auto [stop, error] = nearest_double(first, source_.end(), value);
        if (error == std::errc::result_out_of_range) fail("a number too large for a double");
        const bool is_word = error != std::errc{} || !std::isfinite(value) ||
                             (first != here_ && first != source_.end() && *first == '-') ||
                             (stop != source_.end() && (is_step_word(*stop) || *stop == '.'));
        if (is_word) fail("a number expected");
        if (static_cast<std::uint64_t>(stop - here_) > source_.limits().literal_characters)
            source_.fail_limit(here_, "a number of more than " +
                                          std::to_string(source_.limits().literal_characters) +
                                          " characters");
        here_ = stop;
        return value;
    }

    void skip(std::size_t count) { here_ += count; }

private:
    const InputText& source_;
    const char* here_;
};

/// Goes over one statement up to and with its semicolon: brackets close, texts end, and no
/// character is of another format.
void skip_statement(StepCursor& cursor) {
    std::uint64_t depth = 0;
    for (;;) {
        const char c = cursor.peek();
        if (cursor.at_end()) cursor.fail("the file ends within an entity");
        if (c == '\'' || c == '"') {
            (void)cursor.quoted(c);
            continue;
        }
        if (c == ';' && depth != 0) cursor.fail("';' before all brackets are closed");
        if (c == ')' && depth == 0) cursor.fail("')' without its '('");
        if (c == '(' && ++depth > cursor.source().limits().nesting)
            cursor.source().fail_limit(
                cursor.here(),
                "lists nest deeper than " + std::to_string(cursor.source().limits().nesting));
        if (c == ')') --depth;
        const bool is_known =
            is_step_word(c) || std::string_view("(),;=#$*.+&@<>").find(c) != std::string_view::npos;
        if (!is_known) cursor.fail("unexpected " + shown_word({cursor.here(), 1}));
        cursor.skip(1);
        if (c == ';') return;
    }
}

class StepParser {
public:
    StepParser(const InputText& source, const char* at) : cursor_(source, at) {}

    StepEntity entity() {
        StepEntity out;
        (void)cursor_.peek();
        out.at = cursor_.here();
        cursor_.expect('#');
        out.id = cursor_.entity_number();
        cursor_.expect('=');
        if (cursor_.take('(')) {
            while (!cursor_.take(')')) out.parts.push_back(part());
            if (out.parts.empty()) cursor_.fail("an entity without a keyword");
        } else {
            out.parts.push_back(part());
        }
        cursor_.expect(';');
        return out;
    }

private:
    StepPart part() {
        StepPart out;
        out.keyword = cursor_.keyword();
        if (out.keyword.empty()) cursor_.fail("a keyword expected");
        cursor_.expect('(');
        out.values = list();
        return out;
    }

    /// Up to and with the bracket that closes it. The scan has bounded the depth.
    std::vector<StepValue> list() {
        std::vector<StepValue> out;
        if (cursor_.take(')')) return out;
        do {
            out.push_back(value());
        } while (cursor_.take(','));
        cursor_.expect(')');
        return out;
    }

    StepValue value() {
        StepValue out;
        const char c = cursor_.peek();
        out.at = cursor_.here();
        if (cursor_.take('$')) return out;
        if (cursor_.take('*')) {
            out.kind = StepKind::Derived;
        } else if (cursor_.take('#')) {
            out.kind = StepKind::Reference;
            out.id = cursor_.entity_number();
        } else if (cursor_.take('(')) {
            out.kind = StepKind::List;
            out.items = list();
        } else if (c == '\'' || c == '"') {
            out.kind = c == '"' ? StepKind::Binary : StepKind::Text;
            out.text = cursor_.quoted(c);
        } else if (cursor_.take('.')) {
            out.kind = StepKind::Enumeration;
            out.text = cursor_.keyword();
            cursor_.expect('.');
        } else if (is_step_letter(c)) {
            out.kind = StepKind::Typed;
            out.text = cursor_.keyword();
            cursor_.expect('(');
            out.items = list();
        } else if (is_step_digit(c) || c == '-' || c == '+') {
            out.kind = StepKind::Number;
            out.number = cursor_.number();
        } else {
            cursor_.fail("a value expected");
        }
        return out;
    }

    StepCursor cursor_;
};

const char* name_of_value(StepKind kind) {
    switch (kind) {
        case StepKind::Number:
            return "a number";
        case StepKind::Text:
            return "a text";
        case StepKind::Enumeration:
            return "an enumeration";
        case StepKind::Reference:
            return "a reference";
        case StepKind::List:
            return "a list";
        default:
            return "another value";
    }
}

}  // namespace

const StepPart* StepEntity::part(std::string_view keyword) const {
    for (const StepPart& p : parts)
        if (p.keyword == keyword) return &p;
    return nullptr;
}

std::string StepEntity::keywords() const {
    std::string out;
    for (const StepPart& p : parts) {
        if (!out.empty()) out += ' ';
        out += p.keyword.substr(0, 60);
        if (out.size() > 200) break;
    }
    return out;
}

std::string shown_entity(const StepEntity& entity) {
    return "#" + std::to_string(entity.id) + " " + entity.keywords();
}

StepText::StepText(const InputText& source) : source_(source) {
    StepCursor cursor(source, source.begin());
    if (source.bytes().starts_with("\xEF\xBB\xBF")) cursor.skip(3);
    if (cursor.keyword() != "ISO-10303-21") source.fail(source.begin(), "no file of ISO-10303-21");
    cursor.expect(';');
    bool has_data = false;
    for (;;) {
        (void)cursor.peek();
        const char* at = cursor.here();
        const std::string_view section = cursor.keyword();
        if (section == "END-ISO-10303-21") break;
        if (section != "HEADER" && section != "DATA")
            throw UnsupportedError(source.place(at).to_string() + ": the section " +
                                   shown_word(section) + " of a STEP file is not read");
        has_data = has_data || section == "DATA";
        skip_statement(cursor);
        while (cursor.peek() == '#' || section == "HEADER") {
            check_stop();
            Entry entry;
            entry.at = cursor.here();
            if (section == "DATA") {
                cursor.skip(1);
                entry.id = cursor.entity_number();
                if (entries_.size() >= source.limits().entities)
                    source.fail_limit(entry.at, "more than " +
                                                    std::to_string(source.limits().entities) +
                                                    " entities, the limit for a file");
                entries_.push_back(entry);
                cursor.expect('=');
            } else if (StepCursor(cursor).keyword() == "ENDSEC") {
                break;
            }
            skip_statement(cursor);
        }
        if (cursor.keyword() != "ENDSEC") cursor.fail("an entity or ENDSEC expected");
        cursor.expect(';');
    }
    cursor.expect(';');
    if (cursor.peek() != '\0' || !cursor.at_end()) cursor.fail("more data after the end");
    if (!has_data) cursor.fail("a STEP file without a section DATA");
    const auto less = [](const Entry& a, const Entry& b) { return a.id < b.id; };
    if (!std::is_sorted(entries_.begin(), entries_.end(), less))
        std::stable_sort(entries_.begin(), entries_.end(), less);
    for (std::size_t i = 1; i < entries_.size(); ++i)
        if (entries_[i - 1].id == entries_[i].id)
            source.fail(entries_[i].at,
                        "a second entity with the number #" + std::to_string(entries_[i].id));
}

std::string_view StepText::keyword(std::size_t index) const {
    StepCursor cursor(source_, entries_[index].at + 1);
    (void)cursor.entity_number();
    cursor.expect('=');
    return cursor.keyword();
}

std::size_t StepText::place_of(std::uint64_t id, const char* from) const {
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), id,
                                        [](const Entry& e, std::uint64_t i) { return e.id < i; });
    if (found == entries_.end() || found->id != id)
        source_.fail(from, "there is no entity #" + std::to_string(id));
    return static_cast<std::size_t>(found - entries_.begin());
}

StepEntity StepText::entity(std::uint64_t id, const char* from) const {
    return StepParser(source_, entries_[place_of(id, from)].at).entity();
}

const StepValue& StepText::value(const StepEntity& entity, const StepPart& part, std::size_t index,
                                 StepKind kind) const {
    if (index >= part.values.size())
        fail(entity, "has " + std::to_string(part.values.size()) + " values, too few");
    const StepValue& v = part.values[index];
    if (v.kind != kind)
        fail(entity,
             std::string(name_of_value(kind)) + " expected as value " + std::to_string(index + 1));
    return v;
}

StepEntity StepText::referred(const StepEntity& entity, const StepPart& part,
                              std::size_t index) const {
    const StepValue& v = value(entity, part, index, StepKind::Reference);
    return this->entity(v.id, v.at);
}

bool StepText::flag(const StepEntity& entity, const StepPart& part, std::size_t index) const {
    const StepValue& v = value(entity, part, index, StepKind::Enumeration);
    if (v.text != "T" && v.text != "F")
        fail(entity, ".T. or .F. expected as value " + std::to_string(index + 1));
    return v.text == "T";
}

std::string StepText::name(const StepPart& part, std::size_t index) const {
    if (index >= part.values.size() || part.values[index].kind != StepKind::Text) return {};
    return step_string(part.values[index].text);
}

void StepText::fail(const StepEntity& entity, const std::string& message) const {
    source_.fail(entity.at, shown_entity(entity) + ": " + message);
}

void StepText::fail_limit(const StepEntity& entity, const std::string& message) const {
    source_.fail_limit(entity.at, shown_entity(entity) + ": " + message);
}

void StepText::refuse(const StepEntity& entity, const std::string& message) const {
    throw UnsupportedError(source_.place(entity.at).to_string() + ": " + shown_entity(entity) +
                           ": " + message);
}

}  // namespace trisect::detail
