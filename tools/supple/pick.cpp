// supple pick: what a ray, a pixel of a picture or a place meets of a surface in a pose.
#include "host/camera.h"
#include "tools/common/formatted.h"
#include "tools/supple/command.h"
#include "tools/supple/device_pick.h"
#include "tools/supple/output_files.h"
#include "tools/supple/posed_file.h"
#include "tools/supple/progress.h"
#include "tools/supple/render.h"
#include "tools/supple/render_stage.h"
#include "tools/supple/text_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::tools {
namespace {

struct PickOptions {
    std::string file, output;        ///< no output: stdout
    std::string ray, pixel, closest; ///< one of them is there
    std::string size = "1280x960";   ///< of the picture that the pixel is of
    bool onDevice = false;           ///< it is asked, not suppleFindPoints
    double yaw = DrawOptions{}.yaw, pitch = DrawOptions{}.pitch;
    SurfaceFlags surface;
    std::string clip; ///< name or index; empty: the bind pose
    double time = 0.0;
    std::vector<host::MorphSetting> morphs;
    DeviceFlags device;
};

/// What the surface is asked for.
struct Aim {
    SupplePointQueryKind kind = SUPPLE_FIND_RAY;
    std::array<float, 6> values{}; ///< of a ray; or of a place, its first three
};

/// Numbers with commas between, all finite; false leaves them undefined.
template <size_t N>
bool parseNumbers(const std::string& text, std::array<float, N>& out) {
    const char* at = text.c_str();
    for (size_t k = 0; k < N; ++k) {
        int read = 0;
        if (std::sscanf(at, k == 0 ? "%f%n" : ",%f%n", &out[k], &read) != 1 || !std::isfinite(out[k])) {
            return false;
        }
        at += read;
    }
    return *at == '\0';
}

template <size_t N>
CLI::Validator numbers(const char* form) {
    return {[form](const std::string& text) {
                std::array<float, N> values;
                return parseNumbers(text, values) ? std::string() : text + " is not " + form;
            },
            form};
}

/// The ray through the middle of a pixel of the picture that supple render draws of the pose.
Result<Aim> aimAtPixel(const PickOptions& options, const std::vector<glm::vec3>& figure) {
    const Result<VkExtent2D> size = parseSize(options.size);
    if (!size) {
        return size.error();
    }
    std::array<float, 2> pixel{};
    const glm::vec2 extent(size->width, size->height);
    if (!parseNumbers(options.pixel, pixel) || pixel[0] < 0.0f || pixel[1] < 0.0f || pixel[0] >= extent.x ||
        pixel[1] >= extent.y) {
        return Error{ErrorCode::range, "--at " + options.pixel + ": the picture has " + options.size + " pixels"};
    }
    const host::Camera camera =
        host::frameCamera(figure, radians(options.yaw), radians(options.pitch), extent.x / extent.y, kPictureMargin);
    const glm::vec2 place = (glm::vec2(pixel[0], pixel[1]) + 0.5f) / extent;
    const glm::vec3 origin = camera.eye(), direction = camera.directionThrough(place, extent.x / extent.y);
    return Aim{SUPPLE_FIND_RAY, {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z}};
}

Result<Aim> aimOf(const PickOptions& options, const std::vector<glm::vec3>& figure) {
    if (!options.pixel.empty()) {
        return aimAtPixel(options, figure);
    }
    Aim aim;
    if (!options.closest.empty()) {
        std::array<float, 3> place{};
        aim.kind = SUPPLE_FIND_NEAREST;
        (void)parseNumbers(options.closest, place); // the command line has checked it
        std::copy(place.begin(), place.end(), aim.values.begin());
        return aim;
    }
    (void)parseNumbers(options.ray, aim.values);
    return aim;
}

/// What is found, as the JSON says it.
struct Picked {
    SuppleSurfacePoint point{};
    uint32_t part = 0;
    std::string partName;
    glm::vec3 position{0.0f}, normal{0.0f};
    double distance = 0.0;
};

std::string vectorText(const glm::vec3& v) {
    return formatted("[%.9g,%.9g,%.9g]", double{v.x}, double{v.y}, double{v.z});
}

std::string textOf(const std::optional<Picked>& picked) {
    if (!picked) {
        return "null\n";
    }
    const SuppleSurfacePoint& point = picked->point;
    std::string text = "{\"part\":" + std::to_string(picked->part);
    text += ",\"partName\":" +
            nlohmann::json(picked->partName).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text += ",\"face\":" + std::to_string(point.face) + ",\"side\":" + std::to_string(point.side);
    text += formatted(",\"u\":%.9g,\"v\":%.9g", double{point.a}, double{point.b});
    text += ",\"position\":" + vectorText(picked->position) + ",\"normal\":" + vectorText(picked->normal);
    return text + formatted(",\"distance\":%.9g}\n", picked->distance);
}

glm::vec3 vectorOf(const float* v) {
    return {v[0], v[1], v[2]};
}

/// The normal of a jet, outwards also where the pose mirrors the surface. Zero where there is no tangent plane.
glm::vec3 normalOf(const SuppleSurfaceJet& jet, bool isMirrored) {
    const glm::dvec3 across = glm::cross(glm::dvec3(vectorOf(jet.du)), glm::dvec3(vectorOf(jet.dv)));
    const double length = glm::length(across);
    return length > 0.0 ? glm::vec3((isMirrored ? -1.0 : 1.0) / length * across) : glm::vec3(0.0f);
}

double distanceOf(const Aim& aim, const glm::vec3& position) {
    return glm::distance(glm::dvec3(vectorOf(aim.values.data())), glm::dvec3(position));
}

/// The vertices of the deformed cage, and of its surfaces: what a picture holds.
struct PosedFigure {
    std::vector<glm::vec3> cage, shown;
};
PosedFigure figureOf(const Evaluation& evaluation, const cage::Cage& cage) {
    PosedFigure figure;
    const SuppleBufferRange& range = evaluation.surfaces.front().output.info.deformedCage;
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        figure.cage.push_back(element<glm::vec3>(evaluation.deformedCage, range, v));
    }
    for (const EvaluatedSurface& surface : evaluation.surfaces) {
        const SuppleBufferRange& vertices = surface.output.streams.vertices;
        for (uint32_t v = 0; v < surface.output.grid.vertexCount; ++v) {
            figure.shown.push_back(element<glm::vec3>(surface.vertices, vertices, v));
        }
    }
    if (figure.shown.empty()) { // the cage itself is drawn
        figure.shown = figure.cage;
    }
    return figure;
}

