// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/glb_document.h>

#include <trisect/brep/io/formats/binary.h>
#include <trisect/kernel/error.h>

#include <cmath>
#include <utility>

namespace trisect::detail {
namespace {

constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_head_size = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A;
constexpr std::uint32_t binary_chunk = 0x004E4942;
// Values take some tens of bytes for each byte of text, so text is bounded more tightly than files.
constexpr std::uint64_t most_json = 64U << 20;

struct Chunk {
    std::uint32_t kind = 0;
    std::string_view bytes;
};

std::uint32_t number_at(const char* at) { return load<std::uint32_t, false>(at); }

/// The chunk at `at`, which is moved behind it.
Chunk take_chunk(const InputText& source, const char*& at) {
    const auto left = static_cast<std::uint64_t>(source.end() - at);
    if (left < chunk_head_size) source.fail(at, "the file ends in the head of a chunk");
    const std::uint64_t size = number_at(at);
    if (size > left - chunk_head_size)
        source.fail(at,
                    "a chunk of " + std::to_string(size) + " bytes, more than the file has left");
    const Chunk chunk{number_at(at + 4), {at + chunk_head_size, static_cast<std::size_t>(size)}};
    at += chunk_head_size + size;
    return chunk;
}

}  // namespace

GlbDocument::GlbDocument(const InputText& source) : source_(source) {
    const char* at = source.begin();
    if (source.bytes().size() < header_size)
        source.fail(source.end(), "the file ends in its header");
    if (!source.bytes().starts_with("glTF"))
        source.fail(at, "no GLB: it does not begin with 'glTF'");
    const std::uint32_t version = number_at(at + 4);
    if (version != 2) {
        throw UnsupportedError(source.place(at + 4).to_string() + ": glTF of version " +
                               std::to_string(version) + "; 2 is read");
    }
    if (number_at(at + 8) != source.bytes().size()) {
        source.fail(at + 8, "the header states " + std::to_string(number_at(at + 8)) +
                                " bytes, the file has " + std::to_string(source.bytes().size()));
    }
    at += header_size;
    const Chunk first = take_chunk(source, at);
    if (first.kind != json_chunk)
        source.fail(source.begin() + header_size, "the first chunk is not JSON");
    bool has_binary = false;
    while (at != source.end()) {
        const char* const head = at;
        const Chunk chunk = take_chunk(source, at);
        if (chunk.kind != binary_chunk) continue;  // the specification has others ignored
        if (std::exchange(has_binary, true)) source.fail(head, "two binary chunks");
        binary_ = chunk.bytes;
    }
    parse(first.bytes);
}

void GlbDocument::parse(std::string_view text) {
    if (text.size() > most_json) {
        source_.fail_limit(text.data(), "JSON of more than " + std::to_string(most_json) +
                                            " bytes, the limit for a GLB file");
    }
    const auto deepest = static_cast<int>(std::min<std::uint64_t>(source_.limits().nesting, 1000));
    const auto check_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        if (depth > deepest) {
            source_.fail_limit(text.data(), "JSON nests deeper than " + std::to_string(deepest));
        }
        return true;
    };
    try {
        json_ = nlohmann::json::parse(text.begin(), text.end(), check_depth);
    } catch (const nlohmann::json::parse_error& e) {
        const std::size_t offset = e.byte == 0 ? 0 : std::min(e.byte - 1, text.size());
        source_.fail(text.data() + offset, "the JSON is malformed");
    } catch (const nlohmann::json::out_of_range&) {
        source_.fail(text.data(), "a number of the JSON is larger than a double can be");
    }
    if (!json_.is_object()) source_.fail(text.data(), "the JSON is no object");
}

void GlbDocument::fail(const GlbValue& value, const std::string& message) const {
    source_.fail(source_.begin() + header_size + chunk_head_size, value.path + ": " + message);
}

void GlbDocument::refuse(const GlbValue& value, const std::string& message) const {
    throw UnsupportedError(
        source_.place(source_.begin() + header_size + chunk_head_size).to_string() + ": " +
        value.path + ": " + message);
}

bool GlbDocument::has(const GlbValue& in, const char* name) const {
    return in.json->contains(name);
}

std::optional<GlbValue> GlbDocument::object(const GlbValue& in, const char* name) const {
    const auto found = in.json->find(name);
    if (found == in.json->end()) return std::nullopt;
    GlbValue value{&*found, in.path + "." + name};
    if (!found->is_object()) fail(value, "is no object");
    return value;
}

std::vector<GlbValue> GlbDocument::array(const GlbValue& in, const char* name) const {
    std::vector<GlbValue> out;
    const auto found = in.json->find(name);
    if (found == in.json->end()) return out;
    if (!found->is_array()) fail({&*found, in.path + "." + name}, "is no array");
    out.reserve(found->size());
    for (std::size_t i = 0; i < found->size(); ++i)
        out.push_back({&(*found)[i], in.path + "." + name + "[" + std::to_string(i) + "]"});
    return out;
}

std::string GlbDocument::text(const GlbValue& in, const char* name) const {
    const auto found = in.json->find(name);
    if (found == in.json->end()) return {};
    if (!found->is_string()) fail({&*found, in.path + "." + name}, "is no text");
    return found->get<std::string>();
}

std::optional<std::uint64_t> GlbDocument::count(const GlbValue& in, const char* name) const {
    const auto found = in.json->find(name);
    if (found == in.json->end()) return std::nullopt;
    // Some writers put a point behind whole numbers.
    if (found->is_number_float()) {
        const double value = found->get<double>();
        if (value >= 0 && value < 9e15 && value == std::floor(value))
            return static_cast<std::uint64_t>(value);
    }
    if (!found->is_number_unsigned())
        fail({&*found, in.path + "." + name}, "is no whole number from 0");
    return found->get<std::uint64_t>();
}

std::uint64_t GlbDocument::required_count(const GlbValue& in, const char* name) const {
    const auto value = count(in, name);
    if (!value) fail(in, "has no " + std::string(name));
    return *value;
}

std::vector<double> GlbDocument::numbers(const GlbValue& in, const char* name,
                                         std::vector<double> defaults) const {
    const auto found = in.json->find(name);
    if (found == in.json->end()) return defaults;
    const GlbValue value{&*found, in.path + "." + name};
    if (!found->is_array() || found->size() != defaults.size())
        fail(value, "is no array of " + std::to_string(defaults.size()) + " numbers");
    for (std::size_t i = 0; i < defaults.size(); ++i) {
        if (!(*found)[i].is_number()) fail(value, "has an entry that is no number");
        defaults[i] = (*found)[i].get<double>();
        if (!std::isfinite(defaults[i])) fail(value, "has a number that is not finite");
    }
    return defaults;
}

GlbValue GlbDocument::at(const char* array, std::uint64_t index, const GlbValue& user) const {
    const auto found = json_.find(array);
    if (found == json_.end() || !found->is_array() || index >= found->size())
        fail(user, "there is no " + std::string(array) + "[" + std::to_string(index) + "]");
    GlbValue value{&(*found)[static_cast<std::size_t>(index)],
                   std::string(array) + "[" + std::to_string(index) + "]"};
    if (!value.json->is_object()) fail(value, "is no object");
    return value;
}

}  // namespace trisect::detail
