#include "glb_writer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <utility>

namespace supple::creature {

namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kU8 = 5121;
constexpr int kU16 = 5123;

// To a fixed grid, so that the last bits of a maths library cannot show in the file. Adding zero drops minus zero.
float rounded(double value) {
    return static_cast<float>(std::round(value * 1e5) / 1e5 + 0.0);
}

class Writer {
public:
    int floats(const std::vector<float>& values, const char* type, int components, bool bounds, int target) {
        std::vector<uint8_t> bytes;
        for (float value : values) {
            const uint32_t bits = std::bit_cast<uint32_t>(value);
            for (int i = 0; i < 4; ++i) {
                bytes.push_back(static_cast<uint8_t>(bits >> (8 * i)));
            }
        }
        const size_t count = values.size() / static_cast<size_t>(components);
        Json accessor = {
            {"bufferView", view(bytes, target)}, {"componentType", kFloat}, {"count", count}, {"type", type}};
        if (bounds) {
            std::vector<double> low(static_cast<size_t>(components), 1e30);
            std::vector<double> high(static_cast<size_t>(components), -1e30);
            for (size_t i = 0; i < values.size(); ++i) {
                const size_t c = i % static_cast<size_t>(components);
                low[c] = std::min<double>(low[c], values[i]);
                high[c] = std::max<double>(high[c], values[i]);
            }
            accessor["min"] = low;
            accessor["max"] = high;
        }
        accessors.push_back(accessor);
        return static_cast<int>(accessors.size()) - 1;
    }

    int integers(const std::vector<uint16_t>& values, int component, const char* type, int components, bool normalized,
                 int target) {
        std::vector<uint8_t> bytes;
        for (uint16_t value : values) {
            bytes.push_back(static_cast<uint8_t>(value));
            if (component == kU16) {
                bytes.push_back(static_cast<uint8_t>(value >> 8));
            }
        }
        Json accessor = {{"bufferView", view(bytes, target)},
                         {"componentType", component},
                         {"count", values.size() / static_cast<size_t>(components)},
                         {"type", type}};
        if (normalized) {
            accessor["normalized"] = true;
        }
        accessors.push_back(accessor);
        return static_cast<int>(accessors.size()) - 1;
    }

    bool write(const std::string& path, Json document) {
        document["accessors"] = accessors;
        document["bufferViews"] = views;
        document["buffers"] = Json::array({{{"byteLength", binary.size()}}});
        std::string text = document.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<uint8_t> file;
        const auto word = [&](size_t value) {
            for (int i = 0; i < 4; ++i) {
                file.push_back(static_cast<uint8_t>(value >> (8 * i)));
            }
        };
        word(0x46546c67);
        word(2);
        word(12 + 8 + text.size() + 8 + binary.size());
        word(text.size());
        word(0x4e4f534a);
        file.insert(file.end(), text.begin(), text.end());
        word(binary.size());
        word(0x004e4942);
        file.insert(file.end(), binary.begin(), binary.end());
        std::ofstream out(path, std::ios::binary);
        out.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
        return static_cast<bool>(out);
    }

private:
    int view(const std::vector<uint8_t>& bytes, int target) {
        Json made = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (target != 0) {
            made["target"] = target;
        }
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        binary.resize((binary.size() + 3) / 4 * 4, 0);
        views.push_back(made);
        return static_cast<int>(views.size()) - 1;
    }

