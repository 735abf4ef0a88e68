#include "cage/gltf/writer.h"

#include "cage/gltf/material_writer.h"
#include "cage/gltf/mesh_writer.h"
#include "cage/gltf/packer.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <new>
#include <set>
#include <span>
#include <utility>

namespace supple::cage {
namespace gltf {
namespace {

using Target = Packer::Target;

json matrixNumbers(const glm::mat4& matrix) {
    json list = json::array();
    for (int k = 0; k < 16; ++k) {
        list.push_back(static_cast<double>(matrix[k / 4][k % 4]));
    }
    return list;
}

/// A mesh without a skin reads as a skin of its own node alone (Skin).
bool isSkinned(const Character& character) {
    const Skin& skin = character.skin;
    return skin.joints.size() != 1 || skin.joints[0] != character.meshNode || skin.inverseBinds[0] != glm::mat4(1.0f);
}

/// glTF demands that the joints of a skin have a common root, and readers forgive its absence. Then the roots above
/// them, else none.
std::set<uint32_t> severalRoots(const Character& character) {
    std::set<uint32_t> roots;
    for (uint32_t node : character.skin.joints) {
        while (character.skeleton.nodes[node].parent != kNone) {
            node = character.skeleton.nodes[node].parent;
        }
        roots.insert(node);
    }
    if (roots.size() < 2) {
        roots.clear();
    }
    return roots;
}

json writeNode(const Node& from) {
    json node = json::object();
    if (!from.name.empty()) {
        node["name"] = from.name;
    }
    if (from.hasMatrix) {
        node["matrix"] = matrixNumbers(from.matrix);
        return node;
    }
    if (from.translation != glm::vec3(0.0f)) {
        node["translation"] = numbers(from.translation);
    }
    const glm::quat& q = from.rotation;
    if (q.x != 0.0f || q.y != 0.0f || q.z != 0.0f || q.w != 1.0f) {
        node["rotation"] = numbers(glm::vec4(q.x, q.y, q.z, q.w));
    }
    if (from.scale != glm::vec3(1.0f)) {
        node["scale"] = numbers(from.scale);
    }
    return node;
}

void writeNodes(const Character& character, bool skinned, json& root, Warnings& warnings) {
    const std::vector<Node>& from = character.skeleton.nodes;
    json nodes = json::array();
    for (const Node& node : from) {
        nodes.push_back(writeNode(node));
    }
    json top = json::array();
    json common = json::array();
    const std::set<uint32_t> gathered = skinned ? severalRoots(character) : std::set<uint32_t>();
    for (size_t i = 0; i < from.size(); ++i) {
        if (from[i].parent != kNone) {
            nodes[from[i].parent]["children"].push_back(i);
        } else if (gathered.count(static_cast<uint32_t>(i)) != 0) {
            common.push_back(i);
        } else {
            top.push_back(i);
        }
    }
    if (!common.empty()) {
        warn(warnings, "skin",
             counted(common.size(), "root", "roots") + " above its joints; a node is put above them all");
        top.push_back(nodes.size());
        nodes.push_back({{"children", std::move(common)}});
    }
    nodes[character.meshNode]["mesh"] = 0;
    if (skinned) {
        nodes[character.meshNode]["skin"] = 0;
    }
    root["nodes"] = std::move(nodes);
    root["scenes"] = json::array({json::object({{"nodes", std::move(top)}})});
    root["scene"] = 0;
}

json writeSkin(const Skin& skin, Packer& packer) {
    json written = {{"joints", skin.joints}};
    const bool identities = std::all_of(skin.inverseBinds.begin(), skin.inverseBinds.end(),
                                        [](const glm::mat4& matrix) { return matrix == glm::mat4(1.0f); });
    if (!identities) {
        const std::span<const float> values(&skin.inverseBinds[0][0][0], 16 * skin.inverseBinds.size());
        written["inverseBindMatrices"] = packer.addFloats("MAT4", values, Target::none);
    }
    return written;
}

class ClipWriter {
public:
    ClipWriter(Packer& packer, Warnings& warnings) : packer_(packer), warnings_(warnings) {}

