// SPDX-License-Identifier: Apache-2.0
//
// Drives a harness without libFuzzer, so that every compiler can run it and the suite has a short
// form of each:
//
//     NAME [--runs N] [--seed S] [FILE...]
//
// Runs the files, or N inputs of a generator: random bytes, and mutations of earlier inputs.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

class Generator {
public:
    explicit Generator(std::uint64_t seed) : engine_(seed) {}

    Bytes next() {
        Bytes out = kept_.empty() || below(3) == 0 ? fresh() : mutated(kept_[below(kept_.size())]);
        if (kept_.size() < 100) {
            kept_.push_back(out);
        } else if (below(8) == 0) {
            kept_[below(kept_.size())] = out;
        }
        return out;
    }

private:
    std::uint64_t below(std::uint64_t n) { return engine_() % n; }
    std::uint8_t byte() { return static_cast<std::uint8_t>(engine_()); }
    Bytes fresh() {
        Bytes out(8 + below(120));
        for (auto& b : out) b = byte();
        return out;
    }
    Bytes mutated(Bytes b) {
        for (std::uint64_t n = 1 + below(4); n > 0 && !b.empty(); --n) {
            const auto at = b.begin() + static_cast<std::ptrdiff_t>(below(b.size()));
            switch (below(4)) {
                case 0:
                    *at = byte();
                    break;
                case 1:
                    *at = static_cast<std::uint8_t>(*at + (below(2) == 0 ? 1 : 255));
                    break;
                case 2:
                    b.insert(at, byte());
                    break;
                default:
                    b.erase(at);
            }
        }
        return b;
    }

    std::mt19937_64 engine_;
    std::vector<Bytes> kept_;
};

int run_files(int count, char** names) {
    for (int i = 0; i < count; ++i) {
        std::ifstream in(names[i], std::ios::binary);
        const Bytes bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
        (void)LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
    std::printf("%d files\n", count);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t runs = 1000;
    std::uint64_t seed = 1;
    int i = 1;
    for (; i + 1 < argc && std::strncmp(argv[i], "--", 2) == 0; i += 2)
        (std::strcmp(argv[i], "--seed") == 0 ? seed : runs) =
            std::strtoull(argv[i + 1], nullptr, 10);
    if (i < argc) return run_files(argc - i, argv + i);
    Generator generator(seed);
    for (std::uint64_t n = 0; n < runs; ++n) {
        const Bytes bytes = generator.next();
        // For who looks into a crash: the input is the last one written.
        if (const char* keep = std::getenv("FUZZ_KEEP_INPUT")) {
            std::ofstream(keep, std::ios::binary)
                .write(reinterpret_cast<const char*>(bytes.data()),
                       static_cast<std::streamsize>(bytes.size()));
        }
        (void)LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
    std::printf("%llu runs of seed %llu\n", static_cast<unsigned long long>(runs),
                static_cast<unsigned long long>(seed));
    return 0;
}
