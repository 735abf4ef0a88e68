#include "tools/supple/view_panel.h"

#if SUPPLE_HAS_WINDOW

#include "base/utf8_path.h"
#include "tools/supple/command.h"
#include "tools/supple/view_keys.h"
#include "tools/supple/view_overlay.h"
#include "tools/supple/views.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <bit>
#include <filesystem>
#include <imgui.h>
#include <iterator>
#include <optional>
#include <span>

namespace supple::tools {

namespace {

constexpr int kViewKeysCount = 5; ///< views that have a key
constexpr float kRadiansPerPixel = 0.0085f;
constexpr float kLabelWidth = 72.0f;  ///< behind sliders and lists
constexpr float kListHeight = 150.0f; ///< of a list that may be long; longer ones scroll
const ImVec4 kFailureColor(1.0f, 0.5f, 0.4f, 1.0f);

/// Dragging and scrolling that the panel does not want.
void moveCamera(ViewStage& stage) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse)
        return;
    const float height = std::max(io.DisplaySize.y, 1.0f);
    const bool panKey = io.KeyShift;
    const auto justPressed = [](ImGuiMouseButton button) { return ImGui::IsMouseClicked(button); };
    if (justPressed(ImGuiMouseButton_Left) || justPressed(ImGuiMouseButton_Right) ||
        justPressed(ImGuiMouseButton_Middle))
        return; // how the mouse got there is no dragging
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f) && !panKey)
        stage.orbit(-io.MouseDelta.x * kRadiansPerPixel, io.MouseDelta.y * kRadiansPerPixel);
    else if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0.0f) ||
             ImGui::IsMouseDragging(ImGuiMouseButton_Middle, 0.0f) ||
             ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f))
        stage.pan(-io.MouseDelta.x / height, io.MouseDelta.y / height);
    if (io.MouseWheel != 0.0f)
        stage.zoom(io.MouseWheel);
}

void wishExport(const PanelState& state, ExportKind kind, PanelWishes& wishes) {
    const auto side = [](int pixels) { return static_cast<uint32_t>(std::clamp(pixels, 1, 16384)); };
    wishes.save = {kind, {side(state.exportSize[0]), side(state.exportSize[1])}, state.exportAlpha};
}

void handleKeys(PanelState& state, ViewStage& stage, float aspect, PanelWishes& wishes) {
    if (ImGui::GetIO().WantTextInput)
        return;
    const auto pressed = [&](int key) {
        return std::any_of(state.keys.begin(), state.keys.end(),
                           [&](const host::KeyPress& press) { return press.key == key; });
    };
    const auto isShifted = [&](int key) {
        return std::any_of(state.keys.begin(), state.keys.end(), [&](const host::KeyPress& press) {
            return press.key == key && (press.modifiers & GLFW_MOD_SHIFT) != 0;
        });
    };
    if (pressed(GLFW_KEY_SPACE))
        stage.settings.playing = !stage.settings.playing;
    for (int i = 0; i < kViewKeysCount; ++i) {
        if (pressed(GLFW_KEY_1 + i))
            stage.settings.view = kViews[i].view;
    }
    // The other views one after another, and back with Shift.
    constexpr auto kViewCount = static_cast<uint32_t>(std::size(kViews));
    if (pressed(GLFW_KEY_V))
        stage.settings.view = (stage.settings.view + (isShifted(GLFW_KEY_V) ? kViewCount - 1 : 1)) % kViewCount;
    if (pressed(GLFW_KEY_J))
        stage.settings.joints = !stage.settings.joints;
    if (pressed(GLFW_KEY_B))
        stage.settings.soft.springs = stage.settings.soft.colliders = stage.settings.soft.painted =
            !stage.settings.soft.any();
    if (pressed(GLFW_KEY_F1) || isShifted(GLFW_KEY_SLASH))
        stage.settings.keys = !stage.settings.keys;
    if (pressed(GLFW_KEY_P))
        stage.settings.panel = !stage.settings.panel;
    if (pressed(GLFW_KEY_C))
        stage.settings.cageOverlay = !stage.settings.cageOverlay;
    if (pressed(GLFW_KEY_S)) {
        stage.settings.split = !stage.settings.split;
        if (stage.hasFigure())
            stage.fitFigure(aspect);
    }
    if (pressed(GLFW_KEY_D))
        stage.settings.levels = !stage.settings.levels;
    if (pressed(GLFW_KEY_Z))
        stage.settings.levelsFrozen = !stage.settings.levelsFrozen;
    if (pressed(GLFW_KEY_O))
        state.browser.open = !state.browser.open;
    if (pressed(GLFW_KEY_L))
        stage.settings.look = stage.settings.look == Look::studio ? Look::automatic : Look::studio;
    if (pressed(GLFW_KEY_F) && stage.hasFigure())
        stage.frameFigure(aspect);
    if (pressed(GLFW_KEY_E) && stage.hasFigure())
        wishExport(state, ExportKind::picture, wishes);
    if (pressed(GLFW_KEY_K) && stage.hasFigure())
        wishExport(state, ExportKind::commandLine, wishes);
    wishes.windowPicture = pressed(GLFW_KEY_F12);
    wishes.close = pressed(GLFW_KEY_ESCAPE);
}