    json write(const std::vector<Clip>& clips) {
        json animations = json::array();
        for (const Clip& clip : clips) {
            if (clip.channels.empty()) {
                warn(warnings_, "clip " + quoted(clip.name), "has no channels; left out");
                continue;
            }
            json channels = json::array();
            json samplers = json::array();
            for (const Channel& channel : clip.channels) {
                channels.push_back(
                    {{"sampler", samplers.size()}, {"target", {{"node", channel.node}, {"path", pathOf(channel)}}}});
                samplers.push_back(writeSampler(clip, channel));
            }
            animations.push_back({{"name", clip.name}, {"channels", channels}, {"samplers", samplers}});
        }
        return animations;
    }

private:
    static const char* pathOf(const Channel& channel) {
        switch (channel.path) {
        case ChannelPath::translation:
            return "translation";
        case ChannelPath::rotation:
            return "rotation";
        case ChannelPath::scale:
            return "scale";
        case ChannelPath::weights:
            break;
        }
        return "weights";
    }

    json writeSampler(const Clip& clip, const Channel& channel) {
        const auto [input, isNew] = inputs_.try_emplace(channel.times, 0);
        if (isNew) {
            input->second = packer_.addFloats("SCALAR", channel.times, Target::none, true);
        }
        const char* type = channel.path == ChannelPath::rotation  ? "VEC4"
                           : channel.path == ChannelPath::weights ? "SCALAR"
                                                                  : "VEC3";
        const char* interpolation = channel.interpolation == Interpolation::step          ? "STEP"
                                    : channel.interpolation == Interpolation::cubicSpline ? "CUBICSPLINE"
                                                                                          : "LINEAR";
        std::vector<float> values = channel.values;
        if (channel.path == ChannelPath::rotation && channel.interpolation == Interpolation::cubicSpline) {
            normalizeKeys(clip, values);
        }
        return {{"input", input->second},
                {"interpolation", interpolation},
                {"output", packer_.addFloats(type, values, Target::none)}};
    }

    /// glTF demands unit quaternions between a spline's tangents too; readers keep what a file has.
    void normalizeKeys(const Clip& clip, std::vector<float>& values) {
        constexpr double kTolerance = 1e-3;
        size_t repaired = 0;
        for (size_t k = 4; k + 8 <= values.size(); k += 12) {
            float* q = &values[k];
            const double length = std::sqrt(static_cast<double>(q[0]) * q[0] + static_cast<double>(q[1]) * q[1] +
                                            static_cast<double>(q[2]) * q[2] + static_cast<double>(q[3]) * q[3]);
            if (std::abs(length - 1.0) > kTolerance) {
                ++repaired;
                for (int c = 0; c < 4; ++c) {
                    q[c] = static_cast<float>(q[c] / length);
                }
            }
        }
        if (repaired > 0) {
            warn(warnings_, "clip " + quoted(clip.name),
                 counted(repaired, "key rotation", "key rotations") + " of splines normalised");
        }
    }

    Packer& packer_;
    Warnings& warnings_;
    std::map<std::vector<float>, size_t> inputs_; ///< channels share their key times
};

GlbFile toGlb(const Character& character) {
    GlbFile file;
    Packer packer;
    const bool skinned = isSkinned(character);

    json root;
    root["asset"] = {{"version", "2.0"}, {"generator", "Supple"}};
    if (!character.copyright.empty()) {
        root["asset"]["copyright"] = character.copyright;
    }
    root["extensionsUsed"] = json::array({"FB_ngon_encoding", "SUPPLE_mesh_cage"});
    writeNodes(character, skinned, root, file.warnings);
    json mesh = writeMesh(character, skinned, packer, file);
    const std::string& meshName = character.skeleton.nodes[character.meshNode].name;
    if (!meshName.empty()) {
        mesh["name"] = meshName;
    }
    root["meshes"] = json::array({std::move(mesh)});
    if (skinned) {
        root["skins"] = json::array({writeSkin(character.skin, packer)});
    }
    writeMaterials(character, packer, root, file.warnings);
    json animations = ClipWriter(packer, file.warnings).write(character.clips);
    if (!animations.empty()) {
        root["animations"] = std::move(animations);
    }
    file.bytes = std::move(packer).finish(std::move(root));
    return file;
}

} // namespace
} // namespace gltf

Result<GlbFile> writeGlb(const Character& character) {
    const auto failure = [&](ErrorCode code, const std::string& message) {
        return Error{code, oneLine(character.name + ": " + message)};
    };
    try {
        GlbFile file = gltf::toGlb(character);
        for (std::string& warning : file.warnings) {
            warning = oneLine(std::move(warning));
        }
        return file;
    } catch (const Refusal& refusal) {
        return failure(refusal.code, refusal.message);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, "GLB: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::asset, std::string("GLB: ") + error.what());
    }
}

} // namespace supple::cage
