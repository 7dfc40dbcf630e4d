// SPDX-License-Identifier: Apache-2.0
//
// corpus: writes scenes with their expected results, and scores the results of any kernel.
//
//     trisect corpus DIR [--family F]... [--seed N]    DIR/NAME.json and DIR/NAME-0.off, -1.off,
//     ... trisect corpus DIR --results FOLDER              verifies FOLDER/NAME.off for each of
//     them
//
// What is expected is counted (box_scene.h), so the scores check this program too.
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/file_bytes.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/bsp/verify.h>

#include <fmt/format.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "box_scene.h"
#include "commands.h"
#include "corpus_families.h"
#include "corpus_slanted.h"
#include "operation_name.h"
#include "values.h"

namespace trisect::app {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t counted_points = 16;
constexpr const char* case_schema = "trisect.corpus_case/1";

Json case_json(const std::string& name, BooleanOperation operation, const CountedResult& expected,
               const std::vector<std::string>& files) {
    Json out;
    out["schema"] = case_schema;
    out["name"] = name;
    out["op"] = to_string(operation);
    out["operands"] = files;
    out["volume"] = expected.volume.to_string();
    out["area"] = expected.area.to_string();
    // Pairs (factor, radicand): the area is `area` and the sum of factor · √radicand.
    if (!expected.area_roots.empty()) out["area_roots"] = Json::array();
    for (const auto& [radicand, factor] : expected.area_roots)
        out["area_roots"].push_back({factor.to_string(), radicand});
    out["euler"] = expected.euler;
    out["points"] = Json::array();
    for (const CountedPoint& p : expected.points)
        out["points"].push_back(
            {{"at", {p.at[0].to_string(), p.at[1].to_string(), p.at[2].to_string()}},
             {"inside", p.inside}});
    return out;
}

void write_case(Session& session, const CorpusOptions& options, const SlantedScene& scene) {
    const fs::path folder = options.folder;
    std::vector<std::string> files;
    for (std::size_t i = 0; i < scene.operands.size(); ++i) {
        files.push_back(fmt::format("{}-{}.off", scene.name, i));
        const std::string file = (folder / files.back()).string();
        const FormattedMesh formatted =
            format_mesh(scene.operands[i], {.format = MeshFormat::Off}, file);
        session.write_output(file, formatted.bytes);
    }
    session.write_output(
        (folder / (scene.name + ".json")).string(),
        case_json(scene.name, scene.operation, scene.expected, files).dump(1) + "\n");
}

SlantedScene counted(const BoxScene& scene, std::uint64_t seed) {
    SlantedScene out{scene.name, scene.operation, {}, count(scene, counted_points, seed)};
    for (const auto& operand : scene.operands) out.operands.push_back(mesh_of(operand));
    return out;
}

std::vector<std::string> family_names() {
    std::vector<std::string> names = corpus_family_names();
    for (std::string& name : slanted_family_names()) names.push_back(std::move(name));
    return names;
}

bool is_slanted(const std::string& family) {
    const auto names = slanted_family_names();
    return std::find(names.begin(), names.end(), family) != names.end();
}

Outcome write_corpus(Session& session, const CorpusOptions& options) {
    session.plan(1);
    std::error_code error;
    fs::create_directories(options.folder, error);
    Outcome out;
    out.document["schema"] = "trisect.corpus/1";
    out.document["cases"] = Json::array();
    const auto families = options.families.empty() ? family_names() : options.families;
    const auto write = [&](const SlantedScene& scene) {
        write_case(session, options, scene);
        out.document["cases"].push_back(scene.name);
        out.answer += scene.name + "\n";
    };
    session.stage("write", [&] {
        for (const std::string& family : families) {
            if (is_slanted(family)) {
                for (const auto& scene : slanted_family(family, counted_points, options.seed))
                    write(scene);
            } else {
                for (const BoxScene& scene : corpus_family(family, options.seed))
                    write(counted(scene, options.seed));
            }
        }
    });
    return out;
}

/// A case as it was written. \throw InputError when it is not one.
Json read_case(const fs::path& file) {
    const FileBytes bytes = read_file(file.string(), std::uint64_t{1} << 24);
    Json out = Json::parse(bytes.view(), nullptr, false);
    if (out.is_discarded() || !out.is_object() || out.value("schema", "") != case_schema)
        throw InputError(FilePlace{file.string(), 0, 0, 0}, "not a case of the corpus");
    return out;
}

/// Expected numbers that the result has not.
Json misses_of(const Json& expected, const PolygonMesh& result, Lattice lattice) {
    Json out = Json::array();
    ImportOptions options;
    options.lattice = lattice;
    options.require_closed = false;
    const LatticeMesh mesh = import_mesh(result, options).mesh;
    if (exact_volume(mesh).to_string() != expected.at("volume").get<std::string>())
        out.push_back("volume");
    for (const Json& p : expected.at("points")) {
        ExactPoint at;
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = ExactRational::from_string(p.at("at").at(k).get<std::string>());
        const auto winding = winding_number(mesh, at);
        if (winding && (*winding > 0) == p.at("inside").get<bool>()) continue;
        out.push_back("membership");
        break;
    }
    return out;
}

Json score_of(const CorpusOptions& options, const Json& expected, const EvaluateOptions& evaluate) {
    const std::string name = expected.at("name");
    Json out;
    out["name"] = name;
    const fs::path file = fs::path(options.results) / (name + ".off");
    if (!fs::exists(file)) {
        out["verdict"] = "missing";
        return out;
    }
    std::vector<PolygonMesh> operands;
    for (const Json& operand : expected.at("operands"))
        operands.push_back(
            read_mesh((fs::path(options.folder) / operand.get<std::string>()).string()));
    const PolygonMesh result = read_mesh(file.string());
    VerifyOptions verification;
    verification.evaluate = evaluate;
    const VerifyReport report =
        verify(operation_named(expected.at("op")), operands, result, verification);
    out["verdict"] = to_string(report.verdict);
    if (std::isfinite(report.upper)) out["radius"] = {report.lower, report.upper};
    out["misses"] = misses_of(expected, result, report.lattice);
    return out;
}

/// \throw InputError for a case with other members than were written.
Json scored(const CorpusOptions& options, const fs::path& file, const EvaluateOptions& evaluate) {
    try {
        return score_of(options, read_case(file), evaluate);
    } catch (const Json::exception& e) {
        throw InputError(FilePlace{file.string(), 0, 0, 0}, e.what());
    }
}

// A shell makes the file before the command begins: `trisect corpus DIR ... > DIR/scores.json`.
bool is_standard_output(const fs::path& path) {
    struct stat file {};
    struct stat output {};
    return ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &output) == 0 &&
           file.st_dev == output.st_dev && file.st_ino == output.st_ino;
}

