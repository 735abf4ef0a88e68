#include "wren_assemble.h"

#include "assemble.h"
#include "wren_palette.h"
#include "wren_textures.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace supple::creature::wren {

namespace {

float shade(double value) {
    return static_cast<float>(std::lround(std::clamp(value, 0.0, 1.0) * 65535)) / 65535.0f;
}

// Where a face without coordinates lies: seen along the axis it faces most.
Vec2 boxed(const Vec3& p, const Vec3& normal) {
    const Vec3 n{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    if (n.x >= n.y && n.x >= n.z) {
        return {normal.x > 0 ? -p.z : p.z, -p.y};
    }
    return n.y >= n.z ? Vec2{p.x, normal.y > 0 ? p.z : -p.z} : Vec2{normal.z > 0 ? p.x : -p.x, -p.y};
}

void addFaces(cage::Cage& cage, const Cage& piece, uint32_t base, uint32_t part) {
    for (const Face& face : piece.faces) {
        const Swatch look = swatch(face.part);
        const Vec3 normal = piece.normal(face);
        for (size_t i = 0; i < face.points.size(); ++i) {
            cage.faceVertices.push_back(base + static_cast<uint32_t>(face.points[i]));
            const Vec2 uv = face.uvs.empty() ? boxed(piece.position(face.points[i]), normal) : face.uvs[i];
            const Vec2 at = uv * look.density;
            cage.cornerUvs.push_back({rounded(at.x), rounded(at.y)});
            const Vec3 color = look.color * tint(face, piece.points[static_cast<size_t>(face.points[i])], uv);
            cage.cornerColors.push_back({shade(color.x), shade(color.y), shade(color.z), 1.0f});
        }
        cage.faceStarts.push_back(cage.cornerCount());
        cage.faceMaterials.push_back(look.material);
        cage.faceParts.push_back(part);
    }
    for (const auto& [edge, sharpness] : piece.creases) {
        cage.creases.push_back(
            {base + static_cast<uint32_t>(edge.first), base + static_cast<uint32_t>(edge.second), sharpness});
    }
}

void addTargets(cage::Morphs& morphs, const Piece& piece, uint32_t base) {
    for (const auto& [name, shaped] : piece.targets) {
        cage::MorphTarget target;
        target.name = name;
        for (size_t i = 0; i < piece.cage.points.size(); ++i) {
            const Vec3 by = shaped.points[i].position - piece.cage.points[i].position;
            if (glm::length(by) > 2e-5) {
                target.vertices.push_back(base + static_cast<uint32_t>(i));
                target.deltas.push_back(rounded(by));
            }
        }
        morphs.targets.push_back(target);
        morphs.weights.push_back(0);
    }
}

// Channels that say the same at every key need but two.
void thin(cage::Clip& clip) {
    for (cage::Channel& channel : clip.channels) {
        const size_t width = channel.values.size() / channel.times.size();
        const auto first = channel.values.begin();
        bool same = true;
        for (size_t i = width; i < channel.values.size(); ++i) {
            same = same && channel.values[i] == channel.values[i % width];
        }
        if (same && channel.times.size() > 2) {
            channel.values.assign(first, first + static_cast<std::ptrdiff_t>(width));
            channel.values.insert(channel.values.end(), channel.values.begin(),
                                  channel.values.begin() + static_cast<std::ptrdiff_t>(width));
            channel.times = {channel.times.front(), channel.times.back()};
        }
    }
}

// The weights of a piece's targets, as far as the clip knows them; the others rest.
void addShapes(cage::Clip& made, const Clip& clip, const Piece& piece, const cage::Part& part) {
    bool any = false;
    for (const auto& [name, shaped] : piece.targets) {
        any = any || clip.morphs.count(name);
    }
    if (!any) {
        return;
    }
    cage::Channel channel{part.node, cage::ChannelPath::weights, cage::Interpolation::linear, {}, {}, part.firstTarget};
    for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
        channel.times.push_back(rounded(static_cast<double>(frame) / clip.framesPerSecond));
        for (const auto& [name, shaped] : piece.targets) {
            const auto found = clip.morphs.find(name);
            channel.values.push_back(found == clip.morphs.end() ? 0.0f : rounded(found->second[frame]));
        }
    }
    made.channels.push_back(channel);
}

} // namespace

cage::Character assemble(const std::vector<Piece>& pieces, const Skeleton& skeleton, const std::vector<Clip>& clips) {
    cage::Character character;
    character.name = "wren";
    character.copyright = "The Supple authors, MIT";
    addSkeleton(character, skeleton);
    character.parts.clear();
    character.cage.faceStarts.push_back(0);
    for (const Piece& piece : pieces) {
        cage::Part part;
        part.name = piece.name;
        part.node = static_cast<uint32_t>(character.skeleton.nodes.size());
        part.firstFace = character.cage.faceCount();
        part.firstTarget = static_cast<uint32_t>(character.morphs.targets.size());
        part.targetCount = static_cast<uint32_t>(piece.targets.size());
        cage::Node node;
        node.name = piece.name;
        character.skeleton.nodes.push_back(node);
        const uint32_t base = character.cage.vertexCount();
        for (const Point& point : piece.cage.points) {
            character.cage.positions.push_back(rounded(point.position));
        }
        addFaces(character.cage, piece.cage, base, static_cast<uint32_t>(character.parts.size()));
        addWeights(character, weightsOf(piece.cage, skeleton));
        addTargets(character.morphs, piece, base);
        character.parts.push_back(part);
    }
    character.skeleton.parentsFirst.resize(character.skeleton.nodes.size());
    std::iota(character.skeleton.parentsFirst.begin(), character.skeleton.parentsFirst.end(), 0u);
    for (const Clip& clip : clips) {
        cage::Clip made = assembleClip(clip, skeleton);
        for (size_t i = 0; i < pieces.size(); ++i) {
            addShapes(made, clip, pieces[i], character.parts[i]);
        }
        thin(made);
        character.clips.push_back(made);
    }
    character.materials = materials();
    character.images = pictures();
    return character;
}

} // namespace supple::creature::wren
