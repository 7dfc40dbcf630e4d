// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/partitions/space_tree_partition.h>

#include <chrono>

namespace trisect::hierarchies {

SpaceTreePartition::SpaceTreePartition(std::string_view name, Make make, const InterferenceModel& a,
                                       const InterferenceModel& b)
    : Partition(a, b), name_(name) {
    const auto start = std::chrono::steady_clock::now();
    tree_ = make(data_a(), fixed());
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace trisect::hierarchies