void buildFiles(PanelState& state, const ViewStage& stage, PanelWishes& wishes) {
    const auto shortName = [&](size_t i) {
        return printable(utf8Text(utf8Path(state.files[i].path).filename())) +
               (state.files[i].refused ? " (refused)" : "");
    };
    if (ImGui::Button("open"))
        state.browser.open = !state.browser.open;
    ImGui::SameLine();
    if (!stage.hasFigure()) {
        ImGui::TextDisabled("or drop a file here");
        return;
    }
    if (state.files.size() == 1) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(shortName(0).c_str());
        return;
    }
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##file", shortName(state.file).c_str())) {
        for (size_t i = 0; i < state.files.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(shortName(i).c_str(), i == state.file) && i != state.file)
                wishes.file = state.files[i].path;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
}

/// A second clip over the first one.
void buildCrossfade(ViewStage& stage) {
    ViewSettings& settings = stage.settings;
    const std::vector<host::Figure::Clip>& clips = stage.figure().clips();
    if (clips.size() < 2)
        return;
    const bool fades = settings.fadeClip < clips.size();
    if (ImGui::BeginCombo("fade to", fades ? printable(clips[settings.fadeClip].name).c_str() : "no other clip")) {
        if (ImGui::Selectable("no other clip", !fades))
            settings.fadeClip = SUPPLE_REST_POSE;
        for (uint32_t i = 0; i < clips.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(printable(clips[i].name).c_str(), settings.fadeClip == i))
                settings.fadeClip = i;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    if (fades)
        ImGui::SliderFloat("weight", &settings.fade, 0.0f, 1.0f, "%.2f");
}

/// How another clip is taken.
void buildChange(ViewSettings& settings) {
    struct Row {
        const char* name;
        std::optional<host::TransitionMethod> method;
    };
    static constexpr Row kRows[] = {{"at once", std::nullopt},
                                    {"crossfade", host::TransitionMethod::crossfade},
                                    {"dead blending", host::TransitionMethod::deadBlending},
                                    {"quintic", host::TransitionMethod::quintic}};
    const auto* const shown =
        std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& row) { return row.method == settings.change; });
    if (ImGui::BeginCombo("next clip", shown->name)) {
        for (const Row& row : kRows) {
            if (ImGui::Selectable(row.name, &row == shown))
                settings.change = row.method;
        }
        ImGui::EndCombo();
    }
    if (settings.change)
        ImGui::SliderFloat("seconds", &settings.changeSeconds, 0.05f, 1.0f, "%.2f s");
}

void buildPlayback(ViewStage& stage) {
    ViewSettings& settings = stage.settings;
    const std::vector<host::Figure::Clip>& clips = stage.figure().clips();
    const auto clipName = [&](uint32_t clip) {
        return clip < clips.size() ? printable(clips[clip].name) : std::string("rest pose");
    };
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##clip", clipName(settings.clip).c_str())) {
        for (uint32_t i = 0; i <= clips.size(); ++i) {
            const uint32_t clip = i < clips.size() ? i : SUPPLE_REST_POSE;
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(clipName(clip).c_str(), clip == settings.clip)) {
                settings.clip = clip;
                settings.time = 0.0;
            }
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    const double duration = stage.figure().clipDuration(settings.clip);
    if (duration <= 0.0)
        return;
    if (ImGui::Button(settings.playing ? "pause" : "play", ImVec2(60.0f, 0.0f)))
        settings.playing = !settings.playing;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    const double start = 0.0;
    if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &settings.time, &start, &duration, "%.2f s"))
        settings.playing = false;
    buildCrossfade(stage);
    if (clips.size() > 1)
        buildChange(settings);
    ImGui::SliderFloat("speed", &settings.speed, 0.05f, 3.0f, "%.2f x", ImGuiSliderFlags_Logarithmic);
}

