#include "tools/supple/file_browser.h"

#include "base/utf8_path.h"
#include "tools/supple/command.h"

#include <imgui.h>

namespace supple::tools {

namespace {

constexpr float kBrowserWidth = 460.0f;
constexpr float kFolderHeight = 320.0f;

} // namespace

std::optional<std::string> FileBrowser::build(const std::vector<std::string>& recent) {
    std::optional<std::string> chosen;
    std::optional<std::filesystem::path> entered;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(size.x - 16.0f, 16.0f), ImGuiCond_Appearing, ImVec2(1.0f, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(kBrowserWidth, 0.0f), ImGuiCond_Appearing);
    if (ImGui::Begin("open a file", &open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::PushTextWrapPos(kBrowserWidth);
        ImGui::TextUnformatted(printable(utf8Text(folder_.path)).c_str());
        if (!folder_.fault.empty())
            ImGui::TextUnformatted(printable(folder_.fault).c_str());
        ImGui::PopTextWrapPos();
        if (ImGui::BeginChild("##folder", ImVec2(kBrowserWidth, kFolderHeight), true)) {
            if (folder_.path.has_parent_path() && ImGui::Selectable(".."))
                entered = folder_.path.parent_path();
            for (const std::string& name : folder_.folders) {
                if (ImGui::Selectable((printable(name) + "/").c_str()))
                    entered = folder_.path / name;
            }
            for (const std::string& name : folder_.files) {
                if (ImGui::Selectable(printable(name).c_str()))
                    chosen = utf8Text(folder_.path / utf8Path(name));
            }
            if (folder_.files.empty())
                ImGui::TextDisabled("no glTF, GLB or OBJ here");
        }
        ImGui::EndChild();
        if (!recent.empty())
            ImGui::TextDisabled("opened last");
        for (const std::string& file : recent) {
            if (ImGui::Selectable(printable(file).c_str()))
                chosen = file;
        }
    }
    ImGui::End();
    if (entered)
        enter(*entered);
    return chosen;
}

} // namespace supple::tools
