#include "cage/parts.h"

#include "cage/corner_normals.h"
#include "cage/limits.h"
#include "cage/piece.h"
#include "cage/sharp_features.h"
#include "cage/triangulation.h"
#include "cage/vertex_weights.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>

namespace supple::cage {
namespace {

template <class T>
void appendTo(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

/// An attribute that some parts lack: where others have it, they get `missing`.
template <class T>
void appendPadded(std::vector<T>& all, size_t before, const std::vector<T>& more, size_t count, const T& missing) {
    if (all.empty() && more.empty()) {
        return;
    }
    all.resize(before, missing);
    appendTo(all, more);
    all.resize(before + count, missing);
}

/// What the others have to say of normals and triangles, if one part says it.
struct Shading {
    bool normals = false;
    bool triangles = false;
};

/// A part without normals of its own is then smoothed as a cage is.
void appendShading(const Cage& from, Shading shading, Cage& cage) {
    if (shading.normals) {
        appendTo(cage.cornerNormals, from.cornerNormals.empty() ? cornerNormals(from) : from.cornerNormals);
    }
    if (shading.triangles) {
        for (const uint32_t corner : triangulate(from)) {
            cage.faceTriangles.push_back(cage.cornerCount() + corner);
        }
    }
}

/// Parts may have creases of one set.
void appendCreases(const Cage& from, uint32_t firstVertex, Cage& cage) {
    std::vector<uint32_t> sets;
    for (const std::string& name : from.creaseSets) {
        sets.push_back(creaseSetOf(name, cage));
    }
    for (const Crease& crease : from.creases) {
        const uint32_t set = crease.set != kNone ? sets[crease.set] : kNone;
        cage.creases.push_back({firstVertex + crease.a, firstVertex + crease.b, crease.sharpness, set});
    }
}

/// Leaves out the sets that are too many; their creases keep what sharpness they have.
void boundCreaseSets(Character& character) {
    Cage& cage = character.cage;
    if (cage.creaseSets.size() <= kMaxCreaseSets) {
        return;
    }
    warn(character.warnings, "crease sets",
         "the character has more than " + std::to_string(kMaxCreaseSets) + "; left out from " +
             cage::quoted(cage.creaseSets[kMaxCreaseSets]) + " on");
    cage.creaseSets.resize(kMaxCreaseSets);
    for (Crease& crease : cage.creases) {
        crease.set = crease.set < kMaxCreaseSets ? crease.set : kNone;
    }
}

void appendCage(const Cage& from, uint32_t sourceVertices, Cage& cage) {
    const uint32_t vertices = cage.vertexCount(), faces = cage.faceCount(), corners = cage.cornerCount();
    const uint32_t moreFaces = from.faceCount(), moreCorners = from.cornerCount();
    appendPadded(cage.cornerUvs, corners, from.cornerUvs, moreCorners, glm::vec2(0.0f));
    appendPadded(cage.cornerUvs1, corners, from.cornerUvs1, moreCorners, glm::vec2(0.0f));
    appendPadded(cage.cornerColors, corners, from.cornerColors, moreCorners, glm::vec4(1.0f));
    appendPadded(cage.cornerTangents, corners, from.cornerTangents, moreCorners, glm::vec4(0.0f));
    appendPadded(cage.faceMaterials, faces, from.faceMaterials, moreFaces, kNone);
    appendPadded(cage.faceTrimTiles, faces, from.faceTrimTiles, moreFaces, kNone);
    appendTo(cage.positions, from.positions);
    if (cage.faceStarts.empty()) {
        cage.faceStarts.push_back(0);
    }
    for (uint32_t f = 0; f < moreFaces; ++f) {
        cage.faceStarts.push_back(corners + from.faceStarts[f + 1]);
    }
    for (const uint32_t v : from.faceVertices) {
        cage.faceVertices.push_back(vertices + v);
    }
    for (const uint32_t v : from.sourceVertices) {
        cage.sourceVertices.push_back(sourceVertices + v);
    }
    for (const SourcePrimitive& own : from.sourcePrimitives) {
        const auto before = static_cast<uint32_t>(cage.sourceTriangles.size() / 3);
        cage.sourcePrimitives.push_back({own.mesh, own.primitive, before + own.firstTriangle});
    }
    for (const uint32_t corner : from.sourceTriangles) {
        cage.sourceTriangles.push_back(corner == kNone ? kNone : corners + corner);
    }
    appendCreases(from, vertices, cage);
    for (const SharpVertex& sharp : from.sharpVertices) {
        cage.sharpVertices.push_back({vertices + sharp.vertex, sharp.sharpness});
    }
    for (const uint32_t v : from.roundCorners) {
        cage.roundCorners.push_back(vertices + v);
    }
    for (const CreaseScalar& scalar : from.creaseScalars) {
        cage.creaseScalars.push_back({vertices + scalar.vertex, vertices + scalar.toward, scalar.alpha});
    }
    for (const uint32_t hole : from.holes) {
        cage.holes.push_back(faces + hole);
    }
}

void appendWeights(const PartCage& from, SkinWeights& weights) {
    if (weights.starts.empty()) {
        weights.starts.push_back(0);
    }
    const auto first = static_cast<uint32_t>(weights.influences.size());
    for (size_t v = 1; v < from.weights.starts.size(); ++v) {
        weights.starts.push_back(first + from.weights.starts[v]);
    }
    for (const Influence& influence : from.weights.influences) {
        weights.influences.push_back({from.part.joints[influence.joint], influence.weight});
    }
}

/// Behind appendWeights() of the part, whose vertices begin at `firstVertex`: what is painted of `more`.
template <class T>
void appendPainted(const std::vector<PaintedWeight>& weights, const std::vector<T>& more, uint32_t firstVertex,
                   size_t count, std::vector<PaintedWeight>& allWeights, std::vector<T>& all) {
    appendPadded(allWeights, firstVertex, weights, count, PaintedWeight{});
    const auto first = static_cast<uint32_t>(all.size());
    for (size_t v = firstVertex; v < allWeights.size(); ++v) {
        allWeights[v].index += allWeights[v].index != kNone ? first : 0;
    }
    appendTo(all, more);
}

/// Where one part has a mask, the others are smoothed wholly.
void appendMushMask(const PartCage& from, uint32_t firstVertex, SkinWeights& weights) {
    appendPadded(weights.mushMask, firstVertex, from.weights.mushMask, from.cage.vertexCount(), 1.0f);
}

/// The clips' channels of the weights of each part's targets.
using WeightChannels = std::vector<std::vector<const Channel*>>;

WeightChannels weightChannels(const Character& character, std::span<const PartCage> parts) {
    std::map<uint32_t, size_t> places;
    for (size_t p = 0; p < parts.size(); ++p) {
        places.emplace(parts[p].part.node, p);
    }
    WeightChannels channels(parts.size(), std::vector<const Channel*>(character.clips.size(), nullptr));
    for (size_t c = 0; c < character.clips.size(); ++c) {
        for (const Channel& channel : character.clips[c].channels) {
            const auto found = places.find(channel.node);
            if (channel.path == ChannelPath::weights && found != places.end()) {
                channels[found->second][c] = &channel;
            }
        }
    }
    return channels;
}

bool moveAlike(std::span<const Channel* const> a, std::span<const Channel* const> b) {
    for (size_t c = 0; c < a.size(); ++c) {
        if ((a[c] == nullptr) != (b[c] == nullptr) ||
            (a[c] != nullptr && (a[c]->interpolation != b[c]->interpolation || a[c]->times != b[c]->times ||
                                 a[c]->values != b[c]->values))) {
            return false;
        }
    }
    return true;
}

/// Names that tell targets apart.
std::vector<std::string> targetNames(const Morphs& morphs) {
    std::vector<std::string> names;
    for (const MorphTarget& target : morphs.targets) {
        names.push_back(target.name);
    }
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    const bool differ = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    return differ && (sorted.empty() || !sorted.front().empty()) ? names : std::vector<std::string>();
}

/// Gives each part its run of the character's targets.
void placeTargets(std::span<PartCage> parts, Character& character) {
    const std::vector<size_t> owners = targetOwners(parts, character);
    for (size_t p = 0; p < parts.size(); ++p) {
        Part& part = parts[p].part;
        const Morphs& morphs = parts[p].morphs;
        part.targetCount = static_cast<uint32_t>(morphs.targets.size());
        part.firstTarget = static_cast<uint32_t>(character.morphs.targets.size());
        if (part.targetCount == 0) {
            part.firstTarget = 0;
            continue;
        }
        if (owners[p] != p) {
            part.firstTarget = parts[owners[p]].part.firstTarget;
            continue;
        }
        for (const MorphTarget& target : morphs.targets) {
            character.morphs.targets.push_back({target.name, {}, {}});
        }
        appendTo(character.morphs.weights, morphs.weights);
        for (PoseDriver driver : parts[p].drivers) {
            for (uint32_t& target : driver.targets) {
                target += part.firstTarget;
            }
            character.drivers.push_back(std::move(driver));
        }
    }
}

/// Channels tell which targets they move; those of targets that a channel before moves are left out.
void placeChannels(std::span<const PartCage> parts, Character& character) {
    std::map<uint32_t, uint32_t> firstTargets;
    for (const PartCage& part : parts) {
        firstTargets.emplace(part.part.node, part.part.firstTarget);
    }
    for (Clip& clip : character.clips) {
        std::set<uint32_t> moved;
        std::erase_if(clip.channels, [&](Channel& channel) {
            if (channel.path != ChannelPath::weights) {
                return false;
            }
            channel.firstTarget = firstTargets[channel.node];
            return !moved.insert(channel.firstTarget).second;
        });
    }
}

void appendDisplacements(const PartCage& from, uint32_t firstVertex, Morphs& morphs) {
    for (size_t t = 0; t < from.morphs.targets.size(); ++t) {
        MorphTarget& target = morphs.targets[from.part.firstTarget + t];
        for (const uint32_t v : from.morphs.targets[t].vertices) {
            target.vertices.push_back(firstVertex + v);
        }
        appendTo(target.deltas, from.morphs.targets[t].deltas);
    }
}

void takeTargets(const Character& character, size_t index, std::span<const uint32_t> places, Morphs& morphs) {
    const Part& part = character.parts[index];
    for (uint32_t t = part.firstTarget; t < part.firstTarget + part.targetCount; ++t) {
        const MorphTarget& from = character.morphs.targets[t];
        MorphTarget& target = morphs.targets.emplace_back(MorphTarget{from.name, {}, {}});
        for (size_t i = 0; i < from.vertices.size(); ++i) {
            if (places[from.vertices[i]] != kNone) {
                target.vertices.push_back(places[from.vertices[i]]);
                target.deltas.push_back(from.deltas[i]);
            }
        }
        morphs.weights.push_back(character.morphs.weights[t]);
    }
}

/// Takes from `all` what `weights` name, in the same order. Then `weights` name places in `taken`.
template <class T>
void takePainted(const std::vector<T>& all, std::vector<PaintedWeight>& weights, std::vector<T>& taken) {
    std::vector<uint32_t> places(all.size(), kNone);
    for (const PaintedWeight& own : weights) {
        if (own.index != kNone) {
            places[own.index] = 0;
        }
    }
    for (size_t k = 0; k < places.size(); ++k) {
        if (places[k] != kNone) {
            places[k] = static_cast<uint32_t>(taken.size());
            taken.push_back(all[k]);
        }
    }
    for (PaintedWeight& own : weights) {
        own.index = own.index != kNone ? places[own.index] : kNone;
    }
}

bool isRigid(const SkinWeights& weights) {
    return weights.influences.size() + 1 == weights.starts.size() &&
           std::all_of(weights.influences.begin(), weights.influences.end(),
                       [&](const Influence& i) { return i.joint == weights.influences.front().joint; });
}

} // namespace

std::vector<size_t> targetOwners(std::span<const PartCage> parts, const Character& character) {
    const WeightChannels channels = weightChannels(character, parts);
    std::multimap<std::vector<std::string>, size_t> named; // parts with runs of their own
    std::vector<size_t> owners(parts.size());
    for (size_t p = 0; p < parts.size(); ++p) {
        owners[p] = p;
        const Morphs& morphs = parts[p].morphs;
        if (morphs.targets.empty()) {
            continue;
        }
        const std::vector<std::string> names = targetNames(morphs);
        const auto [first, last] = named.equal_range(names);
        const auto same = std::find_if(first, last, [&](const auto& other) {
            const PartCage& before = parts[other.second];
            return before.morphs.weights == morphs.weights && before.drivers == parts[p].drivers &&
                   moveAlike(channels[other.second], channels[p]);
        });
        if (!names.empty() && same != last) {
            owners[p] = same->second;
        } else {
            named.emplace(names, p);
        }
    }
    return owners;
}

std::vector<uint32_t> PaletteBuilder::add(const Skin& skin) {
    std::map<Key, size_t> seen;
    std::vector<uint32_t> places;
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        Key key{skin.joints[j], {}};
        std::memcpy(key.second.data(), &skin.inverseBinds[j][0][0], sizeof key.second);
        std::vector<uint32_t>& known = known_[key];
        const size_t nth = seen[key]++;
        if (nth == known.size()) {
            known.push_back(static_cast<uint32_t>(palette_->joints.size()));
            palette_->joints.push_back(skin.joints[j]);
            palette_->inverseBinds.push_back(skin.inverseBinds[j]);
        }
        places.push_back(known[nth]);
    }
    return places;
}

namespace {

/// As reverseFaces() moves the corners.
void reverseSourceTriangles(Cage& cage, std::span<const uint8_t> turned) {
    for (uint32_t& corner : cage.sourceTriangles) {
        if (corner == kNone) {
            continue;
        }
        const uint32_t face = cage.faceOf(corner);
        if (turned[face] != 0 && corner != cage.faceStarts[face]) {
            corner = cage.faceStarts[face] + cage.faceStarts[face + 1] - corner;
        }
    }
}

} // namespace

void reverseFaces(Cage& cage, std::span<const uint8_t> turned) {
    const auto reverse = [&](auto& values) {
        for (uint32_t f = 0; f < cage.faceCount() && !values.empty(); ++f) {
            if (turned[f] != 0) {
                std::reverse(values.begin() + cage.faceStarts[f] + 1, values.begin() + cage.faceStarts[f + 1]);
            }
        }
    };
    reverseSourceTriangles(cage, turned);
    reverse(cage.faceVertices);
    reverse(cage.cornerUvs);
    reverse(cage.cornerUvs1);
    reverse(cage.cornerColors);
    reverse(cage.cornerNormals);
    reverse(cage.cornerTangents);
    size_t triangle = 0;
    for (uint32_t f = 0; f < cage.faceCount() && !cage.faceTriangles.empty(); ++f) {
        const uint32_t start = cage.faceStarts[f];
        for (uint32_t t = 2; t < cage.sides(f); ++t, triangle += 3) {
            for (size_t k = 0; k < 3 && turned[f] != 0; ++k) {
                uint32_t& corner = cage.faceTriangles[triangle + k];
                corner = corner == start ? start : start + cage.faceStarts[f + 1] - corner;
            }
            if (turned[f] != 0) {
                std::swap(cage.faceTriangles[triangle + 1], cage.faceTriangles[triangle + 2]);
            }
        }
    }
}

std::vector<uint32_t> sewnTo(const Cage& cage, size_t parts) {
    std::vector<uint32_t> first(parts);
    std::iota(first.begin(), first.end(), 0u);
    const auto rootOf = [&](uint32_t part) {
        while (first[part] != part) {
            part = first[part] = first[first[part]];
        }
        return part;
    };
    std::vector<uint32_t> partOf(cage.vertexCount(), kNone); // the first that has the vertex
    for (uint32_t f = 0; f < cage.faceParts.size(); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            uint32_t& other = partOf[cage.faceVertices[c]];
            if (other == kNone) {
                other = cage.faceParts[f];
            }
            const uint32_t a = rootOf(other), b = rootOf(cage.faceParts[f]);
            first[std::max(a, b)] = std::min(a, b);
        }
    }
    for (uint32_t part = 0; part < parts; ++part) {
        first[part] = rootOf(part);
    }
    return first;
}

