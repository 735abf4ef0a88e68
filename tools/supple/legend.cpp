#include "tools/supple/legend.h"

#include "host/shaders/draw.h"
#include "tools/supple/limit_distance.h"

#include <algorithm>
#include <cmath>

namespace supple::tools {

namespace {

constexpr uint32_t kLetterWidth = 6, kLetterHeight = 10; ///< host::Picture::drawText
constexpr uint8_t kInk[3] = {235, 235, 235};
constexpr float kShade = 0.35f; ///< what is left of the picture behind the legend

std::vector<Legend::Mark> levelMarks() {
    std::vector<Legend::Mark> marks;
    for (int level = 1; level <= static_cast<int>(host::shared::kScaledLevel); level *= 2)
        marks.push_back(
            {std::log2(static_cast<float>(level)) / std::log2(host::shared::kScaledLevel), std::to_string(level)});
    marks.back().text += "+";
    return marks;
}

void shade(host::Picture& picture, uint32_t left, uint32_t top, uint32_t width, uint32_t height) {
    for (uint32_t y = top; y < top + height; ++y) {
        for (uint32_t x = left; x < left + width; ++x) {
            uint8_t* const pixel = picture.pixel(x, y);
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] = static_cast<uint8_t>(kShade * static_cast<float>(pixel[channel]));
        }
    }
}

} // namespace

std::optional<Legend> legendOf(uint32_t view) {
    switch (view) {
    case host::shared::kViewWeights:
        return Legend{"weight of the joint", {{0.0f, "0"}, {0.5f, "0.5"}, {1.0f, "1"}}};
    case host::shared::kViewDistance:
        return Legend{"distance to the Catmull-Clark limit / extent", distanceMarks()};
    case host::shared::kViewLevels:
        return Legend{"largest level of a patch, in segments", levelMarks()};
    default:
        return std::nullopt;
    }
}

std::array<uint8_t, 3> scaleColor(float value) {
    constexpr uint32_t kColors[] = {SUPPLE_SCALE_COLORS};
    const float at = std::clamp(value, 0.0f, 1.0f) * 4.0f;
    const uint32_t low = std::min(static_cast<uint32_t>(at), 3u);
    std::array<uint8_t, 3> color{};
    for (uint32_t channel = 0; channel < 3; ++channel) {
        const auto of = [&](uint32_t step) { return static_cast<float>(kColors[step] >> (16 - 8 * channel) & 255u); };
        color[channel] =
            static_cast<uint8_t>(std::lround(std::lerp(of(low), of(low + 1), at - static_cast<float>(low))));
    }
    return color;
}

void drawLegend(host::Picture& picture, const Legend& legend) {
    const uint32_t scale = std::max(1u, picture.height / 480);
    const uint32_t letter = kLetterWidth * scale, line = (kLetterHeight + 4) * scale, margin = 8 * scale;
    const uint32_t bar = std::max(200 * scale, static_cast<uint32_t>(legend.title.size()) * letter);
    const uint32_t width = bar + 4 * margin, height = 3 * line + 2 * margin; // marks reach beyond the bar's ends
    if (picture.width < width + 2 * margin || picture.height < height + 2 * margin)
        return;
    const uint32_t left = picture.width - width - margin, top = picture.height - height - margin;
    shade(picture, left, top, width, height);
    const uint32_t barLeft = left + 2 * margin, barTop = top + margin + line;
    picture.drawText(barLeft, top + margin, legend.title, scale, kInk);
    for (uint32_t x = 0; x < bar; ++x) {
        const std::array<uint8_t, 3> color = scaleColor(static_cast<float>(x) / static_cast<float>(bar - 1));
        for (uint32_t y = barTop; y < barTop + line - 2 * scale; ++y)
            std::copy(color.begin(), color.end(), picture.pixel(barLeft + x, y));
    }
    for (const Legend::Mark& mark : legend.marks) {
        const auto x = barLeft + static_cast<uint32_t>(mark.at * static_cast<float>(bar - 1));
        const uint32_t half = static_cast<uint32_t>(mark.text.size()) * letter / 2;
        picture.drawText(x - half, barTop + line, mark.text, scale, kInk);
    }
}

} // namespace supple::tools
