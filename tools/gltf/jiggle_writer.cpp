#include "tools/gltf/jiggle_writer.h"

namespace supple::cage::gltf {

std::string jiggleAttribute(size_t jiggle) {
    return "_SUPPLE_JIGGLE_" + std::to_string(jiggle);
}

json writeJiggles(std::span<const Jiggle> jiggles) {
    json list = json::array();
    for (size_t j = 0; j < jiggles.size(); ++j) {
        list.push_back({{"weights", jiggleAttribute(j)},
                        {"frequency", jiggles[j].frequency},
                        {"damping", jiggles[j].damping},
                        {"limit", jiggles[j].limit}});
    }
    return list;
}

} // namespace supple::cage::gltf
