#include "skinning/deform_table.h"

#include "skinning/bits.h"
#include "skinning/centers.h"
#include "skinning/delta_mush.h"

#include <algorithm>

namespace supple::skinning {
namespace {

/// The displacements of every vertex, target by target.
struct Displacements {
    struct One {
        uint32_t target = 0;
        glm::vec3 delta{0.0f};
    };
    std::vector<uint32_t> starts; ///< vertexCount + 1 entries
    std::vector<One> list;
};

Displacements displacementsOf(uint32_t vertexCount, const cage::Morphs& morphs) {
    Displacements result;
    result.starts.assign(size_t{vertexCount} + 1, 0);
    for (const cage::MorphTarget& target : morphs.targets) {
        for (const uint32_t vertex : target.vertices) {
            ++result.starts[vertex + 1];
        }
    }
    for (uint32_t v = 0; v < vertexCount; ++v) {
        result.starts[v + 1] += result.starts[v];
    }
    result.list.resize(result.starts.back());
    std::vector<uint32_t> next(result.starts.begin(), result.starts.end() - 1);
    for (uint32_t t = 0; t < morphs.targets.size(); ++t) {
        const cage::MorphTarget& target = morphs.targets[t];
        for (size_t i = 0; i < target.vertices.size(); ++i) {
            result.list[next[target.vertices[i]]++] = {t, target.deltas[i]};
        }
    }
    return result;
}

using TableWords = std::vector<uint32_t>;

/// Those of a vertex, the heaviest first.
void putInfluences(const cage::SkinWeights& weights, uint32_t vertex, TableWords& words) {
    std::vector<cage::Influence> own(weights.influences.begin() + weights.starts[vertex],
                                     weights.influences.begin() + weights.starts[vertex + 1]);
    const auto heaviest =
        std::max_element(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
    std::rotate(own.begin(), heaviest, heaviest + 1);
    for (size_t i = 0; i < own.size(); i += 2) {
        const cage::Influence second = i + 1 < own.size() ? own[i + 1] : cage::Influence{own[i].joint, 0.0f};
        words.insert(words.end(), {own[i].joint, bits(own[i].weight), second.joint, bits(second.weight)});
    }
}

void putMush(std::span<const MushInfluence> own, TableWords& words) {
    for (const MushInfluence& i : own) {
        words.insert(words.end(), {i.joint, bits(i.weight), bits(i.offset.x), bits(i.offset.y), bits(i.offset.z)});
        for (const float spread : i.spread) {
            words.push_back(bits(spread));
        }
        words.push_back(0u);
    }
}

void putLightMush(std::span<const MushInfluence> own, TableWords& words) {
    for (size_t i = 0; i < own.size(); i += 2) {
        const MushInfluence second = i + 1 < own.size() ? own[i + 1] : MushInfluence{own[i].joint, 0.0f, {}, {}};
        words.insert(words.end(), {own[i].joint, bits(own[i].weight), second.joint, bits(second.weight)});
        for (const glm::vec3& offset : {own[i].offset, second.offset}) {
            words.insert(words.end(), {bits(offset.x), bits(offset.y), bits(offset.z), 0u});
        }
    }
}

void putInfluences(const cage::Character& character, const Skinning& skinning, uint32_t vertex, TableWords& words) {
    const SkinTableKind table = skinningRow(skinning.mode).table;
    if (table == SkinTableKind::plain || table == SkinTableKind::centers) {
        putInfluences(character.weights, vertex, words);
        return;
    }
    const DeltaMush& mush = *skinning.mush;
    const std::span<const MushInfluence> own =
        std::span(mush.influences).subspan(mush.starts[vertex], mush.starts[vertex + 1] - mush.starts[vertex]);
    (table == SkinTableKind::mush ? putMush : putLightMush)(own, words);
}

/// About what vertices turn; empty: joints alone say it.
std::span<const glm::vec4> centersOf(const Skinning& skinning) {
    switch (skinningRow(skinning.mode).extra) {
    case SkinExtra::none:
        return {};
    case SkinExtra::centers:
        return skinning.centers->points;
    case SkinExtra::mush:
        return skinning.mush->places;
    }
    return {};
}

} // namespace

DeformTable buildDeformTable(const cage::Character& character, const Skinning& skinning) {
    const cage::Cage& cage = character.cage;
    const uint32_t vertexCount = cage.vertexCount();
    const Displacements displacements = displacementsOf(vertexCount, character.morphs);
    TableWords vertices, runs, firstInfluences;
    vertices.reserve(4 * (size_t{vertexCount} + 1));
    runs.reserve(4 * displacements.list.size() + 2 * character.weights.influences.size());
    const auto nextElement = [&] { return static_cast<uint32_t>(vertexCount + 1 + runs.size() / 4); };
    for (uint32_t v = 0; v < vertexCount; ++v) {
        const glm::vec3& p = cage.positions[v];
        vertices.insert(vertices.end(), {bits(p.x), bits(p.y), bits(p.z), nextElement()});
        for (uint32_t i = displacements.starts[v]; i < displacements.starts[v + 1]; ++i) {
            const auto& [target, delta] = displacements.list[i];
            runs.insert(runs.end(), {target, bits(delta.x), bits(delta.y), bits(delta.z)});
        }
        firstInfluences.push_back(nextElement());
        putInfluences(character, skinning, v, runs);
    }
    vertices.insert(vertices.end(), {0u, 0u, 0u, nextElement()});

    DeformTable table;
    table.words = std::move(vertices);
    table.words.insert(table.words.end(), runs.begin(), runs.end());
    if (!displacements.list.empty()) {
        table.firstInfluences = static_cast<uint32_t>(table.words.size() / 4);
        table.words.insert(table.words.end(), firstInfluences.begin(), firstInfluences.end());
        table.words.resize((table.words.size() + 3) / 4 * 4, 0u);
    }
    const std::span<const glm::vec4> centers = centersOf(skinning);
    table.firstCenter = centers.empty() ? 0 : static_cast<uint32_t>(table.words.size() / 4);
    for (const glm::vec4& center : centers) {
        table.words.insert(table.words.end(), {bits(center.x), bits(center.y), bits(center.z), bits(center.w)});
    }
    return table;
}

} // namespace supple::skinning
