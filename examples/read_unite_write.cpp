// SPDX-License-Identifier: Apache-2.0
//
// The program of the README: reads two meshes, unites them, writes the result.

#include <iostream>

#include <trisect/trisect.h>

int main(int argc, char** argv) {
    if (argc != 4) {
        std::cerr << "usage: read_unite_write A B RESULT\n";
        return 2;
    }
    try {
        // Finds out whether a mesh meets itself; by default it is taken not to.
        const trisect::SolidOptions options{.embedding = trisect::Embedding::Check};
        const auto a = trisect::Solid::from_mesh(trisect::read_mesh(argv[1]), options);
        const auto b = trisect::Solid::from_mesh(trisect::read_mesh(argv[2]), options);

        const trisect::Solid both = trisect::evaluate(a | b);  // also a & b, a - b, a ^ b, ~a

        trisect::write_mesh(argv[3], both.to_mesh());
        std::cout << trisect::counts(both).triangles << " triangles, volume "
                  << trisect::volume(both) << '\n';
    } catch (const trisect::Error& error) {
        std::cerr << error.what() << '\n';
        return static_cast<int>(error.code());
    }
}
