// SPDX-License-Identifier: Apache-2.0

#include "first_contact_peer.h"

namespace peer {

struct Body::Data {};

bool is_available() { return false; }

Body::Body(const trisect::PolygonMesh&) {}

std::optional<double> first_contact(const Body&, const Body&, const std::array<double, 12>&,
                                    const std::array<double, 3>&, Solver) {
    return std::nullopt;
}

}  // namespace peer
