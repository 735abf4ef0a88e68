// Samples with springs: their files, with what VRM says of springs put in.
#pragma once

#include "tests/support/sample_assets.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <span>
#include <string>
#include <vector>

namespace supple::test {

/// The bytes of a GLB whose JSON gets these extensions; it must have none.
inline std::vector<std::byte> withExtensions(std::span<const std::byte> bytes, const std::string& extensions) {
    const std::string glb(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr size_t kHeader = 12, kChunk = 8;
    uint32_t length = 0;
    std::memcpy(&length, glb.data() + kHeader, sizeof length);
    std::string json = glb.substr(kHeader + kChunk, length);
    json.insert(json.rfind('}'), ",\"extensions\":{" + extensions + "}");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string made = glb.substr(0, kHeader + kChunk) + json + glb.substr(kHeader + kChunk + length);
    const auto put = [&](size_t at, size_t value) {
        const auto word = static_cast<uint32_t>(value);
        std::memcpy(made.data() + at, &word, sizeof word);
    };
    put(8, made.size());
    put(kHeader, json.size());
    const auto all = std::as_bytes(std::span(made));
    return {all.begin(), all.end()};
}
/// The same of a file.
inline std::vector<std::byte> withExtensions(const std::string& path, const std::string& extensions) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file.good()) << path;
    const std::string glb((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    return withExtensions(std::as_bytes(std::span(glb)), extensions);
}

/// Wren with a ponytail and a scarf that swing, against her head and chest: VRM 1.0.
inline const std::string kWrenSprings = R"("VRMC_springBone":{
    "colliders":[{"node":5,"shape":{"sphere":{"offset":[0,0.15,-0.02],"radius":0.15}}},
                 {"node":3,"shape":{"capsule":{"offset":[0,-0.1,-0.02],"radius":0.11,"tail":[0,0.15,-0.03]}}},
                 {"node":14,"shape":{"capsule":{"radius":0.05,"tail":[0.16,-0.16,0]}}},
                 {"node":0,"shape":{"sphere":{}},"extensions":{"VRMC_springBone_extended_collider":{"shape":{"plane":{"offset":[0,0.9,0],"normal":[0,1,0]}}}}},
                 {"node":5,"shape":{"sphere":{}},"extensions":{"VRMC_springBone_extended_collider":{"shape":{"sphere":{"offset":[0,0.15,-0.1],"radius":0.6,"inside":true}}}}}],
    "colliderGroups":[{"colliders":[0,1,4]},{"colliders":[1,2,3]}],
    "springs":[{"name":"ponytail","colliderGroups":[0],"joints":[
                   {"node":6,"stiffness":0.6,"gravityPower":0.3,"dragForce":0.2,"hitRadius":0.03},{"node":7,"stiffness":0.4,"gravityPower":0.3,"dragForce":0.2,"hitRadius":0.03},{"node":8}]},
               {"name":"scarf","colliderGroups":[1],"center":0,"joints":[
                   {"node":9,"stiffness":0.5,"gravityPower":0.5,"dragForce":0.3,"hitRadius":0.02},{"node":10,"stiffness":0.3,"gravityPower":0.5,"dragForce":0.3,"hitRadius":0.02},{"node":11}]}]})";
/// Pip with ears and a tail: VRM 0.x.
inline const std::string kPipSprings = R"("VRM":{"secondaryAnimation":{
    "colliderGroups":[{"node":1,"colliders":[{"offset":{"x":0,"y":0,"z":0},"radius":0.15}]}],
    "boneGroups":[{"comment":"tail","stiffiness":0.8,"gravityPower":0.2,"gravityDir":{"x":0,"y":-1,"z":0},"dragForce":0.3,"center":-1,"hitRadius":0.03,"bones":[56],"colliderGroups":[0]},
                  {"comment":"ears","stiffiness":1.5,"gravityPower":0,"dragForce":0.4,"center":-1,"hitRadius":0.02,"bones":[11,35],"colliderGroups":[]}]}})";

} // namespace supple::test
