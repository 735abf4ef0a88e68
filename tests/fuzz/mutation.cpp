#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

namespace supple::fuzz {
namespace {

using Json = nlohmann::json;

size_t below(Random& random, size_t count) {
    return count == 0 ? 0 : random() % count;
}

Json interestingNumber(Random& random, size_t indices) {
    switch (below(random, 12)) {
    case 0:
        return -1;
    case 1:
        return 0xFFFFFFFFu;
    case 2:
        return uint64_t{1} << 63;
    case 3:
        return 3e38;
    case 4:
        return 1e-40;
    case 5:
        return 0.5;
    case 6:
        return uint64_t{1} << (random() % 33);
    case 7:
        return static_cast<int>(5120 + below(random, 7)); // component types
    case 8:
        return static_cast<int>(below(random, 7)); // modes
    default:
        return below(random, indices + 2);
    }
}

const char* const kNames[] = {
    "POSITION",
    "NORMAL",
    "TANGENT",
    "TEXCOORD_0",
    "TEXCOORD_1",
    "COLOR_0",
    "JOINTS_0",
    "WEIGHTS_0",
    "JOINTS_1",
    "WEIGHTS_1",
    "_CAGE_VERTEX",
    "_TRIM_TILE",
    "SCALAR",
    "VEC2",
    "VEC3",
    "VEC4",
    "MAT4",
    "STEP",
    "LINEAR",
    "CUBICSPLINE",
    "translation",
    "rotation",
    "scale",
    "weights",
    "pointer",
    "MASK",
    "BLEND",
    "FB_ngon_encoding",
    "SUPPLE_mesh_cage",
    "EXT_mesh_polygon",
    "EXT_mesh_manifold",
    "EXT_mesh_primitive_edge_visibility",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_clearcoat",
    "SUPPLE_deformers",
    "drivers",
    "swing",
    "twist",
    "VRM",
    "VRMC_vrm",
    "VRMC_springBone",
    "clearcoatTexture",
    "mappings",
    "faceVertexCounts",
    "faceVertexIndices",
    "cageVertices",
    "creaseIndices",
    "creaseSharpnesses",
    "creaseSets",
    "creaseScalarIndices",
    "creaseScalars",
    "holeIndices",
    "ATTRIBUTES",
    "TRIANGLES",
    "INDICES",
    "OCTAHEDRAL",
    "../x",
    "a//./b",
    "data:,x",
    "\xE2\x80\xAE",
    "",
};

/// All values of the tree.
void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (value.is_structured()) {
        for (Json& part : value) {
            collect(part, all);
        }
    }
}

void changeMembers(Json& object, Random& random, std::vector<Json*>& all) {
    if (object.empty() || below(random, 3) == 0) {
        object[kNames[below(random, std::size(kNames))]] = *all[below(random, all.size())];
        return;
    }
    auto member = object.begin();
    std::advance(member, static_cast<std::ptrdiff_t>(below(random, object.size())));
    if (below(random, 2) == 0) {
        object.erase(member);
    } else {
        object[kNames[below(random, std::size(kNames))]] = Json(member.value());
    }
}

void changeItems(Json& array, Random& random, std::vector<Json*>& all) {
    const size_t at = below(random, array.size());
    switch (below(random, 4)) {
    case 0:
        if (!array.empty()) {
            array.erase(at);
        }
        break;
    case 1:
        for (size_t n = below(random, 20); n > 0 && !array.empty(); --n) {
            array.push_back(Json(array[at]));
        }
        break;
    case 2:
        array.push_back(Json(*all[below(random, all.size())]));
        break;
    default:
        std::shuffle(array.begin(), array.end(), random);
        break;
    }
}

void changeJson(Json& root, Random& random) {
    std::vector<Json*> all;
    collect(root, all);
    Json& value = *all[below(random, all.size())];
    if (below(random, 10) == 0) {
        value = Json(*all[below(random, all.size())]);
    } else if (value.is_object()) {
        changeMembers(value, random, all);
    } else if (value.is_array()) {
        changeItems(value, random, all);
    } else if (value.is_string()) {
        value = kNames[below(random, std::size(kNames))];
    } else {
        value = interestingNumber(random, 8);
    }
}

void changeNumbers(std::string& binary, Random& random) {
    static const float kFloats[] = {0.0f, -0.0f, 1.0f, -1.0f, 0.5f, 1e9f, 2e9f, 3e38f, 1e-40f, INFINITY, NAN};
    for (size_t n = 1 + below(random, 4); n > 0 && binary.size() >= 4; --n) {
        const size_t at = below(random, binary.size() / 4) * 4;
        if (below(random, 2) == 0) {
            std::memcpy(&binary[at], &kFloats[below(random, std::size(kFloats))], 4);
        } else {
            binary[at + below(random, 4)] = static_cast<char>(random());
        }
    }
}

uint32_t readU32(const std::string_view bytes, size_t at) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

void appendU32(std::string& bytes, size_t value) {
    const auto narrow = static_cast<uint32_t>(value);
    bytes.append(reinterpret_cast<const char*>(&narrow), 4);
}

std::string pack(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string glb = "glTF";
    appendU32(glb, 2);
    appendU32(glb, 20 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
    appendU32(glb, json.size());
    glb += "JSON" + json;
    if (!binary.empty()) {
        appendU32(glb, binary.size());
        glb += std::string("BIN\0", 4) + binary;
    }
    return glb;
}

} // namespace

std::vector<uint8_t> mutateGltf(const uint8_t* data, size_t size, Random& random) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    std::string_view text = bytes;
    std::string binary;
    const bool isGlb = bytes.starts_with("glTF") && size >= 20;
    if (isGlb) {
        const size_t length = std::min<size_t>(readU32(bytes, 12), size - 20);
        text = bytes.substr(20, length);
        binary = bytes.size() > 28 + length ? std::string(bytes.substr(28 + length)) : "";
    }
    Json root = Json::parse(text, nullptr, false);
    if (root.is_discarded()) {
        return {};
    }
    if (!binary.empty() && below(random, 4) == 0) {
        changeNumbers(binary, random);
    } else {
        for (size_t n = 1 + below(random, 3); n > 0; --n) {
            changeJson(root, random);
        }
    }
    const std::string changed = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::string packed = isGlb ? pack(changed, binary) : changed;
    return {packed.begin(), packed.end()};
}