Character takePart(const Character& character, size_t index) {
    std::vector<uint32_t> faces(endFace(character, index) - character.parts[index].firstFace);
    std::iota(faces.begin(), faces.end(), character.parts[index].firstFace);
    CagePiece piece = takeFaces(character.cage, faces);
    piece.cage.faceParts.clear();
    Character taken;
    taken.name = character.name;
    taken.parts = {character.parts[index]};
    taken.parts[0].firstFace = taken.parts[0].firstTarget = 0;
    taken.skeleton = character.skeleton;
    taken.skin = character.skin;
    taken.materials = character.materials;
    taken.cage = std::move(piece.cage);
    taken.weights.starts.push_back(0);
    for (const uint32_t v : piece.vertices) {
        appendVertex(character.weights, v, taken.weights);
    }
    takePainted(character.jiggles, taken.weights.jiggles, taken.jiggles);
    takePainted(character.cloths, taken.weights.cloths, taken.cloths);
    std::vector<uint32_t> places(character.cage.vertexCount(), kNone);
    for (uint32_t v = 0; v < piece.vertices.size(); ++v) {
        places[piece.vertices[v]] = v;
    }
    takeTargets(character, index, places, taken.morphs);
    const Part& part = character.parts[index];
    for (const PoseDriver& driver : character.drivers) {
        if (driver.targets[0] >= part.firstTarget && driver.targets[0] < part.firstTarget + part.targetCount) {
            for (uint32_t& target : taken.drivers.emplace_back(driver).targets) {
                target -= part.firstTarget;
            }
        }
    }
    return taken;
}

