#include "assemble.h"

#include "cage/materials.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace supple::creature {

// Adding zero drops minus zero.
float rounded(double value) {
    return static_cast<float>(std::round(value * 1e5) / 1e5 + 0.0);
}

glm::vec3 rounded(const Vec3& v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

namespace {

float color16(double value) {
    return static_cast<float>(std::lround(std::clamp(value, 0.0, 1.0) * 65535)) / 65535.0f;
}

cage::Cage assembleCage(const Cage& model, const std::vector<Vec3>& colors, const Atlas& atlas) {
    cage::Cage cage;
    for (const Point& point : model.points) {
        cage.positions.push_back(rounded(point.position));
    }
    cage.faceStarts.push_back(0);
    for (size_t f = 0; f < model.faces.size(); ++f) {
        const std::vector<int>& points = model.faces[f].points;
        for (size_t i = 0; i < points.size(); ++i) {
            const Vec3& c = colors[static_cast<size_t>(points[i])];
            const Vec2& uv = atlas.corners[f][i];
            cage.faceVertices.push_back(static_cast<uint32_t>(points[i]));
            cage.cornerUvs.push_back({rounded(uv.x), rounded(uv.y)});
            cage.cornerColors.push_back({color16(c.x), color16(c.y), color16(c.z), 1.0f});
        }
        cage.faceStarts.push_back(cage.cornerCount());
        cage.faceMaterials.push_back(0);
    }
    for (const auto& [edge, sharpness] : model.creases) {
        cage.creases.push_back({static_cast<uint32_t>(edge.first), static_cast<uint32_t>(edge.second), sharpness});
    }
    return cage;
}

} // namespace

// Keys of what moves at all.
cage::Clip assembleClip(const Clip& clip, const Skeleton& skeleton) {
    cage::Clip made;
    made.name = clip.name;
    std::vector<float> times;
    for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
        times.push_back(rounded(static_cast<double>(frame) / clip.framesPerSecond));
    }
    made.duration = times.back();
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
            for (const double part : {rotation.x, rotation.y, rotation.z, rotation.w}) {
                rotations.push_back(rounded(part));
            }
            const float* xyz = rotations.data() + rotations.size() - 4;
            turns = turns || xyz[0] != 0 || xyz[1] != 0 || xyz[2] != 0;
            const glm::vec3 at = rounded(skeleton.offset(static_cast<int>(joint)) + pose.moves[joint]);
            translations.insert(translations.end(), {at.x, at.y, at.z});
            moves = moves || pose.moves[joint] != Vec3(0);
        }
        const auto add = [&](cage::ChannelPath path, const std::vector<float>& values) {
            made.channels.push_back({static_cast<uint32_t>(joint), path, cage::Interpolation::linear, times, values});
        };
        if (turns) {
            add(cage::ChannelPath::rotation, rotations);
        }
        if (moves) {
            add(cage::ChannelPath::translation, translations);
        }
    }
    return made;
}

void addSkeleton(cage::Character& character, const Skeleton& skeleton) {
    for (size_t j = 0; j < skeleton.joints.size(); ++j) {
        const Joint& joint = skeleton.joints[j];
        cage::Node node;
        node.name = joint.name;
        node.parent = joint.parent < 0 ? cage::kNone : static_cast<uint32_t>(joint.parent);
        node.translation = rounded(skeleton.offset(static_cast<int>(j)));
        character.skeleton.nodes.push_back(node);
        character.skin.joints.push_back(static_cast<uint32_t>(j));
        glm::mat4 inverse(1.0f);
        inverse[3] = glm::vec4(rounded(-joint.rest), 1.0f);
        character.skin.inverseBinds.push_back(inverse);
    }
}

void addWeights(cage::Character& character, const std::vector<Influences>& influences) {
    if (character.weights.starts.empty()) {
        character.weights.starts.push_back(0);
    }
    for (const Influences& point : influences) {
        for (size_t i = 0; i < point.joints.size() && point.weights[i] > 0; ++i) {
            character.weights.influences.push_back({static_cast<uint32_t>(point.joints[i]), point.weights[i]});
        }
        character.weights.starts.push_back(static_cast<uint32_t>(character.weights.influences.size()));
    }
}

cage::Character assemble(const Cage& model, const Skeleton& skeleton, const std::vector<Influences>& influences,
                         const std::vector<Vec3>& colors, const Atlas& atlas, const std::vector<Clip>& clips) {
    cage::Character character;
    character.name = "pip";
    character.copyright = "The Supple authors, MIT";
    character.cage = assembleCage(model, colors, atlas);
    addSkeleton(character, skeleton);
    character.parts[0].node = static_cast<uint32_t>(character.skeleton.nodes.size());
    cage::Node mesh;
    mesh.name = character.parts[0].name = "pip";
    character.skeleton.nodes.push_back(mesh);
    character.skeleton.parentsFirst.resize(character.skeleton.nodes.size());
    std::iota(character.skeleton.parentsFirst.begin(), character.skeleton.parentsFirst.end(), 0u);
    addWeights(character, influences);
    for (const Clip& clip : clips) {
        character.clips.push_back(assembleClip(clip, skeleton));
    }
    character.materials.push_back(cage::namedMaterial("skin"));
    return character;
}

} // namespace supple::creature