/// What the device finds. The normal of a hit is turned outwards already.
Result<std::optional<Picked>> askDevice(Session& session, SuppleGroup group, const Aim& aim) {
    const std::array<float, 6>& v = aim.values;
    const SupplePlace place{{v[0], v[1], v[2]}, std::numeric_limits<float>::infinity()};
    const SuppleRay ray{{v[0], v[1], v[2]}, 0.0f, {v[3], v[4], v[5]}, std::numeric_limits<float>::infinity()};
    SuppleQueryDesc asked{};
    asked.hostPlaces = aim.kind == SUPPLE_FIND_NEAREST ? &place : nullptr;
    asked.hostRays = aim.kind == SUPPLE_FIND_RAY ? &ray : nullptr;
    const auto hit = pickOnDevice(session, group, asked);
    if (!hit) {
        return hit.error();
    }
    if (!*hit) {
        return std::optional<Picked>();
    }
    Picked picked;
    picked.point = (*hit)->point;
    picked.position = vectorOf((*hit)->position);
    picked.normal = vectorOf((*hit)->normal);
    return std::optional(picked);
}

/// What suppleFindPoints finds in the deformed cage.
Result<std::optional<Picked>> askCpu(Session& session, SuppleGroup group, const Aim& aim,
                                     const std::vector<glm::vec3>& cage, const Evaluation& evaluation) {
    Picked picked;
    SuppleSurfaceJet jet{};
    SupplePointQuery query{};
    query.structSize = sizeof query;
    query.kind = aim.kind;
    query.count = 1;
    query.values = aim.values.data();
    query.cage = &cage[0].x;
    query.cageVertexCount = static_cast<uint32_t>(cage.size());
    query.jets = &jet;
    const Status found = session.context->check(
        suppleFindPoints(session.context->handle(), group, &query, &picked.point), "suppleFindPoints");
    if (!found) {
        return found.error();
    }
    if (picked.point.face == SUPPLE_NO_FACE) {
        return std::optional<Picked>();
    }
    picked.position = vectorOf(jet.position);
    picked.normal = normalOf(jet, evaluation.mirroredFaces[picked.point.face] != 0);
    return std::optional(picked);
}

