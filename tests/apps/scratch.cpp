// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace trisect::test {
namespace {

// Corner i is upper along the axes whose bit is set in i. The lid comes last.
constexpr std::array<std::array<int, 4>, 6> box_faces{
    {{0, 2, 3, 1}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}}};

}  // namespace

std::string box_text(std::array<int, 3> lower, std::array<int, 3> upper, int first) {
    std::string text;
    for (unsigned corner = 0; corner < 8; ++corner) {
        text += "v";
        for (unsigned axis = 0; axis < 3; ++axis) {
            text += ' ' + std::to_string((corner >> axis & 1U) != 0 ? upper[axis] : lower[axis]);
        }
        text += '\n';
    }
    for (const auto& face : box_faces) {
        text += "f";
        for (const int corner : face) text += ' ' + std::to_string(first + corner);
        text += '\n';
    }
    return text;
}

Scratch::Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "trisect-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
}

Scratch::~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::string Scratch::path(std::string_view name) const { return (folder_ / name).string(); }

std::string Scratch::write(std::string_view name, std::string_view bytes) const {
    std::ofstream file(folder_ / name, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path(name);
}

std::string Scratch::read(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool Scratch::exists(std::string_view name) const {
    return std::filesystem::exists(folder_ / name);
}

std::size_t Scratch::entry_count() const {
    const std::filesystem::directory_iterator entries(folder_);
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

std::string Scratch::box(std::string_view name, std::array<int, 3> lower,
                         std::array<int, 3> upper) const {
    return write(name, box_text(lower, upper));
}

std::string Scratch::open_box(std::string_view name) const {
    std::string text = box_text({0, 0, 0}, {1, 1, 1});
    text.resize(text.rfind('f'));
    return write(name, text);
}

}  // namespace trisect::test
