// SPDX-License-Identifier: Apache-2.0
//
// Dynamic boxes along the chain of an articulated body.
#pragma once

#include <memory>

#include <trisect/bsp/interference/boxes/broad_phase.h>

namespace trisect::hierarchies {

/// A binary tree over the slots in their order, with a box for every node. The slots of a chain's
/// links are consecutive where they were added one after the other, so a node stands for a piece of
/// the chain: its shape changes with its own joints only, and links that are near each other in the
/// chain are near each other in space. An update refits the boxes above what moved, O(moved + log
/// n), and makes no new order; pieces of the chain whose boxes are apart are parted by one test.
/// Bodies that are in no chain had better be in another broad phase: their slots say nothing about
/// where they are.
///
/// `work().moves` counts refitted boxes.
/// Source: Lin, Manocha, Cohen, Gottschalk, Collision detection: algorithms and applications (WAFR
/// 1996): dynamic bounding boxes of articulated bodies.
[[nodiscard]] std::unique_ptr<trisect::detail::BroadPhase> make_chain_boxes();

}  // namespace trisect::hierarchies
