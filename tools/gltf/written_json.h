// JSON of a glTF file that is written. Private to tools/gltf/.
#pragma once

#include <nlohmann/json.hpp>

namespace supple::cage::gltf {

using nlohmann::json;

/// An array of the vector's components.
template <class Vec>
[[nodiscard]] json numbers(const Vec& vector) {
    json list = json::array();
    for (int k = 0; k < vector.length(); ++k) {
        list.push_back(static_cast<double>(vector[k]));
    }
    return list;
}

} // namespace supple::cage::gltf