/// What the surface is made by: a group of its own each.
void buildScheme(const ViewStage& stage, PanelWishes& wishes) {
    const SuppleScheme own = stage.scheme();
    if (ImGui::BeginCombo("scheme", schemeName(own))) {
        if (ImGui::Selectable("auto", own == SUPPLE_SCHEME_AUTO))
            wishes.scheme = SUPPLE_SCHEME_AUTO;
        for (const Scheme& scheme : kSchemes) {
            if (ImGui::Selectable(scheme.name, own == scheme.scheme))
                wishes.scheme = scheme.scheme;
        }
        ImGui::EndCombo();
    }
    int skinning = stage.skinning();
    if (ImGui::Combo("skinning", &skinning,
                     "linear\0dual quaternion\0centers of rotation\0delta mush\0light delta mush\0as the file says\0"))
        wishes.skinning = static_cast<SuppleSkinning>(skinning);
}

/// What is painted on the surface.
void buildView(ViewStage& stage) {
    ViewSettings& settings = stage.settings;
    if (ImGui::BeginCombo("view", kViews[settings.view].name)) {
        for (const NamedView& view : kViews) {
            if (ImGui::Selectable(view.name, settings.view == view.view))
                settings.view = view.view;
        }
        ImGui::EndCombo();
    }
    const std::vector<std::string>& joints = stage.figure().jointNames();
    if (joints.empty())
        return;
    if (settings.view == host::shared::kViewWeights &&
        ImGui::BeginCombo("joint", printable(joints[settings.joint]).c_str())) {
        for (uint32_t i = 0; i < joints.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(printable(joints[i]).c_str(), settings.joint == i))
                settings.joint = i;
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
}

/// What levels of detail are chosen by, and how much that is.
void buildLevels(ViewStage& stage) {
    ViewSettings& settings = stage.settings;
    ImGui::SliderFloat("error", &settings.chordError, 0.05f, 20.0f, "%.2f pixels", ImGuiSliderFlags_Logarithmic);
    ImGui::Checkbox("freeze", &settings.levelsFrozen);
    const std::optional<SuppleViewStatistics> drawn = stage.group().levelStatistics();
    if (!drawn)
        return;
    ImGui::SameLine();
    ImGui::TextDisabled("%u vertices", drawn->vertexCount);
    if (drawn->levelScales[0] < 1.0f)
        ImGui::TextDisabled("too many: levels are scaled by %.2f", static_cast<double>(drawn->levelScales[0]));
}

void buildRate(ViewStage& stage, PanelWishes& wishes) {
    ViewSettings& settings = stage.settings;
    if (stage.ratesArePowersOfTwo()) {
        // The slider moves the exponent, so that it stops at the rates there are and nowhere else.
        constexpr int kMaxExponent = static_cast<int>(std::bit_width(SUPPLE_MAX_RATE)) - 1;
        int exponent = static_cast<int>(std::bit_width(static_cast<uint32_t>(settings.rate))) - 1;
        ImGui::SliderInt("rate", &exponent, 1, kMaxExponent, std::to_string(settings.rate).c_str(),
                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
        settings.rate = 1 << exponent;
    } else {
        ImGui::SliderInt("rate", &settings.rate, 1, static_cast<int>(SUPPLE_MAX_RATE), "%d",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    }
    // A rate is a new group: made when the slider is let go, not at every step of it.
    if (ImGui::IsItemDeactivatedAfterEdit())
        wishes.rate = stage.offeredRate(static_cast<uint32_t>(settings.rate));
    uint32_t patches = 0, vertices = 0;
    for (const host::FigureSurface& surface : stage.group().surfaces()) {
        patches += surface.output.surface.patchCount;
        vertices += surface.output.grid.vertexCount;
    }
    ImGui::TextDisabled("%u patches, %u vertices", patches, vertices);
}

void buildSurface(ViewStage& stage, PanelWishes& wishes, float aspect) {
    ViewSettings& settings = stage.settings;
    buildScheme(stage, wishes);
    if (stage.group().hasLevels())
        buildLevels(stage);
    else
        buildRate(stage, wishes);
    buildView(stage);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("cage");
    ImGui::SameLine();
    ImGui::Checkbox("lines", &settings.cageOverlay);
    ImGui::SameLine();
    ImGui::Checkbox("alone", &settings.cageFaces);
    ImGui::SameLine();
    if (ImGui::Checkbox("beside", &settings.split))
        stage.fitFigure(aspect);
    ImGui::Checkbox("ground", &settings.ground);
    if (!stage.figure().jointNames().empty()) {
        ImGui::SameLine();
        ImGui::Checkbox("joints", &settings.joints);
    }
    ImGui::SameLine();
    // The view of levels has them anyway.
    bool levels = settings.levels || settings.view == host::shared::kViewLevels;
    ImGui::BeginDisabled(settings.view == host::shared::kViewLevels);
    if (ImGui::Checkbox("levels", &levels))
        settings.levels = levels;
    ImGui::EndDisabled();
}

/// What swings, jiggles and hangs: whether it does, what is shown of it, and what its numbers are multiplied by.
void buildSoft(ViewStage& stage, PanelWishes& wishes) {
    if (!stage.softFacts().any() || !ImGui::CollapsingHeader("springs and cloth", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    ViewSettings& settings = stage.settings;
    ImGui::Checkbox("move", &settings.simulate);
    ImGui::SameLine();
    ImGui::Checkbox("springs", &settings.soft.springs);
    ImGui::Checkbox("colliders", &settings.soft.colliders);
    ImGui::SameLine();
    ImGui::Checkbox("painted", &settings.soft.painted);
    struct Row {
        const char* name;
        float& factor;
    };
    for (const Row& row : {Row{"stiffness", settings.tuning.stiffness}, Row{"damping", settings.tuning.damping},
                           Row{"gravity", settings.tuning.gravity}}) {
        ImGui::SliderFloat(row.name, &row.factor, 0.1f, 10.0f, "%.2f x",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        // The file is loaded anew when the slider is let go.
        wishes.tune = wishes.tune || ImGui::IsItemDeactivatedAfterEdit();
    }
}

/// The height that a list takes, of which more scrolls.
float listHeight(float whole) {
    return std::min(whole + ImGui::GetStyle().WindowPadding.y, kListHeight);
}

void buildMorphs(ViewStage& stage) {
    const std::vector<host::NamedTargets>& morphs = stage.morphs();
    if (morphs.empty() || !ImGui::CollapsingHeader("morph targets"))
        return;
    const float rows = static_cast<float>(morphs.size()) * ImGui::GetFrameHeightWithSpacing();
    if (ImGui::BeginChild("##morphs", ImVec2(0.0f, listHeight(rows)))) {
        for (size_t i = 0; i < morphs.size(); ++i) {
            float weight = stage.morphWeight(morphs[i]);
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::SliderFloat(printable(morphs[i].name).c_str(), &weight, 0.0f, 1.0f))
                stage.setMorphWeight(morphs[i], weight);
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
    if (!stage.settings.morphWeights.empty() && ImGui::Button("as the clip has them"))
        stage.settings.morphWeights.clear();
}

void buildWarnings(const ViewStage& stage) {
    const std::vector<std::string>& warnings = stage.warnings();
    const std::string title = "warnings (" + std::to_string(warnings.size()) + ")###warnings";
    if (warnings.empty() || !ImGui::CollapsingHeader(title.c_str(), ImGuiTreeNodeFlags_DefaultOpen))
        return;
    const float width = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
    float height = 0.0f;
    for (const std::string& warning : warnings)
        height +=
            ImGui::CalcTextSize(printable(warning).c_str(), nullptr, false, width).y + ImGui::GetStyle().ItemSpacing.y;
    if (ImGui::BeginChild("##warnings", ImVec2(0.0f, listHeight(height)))) {
        for (const std::string& warning : warnings)
            ImGui::TextWrapped("%s", printable(warning).c_str());
    }
    ImGui::EndChild();
}

/// An eye, open or shut; whether it was clicked.
bool eyeButton(bool open) {
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton("eye", ImVec2(height * 1.3f, height));
    const ImU32 ink = ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_ButtonHovered
                                         : open                 ? ImGuiCol_Text
                                                                : ImGuiCol_TextDisabled);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 left(corner.x + 0.1f * height, corner.y + 0.5f * height);
    const ImVec2 right(left.x + 1.1f * height, left.y), middle(left.x + 0.55f * height, left.y);
    draw.AddBezierQuadratic(left, ImVec2(middle.x, middle.y + 0.6f * height), right, ink, 1.5f);
    if (open) {
        draw.AddBezierQuadratic(left, ImVec2(middle.x, middle.y - 0.6f * height), right, ink, 1.5f);
        draw.AddCircleFilled(middle, 0.14f * height, ink);
    }
    return clicked;
}

/// The parts of the figure, with an eye each. A click with Ctrl shows that part alone, or all again.
/// What a part is.
void buildPart(const ViewStage& stage, uint32_t index) {
    const SupplePartInfo& part = stage.figure().parts()[index];
    const SuppleScheme scheme = stage.group().schemeOfPart(index);
    ImGui::TextDisabled("%u faces, %s", part.faceCount, part.joint == SUPPLE_NO_JOINT ? "skinned" : "rigid");
    ImGui::TextDisabled("scheme %s", schemeName(scheme));
    if (scheme == part.scheme)
        ImGui::TextWrapped("%s", printable(part.schemeReason).c_str());
    for (const uint32_t material : std::span(part.materials, part.materialCount)) {
        const std::string name = stage.figure().materials().of(material).name;
        if (material != SUPPLE_NO_MATERIAL)
            ImGui::TextDisabled("material %s",
                                name.empty() ? std::to_string(material).c_str() : printable(name).c_str());
    }
}

void buildParts(ViewStage& stage) {
    const std::vector<std::string>& names = stage.figure().partNames();
    std::vector<bool>& shown = stage.settings.shownParts;
    if (names.size() < 2)
        return;
    const auto count = static_cast<size_t>(std::count(shown.begin(), shown.end(), true));
    const std::string title = std::to_string(count) + " of " + std::to_string(names.size()) + " parts###parts";
    if (eyeButton(count > 0))
        shown.assign(names.size(), count == 0);
    ImGui::SameLine();
    if (!ImGui::TreeNode(title.c_str()))
        return;
    for (size_t p = 0; p < names.size(); ++p) {
        ImGui::PushID(static_cast<int>(p));
        if (eyeButton(shown[p])) {
            const bool alone = ImGui::GetIO().KeyCtrl;
            const bool all = alone && count == 1 && shown[p];
            if (alone)
                shown.assign(names.size(), all);
            shown[p] = alone || !shown[p];
        }
        ImGui::SameLine();
        const std::string name = names[p].empty() ? "part " + std::to_string(p) : printable(names[p]);
        if (ImGui::TreeNode(name.c_str())) {
            buildPart(stage, static_cast<uint32_t>(p));
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    ImGui::TreePop();
}

constexpr ImU32 kTimeColors[] = {IM_COL32(74, 168, 224, 255),  IM_COL32(240, 183, 63, 255),
                                 IM_COL32(51, 196, 154, 255),  IM_COL32(224, 160, 196, 255),
                                 IM_COL32(143, 208, 247, 255), IM_COL32(245, 139, 76, 255),
                                 IM_COL32(167, 157, 240, 255), IM_COL32(201, 199, 95, 255)};
constexpr float kGraphHeight = 84.0f;

/// The last frames, the newest on the right: passes or parts one above the other, and the budget.
void buildGraph(const TimeHistory& history, float budgetMs) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, step = width / static_cast<float>(TimeHistory::kFrames);
    const float most = std::max({history.most(), 1.15f * budgetMs, 1e-3f});
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, ImVec2(corner.x + width, corner.y + kGraphHeight), ImGui::GetColorU32(ImGuiCol_FrameBg));
    for (size_t i = 0; i < history.frames(); ++i) {
        const float x = corner.x + width - step * static_cast<float>(history.frames() - i);
        float bottom = corner.y + kGraphHeight;
        for (size_t pass = 0; pass < history.row(i).size(); ++pass) {
            const float top = bottom - kGraphHeight * history.row(i)[pass] / most;
            draw.AddRectFilled(ImVec2(x, top), ImVec2(x + step, bottom), kTimeColors[pass % std::size(kTimeColors)]);
            bottom = top;
        }
    }
    if (budgetMs > 0.0f) {
        const float y = corner.y + kGraphHeight * (1.0f - budgetMs / most);
        draw.AddLine(ImVec2(corner.x, y), ImVec2(corner.x + width, y), ImGui::GetColorU32(kFailureColor), 1.5f);
    }
    char label[32];
    std::snprintf(label, sizeof label, "%.2f ms", static_cast<double>(most));
    draw.AddText(ImVec2(corner.x + 4.0f, corner.y + 2.0f), ImGui::GetColorU32(ImGuiCol_Text), label);
    ImGui::Dummy(ImVec2(width, kGraphHeight));
}

void buildTimings(const PanelState& state, ViewStage& stage) {
    ViewSettings& settings = stage.settings;
    const TimeHistory& history = settings.timingsByPart ? stage.partTimes() : stage.passTimes();
    ImGui::TextDisabled("%s", state.device.c_str());
    buildGraph(history, settings.budgetMs);
    int by = settings.timingsByPart ? 1 : 0;
    ImGui::RadioButton("by pass", &by, 0);
    ImGui::SameLine();
    ImGui::RadioButton("by part", &by, 1);
    settings.timingsByPart = by == 1;
    ImGui::SameLine();
    ImGui::Checkbox("pause", &settings.timingsPaused);
    float sum = 0.0f;
    for (size_t i = 0; i < history.names().size(); ++i) {
        sum += history.means()[i];
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, at.y + 3.0f), ImVec2(at.x + 10.0f, at.y + 13.0f),
                                                  kTimeColors[i % std::size(kTimeColors)]);
        ImGui::Text("   %-14.14s %8.3f ms", printable(history.names()[i]).c_str(),
                    static_cast<double>(history.means()[i]));
    }
    if (settings.timingsByPart)
        ImGui::TextWrapped("A scheme's parts share its time by their patches.");
    ImGui::Text("surface %.2f ms   frame %.1f ms", static_cast<double>(sum), state.frameMilliseconds);
    ImGui::SetNextItemWidth(90.0f);
    if (ImGui::InputFloat("budget ms", &settings.budgetMs, 0.0f, 0.0f, "%.2f"))
        settings.budgetMs = std::max(settings.budgetMs, 0.0f);
}

void buildKeys(ViewStage& stage) {
    if (!stage.settings.keys)
        return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(size.x - 16.0f, 16.0f), ImGuiCond_Always, ImVec2(1.0f, 0.0f));
    if (ImGui::Begin("keys", &stage.settings.keys,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings) &&
        ImGui::BeginTable("##keys", 2)) {
        for (const ViewKey& key : kViewKeys) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(key.keys);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", key.what);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

/// How pictures come about, and how far this one has come.
void buildLook(const PanelState& state, ViewSettings& settings) {
    int look = static_cast<int>(settings.look);
    if (ImGui::Combo("look", &look, "auto\0fast\0studio\0"))
        settings.look = static_cast<Look>(look);
    if (!state.timings)
        return;
    switch (state.step.kind) {
    case LookStep::Kind::studio:
        break;
    case LookStep::Kind::fast:
        ImGui::TextDisabled("fast, %.0f %% of the pixels",
                            100.0f * kFastScales[state.step.scaleIndex] * kFastScales[state.step.scaleIndex]);
        break;
    case LookStep::Kind::refine:
        ImGui::TextDisabled("refining, pass %u", state.step.pass + 1);
        break;
    case LookStep::Kind::keep:
        ImGui::TextDisabled("refined");
        break;
    }
}

/// Pictures of what is shown.
void buildExport(PanelState& state, const ViewSettings& settings, PanelWishes& wishes) {
    if (ImGui::CollapsingHeader("export")) {
        ImGui::InputInt2("pixels", state.exportSize);
        ImGui::Checkbox("alpha", &state.exportAlpha);
        if (ImGui::Button("picture"))
            wishExport(state, ExportKind::picture, wishes);
        ImGui::SameLine();
        if (ImGui::Button("sequence"))
            wishExport(state, ExportKind::sequence, wishes);
        ImGui::SameLine();
        if (ImGui::Button("animation"))
            wishExport(state, ExportKind::animation, wishes);
        if (ImGui::Button("copy the command line"))
            wishExport(state, ExportKind::commandLine, wishes);
        if (settings.fadeClip != SUPPLE_REST_POSE)
            ImGui::TextWrapped("The crossfade is left out: the command line has none.");
        if (settings.change)
            ImGui::TextWrapped("Transitions are left out: a picture shows the clip alone.");
        if (settings.tuning != host::Tuning())
            ImGui::TextWrapped("Other numbers of springs and cloth are left out: the file has its own.");
        if (settings.levelsFrozen)
            ImGui::TextWrapped("The frozen camera is left out: levels are chosen from where the picture is seen.");
    }
    if (!state.exported.empty())
        ImGui::TextWrapped("%s", printable(state.exported).c_str());
}

/// What the panel has, from above.
void buildSections(PanelState& state, ViewStage& stage, PanelWishes& wishes, float aspect) {
    buildFiles(state, stage, wishes);
    if (stage.hasFigure()) {
        buildPlayback(stage);
        ImGui::Separator();
        buildSurface(stage, wishes, aspect);
        buildSoft(stage, wishes);
        buildLook(state, stage.settings);
        buildMorphs(stage);
        buildWarnings(stage);
        buildParts(stage);
        buildExport(state, stage.settings, wishes);
        if (state.timings) {
            ImGui::Separator();
            buildTimings(state, stage);
        }
    }
    ImGui::TextDisabled("F1 shows the keys");
}

/// Why something could not be done, until it is closed.
void buildMessage(PanelState& state) {
    if (state.message.empty())
        return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    bool open = true;
    const float left = std::min(kPanelRight, 0.5f * size.x);
    ImGui::SetNextWindowPos(ImVec2(left, size.y - 16.0f), ImGuiCond_Always, ImVec2(0.0f, 1.0f));
    ImGui::SetNextWindowSize(ImVec2(std::min(560.0f, size.x - left - 16.0f), 0.0f), ImGuiCond_Always);
    if (ImGui::Begin("failed", &open, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse)) {
        ImGui::PushStyleColor(ImGuiCol_Text, kFailureColor);
        ImGui::TextWrapped("%s", printable(state.message).c_str());
        ImGui::PopStyleColor();
    }
    ImGui::End();
    if (!open)
        state.message.clear();
}

} // namespace

std::string panelText(const PanelState& state, const ViewStage& stage) {
    const Folder& folder = state.browser.folder();
    std::string text = utf8Text(folder.path) + folder.fault + state.message + state.exported;
    const auto add = [&](const std::vector<std::string>& names) {
        for (const std::string& name : names)
            text += name;
    };
    for (const PanelFile& file : state.files)
        text += file.path;
    add(folder.folders);
    add(folder.files);
    add(state.recent);
    if (!stage.hasFigure())
        return text;
    const host::Figure& figure = stage.figure();
    for (const host::Figure::Clip& clip : figure.clips())
        text += clip.name;
    for (const host::Figure::MorphTarget& morph : figure.morphTargets())
        text += morph.name;
    for (const SupplePartInfo& part : figure.parts()) {
        for (const uint32_t material : std::span(part.materials, part.materialCount))
            text += figure.materials().of(material).name;
    }
    add(figure.partNames());
    add(figure.jointNames());
    add(stage.warnings());
    return text;
}

PanelWishes buildPanel(PanelState& state, ViewStage& stage, float aspect) {
    PanelWishes wishes;
    if (stage.settings.panel) {
        ImGui::SetNextWindowPos(ImVec2(16.0f, 16.0f), ImGuiCond_FirstUseEver);
        ImGui::SetNextWindowSize(ImVec2(kPanelRight - 32.0f, 0.0f), ImGuiCond_Always);
        const float width = kPanelRight - 32.0f, height = std::max(ImGui::GetIO().DisplaySize.y - 32.0f, 64.0f);
        ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, height)); // scrolls beyond that
        if (ImGui::Begin("supple", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
            ImGui::PushItemWidth(-kLabelWidth);
            buildSections(state, stage, wishes, aspect);
            ImGui::PopItemWidth();
        }
        ImGui::End();
    }
    if (state.browser.open) {
        if (std::optional<std::string> chosen = state.browser.build(state.recent))
            wishes.file = std::move(chosen);
    }
    if (stage.hasFigure())
        drawOverPicture(stage, aspect);
    buildKeys(stage);
    buildMessage(state);
    if (stage.hasFigure()) {
        wishes.takeOff = buildPick(stage, aspect, state.picked);
        moveCamera(stage);
        wishes.pick = clickedPlace();
    }
    handleKeys(state, stage, aspect, wishes);
    return wishes;
}

} // namespace supple::tools

#endif
