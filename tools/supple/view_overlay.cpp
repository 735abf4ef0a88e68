#include "tools/supple/view_overlay.h"

#if SUPPLE_HAS_WINDOW

#include "tools/supple/command.h"
#include "tools/supple/legend.h"

#include <algorithm>
#include <imgui.h>

namespace supple::tools {

namespace {

/// Bones from joint to joint.
void drawJoints(const ViewStage& stage, float aspect) {
    const std::vector<ViewStage::ShownJoint> joints = stage.shownJoints(aspect);
    const std::vector<uint32_t>& parents = stage.figure().jointParents();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto place = [&](const ViewStage::ShownJoint& joint) {
        return ImVec2(joint.at.x * size.x, joint.at.y * size.y);
    };
    const ImU32 ink = IM_COL32(255, 255, 255, 220), rim = IM_COL32(0, 0, 0, 160);
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (size_t i = 0; i < joints.size(); ++i) {
        if (!joints[i].seen)
            continue;
        if (parents[i] != SUPPLE_NO_JOINT && joints[parents[i]].seen) {
            draw.AddLine(place(joints[parents[i]]), place(joints[i]), rim, 3.0f);
            draw.AddLine(place(joints[parents[i]]), place(joints[i]), ink, 1.5f);
        }
        draw.AddCircleFilled(place(joints[i]), 4.0f, rim);
        draw.AddCircleFilled(place(joints[i]), 3.0f,
                             i == stage.settings.joint ? ImGui::GetColorU32(ImGuiCol_CheckMark) : ink);
    }
}

/// What makes the figure soft, and in the upper right corner what the colors stand for.
void drawSoft(const ViewStage& stage, float aspect) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto packed = [](const std::array<uint8_t, 3>& color) { return IM_COL32(color[0], color[1], color[2], 230); };
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (const PlacedStroke& stroke : stage.shownStrokes(aspect)) {
        const ImVec2 from(stroke.from.x * size.x, stroke.from.y * size.y),
            to(stroke.to.x * size.x, stroke.to.y * size.y);
        if (stroke.isDot())
            draw.AddCircleFilled(from, 3.0f, packed(stroke.color));
        else
            draw.AddLine(from, to, packed(stroke.color), 1.5f);
    }
    const float line = ImGui::GetTextLineHeightWithSpacing(), side = ImGui::GetTextLineHeight();
    ImVec2 at(size.x - 260.0f, 16.0f);
    for (const SoftKey& key : softKeys(stage.softFacts(), stage.settings.soft)) {
        draw.AddRectFilled(at, ImVec2(at.x + side, at.y + side), packed(key.color));
        draw.AddText(ImVec2(at.x + line + 4.0f, at.y), ImGui::GetColorU32(ImGuiCol_Text), key.text.c_str());
        at.y += line;
    }
}

constexpr float kMargin = 16.0f, kInset = 12.0f, kBarHeight = 12.0f, kLeastWidth = 260.0f;

/// The box in the lower right corner for something of this size, which begins at the point returned.
ImVec2 drawBox(float width, float height) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const ImVec2 corner(size.x - kMargin - width - 2.0f * kInset, size.y - kMargin - height - kInset);
    ImGui::GetBackgroundDrawList()->AddRectFilled(corner, ImVec2(size.x - kMargin, size.y - kMargin),
                                                  IM_COL32(0, 0, 0, 160), 4.0f);
    return {corner.x + kInset, corner.y + 0.5f * kInset};
}

ImU32 packed(const std::array<uint8_t, 3>& color) {
    return IM_COL32(color[0], color[1], color[2], 255);
}

void drawSwatches(const Legend& legend) {
    const float line = ImGui::GetTextLineHeightWithSpacing(), side = ImGui::GetTextLineHeight();
    float width = 0.0f;
    for (const Legend::Swatch& swatch : legend.swatches)
        width = std::max(width, ImGui::CalcTextSize(swatch.text.c_str()).x);
    ImVec2 at = drawBox(width + line + kInset, line * static_cast<float>(legend.swatches.size()));
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (const Legend::Swatch& swatch : legend.swatches) {
        draw.AddRectFilled(at, ImVec2(at.x + side, at.y + side), packed(swatch.color));
        draw.AddText(ImVec2(at.x + line + kInset, at.y), ImGui::GetColorU32(ImGuiCol_Text), swatch.text.c_str());
        at.y += line;
    }
}

/// The title, with a bar below it if there is one.
void drawScale(const Legend& legend) {
    const float line = ImGui::GetTextLineHeightWithSpacing(), title = ImGui::CalcTextSize(legend.title.c_str()).x;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
    if (legend.bar == Legend::Bar::none) {
        draw.AddText(drawBox(title, line), ink, legend.title.c_str());
        return;
    }
    const float bar = std::max(kLeastWidth, title);
    const ImVec2 top = drawBox(bar, kBarHeight + 2.0f * line);
    draw.AddText(top, ink, legend.title.c_str());
    const ImVec2 left(top.x, top.y + line);
    const int steps = legend.bar == Legend::Bar::stripes ? 4 * static_cast<int>(legend.stripes) : 64;
    for (int i = 0; i < steps; ++i) {
        const float from = static_cast<float>(i) / static_cast<float>(steps),
                    to = static_cast<float>(i + 1) / static_cast<float>(steps);
        draw.AddRectFilled(ImVec2(left.x + from * bar, left.y), ImVec2(left.x + to * bar, left.y + kBarHeight),
                           packed(barColor(legend, 0.5f * (from + to))));
    }
    for (const Legend::Mark& mark : legend.marks) {
        const float half = 0.5f * ImGui::CalcTextSize(mark.text.c_str()).x;
        const float x = std::clamp(mark.at * bar - half, 0.0f, bar - 2.0f * half);
        draw.AddText(ImVec2(left.x + x, left.y + kBarHeight + 2.0f), ink, mark.text.c_str());
    }
}

} // namespace

void drawOverPicture(const ViewStage& stage, float aspect) {
    if (stage.settings.joints)
        drawJoints(stage, aspect);
    if (stage.settings.soft.any())
        drawSoft(stage, aspect);
    if (stage.settings.cageFaces)
        return;
    std::optional<Legend> legend = legendOf(stage.settings.view, viewFactsOf(stage.group(), stage.settings.joint));
    if (!legend)
        return;
    if (isMeasured(stage.settings.view))
        legend->title += ", " + printable(stage.measuredPose());
    if (legend->swatches.empty())
        drawScale(*legend);
    else
        drawSwatches(*legend);
}

void drawAnnouncement(const std::string& text) {
    const ImVec2 size = ImGui::GetIO().DisplaySize, own = ImGui::CalcTextSize(text.c_str());
    const ImVec2 at(0.5f * (size.x - own.x), 0.5f * (size.y - own.y));
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    draw.AddRectFilled(ImVec2(at.x - kInset, at.y - kInset), ImVec2(at.x + own.x + kInset, at.y + own.y + kInset),
                       IM_COL32(0, 0, 0, 200), 4.0f);
    draw.AddText(at, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

} // namespace supple::tools

#endif
