#include "cage/gltf/deformers.h"

#include "cage/gltf/accessors.h"
#include "cage/message.h"
#include "cage/refusal.h"
#include "cage/smoothing.h"

namespace supple::cage::gltf {

namespace {

constexpr const char* kDeformers = "SUPPLE_deformers";

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
    const Json& mesh = document.meshes[meshIndex];
    const std::string place = at("mesh", meshIndex) + " " + kDeformers, own = place + " smoothing";
    document.leniency->leaveOut([&] {
        const Json* const deformers =
            hasExtension(mesh, kDeformers) ? objectIn(member(mesh, "extensions"), kDeformers) : nullptr;
        const Json* const from = deformers != nullptr ? objectMember(*deformers, "smoothing", place) : nullptr;
        if (from != nullptr) {
            read.numbers = smoothingIn(*from, own);
            read.mask = paintedName(*from, "mask", own);
        }
    });
    return read;
}

std::vector<float> readPainted(const Document& document, int accessor, size_t count, const std::string& name) {
    checkVertexCount(document, accessor, count, name);
    std::vector<float> weights =
        readFloats(document, accessor, file::kScalar, kFloat | kNormalizedU8 | kNormalizedU16, name);
    for (size_t v = 0; v < weights.size(); ++v) {
        if (!(weights[v] >= 0.0f && weights[v] <= 1.0f)) {
            refuse(item(name, v), "not from 0 to 1");
        }
    }
    return weights;
}

std::string paintedName(const Json& from, const char* key, const std::string& element) {
    std::string name = stringMember(from, key, element);
    if (!name.empty() && name.front() != '_') {
        refuse(element + " " + key, cage::quoted(name) + " is no name of an application's attribute: it has no _");
    }
    return name;
}

int paintedAccessor(const file::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return !name.empty() && found != primitive.attributes.end() ? found->second : -1;
}

void appendMushMask(const Document& document, int accessor, size_t firstVertex, size_t count, const std::string& name,
                    std::vector<float>& mask) {
    std::vector<float> own;
    if (accessor >= 0) {
        document.leniency->leaveOut([&] {
            document.memory->take(count, 2 * sizeof(float), name);
            own = readPainted(document, accessor, count, name);
        });
    }
    if (!mask.empty() || !own.empty()) {
        mask.resize(firstVertex, 1.0f);
        mask.insert(mask.end(), own.begin(), own.end());
        mask.resize(firstVertex + count, 1.0f);
    }
}

} // namespace supple::cage::gltf
