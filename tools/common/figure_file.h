// A character file opened for drawing.
#pragma once

#include "host/figure.h"
#include "tools/common/character_file.h"

namespace supple::host {

/// Takes the character's cage. The context must outlive the figure.
[[nodiscard]] Result<std::unique_ptr<Figure>> createFigure(Context& context, CharacterFile file);
/// Reads the file and makes the figure.
[[nodiscard]] Result<std::unique_ptr<Figure>> openFigure(Context& context, const std::string& path,
                                                         const ReadOptions& flags = {});

/// As findClip() of tools/common/character_file.h, but SUPPLE_REST_POSE for an empty text: pictures show the character
/// as its file poses it.
[[nodiscard]] Result<uint32_t> findClip(const Figure& figure, const std::string& nameOrIndex);

} // namespace supple::host