void findFirstFaces(Character& character) {
    const std::vector<uint32_t>& of = character.cage.faceParts;
    for (uint32_t part = 0; part < character.parts.size(); ++part) {
        const auto first = std::lower_bound(of.begin(), of.end(), part);
        character.parts[part].firstFace = static_cast<uint32_t>(first - of.begin());
    }
}

CageNames joinParts(std::vector<PartCage> parts, Character& character) {
    placeTargets(parts, character);
    placeChannels(parts, character);
    Shading shading;
    for (const PartCage& part : parts) {
        shading.normals = shading.normals || !part.cage.cornerNormals.empty();
        shading.triangles = shading.triangles || !part.cage.faceTriangles.empty();
    }
    character.parts.clear();
    CageNames names;
    for (PartCage& part : parts) {
        names.parts.push_back(part.element);
        for (const uint32_t v : part.cage.faceVertices) {
            names.cornerVertices.push_back(part.namesBySource ? part.cage.sourceVertices[v] : v);
        }
        part.part.firstFace = character.cage.faceCount();
        part.part.rigid = isRigid(part.weights);
        const uint32_t firstVertex = character.cage.vertexCount();
        appendDisplacements(part, firstVertex, character.morphs);
        appendShading(part.cage, shading, character.cage);
        appendCage(part.cage, character.sourceVertexCount, character.cage);
        appendWeights(part, character.weights);
        const size_t count = part.cage.vertexCount();
        appendPainted(part.weights.jiggles, part.jiggles, firstVertex, count, character.weights.jiggles,
                      character.jiggles);
        appendPainted(part.weights.cloths, part.cloths, firstVertex, count, character.weights.cloths, character.cloths);
        appendMushMask(part, firstVertex, character.weights);
        character.sourceVertexCount += part.sourceVertexCount;
        character.seamVertexCount += part.seamVertexCount;
        character.parts.push_back(std::move(part.part));
        part = {};
    }
    for (uint32_t part = 0; part < character.parts.size() && character.parts.size() > 1; ++part) {
        character.cage.faceParts.resize(endFace(character, part), part);
    }
    boundCreaseSets(character);
    return names;
}

} // namespace supple::cage
