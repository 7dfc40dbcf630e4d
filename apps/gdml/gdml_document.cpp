// SPDX-License-Identifier: Apache-2.0
#include "gdml_document.h"

#include <trisect/brep/io/formats/input_text.h>
#include <trisect/brep/io/models/xml_reader.h>
#include <trisect/kernel/error.h>

#include <algorithm>
#include <array>

#include "gdml_loops.h"

namespace trisect::app {
namespace {

constexpr std::uint64_t most_elements = 20'000'000;
constexpr std::array<std::string_view, 4> kept_sections{"define", "solids", "structure", "setup"};

class TreeBuilder final : public detail::XmlHandler {
public:
    TreeBuilder(const detail::InputText& source, GdmlElement& root)
        : source_(source), root_(root) {}

    void begin(const detail::XmlElement& element) override {
        if (open_.empty() && element.name != "gdml")
            source_.fail(element.at, "<" + std::string(element.name) + "> is no GDML");
        if (open_.size() == 1)
            keeps_ = std::ranges::find(kept_sections, element.name) != kept_sections.end();
        if (!keeps_ && !open_.empty()) {
            open_.push_back(nullptr);
            return;
        }
        if (++count_ > most_elements) source_.fail_limit(element.at, "too many elements");
        // An element's children are added while it is the last one of its own parent, so pointers
        // to elements that are open stay what they are.
        GdmlElement* const made = open_.empty() ? &root_ : &open_.back()->children.emplace_back();
        made->name = element.name;
        for (const auto& [name, value] : element.attributes())
            made->attributes.emplace_back(name, value);
        made->offset = static_cast<std::uint64_t>(element.at - source_.begin());
        open_.push_back(made);
    }
    /// Of <expression> the text is the formula.
    void text(std::string_view piece) override {
        if (open_.empty() || open_.back() == nullptr || open_.back()->name != "expression") return;
        auto& attributes = open_.back()->attributes;
        if (attributes.empty() || attributes.back().first != "value")
            attributes.emplace_back("value", std::string());
        attributes.back().second += piece;
    }
    void end() override { open_.pop_back(); }

private:
    const detail::InputText& source_;
    GdmlElement& root_;
    std::vector<GdmlElement*> open_;
    std::uint64_t count_ = 0;
    bool keeps_ = true;
};

}  // namespace

const std::string* GdmlElement::find(std::string_view attribute) const {
    for (const auto& [key, value] : attributes)
        if (key == attribute) return &value;
    return nullptr;
}

const GdmlElement* GdmlElement::child(std::string_view wanted) const {
    for (const GdmlElement& c : children)
        if (c.name == wanted) return &c;
    return nullptr;
}

std::string GdmlElement::text(std::string_view attribute) const {
    const std::string* found = find(attribute);
    return found != nullptr ? *found : std::string();
}

GdmlDocument::GdmlDocument(std::string file, std::string bytes, const ReadLimits& limits)
    : file_(std::move(file)), bytes_(std::move(bytes)), limits_(limits) {
    const detail::InputText source(bytes_, file_, limits_, false);
    TreeBuilder builder(source, root_);
    detail::read_xml(source, builder);
    unroll_gdml_loops(root_, *this);
}

const GdmlElement& GdmlDocument::section(std::string_view name) const {
    const GdmlElement* found = root_.child(name);
    if (found == nullptr) fail(root_, "there is no <" + std::string(name) + ">");
    return *found;
}

const std::string& GdmlDocument::required(const GdmlElement& element,
                                          std::string_view attribute) const {
    const std::string* found = element.find(attribute);
    if (found == nullptr)
        fail(element, "<" + element.name + "> without the attribute " + std::string(attribute));
    return *found;
}

std::string GdmlDocument::place(const GdmlElement& element) const {
    const detail::InputText source(bytes_, file_, limits_, false);
    return source.place(source.begin() + element.offset).to_string();
}

void GdmlDocument::fail(const GdmlElement& element, const std::string& what) const {
    const detail::InputText source(bytes_, file_, limits_, false);
    source.fail(source.begin() + element.offset, what);
}

void GdmlDocument::fail_limit(const GdmlElement& element, const std::string& what) const {
    throw LimitError(place(element) + ": " + what);
}

void GdmlDocument::fail_unsupported(const GdmlElement& element, const std::string& what) const {
    throw UnsupportedError(place(element) + ": " + what);
}

}  // namespace trisect::app
