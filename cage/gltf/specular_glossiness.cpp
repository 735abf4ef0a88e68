#include "cage/gltf/specular_glossiness.h"

#include <algorithm>
#include <cmath>

namespace supple::cage::gltf {
namespace {

// In doubles: roots of the quadratic are differences, and a metal shall be one of 1.
constexpr double kSmallest = 1e-6; // instead of a division by 0
constexpr double kDielectricSpecular = 0.04;

double brightnessOf(const glm::dvec3& color) {
    return std::sqrt(glm::dot(glm::dvec3(0.299, 0.587, 0.114), color * color));
}

/// How metallic a material is whose diffuse and specular colors are so bright: the root of a quadratic.
double metallicOf(double diffuse, double specular, double oneMinusSpecular) {
    if (specular < kDielectricSpecular) {
        return 0.0;
    }
    const double a = kDielectricSpecular;
    const double b = diffuse * oneMinusSpecular / (1.0 - a) + specular - 2.0 * a;
    const double c = a - specular; // never above 0, so the root is real
    return std::clamp((std::sqrt(b * b - 4.0 * a * c) - b) / (2.0 * a), 0.0, 1.0);
}

} // namespace

MetallicRoughness toMetallicRoughness(const SpecularGlossiness& from) {
    const glm::dvec3 diffuse(from.diffuse), specular(from.specular);
    const double oneMinusSpecular = 1.0 - std::max({specular.x, specular.y, specular.z});
    const double metallic = metallicOf(brightnessOf(diffuse), brightnessOf(specular), oneMinusSpecular);
    const glm::dvec3 fromDiffuse =
        diffuse * (oneMinusSpecular / (1.0 - kDielectricSpecular) / std::max(1.0 - metallic, kSmallest));
    const glm::dvec3 fromSpecular = (specular - kDielectricSpecular * (1.0 - metallic)) / std::max(metallic, kSmallest);
    const glm::dvec3 color = glm::clamp(glm::mix(fromDiffuse, fromSpecular, metallic * metallic), 0.0, 1.0);
    return {glm::vec4(glm::vec3(color), from.diffuse.w), static_cast<float>(metallic), 1.0f - from.glossiness};
}

} // namespace supple::cage::gltf
