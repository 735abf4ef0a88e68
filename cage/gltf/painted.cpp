#include "cage/gltf/painted.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/deformers.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>

namespace supple::cage::gltf {
namespace {

std::string readAttribute(const Json& from, const std::string& place) {
    if (!from.isObject()) {
        refuse(place, "not an object");
    }
    std::string name = paintedName(from, "weights", place);
    if (name.empty()) {
        refuse(place, "weights is missing");
    }
    return name;
}

} // namespace

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

std::vector<float> readPaintedWeights(const Document& document, int accessor, size_t count, const std::string& name) {
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

std::vector<Painted> readPainted(const Document& document, size_t meshIndex, const char* key, size_t most,
                                 const std::function<void(const Json&, const std::string&)>& read) {
    std::vector<Painted> painted;
    const std::string place = at("mesh", meshIndex) + " " + kDeformers, list = place + " " + key;
    document.leniency->leaveOut([&] {
        const Json* const deformers = deformersOf(document.meshes[meshIndex]);
        const Json* const given = deformers != nullptr ? arrayMember(*deformers, key, place) : nullptr;
        const size_t count = given != nullptr ? given->size() : 0;
        for (size_t i = 0; i < std::min(count, most); ++i) {
            document.leniency->leaveOut([&] {
                Painted own{readAttribute((*given)[i], item(list, i)), item(list, i)};
                const bool isThere = std::any_of(painted.begin(), painted.end(),
                                                 [&](const Painted& other) { return other.weights == own.weights; });
                if (isThere) {
                    refuse(own.place + " weights", cage::quoted(own.weights) + " is there twice");
                }
                document.memory->take(2 * own.weights.size(), list);
                read((*given)[i], own.place);
                painted.push_back(std::move(own));
            });
        }
        if (count > most) {
            refuse(list, std::to_string(count) + ", of at most " + std::to_string(most));
        }
    });
    return painted;
}

void findPainted(const file::Primitive& primitive, std::span<const Painted> painted, std::vector<int>& accessors) {
    for (const Painted& own : painted) {
        accessors.push_back(paintedAccessor(primitive, own.weights));
    }
}

void appendPaintedWeights(const Document& document, std::span<const int> accessors, size_t firstVertex, size_t count,
                          const std::string& element, std::span<Painted> painted, std::vector<PaintedWeight>& weights) {
    if (!weights.empty()) {
        weights.resize(firstVertex + count);
    }
    for (size_t k = 0; k < accessors.size(); ++k) {
        std::vector<float> own;
        if (accessors[k] < 0 || !document.leniency->leaveOut([&] {
                document.memory->take(count, sizeof(float) + sizeof(PaintedWeight), element);
                own = readPaintedWeights(document, accessors[k], count, element + " " + painted[k].weights);
            })) {
            continue;
        }
        weights.resize(firstVertex + count);
        for (size_t v = 0; v < count; ++v) {
            PaintedWeight& most = weights[firstVertex + v];
            painted[k].isPainted = painted[k].isPainted || own[v] > 0.0f;
            if (own[v] > most.weight) {
                most = {static_cast<uint32_t>(k), own[v]};
            }
        }
    }
}

std::vector<size_t> usedPainted(const Document& document, std::span<const Painted> painted,
                                std::vector<PaintedWeight>& weights) {
    std::vector<uint32_t> places(painted.size(), kNone);
    for (const PaintedWeight& own : weights) {
        if (own.index != kNone) {
            places[own.index] = 0;
        }
    }
    std::vector<size_t> used;
    for (size_t k = 0; k < painted.size(); ++k) {
        if (document.leniency->leaveOut([&] {
                if (!painted[k].isPainted) {
                    refuse(painted[k].place, "no vertex has a weight of " + cage::quoted(painted[k].weights));
                }
            }) &&
            places[k] != kNone) {
            places[k] = static_cast<uint32_t>(used.size());
            used.push_back(k);
        }
    }
    for (PaintedWeight& own : weights) {
        own.index = own.index != kNone ? places[own.index] : kNone;
    }
    if (used.empty()) {
        weights.clear();
    }
    return used;
}

} // namespace supple::cage::gltf
