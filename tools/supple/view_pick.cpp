#include "tools/supple/view_pick.h"

#if SUPPLE_HAS_WINDOW

#include "tools/supple/command.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <map>
#include <string>
#include <vector>

namespace supple::tools {
namespace {

/// A mouse that moves by more between press and release drags.
constexpr float kClickPixels = 3.0f;
constexpr size_t kMostJoints = 6; ///< that the window lists
constexpr int kMostHidden = 32;   ///< hits on hidden parts that a ray goes on behind

struct CameraRay {
    glm::vec3 origin{0.0f}, direction{0.0f};
};

CameraRay rayThrough(const ViewStage& stage, const glm::vec2& place, float aspect) {
    const host::Camera& camera = stage.camera();
    const glm::vec2 shifted(place.x - stage.surfaceShift(), place.y);
    return {camera.eye(), camera.directionThrough(shifted, aspect)};
}

/// How much each corner of the point's face has of the point, by straight lines.
std::vector<float> cornerShares(const host::CageMesh& cage, const SuppleSurfacePoint& point) {
    const uint32_t sides = cage.sides(point.face);
    const float a = point.a, b = point.b, rest = 1.0f - a - b;
    if (sides == 3) {
        return {rest, a, b};
    }
    if (sides == 4) {
        return {(1.0f - a) * (1.0f - b), a * (1.0f - b), a * b, (1.0f - a) * b};
    }
    std::vector<float> shares(sides, b / static_cast<float>(sides));
    shares[point.side] += rest;
    shares[(point.side + 1) % sides] += a;
    return shares;
}

std::vector<ViewPick::Joint> jointsAt(const ViewStage& stage, const SuppleSurfacePoint& point) {
    const host::CageMesh& cage = stage.figure().cage();
    const cage::SkinWeights& skin = stage.skinWeights();
    const std::vector<float> shares = cornerShares(cage, point);
    std::map<uint32_t, float> sums;
    for (uint32_t k = 0; k < shares.size() && !skin.starts.empty(); ++k) {
        const uint32_t vertex = cage.corners[cage.faceStarts[point.face] + k];
        for (uint32_t i = skin.starts[vertex]; i < skin.starts[vertex + 1]; ++i) {
            sums[skin.influences[i].joint] += shares[k] * skin.influences[i].weight;
        }
    }
    std::vector<ViewPick::Joint> joints;
    for (const auto& [number, weight] : sums) {
        if (weight > 0.0f) {
            joints.push_back({number, weight});
        }
    }
    std::stable_sort(joints.begin(), joints.end(),
                     [](const ViewPick::Joint& x, const ViewPick::Joint& y) { return x.weight > y.weight; });
    return joints;
}

const char* nameOr(const std::string& name, const char* other) {
    return name.empty() ? other : name.c_str();
}

void buildLines(const ViewStage& stage, const ViewPick& pick) {
    const std::string part = printable(nameOr(stage.figure().partNames()[pick.part], "no name"));
    ImGui::Text("part %u, %s", pick.part, part.c_str());
    ImGui::Text("face %u, u %.4f, v %.4f", pick.point.face, double{pick.point.a}, double{pick.point.b});
    if (stage.figure().cage().sides(pick.point.face) > 4) {
        ImGui::Text("side %u", pick.point.side);
    }
    ImGui::Text("at %.4g, %.4g, %.4g", double{pick.position.x}, double{pick.position.y}, double{pick.position.z});
    for (size_t k = 0; k < std::min(pick.joints.size(), kMostJoints); ++k) {
        const ViewPick::Joint& joint = pick.joints[k];
        const std::string name = printable(nameOr(stage.figure().jointNames()[joint.number], "no name"));
        ImGui::Text("%5.1f %%  %s", 100.0 * double{joint.weight}, name.c_str());
    }
    if (pick.joints.size() > kMostJoints) {
        ImGui::TextDisabled("and %u more", static_cast<unsigned>(pick.joints.size() - kMostJoints));
    }
}

/// What clicks attach. Returns whether the last one is to be taken off.
bool buildProps(ViewStage& stage) {
    ImGui::Separator();
    ImGui::TextUnformatted("a click attaches");
    int chosen = static_cast<int>(stage.settings.prop);
    static constexpr const char* kNames[] = {"nothing", "a lantern", "an arrow", "a sticker"};
    for (int prop = 0; prop < 4; ++prop) {
        ImGui::RadioButton(kNames[prop], &chosen, prop);
    }
    stage.settings.prop = static_cast<Prop>(chosen);
    return !stage.attached().empty() && ImGui::Button("take the last one off");
}

void drawMarker(const ViewStage& stage, float aspect, const ViewPick& pick) {
    const glm::vec4 at =
        stage.camera().projection(aspect, 1.0f) * stage.camera().view() * glm::vec4(pick.position, 1.0f);
    if (at.w <= 0.0f) {
        return;
    }
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const ImVec2 place((stage.surfaceShift() + 0.5f + 0.5f * at.x / at.w) * size.x,
                       (0.5f - 0.5f * at.y / at.w) * size.y);
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddCircle(place, 6.0f, IM_COL32(0, 0, 0, 200), 0, 3.5f);
    draw.AddCircle(place, 6.0f, IM_COL32(255, 255, 255, 255), 0, 1.5f);
}

/// What a ray meets first of the deformed cage's surface.
Result<std::optional<ViewPick>> cast(const ViewStage& stage, const std::vector<glm::vec3>& cage, const CameraRay& ray) {
    const host::Figure& figure = stage.figure();
    ViewPick pick;
    SuppleSurfaceJet jet{};
    SupplePointQuery query{};
    query.structSize = sizeof query;
    query.kind = SUPPLE_FIND_RAY;
    query.count = 1;
    query.values = &ray.origin.x;
    query.cage = &cage.front().x;
    query.cageVertexCount = static_cast<uint32_t>(cage.size());
    query.jets = &jet;
    host::Context& context = figure.context();
    const Status found = context.check(suppleFindPoints(context.handle(), stage.group().handle(), &query, &pick.point),
                                       "suppleFindPoints");
    if (!found) {
        return found.error();
    }
    if (pick.point.face == SUPPLE_NO_FACE) {
        return std::optional<ViewPick>();
    }
    pick.part = figure.cage().parts.empty() ? 0 : figure.cage().parts[pick.point.face];
    pick.position = {jet.position[0], jet.position[1], jet.position[2]};
    pick.joints = jointsAt(stage, pick.point);
    pick.version = stage.shown().version;
    pick.clip = stage.settings.clip;
    pick.time = stage.settings.time;
    return std::optional(std::move(pick));
}

} // namespace

Result<std::optional<ViewPick>> pickAt(const ViewStage& stage, const glm::vec2& place, float aspect) {
    const Result<std::vector<glm::vec3>> cage = stage.group().readCage();
    if (!cage) {
        return cage.error();
    }
    CameraRay ray = rayThrough(stage, place, aspect);
    const glm::vec3 eye = ray.origin;
    for (int hidden = 0; hidden < kMostHidden; ++hidden) {
        Result<std::optional<ViewPick>> pick = cast(stage, *cage, ray);
        if (!pick || !pick->has_value() || stage.settings.shownParts[(*pick)->part]) {
            return pick;
        }
        ray.origin = (*pick)->position + 1e-4f * ((*pick)->position - eye);
    }
    return std::optional<ViewPick>();
}

std::optional<glm::vec2> clickedPlace() {
    const ImGuiIO& io = ImGui::GetIO();
    const bool isClick = ImGui::IsMouseReleased(ImGuiMouseButton_Left) && !io.KeyCtrl && !io.KeyShift &&
                         io.MouseDragMaxDistanceSqr[0] < kClickPixels * kClickPixels;
    return isClick && !io.WantCaptureMouse && io.DisplaySize.x > 0.0f && io.DisplaySize.y > 0.0f
               ? std::optional(glm::vec2(io.MousePos.x / io.DisplaySize.x, io.MousePos.y / io.DisplaySize.y))
               : std::nullopt;
}

bool buildPick(ViewStage& stage, float aspect, std::optional<ViewPick>& pick) {
    if (pick && pick->version != stage.shown().version) {
        pick.reset();
    }
    if (!pick) {
        return false;
    }
    if (pick->clip == stage.settings.clip && pick->time == stage.settings.time) {
        drawMarker(stage, aspect, *pick);
    }
    bool open = true, takeOff = false;
    ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - 16.0f, 16.0f), ImGuiCond_Appearing,
                            ImVec2(1.0f, 0.0f));
    if (ImGui::Begin("picked", &open,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoCollapse)) {
        buildLines(stage, *pick);
        takeOff = buildProps(stage);
    }
    ImGui::End();
    if (!open) {
        pick.reset();
    }
    return takeOff;
}

} // namespace supple::tools

#endif
