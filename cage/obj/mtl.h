// Takes the text of an MTL file apart, by the rules of libtinyobjloader. Private to cage/obj/.
#pragma once

#include "cage/message.h"

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace supple::cage::obj {

/// A map as a statement gives it: what the file calls it, and where it lies.
struct MtlMap {
    std::string file; ///< empty: no map
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    bool clamp = false;
    float multiplier = 1.0f; ///< -bm

    [[nodiscard]] bool exists() const { return !file.empty(); }
};

/// What is not said has no value.
struct MtlMaterial {
    std::string name;
    std::optional<glm::vec3> diffuse;  ///< Kd
    std::optional<glm::vec3> emission; ///< Ke
    std::optional<float> dissolve;     ///< d, else 1 - Tr
    std::optional<float> shininess;    ///< Ns
    std::optional<float> roughness;    ///< Pr
    std::optional<float> metallic;     ///< Pm
    MtlMap diffuseMap;                 ///< map_Kd
    MtlMap emissionMap;                ///< map_Ke
    MtlMap alphaMap;                   ///< map_d
    MtlMap bumpMap;                    ///< map_Bump, bump
    MtlMap normalMap;                  ///< norm
    std::set<std::string> unused;      ///< statements that say something else
};

/// Those whose names are wanted, in the file's order; of several with one name the first counts, but all are here.
/// Lines of them that make no sense are left out, with one warning that counts them. `element` is what warnings call
/// the file.
[[nodiscard]] std::vector<MtlMaterial> parseMtl(std::string_view text,
                                                const std::function<bool(const std::string& name)>& isWanted,
                                                const std::string& element, Warnings& warnings);

} // namespace supple::cage::obj
