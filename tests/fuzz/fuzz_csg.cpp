// SPDX-License-Identifier: Apache-2.0
//
// Fuzzing of programs in OpenSCAD's evaluated form. The first byte of an input says what the others
// are: text as it is, or words of programs, most of them where they belong. Whatever it is, a
// program is refused with a documented error, or its set has a mesh. Files are not read; work and
// memory are limited.
#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "byte_source.h"
#include "csg_mutations.h"

namespace {

using fuzz::ByteSource;

constexpr std::string_view numbers[] = {"1", "0",  "2",  "3",  "-1", "0.5", "0.1",    "5",
                                        "4", "-2", "10", "45", "90", "1.5", "0.7071", "7"};

constexpr std::string_view odd_values[] = {"1e-9", "1e9",   "inf",   "nan",   "1e308", "-1e-300",
                                           "true", "false", "undef", "\"a\"", "[]",    "360"};

constexpr std::string_view groups[] = {
    "group()",    "union()",     "difference()",   "intersection()",
    "hull()",     "minkowski()", "color([1,0,0])", "render()",
    "projection", "multmatrix",  "linear_extrude", "rotate_extrude",
    "resize",     "offset",      "projection",     "multmatrix"};

constexpr std::string_view shapes[] = {"cube",    "sphere", "cylinder", "square",    "circle",
                                       "polygon", "cube",   "square",   "polyhedron"};

constexpr std::string_view junk[] = {"{",       "}",
                                     "(",       ")",
                                     "[",       "]",
                                     ";",       ",",
                                     "=",       "#",
                                     "*",       "!",
                                     "%",       "//",
                                     "/*",      "import(file=\"x.off\");",
                                     "text();", "surface(file=\"x.dat\");",
                                     "\"",      "1e",
                                     "$fn"};

class Program {
public:
    explicit Program(ByteSource& source) : source_(source) {}

    std::string text() {
        while (!source_.is_empty() && text_.size() < most_bytes) node(0);
        return std::move(text_);
    }

private:
    static constexpr std::size_t most_bytes = 4000;
    static constexpr int most_levels = 12;

    template <std::size_t N>
    std::string_view one_of(const std::string_view (&words)[N]) {
        return words[source_.below(N)];
    }
    std::string number() {
        return std::string(source_.below(64) == 1 ? one_of(odd_values) : one_of(numbers));
    }
    std::string list(unsigned count) {
        std::string out = "[";
        for (unsigned i = 0; i < count; ++i) out += (i == 0 ? "" : ",") + number();
        return out + "]";
    }

    void node(int level) {
        const unsigned choice = source_.below(16);
        if (choice == 0) text_ += one_of(junk);
        if (choice == 1) text_ += "#%*!"[source_.below(4)];
        if (level < most_levels && choice >= 2 && choice < 9)
            group(level);
        else if (choice >= 2)
            shape();
    }

    void group(int level) {
        const std::string_view name = one_of(groups);
        text_ += name;
        if (name.back() != ')') text_ += arguments_of_group(name);
        text_ += "{";
        for (unsigned n = source_.below(4); n > 0 && !source_.is_empty(); --n) node(level + 1);
        text_ += "}";
    }

    std::string arguments_of_group(std::string_view name) {
        if (name == "multmatrix")
            return "([" + row(0) + "," + row(1) + "," + row(2) + ",[0,0,0,1]])";
        if (name == "linear_extrude")
            return "(height=" + number() + ",center=" + truth() + ",twist=" + number() +
                   ",slices=" + small() + ",scale=" + list(2) + ",$fn=" + small() + ")";
        if (name == "rotate_extrude") return "(angle=" + number() + ",$fn=" + small() + ")";
        if (name == "resize") return "(newsize=" + list(3) + ",auto=" + list(3) + ")";
        if (name == "offset")
            return std::string(source_.below(2) == 0 ? "(r=" : "(delta=") + number() +
                   ",chamfer=" + truth() + ",$fn=" + small() + ")";
        return "(cut=" + truth() + ")";
    }

