// SPDX-License-Identifier: Apache-2.0
#include "layer_stack.h"
#include "outcome.h"

namespace trisect::app {

std::string json_of_layers(const LayerStack& stack) {
    Json document;
    document["schema"] = "trisect.layers/1";
    document["axis"] =
        stack.axis ? Json(std::string(1, static_cast<char>('x' + *stack.axis))) : Json();
    document["layers"] = Json::array();
    for (const Layer& layer : stack.layers) {
        Json entry;
        entry["height"] = layer.height;
        if (layer.step) entry["step"] = *layer.step;
        entry["regions"] = Json::array();
        for (const auto& region : layer.regions) {
            Json piece;
            piece["outer"] = region.front();
            piece["holes"] = Json::array();
            for (std::size_t k = 1; k < region.size(); ++k) piece["holes"].push_back(region[k]);
            entry["regions"].push_back(std::move(piece));
        }
        document["layers"].push_back(std::move(entry));
    }
    return document.dump() + '\n';
}

}  // namespace trisect::app
