#include "tools/common/figure_file.h"

#include "tools/common/character_file.h"

#include <algorithm>
#include <utility>

namespace supple::host {

namespace {

CageMesh meshOf(cage::Cage cage) {
    static_assert(cage::kNone == SUPPLE_NO_MATERIAL);
    return {std::move(cage.positions),    std::move(cage.faceStarts),
            std::move(cage.faceVertices), std::move(cage.faceMaterials),
            std::move(cage.faceParts),    {std::move(cage.cornerUvs), std::move(cage.cornerUvs1)},
            std::move(cage.cornerColors)};
}

} // namespace

Result<std::unique_ptr<Figure>> createFigure(Context& context, CharacterFile file) {
    const Result<SuppleAsset> asset = createAsset(context, file);
    if (!asset)
        return asset.error();
    // Supple hands out no faces of the cage: to draw them, a host keeps its own.
    return Figure::create(context, *asset, meshOf(std::move(file.character.cage)), file.path);
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
