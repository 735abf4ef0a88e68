#include "cage/gltf/deformers.h"

#include "cage/gltf/painted.h"
#include "cage/message.h"
#include "cage/refusal.h"
#include "cage/smoothing.h"

namespace supple::cage::gltf {

namespace {

Smoothing smoothingIn(const Json& from, const std::string& place) {
    Smoothing read;
    read.lambda = numberMember(from, "lambda", read.lambda, kMinSmoothingLambda, kMaxSmoothingLambda, place);
    const uint64_t iterations = unsignedMember(from, "iterations", place, read.iterations);
    if (iterations < 1 || iterations > kMaxSmoothingIterations) {
        refuse(place + " iterations",
               std::to_string(iterations) + ": not from 1 to " + std::to_string(kMaxSmoothingIterations));
    }
    read.iterations = static_cast<uint32_t>(iterations);
    return read;
}

} // namespace

const Json* deformersOf(const Json& mesh) {
    return hasExtension(mesh, kDeformers) ? objectIn(member(mesh, "extensions"), kDeformers) : nullptr;
}

std::optional<SkinningMode> readSkinningMode(const Json& mesh, const std::string& element) {
    const Json* const deformers =
        hasExtension(mesh, kDeformers) ? objectMember(mesh.at("extensions"), kDeformers, element) : nullptr;
    if (deformers == nullptr) {
        return std::nullopt;
    }
    const std::string place = element + " " + kDeformers, name = stringMember(*deformers, "skinning", place);
    for (const SkinningMode mode : {SkinningMode::linear, SkinningMode::dualQuaternion, SkinningMode::centersOfRotation,
                                    SkinningMode::deltaMush, SkinningMode::deltaMushLight}) {
        if (name == skinningModeName(mode)) {
            return mode;
        }
    }
    if (!name.empty()) {
        refuse(place + " skinning", quoted(name) + " is not allowed");
    }
    return std::nullopt;
}

SmoothingFields readSmoothing(const Document& document, size_t meshIndex) {
    SmoothingFields read;
    const std::string place = at("mesh", meshIndex) + " " + kDeformers, own = place + " smoothing";
    document.leniency->leaveOut([&] {
        const Json* const deformers = deformersOf(document.meshes[meshIndex]);
        const Json* const from = deformers != nullptr ? objectMember(*deformers, "smoothing", place) : nullptr;
        if (from != nullptr) {
            read.numbers = smoothingIn(*from, own);
            read.mask = paintedName(*from, "mask", own);
        }
    });
    return read;
}

void appendMushMask(const Document& document, int accessor, size_t firstVertex, size_t count, const std::string& name,
                    std::vector<float>& mask) {
    std::vector<float> own;
    if (accessor >= 0) {
        document.leniency->leaveOut([&] {
            document.memory->take(count, 2 * sizeof(float), name);
            own = readPaintedWeights(document, accessor, count, name);
        });
    }
    if (!mask.empty() || !own.empty()) {
        mask.resize(firstVertex, 1.0f);
        mask.insert(mask.end(), own.begin(), own.end());
        mask.resize(firstVertex + count, 1.0f);
    }
}

} // namespace supple::cage::gltf