/// Looks for the aim on the group's surfaces, as the frame has deformed them.
Result<std::optional<Picked>> pick(Session& session, SuppleGroup group, const cage::Character& character,
                                   const Evaluation& evaluation, const PickOptions& options) {
    const PosedFigure figure = figureOf(evaluation, character.cage);
    const Result<Aim> aim = aimOf(options, figure.shown);
    if (!aim) {
        return aim.error();
    }
    auto picked =
        options.onDevice ? askDevice(session, group, *aim) : askCpu(session, group, *aim, figure.cage, evaluation);
    if (picked && *picked) {
        const std::vector<uint32_t>& parts = character.cage.faceParts;
        Picked& own = **picked;
        own.part = parts.empty() ? 0 : parts[own.point.face];
        own.partName = character.parts[own.part].name;
        own.distance = distanceOf(*aim, own.position);
    }
    return picked;
}

Status pickIn(Session& session, const host::CharacterFile& file, const PickOptions& options, const Pose& pose,
              std::string& text) {
    const Result<SuppleAsset> asset = host::createAsset(*session.context, file);
    if (!asset) {
        return asset.error();
    }
    SuppleGroup group{};
    const Result<Evaluation> evaluated =
        evaluate(session, *asset, file.character, options.surface, pose, 0, [&](SuppleGroup made) {
            group = made;
            return success();
        });
    if (!evaluated) {
        return evaluated.error();
    }
    const auto picked = pick(session, group, file.character, *evaluated, options);
    if (!picked) {
        return picked.error();
    }
    text = textOf(*picked);
    return options.output.empty() ? success() : writeTextFile(options.output, text);
}

int runPick(const PickOptions& options) {
    const Result<PosedFile> posed =
        readPosed(options.file, options.surface.reading, options.clip, options.time, options.morphs);
    if (!posed) {
        return fail(kExitBadInput, posed.error().message);
    }
    std::string text;
    const int code = withSession(
        options.device, [&](Session& session) { return pickIn(session, posed->file, options, posed->pose, text); });
    if (code == kExitOk && options.output.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
    } else if (code == kExitOk) {
        tellWritten(options.output);
    }
    return code;
}

/// What is looked for: one of three.
void bindAim(CLI::App& command, PickOptions& options) {
    CLI::Option_group* const aim = command.add_option_group("What is looked for");
    aim->add_option("--ray", options.ray, "What a ray meets first: its origin and its direction")
        ->check(numbers<6>("OX,OY,OZ,DX,DY,DZ"));
    aim->add_option("--at", options.pixel,
                    "What is seen in a pixel of the picture that supple render draws, counted from the upper left")
        ->check(numbers<2>("PX,PY"));
    aim->add_option("--closest", options.closest, "The nearest point to a place")->check(numbers<3>("X,Y,Z"));
    aim->require_option(1);
    command.add_flag("--on-device", options.onDevice, "Let the device look, as suppleRecordQueries does");
    const HelpGroup heading(command, "Camera");
    bindSize(command, "--size", options.size, "With --at: of the picture");
    command.add_option("--yaw", options.yaw, "With --at: degrees; 0 looks at the front")
        ->check(CLI::Range(-360.0, 360.0))
        ->capture_default_str();
    command.add_option("--pitch", options.pitch, "With --at: degrees; positive looks down")
        ->check(CLI::Range(-89.0, 89.0))
        ->capture_default_str();
}

} // namespace

void bindPick(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<PickOptions>();
    CLI::App* command = app.add_subcommand("pick", "What a ray, a pixel or a place meets of the surface, in a pose");
    command->footer("Prints JSON: part, partName, face, side, u, v, position, normal and distance; null if nothing is "
                    "met.\n\nExamples:\n"
                    "  supple pick hero.glb --ray 0,1.5,3,0,0,-1 --clip walk --time 0.4\n"
                    "  supple pick hero.glb --at 640,300\n"
                    "  supple pick hero.glb --closest 0.3,1.2,0.1 --scheme pm");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command->add_option("-o,--output", options->output, "A file for the JSON, instead of printing it")
        ->type_name("OUT.json");
    bindAim(*command, *options);
    bindSurface(*command, options->surface, {"cage"});
    bindPose(*command, options->clip, options->time);
    bindMorphs(*command, options->morphs);
    bindDevice(*command, options->device);
    command->callback([options, &exitCode] {
        if (!options->output.empty()) {
            checkOutputs(inputsOf(options->file, options->surface.reading.clipFiles), {{"--output", options->output}});
        }
        exitCode = runPick(*options);
    });
}

} // namespace supple::tools
