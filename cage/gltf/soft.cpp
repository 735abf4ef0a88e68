#include "cage/gltf/soft.h"

#include "cage/refusal.h"
#include "cage/soft.h"

#include <algorithm>

namespace supple::cage::gltf {
namespace {

Jiggle readJiggle(const Json& from, const std::string& place) {
    Jiggle own;
    own.frequency = numberMember(from, "frequency", own.frequency, kMinJiggleFrequency, kMaxJiggleFrequency, place);
    own.damping = numberMember(from, "damping", own.damping, 0.0f, kMaxJiggleDamping, place);
    own.limit = numberMember(from, "limit", own.limit, kMinJiggleLimit, kMaxCoordinate, place);
    return own;
}

bool flagMember(const Json& from, const char* key, const std::string& place) {
    const Json* const given = member(from, key);
    if (given != nullptr && !given->isBoolean()) {
        refuse(place + " " + key, "neither true nor false");
    }
    return given != nullptr && given->boolean();
}

Cloth readCloth(const Json& from, const std::string& place) {
    Cloth own;
    own.stretch = numberMember(from, "stretch", own.stretch, 0.0f, kMaxClothCompliance, place);
    own.shear = numberMember(from, "shear", own.stretch, 0.0f, kMaxClothCompliance, place);
    own.bend = numberMember(from, "bend", own.bend, 0.0f, kMaxClothCompliance, place);
    own.volume = flagMember(from, "volume", place);
    own.tether = numberMember(from, "tether", own.tether, 0.0f, kMaxClothTether, place);
    if (own.tether > 0.0f && own.tether < 1.0f) {
        refuse(place + " tether", "neither 0 nor 1 or more");
    }
    own.drag = numberMember(from, "drag", own.drag, 0.0f, 1.0f, place);
    own.air = numberMember(from, "air", own.air, 0.0f, 1.0f, place);
    own.gravity = numberMember(from, "gravity", own.gravity, 0.0f, kMaxClothGravity, place);
    own.hitRadius = numberMember(from, "hitRadius", own.hitRadius, 0.0f, kMaxCoordinate, place);
    const uint64_t substeps = unsignedMember(from, "substeps", place, own.substeps);
    if (substeps < 1 || substeps > kMaxClothSubsteps) {
        refuse(place + " substeps", "not from 1 to " + std::to_string(kMaxClothSubsteps));
    }
    own.substeps = static_cast<uint32_t>(substeps);
    if (const Json* const colliders = arrayMember(from, "colliders", place)) {
        if (colliders->size() > kMaxClothColliders) {
            refuse(place + " colliders",
                   std::to_string(colliders->size()) + ", of at most " + std::to_string(kMaxClothColliders));
        }
        for (const Json& collider : colliders->items()) {
            own.colliders.push_back(
                static_cast<uint32_t>(std::min<uint64_t>(toUnsigned(collider, place + " colliders"), kNone - 1)));
        }
    }
    return own;
}

template <class T>
void keepUsed(const std::vector<size_t>& used, std::vector<T>& all) {
    std::vector<T> kept;
    for (const size_t k : used) {
        kept.push_back(std::move(all[k]));
    }
    all = std::move(kept);
}

} // namespace

SoftReader::SoftReader(const Document& document, size_t meshIndex) {
    paintedJiggles_ =
        readPainted(document, meshIndex, "jiggle", kMaxJiggles, [&](const Json& from, const std::string& place) {
            read_.jiggles.push_back(readJiggle(from, place));
        });
    paintedCloths_ =
        readPainted(document, meshIndex, "cloth", kMaxCloths, [&](const Json& from, const std::string& place) {
            read_.cloths.push_back(readCloth(from, place));
        });
}

std::vector<int> SoftReader::accessorsOf(const file::Primitive& primitive) const {
    std::vector<int> accessors;
    findPainted(primitive, paintedJiggles_, accessors);
    findPainted(primitive, paintedCloths_, accessors);
    return accessors;
}

void SoftReader::append(const Document& document, std::span<const int> accessors, size_t firstVertex, size_t count,
                        const std::string& element) {
    const size_t jiggles = paintedJiggles_.size();
    appendPaintedWeights(document, accessors.first(jiggles), firstVertex, count, element, paintedJiggles_,
                         read_.jiggleWeights);
    appendPaintedWeights(document, accessors.subspan(jiggles), firstVertex, count, element, paintedCloths_,
                         read_.clothWeights);
}

SoftReader::Lists SoftReader::finish(const Document& document) && {
    keepUsed(usedPainted(document, paintedJiggles_, read_.jiggleWeights), read_.jiggles);
    keepUsed(usedPainted(document, paintedCloths_, read_.clothWeights), read_.cloths);
    return std::move(read_);
}

} // namespace supple::cage::gltf
