#include "tools/supple/legend.h"

#include "host/shaders/draw.h"
#include "tools/supple/command.h"
#include "tools/supple/curvature_view.h"
#include "tools/supple/limit_distance.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

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

constexpr std::array<uint8_t, 3> kGridLine = {29, 33, 43}, kBorderLine = {228, 129, 53}; ///< about as surface.frag's

/// Sizes in the picture, in pixels.
struct Layout {
    Layout(const host::Picture& picture, const Legend& legend)
        : scale(std::max(1u, picture.height / 480)), gap(4 * scale), line((kLetterHeight + 2) * scale) {
        if (legend.swatches
                .empty()) { // fits below a figure that fills the picture: the title, and marks inside of the bar
            bar = legend.bar == Legend::Bar::none ? 0 : kBarWidth * scale;
            width = textWidth(legend.title) + 2 * gap + (bar > 0 ? bar + gap : 0);
            height = line;
            return;
        }
        for (const Legend::Swatch& swatch : legend.swatches)
            width = std::max(width, line + textWidth(swatch.text) + 3 * gap);
        height = line * static_cast<uint32_t>(legend.swatches.size());
    }
    [[nodiscard]] uint32_t textWidth(const std::string& text) const {
        return static_cast<uint32_t>(text.size()) * kLetterWidth * scale;
    }

    uint32_t scale, gap, line;
    uint32_t bar = 0;
    uint32_t width = 0, height = 0;
};

void fill(host::Picture& picture, uint32_t left, uint32_t top, uint32_t width, uint32_t height,
          const std::array<uint8_t, 3>& color) {
    for (uint32_t y = top; y < top + height; ++y) {
        for (uint32_t x = left; x < left + width; ++x)
            std::copy(color.begin(), color.end(), picture.pixel(x, y));
    }
}

void drawSwatches(host::Picture& picture, const Legend& legend, const Layout& layout, uint32_t left, uint32_t top) {
    for (const Legend::Swatch& swatch : legend.swatches) {
        const uint32_t inset = layout.scale, side = layout.line - 2 * inset;
        fill(picture, left, top + inset, side, side, {kInk[0], kInk[1], kInk[2]});
        fill(picture, left + inset, top + 2 * inset, side - 2 * inset, side - 2 * inset, swatch.color);
        picture.drawText(left + layout.line + layout.gap, top + layout.scale, swatch.text, layout.scale, kInk);
        top += layout.line;
    }
}

std::vector<Legend::Swatch> swatchesOf(uint32_t classes) {
    constexpr uint32_t kColors[] = {SUPPLE_CLASS_COLORS};
    constexpr const char* kNames[] = {"regular",
                                      "perturbed",
                                      "polar",
                                      "P_3",
                                      "P_4",
                                      "P_5",
                                      "fragment",
                                      "loop",
                                      "irregular",
                                      "with sharp edges",
                                      "triangle",
                                      "irregular",
                                      "with sharp edges",
                                      "creased",
                                      "regular",
                                      "irregular",
                                      "with sharp edges",
                                      "regular"};
    static_assert(std::size(kNames) == host::shared::kClassCount && std::size(kColors) == host::shared::kClassCount);
    std::vector<Legend::Swatch> swatches;
    for (uint32_t i = 0; i < host::shared::kClassCount; ++i) {
        if ((classes >> i & 1u) != 0) {
            const uint32_t c = kColors[i];
            swatches.push_back(
                {{static_cast<uint8_t>(c >> 16), static_cast<uint8_t>(c >> 8), static_cast<uint8_t>(c)}, kNames[i]});
        }
    }
    return swatches;
}

/// Why the view has nothing to show; empty if it has.
std::string whatIsMissing(uint32_t view, const ViewFacts& facts) {
    switch (view) {
    case host::shared::kViewUv:
        return facts.uvs ? "" : "the file has no texture coordinates";
    case host::shared::kViewUv1:
        return facts.secondUvs ? "" : "the file has no second texture coordinates";
    case host::shared::kViewVertexColor:
        return facts.vertexColors ? "" : "the file has no vertex colors";
    case host::shared::kViewNormalMap:
        return facts.normalMaps ? "" : "no material has a normal map";
    case host::shared::kViewOcclusion:
        return facts.occlusionMaps ? "" : "no material has an occlusion map";
    case host::shared::kViewEmissive:
        return facts.emission ? "" : "no material emits light";
    case host::shared::kViewWeights:
        return facts.jointMoves ? "" : "joint " + printable(facts.joint) + " moves no vertex";
    case host::shared::kViewPatches:
        return facts.patchClasses != 0 ? "" : "there are no patches";
    default:
        return "";
    }
}

