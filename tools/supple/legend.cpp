#include "tools/supple/legend.h"

#include "host/shaders/draw.h"
#include "tools/supple/curvature_view.h"
#include "tools/supple/limit_distance.h"

#include <algorithm>
#include <cmath>

namespace supple::tools {

namespace {

constexpr uint32_t kLetterWidth = 6, kLetterHeight = 10; ///< host::Picture::drawText
constexpr uint32_t kBarWidth = 200;
constexpr uint8_t kInk[3] = {235, 235, 235}, kDarkInk[3] = {10, 20, 30};
constexpr std::array<uint8_t, 3> kBright = {200, 201, 203}, kDark = {24, 25, 29}; ///< stripes
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

/// What can be read on the bar.
bool isInkDark(const Legend& legend, float at) {
    switch (legend.bar) {
    case Legend::Bar::scale:
        return at > 0.6f;
    case Legend::Bar::signedScale:
        return at > 0.15f && at < 0.85f;
    default:
        return false;
    }
}

} // namespace

std::optional<Legend> legendOf(uint32_t view) {
    switch (view) {
    case host::shared::kViewWeights:
        return Legend{"weight of the joint", {{0.0f, "0"}, {0.5f, "0.5"}, {1.0f, "1"}}};
    case host::shared::kViewDistance:
        return Legend{"distance to the limit / extent", distanceMarks()};
    case host::shared::kViewLevels:
        return Legend{"largest level of a patch, in segments", levelMarks()};
    case host::shared::kViewMeanCurvature:
        return Legend{"mean curvature x extent", curvatureMarks(), Legend::Bar::signedScale};
    case host::shared::kViewGaussianCurvature:
        return Legend{"root of Gaussian curvature x extent", curvatureMarks(), Legend::Bar::signedScale};
    case host::shared::kViewHighlights:
        return Legend{"24 lights along x, round the figure",
                      {{0.0f, "-180"}, {0.5f, "0"}, {1.0f, "180"}},
                      Legend::Bar::stripes,
                      host::shared::kHighlightCount};
    case host::shared::kViewIsophotes:
        return Legend{"degrees from (1, 2, 2)",
                      {{0.0f, "0"}, {0.5f, "90"}, {1.0f, "180"}},
                      Legend::Bar::stripes,
                      static_cast<uint32_t>(180.0f / host::shared::kIsophoteDegrees)};
    default:
        return std::nullopt;
    }
}

std::array<uint8_t, 3> barColor(const Legend& legend, float at) {
    if (legend.bar == Legend::Bar::stripes) { // bright where a stripe begins and ends, as stripes.glsl has it
        const float stripe = at * static_cast<float>(legend.stripes);
        const bool bright = std::abs(stripe - std::floor(stripe) - 0.5f) > 0.25f;
        return bright ? kBright : kDark;
    }
    constexpr uint32_t kColors[] = {SUPPLE_SCALE_COLORS}, kSigned[] = {SUPPLE_SIGNED_COLORS};
    const uint32_t* const colors = legend.bar == Legend::Bar::signedScale ? kSigned : kColors;
    const float steps = std::clamp(at, 0.0f, 1.0f) * 4.0f;
    const uint32_t low = std::min(static_cast<uint32_t>(steps), 3u);
    std::array<uint8_t, 3> color{};
    for (uint32_t channel = 0; channel < 3; ++channel) {
        const auto of = [&](uint32_t step) { return static_cast<float>(colors[step] >> (16 - 8 * channel) & 255u); };
        color[channel] =
            static_cast<uint8_t>(std::lround(std::lerp(of(low), of(low + 1), steps - static_cast<float>(low))));
    }
    return color;
}

void drawLegend(host::Picture& picture, const Legend& legend) {
    // One line, which fits below a figure that fills the picture: the title, and marks inside of the bar.
    const uint32_t scale = std::max(1u, picture.height / 480), gap = 4 * scale;
    const uint32_t bar = kBarWidth * scale, height = (kLetterHeight + 2) * scale;
    const auto textWidth = [&](const std::string& text) {
        return static_cast<uint32_t>(text.size()) * kLetterWidth * scale;
    };
    const uint32_t width = textWidth(legend.title) + bar + 3 * gap;
    if (picture.width < width + 2 * gap || picture.height < height + 4 * gap)
        return;
    const uint32_t left = picture.width - width - gap, top = picture.height - height - 2 * gap;
    shade(picture, left, top - gap / 2, width, height + gap);
    picture.drawText(left + gap, top + scale, legend.title, scale, kInk);
    const uint32_t barLeft = left + width - gap - bar;
    for (uint32_t x = 0; x < bar; ++x) {
        const std::array<uint8_t, 3> color = barColor(legend, static_cast<float>(x) / static_cast<float>(bar - 1));
        for (uint32_t y = top; y < top + height; ++y)
            std::copy(color.begin(), color.end(), picture.pixel(barLeft + x, y));
    }
    for (const Legend::Mark& mark : legend.marks) {
        const uint32_t room = bar - textWidth(mark.text) - 2 * scale;
        const auto x = static_cast<uint32_t>(
            std::clamp(mark.at * static_cast<float>(bar) - 0.5f * static_cast<float>(textWidth(mark.text)),
                       static_cast<float>(2 * scale), static_cast<float>(room)));
        if (legend.bar == Legend::Bar::stripes)
            shade(picture, barLeft + x - scale, top, textWidth(mark.text) + scale, height);
        picture.drawText(barLeft + x, top + scale, mark.text, scale, isInkDark(legend, mark.at) ? kDarkInk : kInk);
    }
}

} // namespace supple::tools
