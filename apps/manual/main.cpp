// SPDX-License-Identifier: Apache-2.0
//
// write_manual FOLDER [--ranks]: manual pages and completion of the command, from its table of
// options, to man1/, bash/, zsh/ and fish/ in FOLDER; with --ranks the page of trisect-mpi, too.
#include "program_commands.h"
#include "trisect/command_line.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "completion.h"
#include "manual_pages.h"

namespace trisect::app {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

void write_all(const std::filesystem::path& folder, bool with_ranks) {
    const CommandTable table = command_table(program_commands());
    write(folder / "man1/trisect.1", program_page(table));
    for (const CommandEntry& command : table.commands)
        write(folder / "man1" / ("trisect-" + command.name + ".1"), command_page(table, command));
    if (with_ranks) write(folder / "man1/trisect-mpi.1", ranks_page(table));
    write(folder / "bash/trisect", bash_completion(table));
    write(folder / "zsh/_trisect", zsh_completion(table));
    write(folder / "fish/trisect.fish", fish_completion(table));
}

}  // namespace
}  // namespace trisect::app

int main(int argc, char** argv) {
    const bool with_ranks = argc == 3 && std::string_view(argv[2]) == "--ranks";
    if (argc != 2 && !with_ranks) {
        std::cerr << "usage: write_manual FOLDER [--ranks]\n";
        return 2;
    }
    try {
        trisect::app::write_all(argv[1], with_ranks);
    } catch (const std::exception& error) {
        std::cerr << "write_manual: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