    std::string row(unsigned axis) {
        // Mostly a translation.
        if (source_.below(4) == 0) return list(4);
        std::string out = "[";
        for (unsigned k = 0; k < 3; ++k) out += k == axis ? "1," : "0,";
        return out + number() + "]";
    }
    std::string truth() { return source_.below(2) == 0 ? "true" : "false"; }
    std::string small() { return std::to_string(source_.below(9)); }

    void shape() {
        const std::string_view name = one_of(shapes);
        text_ += name;
        if (name == "cube") text_ += "(size=" + list(3) + ",center=" + truth() + ");";
        if (name == "square") text_ += "(size=" + list(2) + ",center=" + truth() + ");";
        if (name == "sphere" || name == "circle")
            text_ += "(r=" + number() + ",$fn=" + small() + ");";
        if (name == "cylinder")
            text_ +=
                "(h=" + number() + ",r1=" + number() + ",r2=" + number() + ",$fn=" + small() + ");";
        if (name == "polygon") text_ += "(points=" + points(2) + ",paths=undef);";
        if (name == "polyhedron")
            text_ += "(points=" + points(3) + ",faces=[[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);";
    }
    std::string points(unsigned dimension) {
        std::string out = "[";
        for (unsigned n = 3 + source_.below(4), i = 0; i < n; ++i)
            out += (i == 0 ? "" : ",") + list(dimension);
        return out + "]";
    }

    ByteSource& source_;
    std::string text_;
};

// TRISECT_FUZZ_WORK: how much work an input may take. TRISECT_FUZZ_EVALUATED=N: of programs that
// are read one of N is evaluated, which their text chooses. Either tries more inputs in the same
// time.
std::uint64_t number_of(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

bool is_evaluated(const std::string& text) {
    static const std::uint64_t one_of =
        std::max<std::uint64_t>(number_of("TRISECT_FUZZ_EVALUATED", 1), 1);
    std::uint64_t hash = 1469598103934665603U;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return (hash >> 32) % one_of == 0;
}

void evaluate_text(const std::string& text) {
    trisect::StopLimits limits;
    static const std::uint64_t most_work = number_of("TRISECT_FUZZ_WORK", 20'000);
    limits.max_work = most_work;
    limits.max_memory = std::uint64_t{64} << 20;
    const trisect::StopScope scope(limits);
    trisect::CsgOptions options;
    options.reads_files = false;
    options.evaluate.threads = 1;
    const trisect::CsgTree tree = trisect::parse_csg(text, "fuzz");
    if (!is_evaluated(text)) return;
    trisect::CsgReport report;
    const trisect::Solid solid = trisect::evaluate_csg(tree, options, &report);
    const trisect::PolygonMesh mesh = solid.to_mesh(1);
    for (const std::uint32_t corner : mesh.corners)
        if (corner >= mesh.points.size()) std::abort();
}

}  // namespace

// libFuzzer's own changes of bytes, where it is.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                                              std::size_t most);

/// Half of the changes of text are changes of its nodes and numbers.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    if (size == 0 || data[0] % 8 != 0 || seed % 2 == 0)
        return LLVMFuzzerMutate == nullptr ? size : LLVMFuzzerMutate(data, size, most);
    const std::string now =
        fuzz::CsgMutation(std::string(reinterpret_cast<const char*>(data) + 1, size - 1), seed)
            .result()
            .substr(0, most - 1);
    std::copy(now.begin(), now.end(), data + 1);
    return now.size() + 1;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    ByteSource source(data + 1, size - 1);
    const std::string text = data[0] % 8 == 0
                                 ? std::string(reinterpret_cast<const char*>(data) + 1, size - 1)
                                 : Program(source).text();
    if (const char* shown = std::getenv("TRISECT_FUZZ_SHOW"); shown != nullptr)
        std::fprintf(stderr, "%s\n", text.c_str());
    try {
        evaluate_text(text);
    } catch (const trisect::Error& error) {
        // An error of use, or one within, would be our fault.
        if (error.code() == trisect::ErrorCode::Usage ||
            error.code() == trisect::ErrorCode::Internal)
            throw;
    }
    return 0;
}