std::vector<uint8_t> mutateLines(const uint8_t* data, size_t size, Random& random) {
    static const char* const kWords[] = {
        "v",  "vt", "vn",         "f",           "usemtl", "mtllib", "o",     "g",      "s",      "l",   "1",
        "2",  "3",  "-1",         "0",           "1/1",    "1//1",   "1/1/1", "1e9",    "3e38",   "nan", "#",
        "\\", "/",  "4294967296", "-9999999999", "\t",     "\r",     "\xFF",  "newmtl", "map_Kd", "Kd"};
    std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    for (size_t n = 1 + below(random, 3); n > 0; --n) {
        const size_t at = below(random, lines.size());
        if (lines.empty() || below(random, 4) == 0) {
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), kWords[below(random, std::size(kWords))]);
        } else if (below(random, 4) == 0) {
            lines.push_back(lines[at]);
        } else if (below(random, 6) == 0) {
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
        } else {
            lines[at] += std::string(" ") + kWords[below(random, std::size(kWords))];
        }
    }
    std::string text;
    for (const std::string& line : lines) {
        text += line + "\n";
    }
    return {text.begin(), text.end()};
}

std::vector<uint8_t> mutateBytes(const uint8_t* data, size_t size, Random& random) {
    std::vector<uint8_t> bytes(data, data + size);
    for (size_t n = 1 + below(random, 8); n > 0; --n) {
        const auto at = static_cast<std::ptrdiff_t>(below(random, bytes.size()));
        switch (below(random, 5)) {
        case 0:
            bytes.insert(bytes.begin() + at, static_cast<uint8_t>(random()));
            break;
        case 1:
            if (!bytes.empty()) {
                bytes.erase(bytes.begin() + at);
            }
            break;
        case 2:
            bytes.resize(static_cast<size_t>(at));
            break;
        default:
            if (!bytes.empty()) {
                bytes[static_cast<size_t>(at)] = static_cast<uint8_t>(random());
            }
            break;
        }
    }
    return bytes;
}

} // namespace supple::fuzz
