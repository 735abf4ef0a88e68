#include "cage/gltf/jiggles.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/deformers.h"
#include "cage/jiggle.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>

namespace supple::cage::gltf {
namespace {

constexpr const char* kExtension = "SUPPLE_deformers";

PaintedJiggle readJiggle(const Json& from, const std::string& place) {
    if (!from.isObject()) {
        refuse(place, "not an object");
    }
    PaintedJiggle read;
    read.place = place;
    read.weights = paintedName(from, "weights", place);
    if (read.weights.empty()) {
        refuse(place, "weights is missing");
    }
    Jiggle& own = read.jiggle;
    own.frequency = numberMember(from, "frequency", own.frequency, kMinJiggleFrequency, kMaxJiggleFrequency, place);
    own.damping = numberMember(from, "damping", own.damping, 0.0f, kMaxJiggleDamping, place);
    own.limit = numberMember(from, "limit", own.limit, kMinJiggleLimit, kMaxCoordinate, place);
    return read;
}

} // namespace

std::vector<PaintedJiggle> readJiggles(const Document& document, size_t meshIndex) {
    std::vector<PaintedJiggle> jiggles;
    const Json& mesh = document.meshes[meshIndex];
    const std::string place = at("mesh", meshIndex) + " " + kExtension, list = place + " jiggle";
    document.leniency->leaveOut([&] {
        const Json* const deformers =
            hasExtension(mesh, kExtension) ? objectIn(member(mesh, "extensions"), kExtension) : nullptr;
        const Json* const given = deformers != nullptr ? arrayMember(*deformers, "jiggle", place) : nullptr;
        const size_t count = given != nullptr ? given->size() : 0;
        for (size_t i = 0; i < std::min(count, kMaxJiggles); ++i) {
            document.leniency->leaveOut([&] {
                PaintedJiggle read = readJiggle((*given)[i], item(list, i));
                const bool isThere = std::any_of(jiggles.begin(), jiggles.end(), [&](const PaintedJiggle& other) {
                    return other.weights == read.weights;
                });
                if (isThere) {
                    refuse(item(list, i) + " weights", cage::quoted(read.weights) + " is there twice");
                }
                document.memory->take(2 * read.weights.size(), list);
                jiggles.push_back(std::move(read));
            });
        }
        if (count > kMaxJiggles) {
            refuse(list, std::to_string(count) + ", of at most " + std::to_string(kMaxJiggles));
        }
    });
    return jiggles;
}

std::vector<int> jiggleAccessors(const file::Primitive& primitive, std::span<const PaintedJiggle> jiggles) {
    std::vector<int> accessors;
    for (const PaintedJiggle& jiggle : jiggles) {
        accessors.push_back(paintedAccessor(primitive, jiggle.weights));
    }
    return accessors;
}

void appendJiggleWeights(const Document& document, std::span<const int> accessors, size_t firstVertex, size_t count,
                         const std::string& element, std::span<PaintedJiggle> jiggles,
                         std::vector<JiggleWeight>& weights) {
    if (!weights.empty()) {
        weights.resize(firstVertex + count);
    }
    for (size_t j = 0; j < accessors.size(); ++j) {
        std::vector<float> own;
        if (accessors[j] < 0 || !document.leniency->leaveOut([&] {
                document.memory->take(count, sizeof(float) + sizeof(JiggleWeight), element);
                own = readPainted(document, accessors[j], count, element + " " + jiggles[j].weights);
            })) {
            continue;
        }
        weights.resize(firstVertex + count);
        for (size_t v = 0; v < count; ++v) {
            JiggleWeight& painted = weights[firstVertex + v];
            jiggles[j].isPainted = jiggles[j].isPainted || own[v] > 0.0f;
            if (own[v] > painted.weight) {
                painted = {static_cast<uint32_t>(j), own[v]};
            }
        }
    }
}

std::vector<Jiggle> usedJiggles(const Document& document, std::span<const PaintedJiggle> jiggles,
                                std::vector<JiggleWeight>& weights) {
    std::vector<uint32_t> places(jiggles.size(), kNone);
    for (const JiggleWeight& own : weights) {
        if (own.jiggle != kNone) {
            places[own.jiggle] = 0;
        }
    }
    std::vector<Jiggle> used;
    for (size_t j = 0; j < jiggles.size(); ++j) {
        if (document.leniency->leaveOut([&] {
                if (!jiggles[j].isPainted) {
                    refuse(jiggles[j].place, "no vertex has a weight of " + cage::quoted(jiggles[j].weights));
                }
            }) &&
            places[j] != kNone) {
            places[j] = static_cast<uint32_t>(used.size());
            used.push_back(jiggles[j].jiggle);
        }
    }
    for (JiggleWeight& own : weights) {
        own.jiggle = own.jiggle != kNone ? places[own.jiggle] : kNone;
    }
    if (used.empty()) {
        weights.clear();
    }
    return used;
}

} // namespace supple::cage::gltf
