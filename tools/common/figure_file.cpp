#include "tools/common/figure_file.h"

namespace supple::host {

Result<std::unique_ptr<Figure>> openFigure(Context& context, const std::string& path, const ReadFlags& flags) {
    // Supple keeps what it computes with; materials, pictures and the cage's faces are the host's to draw.
    Result<CharacterFile> file = readCharacterFile(path, flags);
    if (!file)
        return file.error();
    const Result<SuppleAsset> asset = createAsset(context, *file);
    if (!asset)
        return asset.error();
    return Figure::create(context, *asset, std::move(file->character), path);
}

} // namespace supple::host
