#include "tools/gltf/writer.h"

#include "cage/corner_normals.h"
#include "cage/message.h"
#include "cage/parts.h"
#include "cage/refusal.h"
#include "tools/gltf/driver_writer.h"
#include "tools/gltf/material_writer.h"
#include "tools/gltf/mesh_writer.h"
#include "tools/gltf/packer.h"
#include "tools/gltf/part_weights.h"
#include "tools/gltf/smoothing_writer.h"
#include "tools/gltf/soft_writer.h"
#include "tools/gltf/spring_writer.h"
#include "tools/gltf/still_mesh_writer.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <new>
#include <numeric>
#include <optional>
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

/// The skins that the parts have, each once: places in the palette.
struct Skins {
    std::vector<std::vector<uint32_t>> joints;
    std::vector<std::optional<size_t>> ofPart; ///< none: the part follows its own node, in whose space it is given

    /// Only a single mesh reads as it was: others are taken to the bind pose.
    static bool followsItsNode(const Character& character, const Part& part, uint32_t joint) {
        return character.parts.size() == 1 && character.skin.joints[joint] == part.node &&
               character.skin.inverseBinds[joint] == glm::mat4(1.0f);
    }

    explicit Skins(const Character& character) {
        std::map<std::vector<uint32_t>, size_t> known;
        for (const Part& part : character.parts) {
            std::vector<uint32_t> own = part.joints;
            if (own.empty()) {
                own.resize(character.skin.joints.size());
                std::iota(own.begin(), own.end(), 0u);
            }
            if (own.size() == 1 && followsItsNode(character, part, own[0])) {
                ofPart.emplace_back();
                continue;
            }
            const auto [found, isNew] = known.try_emplace(own, joints.size());
            if (isNew) {
                joints.push_back(std::move(own));
            }
            ofPart.push_back(found->second);
        }
    }
};

