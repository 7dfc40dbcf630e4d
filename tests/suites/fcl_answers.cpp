// SPDX-License-Identifier: Apache-2.0
//
// fcl_answers
//
// What FCL of this machine says of pairs of shapes, one a line of the input: 1 where they meet, 0
// where not. A line is the solver (LIBCCD or INDEP), then twice the number of parameters, a kind,
// the parameters and the twelve entries of a placement by rows. fcl.py asks it.

#include <array>
#include <cstddef>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcl/fcl.h>

namespace {

using Shape = std::shared_ptr<fcl::CollisionGeometryd>;

Shape shape_of(const std::string& kind, const std::vector<double>& p) {
    if (kind == "Box") {
        return std::make_shared<fcl::Boxd>(p.at(0), p.at(1), p.at(2));
    }
    if (kind == "Sphere") {
        return std::make_shared<fcl::Sphered>(p.at(0));
    }
    if (kind == "Ellipsoid") {
        return std::make_shared<fcl::Ellipsoidd>(p.at(0), p.at(1), p.at(2));
    }
    if (kind == "Capsule") {
        return std::make_shared<fcl::Capsuled>(p.at(0), p.at(1));
    }
    if (kind == "Cylinder") {
        return std::make_shared<fcl::Cylinderd>(p.at(0), p.at(1));
    }
    if (kind == "Cone") {
        return std::make_shared<fcl::Coned>(p.at(0), p.at(1));
    }
    const fcl::Vector3d normal(p.at(0), p.at(1), p.at(2));
    if (kind == "Halfspace") {
        return std::make_shared<fcl::Halfspaced>(normal, p.at(3));
    }
    if (kind == "Plane") {
        return std::make_shared<fcl::Planed>(normal, p.at(3));
    }
    throw std::invalid_argument("no such shape: " + kind);
}

fcl::CollisionObjectd read_object(std::istream& in) {
    std::size_t count = 0;
    std::string kind;
    in >> count >> kind;
    std::vector<double> parameters(count);
    for (double& value : parameters) {
        in >> value;
    }
    fcl::Transform3d placement = fcl::Transform3d::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            in >> placement.matrix()(row, column);
        }
    }
    if (!in) {
        throw std::invalid_argument("a line is too short");
    }
    return fcl::CollisionObjectd(shape_of(kind, parameters), placement);
}

bool meet(const std::string& line) {
    std::istringstream in(line);
    std::string solver;
    in >> solver;
    const fcl::CollisionObjectd a = read_object(in);
    const fcl::CollisionObjectd b = read_object(in);
    fcl::CollisionRequestd request;
    request.gjk_solver_type = solver == "INDEP" ? fcl::GST_INDEP : fcl::GST_LIBCCD;
    fcl::CollisionResultd result;
    return fcl::collide(&a, &b, request, result) > 0;
}

}  // namespace

int main() {
    try {
        for (std::string line; std::getline(std::cin, line);) {
            std::cout << (meet(line) ? 1 : 0) << '\n';
        }
    } catch (const std::exception& error) {
        std::cerr << "fcl_answers: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
