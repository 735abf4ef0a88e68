#include "cage/gltf/deformers.h"

#include "cage/refusal.h"

namespace supple::cage::gltf {

namespace {

constexpr const char* kDeformers = "SUPPLE_deformers";

} // namespace

std::optional<SkinningMode> readSkinningMode(const Json& mesh, const std::string& element, Warnings& warnings) {
    const Json* const deformers =
        hasExtension(mesh, kDeformers) ? objectMember(mesh.at("extensions"), kDeformers, element) : nullptr;
    if (deformers == nullptr) {
        return std::nullopt;
    }
    const std::string place = element + " " + kDeformers, name = stringMember(*deformers, "skinning", place);
    for (const SkinningMode mode :
         {SkinningMode::linear, SkinningMode::dualQuaternion, SkinningMode::centersOfRotation}) {
        if (name == skinningModeName(mode)) {
            return mode;
        }
    }
    if (name == "deltaMush" || name == "deltaMushLight") {
        warn(warnings, place + " skinning", quoted(name) + " is not followed");
    } else if (!name.empty()) {
        refuse(place + " skinning", quoted(name) + " is not allowed");
    }
    return std::nullopt;
}

} // namespace supple::cage::gltf
