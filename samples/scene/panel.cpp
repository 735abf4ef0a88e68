#include "panel.h"

#include <imgui.h>

namespace market {

namespace {

void showTimes(const char* title, const std::vector<PassMilliseconds>& passes) {
    double sum = 0.0;
    for (const PassMilliseconds& pass : passes)
        sum += pass.milliseconds;
    if (!ImGui::BeginTable(title, 2))
        return;
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthFixed, 130.0f);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", title);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%8.2f ms", sum);
    for (const PassMilliseconds& pass : passes) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(pass.name.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%8.2f ms", pass.milliseconds);
    }
    ImGui::EndTable();
}

} // namespace

void showPanel(const PanelFacts& facts, PanelSettings& settings) {
    ImGui::SetNextWindowPos(ImVec2(16.0f, 16.0f), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(300.0f, 0.0f), ImGuiCond_FirstUseEver);
    ImGui::Begin("Market place");
    const SuppleViewStatistics& drawn = facts.statistics;
    ImGui::Text("%u characters, %u seen", facts.figures, drawn.drawnInstanceCount);
    constexpr uint32_t kLeast = 20'000;
    ImGui::SliderScalar("budget", ImGuiDataType_U32, &settings.budget, &kLeast, &facts.mostVertices, "%u",
                        ImGuiSliderFlags_Logarithmic);
    ImGui::Text("%u vertices of %u patches", drawn.vertexCount, drawn.patchCount);
    ImGui::Text("levels scaled by %.3f%s", static_cast<double>(drawn.levelScales[0]),
                drawn.shortfall != 0 ? ", and more" : "");
    if (drawn.droppedInstanceCount > 0)
        ImGui::Text("%u have no room", drawn.droppedInstanceCount);
    ImGui::Text("%u draws by %u indirect calls", facts.drawCount, facts.callCount);
    ImGui::Text("%.0f MiB in %u pieces",
                static_cast<double>(facts.memory.deviceLocal + facts.memory.hostVisible) / (1 << 20),
                facts.memory.allocationCount);
    ImGui::Checkbox("moves", &settings.moves);
    ImGui::SameLine();
    ImGui::Checkbox("paint levels", &settings.paint);
    ImGui::Separator();
    showTimes("Supple", facts.supple);
    showTimes("drawing", facts.drawing);
    ImGui::Text("a frame takes %.1f ms", facts.frameMilliseconds);
    ImGui::End();
}

} // namespace market
