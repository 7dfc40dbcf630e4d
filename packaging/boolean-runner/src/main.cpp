// SPDX-License-Identifier: Apache-2.0
//
// The runner of the open boolean benchmark (github.com/solidean/boolean-benchmark-runners):
//
//     trisect_runner --request FILE --result FILE [--embedded] [--threads N]
//
// --embedded takes for granted that no mesh meets itself. 0 threads are as many as there are.
#include "benchmark_case.h"
#include "result_file.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

struct Arguments {
    std::string request;
    std::string result;
    bool embedded = false;
    std::uint32_t threads = 0;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&] {
            if (++i == argc) throw std::invalid_argument(word + " has no value");
            return std::string(argv[i]);
        };
        if (word == "--request") {
            arguments.request = value();
        } else if (word == "--result") {
            arguments.result = value();
        } else if (word == "--embedded") {
            arguments.embedded = true;
        } else if (word == "--threads") {
            arguments.threads = static_cast<std::uint32_t>(std::stoul(value()));
        } else {
            throw std::invalid_argument("unknown argument " + word);
        }
    }
    if (arguments.request.empty() || arguments.result.empty()) {
        throw std::invalid_argument("--request and --result are needed");
    }
    return arguments;
}

runner::Settings settings_of(const Arguments& arguments) {
    runner::Settings settings;
    settings.import.embedding =
        arguments.embedded ? trisect::Embedding::Assume : trisect::Embedding::Check;
    settings.import.import.threads = arguments.threads;
    settings.evaluate.threads = arguments.threads;
    return settings;
}

/// Whether all cases succeeded.
bool run(const Arguments& arguments) {
    std::ifstream file(arguments.request);
    if (!file) throw std::runtime_error("cannot read " + arguments.request);
    const auto request = nlohmann::json::parse(file);
    const runner::Settings settings = settings_of(arguments);
    runner::ResultFile results(arguments.result, request);
    bool good = true;
    for (const auto& entry : request.at("runs")) {
        auto result = runner::run_case(entry, settings);
        result["case_id"] = entry.at("case_id");
        std::cerr << result["case_id"] << ": " << result["status"] << '\n';
        good = good && result["status"] == "success";
        results.add(std::move(result));
    }
    results.write();
    return good;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(parse(argc, argv)) ? 0 : 1;
    } catch (const std::exception& error) {
        std::cerr << "trisect_runner: " << error.what() << '\n';
        return 2;
    }
}