Outcome score_corpus(Session& session, const CorpusOptions& options) {
    session.plan(1);
    std::vector<fs::path> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(options.folder, error))
        if (entry.path().extension() == ".json" && !is_standard_output(entry.path()))
            files.push_back(entry.path());
    if (error) throw InputError(FilePlace{options.folder, 0, 0, 0}, error.message());
    std::sort(files.begin(), files.end());
    Outcome out;
    out.document["schema"] = "trisect.corpus_score/1";
    out.document["cases"] = Json::array();
    std::map<std::string, int> counts;
    const EvaluateOptions evaluate = session.evaluation_options({});
    session.stage("score", [&] {
        for (const fs::path& file : files) {
            Json score = scored(options, file, evaluate);
            const std::string verdict = score["verdict"];
            ++counts[verdict];
            const bool is_right = verdict == "equal" && score["misses"].empty();
            if (!is_right) {
                out.code = exit_findings;
                out.answer += score.dump() + "\n";
            }
            out.document["cases"].push_back(std::move(score));
        }
    });
    for (const auto& [verdict, n] : counts) out.answer += fmt::format("{:<12}{}\n", verdict, n);
    out.document["counts"] = counts;
    return out;
}

}  // namespace

void add_corpus_command(CLI::App& app, CorpusOptions& options) {
    CLI::App* command = app.add_subcommand(
        "corpus", "write test scenes with expected results, or score results of any kernel");
    command->add_option("DIR", options.folder, "folder of the corpus")->required();
    command->add_option("--family", options.families, "only these families")
        ->check(CLI::IsMember(family_names()));
    command
        ->add_option_function<std::string>(
            "--seed",
            [&options](const std::string& text) {
                options.seed = static_cast<std::uint64_t>(parse_integer(text, "--seed"));
            },
            "of random heights and sample points (default 1)")
        ->type_name("N");
    command->add_option("--results", options.results,
                        "score the results FOLDER/NAME.off instead of writing");
}

Outcome run_corpus(Session& session, const CorpusOptions& options) {
    return options.results.empty() ? write_corpus(session, options)
                                   : score_corpus(session, options);
}

}  // namespace trisect::app