std::optional<Legend> measuredLegend(uint32_t view) {
    switch (view) {
    case host::shared::kViewDistance:
        return Legend{"distance to the limit / extent", distanceMarks(), Legend::Bar::scale};
    case host::shared::kViewLevels:
        return Legend{"largest level of a patch, in segments", levelMarks(), Legend::Bar::scale};
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

/// What can be read on the bar.
bool isInkDark(const Legend& legend, float at) {
    switch (legend.bar) {
    case Legend::Bar::scale:
    case Legend::Bar::gray:
        return at > 0.6f;
    case Legend::Bar::signedScale:
        return at > 0.15f && at < 0.85f;
    default:
        return false;
    }
}

} // namespace

std::optional<Legend> legendOf(uint32_t view, const ViewFacts& facts) {
    if (std::string missing = whatIsMissing(view, facts); !missing.empty())
        return Legend{std::move(missing), {}};
    const std::vector<Legend::Mark> parts = {{0.0f, "0"}, {0.5f, "0.5"}, {1.0f, "1"}};
    switch (view) {
    case host::shared::kViewWire:
        return Legend{
            "", {}, Legend::Bar::none, 0, {{kGridLine, "grid of samples"}, {kBorderLine, "borders of patches"}}};
    case host::shared::kViewPatches:
        return Legend{"", {}, Legend::Bar::none, 0, swatchesOf(facts.patchClasses)};
    case host::shared::kViewNormals:
        return Legend{"normals: red +X, green +Y, blue +Z", {}};
    case host::shared::kViewTangents:
        return Legend{"tangents: red +X, green +Y, blue +Z", {}};
    case host::shared::kViewZebra:
        return Legend{"light tubes round the viewer, reflected", {}};
    case host::shared::kViewUv:
        return Legend{"texture coordinates: 32 squares a unit, redder with u, bluer with v", {}};
    case host::shared::kViewUv1:
        return Legend{"second texture coordinates: 32 squares a unit, redder with u, bluer with v", {}};
    case host::shared::kViewVertexColor:
        return Legend{"vertex colors of the file", {}};
    case host::shared::kViewBaseColor:
        return Legend{"base color, without light", {}};
    case host::shared::kViewNormalMap:
        return Legend{"normal map, as stored", {}};
    case host::shared::kViewEmissive:
        return Legend{"emission", {}};
    case host::shared::kViewMetallic:
        return Legend{"metallic", parts, Legend::Bar::gray};
    case host::shared::kViewRoughness:
        return Legend{"roughness", parts, Legend::Bar::gray};
    case host::shared::kViewOcclusion:
        return Legend{"occlusion: open light", parts, Legend::Bar::gray};
    case host::shared::kViewWeights:
        return Legend{"weight of " + printable(facts.joint), parts, Legend::Bar::scale};
    default:
        return measuredLegend(view);
    }
}

std::array<uint8_t, 3> barColor(const Legend& legend, float at) {
    if (legend.bar == Legend::Bar::stripes) { // bright where a stripe begins and ends, as stripes.glsl has it
        const float stripe = at * static_cast<float>(legend.stripes);
        const bool bright = std::abs(stripe - std::floor(stripe) - 0.5f) > 0.25f;
        return bright ? kBright : kDark;
    }
    if (legend.bar == Legend::Bar::gray) {
        const auto byte = static_cast<uint8_t>(std::lround(255.0f * std::clamp(at, 0.0f, 1.0f)));
        return {byte, byte, byte};
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

namespace {

/// The title, then the bar, if there is one.
void drawLine(host::Picture& picture, const Legend& legend, const Layout& layout, uint32_t left, uint32_t top) {
    const uint32_t scale = layout.scale, bar = layout.bar;
    picture.drawText(left, top + scale, legend.title, scale, kInk);
    const uint32_t barLeft = left + layout.textWidth(legend.title) + layout.gap;
    for (uint32_t x = 0; x < bar; ++x)
        fill(picture, barLeft + x, top, 1, layout.height,
             barColor(legend, static_cast<float>(x) / static_cast<float>(bar - 1)));
    for (const Legend::Mark& mark : legend.marks) {
        const uint32_t width = layout.textWidth(mark.text), room = bar - width - 2 * scale;
        const auto x =
            static_cast<uint32_t>(std::clamp(mark.at * static_cast<float>(bar) - 0.5f * static_cast<float>(width),
                                             static_cast<float>(2 * scale), static_cast<float>(room)));
        if (legend.bar == Legend::Bar::stripes)
            shade(picture, barLeft + x - scale, top, width + scale, layout.height);
        picture.drawText(barLeft + x, top + scale, mark.text, scale, isInkDark(legend, mark.at) ? kDarkInk : kInk);
    }
}

} // namespace

void drawLegend(host::Picture& picture, const Legend& legend) {
    const Layout layout(picture, legend);
    if (layout.width + 2 * layout.gap > picture.width || layout.height + 4 * layout.gap > picture.height)
        return;
    const uint32_t left = picture.width - layout.width - layout.gap;
    const uint32_t top = picture.height - layout.height - 2 * layout.gap;
    shade(picture, left, top - layout.gap / 2, layout.width, layout.height + layout.gap);
    if (!legend.swatches.empty())
        drawSwatches(picture, legend, layout, left + layout.gap, top);
    else
        drawLine(picture, legend, layout, left + layout.gap, top);
}

} // namespace supple::tools
