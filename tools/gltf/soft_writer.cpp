#include "tools/gltf/soft_writer.h"

#include "tools/gltf/soft_numbers.h"

#include <utility>

namespace supple::cage::gltf {

std::string jiggleAttribute(size_t jiggle) {
    return "_SUPPLE_JIGGLE_" + std::to_string(jiggle);
}

std::string clothAttribute(size_t cloth) {
    return "_SUPPLE_CLOTH_" + std::to_string(cloth);
}

json writeJiggles(std::span<const Jiggle> jiggles) {
    json list = json::array();
    for (size_t j = 0; j < jiggles.size(); ++j) {
        json jiggle = softNumbers(jiggles[j]);
        jiggle["weights"] = jiggleAttribute(j);
        list.push_back(std::move(jiggle));
    }
    return list;
}

json writeCloths(std::span<const Cloth> cloths) {
    json list = json::array();
    for (size_t c = 0; c < cloths.size(); ++c) {
        json cloth = softNumbers(cloths[c]);
        cloth["weights"] = clothAttribute(c);
        cloth["colliders"] = cloths[c].colliders;
        list.push_back(std::move(cloth));
    }
    return list;
}

} // namespace supple::cage::gltf
