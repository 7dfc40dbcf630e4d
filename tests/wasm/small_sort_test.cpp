// SPDX-License-Identifier: Apache-2.0
//
// The sorts of the module for JavaScript beside the standard ones: drawn, sorted, reversed and few
// different keys.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <small_sort.h>

namespace {

struct Item {
    unsigned key = 0;
    unsigned place = 0;
    bool operator==(const Item&) const = default;
};

void require(bool condition, const char* what) {
    if (condition) return;
    std::cerr << "small_sort_test: " << what << '\n';
    std::exit(1);
}

unsigned key_of(unsigned mode, unsigned i, unsigned count, unsigned drawn) {
    if (mode == 0) return i;
    if (mode == 1) return count - i;
    if (mode == 2) return std::min(i, count - i);
    if (mode == 3) return i % 7;
    if (mode == 4) return drawn % 3;
    return drawn;
}

void compare(const std::vector<Item>& items) {
    auto by_key = [](const Item& a, const Item& b) { return a.key < b.key; };
    const auto by_place = [](const Item& a, const Item& b) { return a.place < b.place; };
    std::vector<Item> ours = items;
    std::vector<Item> expected = items;
    trisect_small_sort::sort_unless_sorted(ours.data(), ours.data() + ours.size(), by_key);
    require(std::is_sorted(ours.begin(), ours.end(), by_key), "not sorted");
    std::sort(ours.begin(), ours.end(), by_place);
    require(ours == items, "items are lost");
    trisect_small_sort::stable_sort(ours.data(), ours.data() + ours.size(), by_key);
    std::stable_sort(expected.begin(), expected.end(), by_key);
    require(ours == expected, "not stable");

    std::vector<std::string> texts;
    for (const Item& item : items)
        texts.push_back("a text that is not short " + std::to_string(item.key));
    std::vector<std::string> sorted = texts;
    auto less = [](const std::string& a, const std::string& b) { return a < b; };
    trisect_small_sort::sort_unless_sorted(texts.data(), texts.data() + texts.size(), less);
    std::sort(sorted.begin(), sorted.end());
    require(texts == sorted, "texts");
}

}  // namespace

int main() {
    std::mt19937 engine(1);
    const auto random = [&] { return static_cast<unsigned>(engine()); };
    for (unsigned round = 0; round < 6000; ++round) {
        const unsigned count = random() % (round % 100 == 0 ? 5000 : 60);
        std::vector<Item> items(count);
        for (unsigned i = 0; i < count; ++i) items[i] = {key_of(round % 6, i, count, random()), i};
        if (round % 12 == 0 && count > 0) items.back().key = 0;
        compare(items);
    }
    return 0;
}