/// glTF demands that the joints of a skin have a common root, and readers forgive its absence. Then the roots above
/// them, else none.
std::set<uint32_t> severalRoots(const Character& character, const Skins& skins) {
    std::set<uint32_t> gathered;
    for (const std::vector<uint32_t>& joints : skins.joints) {
        std::set<uint32_t> roots;
        for (const uint32_t joint : joints) {
            uint32_t node = character.skin.joints[joint];
            while (character.skeleton.nodes[node].parent != kNone) {
                node = character.skeleton.nodes[node].parent;
            }
            roots.insert(node);
        }
        if (roots.size() > 1) {
            gathered.insert(roots.begin(), roots.end());
        }
    }
    return gathered;
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

void writeNodes(const Character& character, const Skins& skins, json& root, Warnings& warnings) {
    const std::vector<Node>& from = character.skeleton.nodes;
    json nodes = json::array();
    for (const Node& node : from) {
        nodes.push_back(writeNode(node));
    }
    json top = json::array();
    json common = json::array();
    const std::set<uint32_t> gathered = severalRoots(character, skins);
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
    for (size_t p = 0; p < character.parts.size(); ++p) {
        nodes[character.parts[p].node]["mesh"] = p;
        if (skins.ofPart[p]) {
            nodes[character.parts[p].node]["skin"] = *skins.ofPart[p];
        }
    }
    root["nodes"] = std::move(nodes);
    root["scenes"] = json::array({json::object({{"nodes", std::move(top)}})});
    root["scene"] = 0;
}

json writeSkin(const Skin& palette, std::span<const uint32_t> joints, Packer& packer) {
    std::vector<uint32_t> nodes;
    std::vector<glm::mat4> binds;
    for (const uint32_t joint : joints) {
        nodes.push_back(palette.joints[joint]);
        binds.push_back(palette.inverseBinds[joint]);
    }
    json written = {{"joints", nodes}};
    if (std::any_of(binds.begin(), binds.end(), [](const glm::mat4& m) { return m != glm::mat4(1.0f); })) {
        const std::span<const float> values(&binds[0][0][0], 16 * binds.size());
        written["inverseBindMatrices"] = packer.addFloats("MAT4", values, Target::none);
    }
    return written;
}

class ClipWriter {
public:
    ClipWriter(const Character& character, Packer& packer, Warnings& warnings)
        : parts_(character.parts), restWeights_(character.morphs.weights), packer_(packer), warnings_(warnings) {}

    json write(const std::vector<Clip>& clips) {
        json animations = json::array();
        for (const Clip& clip : clips) {
            if (clip.channels.empty()) {
                warn(warnings_, "clip " + quoted(clip.name), "has no channels; left out");
                continue;
            }
            json channels = json::array();
            json samplers = json::array();
            for (const Channel& channel : channelsOf(clip)) {
                for (const uint32_t node : nodesOf(channel)) {
                    channels.push_back(
                        {{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", pathOf(channel)}}}});
                }
                samplers.push_back(writeSampler(clip, channel));
            }
            json curves = json::array();
            for (const SharpnessCurve& curve : clip.sharpness) {
                curves.push_back({{"set", curve.set}, {"sampler", samplers.size()}});
                samplers.push_back(writeSampler(clip, curve.keys));
            }
            animations.push_back({{"name", clip.name}, {"channels", channels}, {"samplers", samplers}});
            if (!curves.empty()) {
                animations.back()["extras"]["sharpness"] = std::move(curves);
            }
            for (const Marker& marker : clip.markers) {
                animations.back()["extras"]["markers"].push_back({{"name", marker.name}, {"time", marker.time}});
            }
        }
        return animations;
    }

private:
    /// As glTF has them: one for the weights of each part that has targets of its own. In their order.
    [[nodiscard]] std::vector<Channel> channelsOf(const Clip& clip) const {
        std::vector<Channel> channels;
        std::set<uint32_t> written;
        for (const Channel& channel : clip.channels) {
            if (channel.path != ChannelPath::weights) {
                channels.push_back(channel);
                continue;
            }
            for (const Part& part : parts_) {
                if (setsWeightsOf(channel, part) && written.insert(part.firstTarget).second) {
                    channels.push_back(*partWeights(clip, part, restWeights_));
                }
            }
        }
        return channels;
    }

    /// Those whose property the channel moves: parts may share morph targets.
    [[nodiscard]] std::vector<uint32_t> nodesOf(const Channel& channel) const {
        std::vector<uint32_t> nodes;
        for (const Part& part : parts_) {
            if (channel.path == ChannelPath::weights && part.targetCount > 0 &&
                part.firstTarget == channel.firstTarget) {
                nodes.push_back(part.node);
            }
        }
        return channel.path == ChannelPath::weights ? nodes : std::vector<uint32_t>{channel.node};
    }

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

    const std::vector<Part>& parts_;
    std::span<const float> restWeights_;
    Packer& packer_;
    Warnings& warnings_;
    std::map<std::vector<float>, size_t> inputs_; ///< channels share their key times
};

void reportFeatures(const Cage& cage, Warnings& warnings) {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    std::set<uint32_t> vertices;
    for (uint32_t f = 0;
         f < cage.faceCount() && !(cage.creases.empty() && cage.sharpVertices.empty() && cage.creaseScalars.empty());
         ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const uint32_t next = c + 1 < cage.faceStarts[f + 1] ? c + 1 : cage.faceStarts[f];
            edges.insert(std::minmax(cage.faceVertices[c], cage.faceVertices[next]));
            vertices.insert(cage.faceVertices[c]);
        }
    }
    const auto strays = static_cast<size_t>(
        std::count_if(cage.creases.begin(), cage.creases.end(),
                      [&](const Crease& crease) { return edges.count(std::minmax(crease.a, crease.b)) == 0; }) +
        std::count_if(cage.sharpVertices.begin(), cage.sharpVertices.end(),
                      [&](const SharpVertex& sharp) { return vertices.count(sharp.vertex) == 0; }));
    if (strays > 0) {
        warn(warnings, "creases",
             counted(strays, "crease or sharp vertex is", "creases or sharp vertices are") +
                 " not on a face of the cage; left out");
    }
    const auto strayScalars = static_cast<size_t>(
        std::count_if(cage.creaseScalars.begin(), cage.creaseScalars.end(), [&](const CreaseScalar& scalar) {
            return edges.count(std::minmax(scalar.vertex, scalar.toward)) == 0;
        }));
    if (strayScalars > 0) {
        warn(warnings, "creases",
             counted(strayScalars, "crease scalar is", "crease scalars are") + " not on a face of the cage; left out");
    }
}

/// One a part. Normals are those of the whole, so that sewn parts look as one.
json writeMeshes(const Character& character, const Skins& skins, Packer& packer, GlbFile& file) {
    const std::vector<glm::vec3> normals = cornerNormals(character.cage);
    json meshes = json::array();
    for (size_t p = 0; p < character.parts.size(); ++p) {
        const Character part = takePart(character, p);
        const uint32_t first = character.cage.faceStarts[character.parts[p].firstFace];
        json mesh = writeMesh(part, skins.ofPart[p].has_value(),
                              std::span(normals).subspan(first, part.cage.cornerCount()), packer, file);
        if (!part.parts[0].name.empty()) {
            mesh["name"] = part.parts[0].name;
        }
        if (const auto& skinning = part.parts[0].skinning) {
            mesh["extensions"]["SUPPLE_deformers"]["skinning"] = skinningModeName(*skinning);
        }
        if (saysSmoothing(part)) {
            mesh["extensions"]["SUPPLE_deformers"]["smoothing"] = writeSmoothing(part);
        }
        if (!part.drivers.empty()) {
            mesh["extensions"]["SUPPLE_deformers"]["drivers"] = writeDrivers(part.drivers, packer);
        }
        if (!part.jiggles.empty()) {
            mesh["extensions"]["SUPPLE_deformers"]["jiggle"] = writeJiggles(part.jiggles);
        }
        if (!part.cloths.empty()) {
            mesh["extensions"]["SUPPLE_deformers"]["cloth"] = writeCloths(part.cloths);
        }
        meshes.push_back(std::move(mesh));
    }
    reportFeatures(character.cage, file.warnings);
    return meshes;
}

json newRoot(const Character& character) {
    json root;
    root["asset"] = {{"version", "2.0"}, {"generator", "Supple"}};
    if (!character.copyright.empty()) {
        root["asset"]["copyright"] = character.copyright;
    }
    return root;
}

GlbFile toGlb(const Character& character) {
    if (character.parts.empty() || character.cage.faceCount() == 0) {
        refuse("GLB", "there are no faces to write");
    }
    GlbFile file;
    Packer packer;
    const Skins skins(character);

    json root = newRoot(character);
    root["extensionsUsed"] = json::array({"FB_ngon_encoding", "SUPPLE_mesh_cage"});
    if (std::any_of(character.parts.begin(), character.parts.end(),
                    [](const Part& part) { return part.skinning || part.smoothing; }) ||
        !character.weights.mushMask.empty() || !character.drivers.empty() || !character.jiggles.empty() ||
        !character.cloths.empty()) {
        root["extensionsUsed"].push_back("SUPPLE_deformers");
    }
    writeNodes(character, skins, root, file.warnings);
    writeSpringBones(character, root);
    root["meshes"] = writeMeshes(character, skins, packer, file);
    for (const std::vector<uint32_t>& joints : skins.joints) {
        root["skins"].push_back(writeSkin(character.skin, joints, packer));
    }
    writeMaterials(character.materials, character.images, packer, root, file.warnings);
    json animations = ClipWriter(character, packer, file.warnings).write(character.clips);
    if (!animations.empty()) {
        root["animations"] = std::move(animations);
    }
    file.bytes = std::move(packer).finish(std::move(root));
    return file;
}

/// Faces of a baked mesh are not those of the cage, which such a trim lies on.
std::vector<Material> withoutFaceTrims(std::vector<Material> materials, Warnings& warnings) {
    for (size_t m = 0; m < materials.size(); ++m) {
        if (materials[m].trim && materials[m].trim->domain == TrimDomain::face) {
            warn(warnings, at("material", m), "its trim lies on faces of the cage; left out");
            materials[m].trim.reset();
        }
    }
    return materials;
}

GlbFile toGlb(const Character& character, std::span<const StillMesh> meshes) {
    GlbFile file;
    Packer packer;
    json root = newRoot(character);
    json scene = json::array();
    for (const StillMesh& mesh : meshes) {
        json node = {{"mesh", scene.size()}};
        if (!mesh.name.empty()) {
            node["name"] = mesh.name;
        }
        scene.push_back(scene.size());
        root["nodes"].push_back(std::move(node));
        root["meshes"].push_back(writeStillMesh(mesh, character, packer, file));
    }
    if (scene.empty()) {
        refuse("GLB", "there are no faces to write");
    }
    root["scenes"] = json::array({json::object({{"nodes", std::move(scene)}})});
    root["scene"] = 0;
    writeMaterials(withoutFaceTrims(character.materials, file.warnings), character.images, packer, root, file.warnings);
    file.bytes = std::move(packer).finish(std::move(root));
    return file;
}

/// What `write` has written, or why it has not.
template <class Write>
Result<GlbFile> guarded(const Character& character, Write&& write) {
    const auto failure = [&](ErrorCode code, const std::string& message) {
        return Error{code, oneLine(character.name + ": " + message)};
    };
    try {
        GlbFile file = write();
        for (std::string& warning : file.warnings) {
            warning = oneLine(std::move(warning));
        }
        return file;
    } catch (const Refusal& refusal) {
        return asError(refusal, character.name);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, "GLB: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::asset, std::string("GLB: ") + error.what());
    }
}

} // namespace
} // namespace gltf

Result<GlbFile> writeGlb(const Character& character) {
    return gltf::guarded(character, [&] { return gltf::toGlb(character); });
}

Result<GlbFile> writeGlb(const Character& character, std::span<const StillMesh> meshes) {
    return gltf::guarded(character, [&] { return gltf::toGlb(character, meshes); });
}

} // namespace supple::cage