    Json accessors = Json::array();
    Json views = Json::array();
    std::vector<uint8_t> binary;
};

Json meshPrimitive(Writer& writer, const Cage& cage, const std::vector<Influences>& influences,
                   const std::vector<Vec3>& colours, const Atlas& atlas) {
    // A point is written once for each chart it is in; its copies differ in nothing but the texture coordinate.
    std::map<std::pair<int, int>, int> written;
    std::vector<float> positions;
    std::vector<float> coordinates;
    std::vector<float> weights;
    std::vector<uint16_t> joints;
    std::vector<uint16_t> tints;
    std::vector<uint16_t> indices;
    const auto vertex = [&](size_t q, size_t corner) {
        const int point = cage.quads[q].points[corner];
        const auto [it, fresh] = written.insert({{point, atlas.chart[q]}, static_cast<int>(positions.size() / 3)});
        if (fresh) {
            const size_t p = static_cast<size_t>(point);
            for (int i = 0; i < 3; ++i) {
                positions.push_back(rounded(cage.points[p].position[i]));
                tints.push_back(static_cast<uint16_t>(std::lround(std::clamp(colours[p][i], 0.0, 1.0) * 65535)));
            }
            tints.push_back(65535);
            coordinates.push_back(rounded(atlas.corners[q][corner].x));
            coordinates.push_back(rounded(atlas.corners[q][corner].y));
            for (size_t i = 0; i < 4; ++i) {
                joints.push_back(static_cast<uint16_t>(influences[p].joints[i]));
                weights.push_back(influences[p].weights[i]);
            }
        }
        return static_cast<uint16_t>(it->second);
    };
    // FB_ngon_encoding: the triangles of a polygon share their first vertex, and the next polygon begins with another.
    int previous = -1;
    for (size_t q = 0; q < cage.quads.size(); ++q) {
        std::array<uint16_t, 4> corner{};
        for (size_t i = 0; i < 4; ++i) {
            corner[i] = vertex(q, i);
        }
        const size_t start = corner[0] == previous ? 1 : 0;
        previous = corner[start];
        for (size_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
            indices.push_back(corner[(start + i) % 4]);
        }
    }
    constexpr int kVertices = 34962;
    constexpr int kIndices = 34963;
    Json attributes;
    attributes["POSITION"] = writer.floats(positions, "VEC3", 3, true, kVertices);
    attributes["TEXCOORD_0"] = writer.floats(coordinates, "VEC2", 2, false, kVertices);
    attributes["COLOR_0"] = writer.integers(tints, kU16, "VEC4", 4, true, kVertices);
    attributes["JOINTS_0"] = writer.integers(joints, kU8, "VEC4", 4, false, kVertices);
    attributes["WEIGHTS_0"] = writer.floats(weights, "VEC4", 4, false, kVertices);
    return {{"attributes", attributes},
            {"indices", writer.integers(indices, kU16, "SCALAR", 1, false, kIndices)},
            {"material", 0},
            {"mode", 4},
            {"extensions", {{"FB_ngon_encoding", Json::object()}}}};
}

Json animation(Writer& writer, const Skeleton& skeleton, const Clip& clip) {
    std::vector<float> times;
    for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
        times.push_back(rounded(static_cast<double>(frame) / clip.framesPerSecond));
    }
    const int input = writer.floats(times, "SCALAR", 1, true, 0);
    Json channels = Json::array();
    Json samplers = Json::array();
    const auto add = [&](size_t joint, const char* path, const std::vector<float>& values, const char* type,
                         int components) {
        samplers.push_back({{"input", input},
                            {"interpolation", "LINEAR"},
                            {"output", writer.floats(values, type, components, false, 0)}});
        channels.push_back({{"sampler", samplers.size() - 1}, {"target", {{"node", joint}, {"path", path}}}});
    };
    for (size_t joint = 0; joint < skeleton.joints.size(); ++joint) {
        std::vector<float> rotations;
        std::vector<float> translations;
        bool turns = false;
        bool moves = false;
        Quat before(1, 0, 0, 0);
        for (const Pose& pose : clip.frames) {
            Quat rotation = glm::normalize(pose.rotations[joint]);
            if (glm::dot(rotation, before) < 0) {
                rotation = -rotation;
            }
            before = rotation;
            const float parts[] = {rounded(rotation.x), rounded(rotation.y), rounded(rotation.z), rounded(rotation.w)};
            rotations.insert(rotations.end(), parts, parts + 4);
            turns = turns || parts[0] != 0 || parts[1] != 0 || parts[2] != 0;
            const Vec3 at = skeleton.offset(static_cast<int>(joint)) + pose.moves[joint];
            for (int i = 0; i < 3; ++i) {
                translations.push_back(rounded(at[i]));
                moves = moves || pose.moves[joint][i] != 0;
            }
        }
        if (turns) {
            add(joint, "rotation", rotations, "VEC4", 4);
        }
        if (moves) {
            add(joint, "translation", translations, "VEC3", 3);
        }
    }
    return {{"name", clip.name}, {"channels", channels}, {"samplers", samplers}};
}

} // namespace

bool writeGlb(const std::string& path, const Cage& cage, const Skeleton& skeleton,
              const std::vector<Influences>& influences, const std::vector<Vec3>& colours, const Atlas& atlas,
              const std::vector<Clip>& clips) {
    Writer writer;
    Json document;
    document["asset"] = {
        {"version", "2.0"}, {"generator", "supple_creature"}, {"copyright", "The Supple authors, MIT"}};
    document["extensionsUsed"] = Json::array({"FB_ngon_encoding"});
    document["materials"] = Json::array(
        {{{"name", "skin"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {1.0, 1.0, 1.0, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}}}}});
    document["meshes"] = Json::array(
        {{{"name", "pip"}, {"primitives", Json::array({meshPrimitive(writer, cage, influences, colours, atlas)})}}});

    Json nodes = Json::array();
    Json joints = Json::array();
    std::vector<float> inverses;
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint& joint = skeleton.joints[j];
        const Vec3 offset = skeleton.offset(static_cast<int>(j));
        Json node = {{"name", joint.name}, {"translation", {rounded(offset.x), rounded(offset.y), rounded(offset.z)}}};
        Json children = Json::array();
        for (size_t k = 0; k < skeleton.joints.size(); ++k) {
            if (skeleton.joints[k].parent == static_cast<int>(j)) {
                children.push_back(k);
            }
        }
        if (!children.empty()) {
            node["children"] = children;
        }
        nodes.push_back(node);
        joints.push_back(j);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                inverses.push_back(column == 3 && row < 3 ? rounded(-joint.rest[row]) : (column == row ? 1.0f : 0.0f));
            }
        }
    }
    const size_t meshNode = nodes.size();
    nodes.push_back({{"name", "pip"}, {"mesh", 0}, {"skin", 0}});
    document["nodes"] = nodes;
    document["skins"] = Json::array({{{"name", "pip"},
                                      {"joints", joints},
                                      {"skeleton", 0},
                                      {"inverseBindMatrices", writer.floats(inverses, "MAT4", 16, false, 0)}}});
    document["scenes"] = Json::array({{{"name", "pip"}, {"nodes", {size_t{0}, meshNode}}}});
    document["scene"] = 0;
    Json animations = Json::array();
    for (const Clip& clip : clips) {
        animations.push_back(animation(writer, skeleton, clip));
    }
    document["animations"] = animations;
    return writer.write(path, document);
}

} // namespace supple::creature
