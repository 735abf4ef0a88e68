#include "arcs.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>

namespace crowd {

namespace {

using Json = nlohmann::json;

constexpr size_t kHeader = 12, kChunkHeader = 8;
constexpr uint32_t kKeys = 25; ///< of an arc: the chords between them cut a turn of 4 radians by 0.4 % of its radius

uint32_t word(const std::vector<char>& bytes, size_t at) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

void pad(std::vector<char>& chunk, char with) {
    chunk.resize((chunk.size() + 3) / 4 * 4, with);
}

/// The joint that is no joint's child.
int rootJoint(const Json& file) {
    const Json& joints = file["skins"][0]["joints"];
    std::set<int> children;
    for (const Json& joint : joints)
        for (const Json& child : file["nodes"][joint.get<size_t>()].value("children", Json::array()))
            children.insert(child.get<int>());
    for (const Json& joint : joints)
        if (!children.contains(joint.get<int>()))
            return joint.get<int>();
    return joints[0].get<int>();
}

/// Appends floats as an accessor; its index.
size_t addAccessor(Json& file, std::vector<char>& binary, const std::vector<float>& values, const char* type,
                   size_t width) {
    pad(binary, 0);
    const size_t bytes = values.size() * sizeof(float);
    file["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes}});
    Json accessor = {{"bufferView", file["bufferViews"].size() - 1},
                     {"componentType", 5126},
                     {"count", values.size() / width},
                     {"type", type}};
    if (width == 1) {
        accessor["min"] = {*std::min_element(values.begin(), values.end())};
        accessor["max"] = {*std::max_element(values.begin(), values.end())};
    }
    file["accessors"].push_back(accessor);
    const char* const from = reinterpret_cast<const char*>(values.data());
    binary.insert(binary.end(), from, from + bytes);
    return file["accessors"].size() - 1;
}

} // namespace

std::optional<std::vector<char>> withArcs(const std::vector<char>& glb, const std::string& walk, float stride,
                                          std::span<const Arc> arcs) {
    if (glb.size() < kHeader + kChunkHeader)
        return std::nullopt;
    const size_t jsonBytes = word(glb, kHeader), binaryHeader = kHeader + kChunkHeader + jsonBytes;
    if (binaryHeader + kChunkHeader > glb.size() || word(glb, binaryHeader) > glb.size() - binaryHeader - kChunkHeader)
        return std::nullopt;
    const auto text = glb.begin() + kHeader + kChunkHeader;
    Json file = Json::parse(text, text + static_cast<ptrdiff_t>(jsonBytes), nullptr, false);
    if (!file.is_object() || file.value("skins", Json::array()).empty() ||
        file.value("animations", Json::array()).empty())
        return std::nullopt;
    const auto begin = glb.begin() + static_cast<ptrdiff_t>(binaryHeader + kChunkHeader);
    std::vector<char> binary(begin, begin + word(glb, binaryHeader));

    Json source = file["animations"][0];
    for (const Json& animation : file["animations"])
        if (animation.value("name", "") == walk)
            source = animation;
    float duration = 0.0f;
    for (const Json& sampler : source["samplers"])
        duration = std::max(duration,
                            file["accessors"][sampler["input"].get<size_t>()].value("max", Json{0.0f})[0].get<float>());
    const int root = rootJoint(file);
    // The arc takes the place of what moved the root.
    Json kept = Json::array();
    for (const Json& channel : source["channels"])
        if (channel["target"].value("node", -1) != root || channel["target"]["path"] == "scale")
            kept.push_back(channel);
    source["channels"] = kept;
    for (const Arc& arc : arcs) {
        std::vector<float> times, places, turns;
        for (uint32_t k = 0; k < kKeys; ++k) {
            const float part = static_cast<float>(k) / static_cast<float>(kKeys - 1),
                        angle = part * stride / arc.radius;
            times.push_back(part * duration);
            places.insert(places.end(),
                          {arc.turn * arc.radius * (1.0f - std::cos(angle)), 0.0f, arc.radius * std::sin(angle)});
            turns.insert(turns.end(), {0.0f, arc.turn * std::sin(0.5f * angle), 0.0f, std::cos(0.5f * angle)});
        }
        const size_t input = addAccessor(file, binary, times, "SCALAR", 1);
        Json clip = source;
        clip["name"] = arc.clip;
        const auto add = [&](const char* path, size_t output) {
            clip["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
            clip["channels"].push_back(
                {{"sampler", clip["samplers"].size() - 1}, {"target", {{"node", root}, {"path", path}}}});
        };
        add("translation", addAccessor(file, binary, places, "VEC3", 3));
        add("rotation", addAccessor(file, binary, turns, "VEC4", 4));
        file["animations"].push_back(clip);
    }
    pad(binary, 0);
    file["buffers"][0]["byteLength"] = binary.size();

    const std::string written = file.dump();
    std::vector<char> json(written.begin(), written.end()), result(glb.begin(), glb.begin() + kHeader);
    pad(json, ' ');
    const auto addChunk = [&](const std::vector<char>& chunk, const char* kind) {
        const auto size = static_cast<uint32_t>(chunk.size());
        const char* const from = reinterpret_cast<const char*>(&size);
        result.insert(result.end(), from, from + 4);
        result.insert(result.end(), kind, kind + 4);
        result.insert(result.end(), chunk.begin(), chunk.end());
    };
    constexpr char kBinary[] = {'B', 'I', 'N', '\0'};
    addChunk(json, "JSON");
    addChunk(binary, kBinary);
    const auto all = static_cast<uint32_t>(result.size());
    std::memcpy(result.data() + 8, &all, sizeof all);
    return result;
}

} // namespace crowd
