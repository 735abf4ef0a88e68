#include "tools/common/figure_file.h"

#include "tools/common/character_file.h"

#include <algorithm>
#include <utility>

namespace supple::host {

namespace {

/// Whether a pose may mirror anything: without a negative scale, matrix or inverse bind none does. Tangents of cubic
/// keys may take a scale below 0.
bool mayMirror(const cage::Character& character) {
    const auto mirrors = [](const cage::Node& node) {
        return node.hasMatrix ? glm::determinant(glm::mat3(node.matrix)) < 0.0f
                              : std::min({node.scale.x, node.scale.y, node.scale.z}) < 0.0f;
    };
    const auto isScaleBelowZero = [](const cage::Channel& channel) {
        return channel.path == cage::ChannelPath::scale &&
               (channel.interpolation == cage::Interpolation::cubicSpline ||
                *std::min_element(channel.values.begin(), channel.values.end()) < 0.0f);
    };
    const auto bindMirrors = [](const glm::mat4& bind) { return glm::determinant(glm::mat3(bind)) < 0.0f; };
    return std::any_of(character.skeleton.nodes.begin(), character.skeleton.nodes.end(), mirrors) ||
           std::any_of(character.skin.inverseBinds.begin(), character.skin.inverseBinds.end(), bindMirrors) ||
           std::any_of(character.clips.begin(), character.clips.end(), [&](const cage::Clip& clip) {
               return std::any_of(clip.channels.begin(), clip.channels.end(), isScaleBelowZero);
           });
}

CageMesh meshOf(cage::Character character) {
    static_assert(cage::kNone == SUPPLE_NO_MATERIAL);
    const bool mirrors = mayMirror(character);
    cage::Cage& cage = character.cage;
    return {std::move(cage.positions),    std::move(cage.faceStarts),
            std::move(cage.faceVertices), std::move(cage.faceMaterials),
            std::move(cage.faceParts),    {std::move(cage.cornerUvs), std::move(cage.cornerUvs1)},
            std::move(cage.cornerColors), mirrors};
}

} // namespace

Result<std::unique_ptr<Figure>> createFigure(Context& context, CharacterFile file) {
    const Result<SuppleAsset> asset = createAsset(context, file);
    if (!asset)
        return asset.error();
    // Supple hands out no faces of the cage: to draw them, a host keeps its own.
    return Figure::create(context, *asset, meshOf(std::move(file.character)), file.path);
}

Result<std::unique_ptr<Figure>> openFigure(Context& context, const std::string& path, const ReadOptions& flags) {
    Result<CharacterFile> file = readCharacterFile(path, flags);
    if (!file)
        return file.error();
    return createFigure(context, std::move(*file));
}

Result<uint32_t> findClip(const Figure& figure, const std::string& nameOrIndex) {
    if (nameOrIndex.empty())
        return SUPPLE_REST_POSE;
    std::vector<std::string> names;
    for (const Figure::Clip& clip : figure.clips())
        names.push_back(clip.name);
    return findClip(figure.path(), names, nameOrIndex);
}

} // namespace supple::host
