// supple points: where points of a surface are in a pose, and how they are turned, as the device has them.
#include "base/utf8_path.h"
#include "tools/supple/command.h"
#include "tools/supple/output_files.h"
#include "tools/supple/posed_file.h"
#include "tools/supple/progress.h"
#include "tools/supple/text_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/glm.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace supple::tools {
namespace {

using PointsJson = nlohmann::json;

struct PointsOptions {
    std::string file, points, output;
    bool onVertices = false;
    SurfaceFlags surface;
    std::string clip; ///< name or index; empty: the bind pose
    double time = 0.0;
    std::vector<host::MorphSetting> morphs;
    DeviceFlags device;
};

/// What the file of points says.
struct GivenPoints {
    std::vector<SuppleSurfacePoint> points;
    /// Those that are of triangles of the file, by their numbers among `points`, where they are put once they are
    /// found.
    std::vector<std::pair<size_t, SuppleGltfPoint>> gltf;
    std::vector<float> tangents; ///< three a point; zeros where the file has none
};

/// A whole number of an object, or nothing: it is something else.
std::optional<uint32_t> wholeNumber(const PointsJson& value) {
    return value.is_number_integer() && value >= 0 && value <= int64_t{UINT32_MAX}
               ? std::optional(value.get<uint32_t>())
               : std::nullopt;
}

/// Keeps a point with its tangent, if it has one. The fault, or an empty text.
std::string takeTangent(const PointsJson& entry, const SuppleSurfacePoint& point, GivenPoints& out) {
    std::array<float, 3> tangent{};
    if (entry.contains("tangent")) {
        const PointsJson& given = entry["tangent"];
        if (!given.is_array() || given.size() != 3 || !given[0].is_number() || !given[1].is_number() ||
            !given[2].is_number()) {
            return "tangent is not three numbers";
        }
        tangent = {given[0].get<float>(), given[1].get<float>(), given[2].get<float>()};
    }
    out.points.push_back(point);
    out.tangents.insert(out.tangents.end(), tangent.begin(), tangent.end());
    return {};
}

/// The point of a triangle; nothing if the entry does not say it whole, or its weights do not add up to 1.
std::optional<SuppleGltfPoint> gltfPoint(const PointsJson& entry) {
    const auto number = [&](const char* key) { return entry.contains(key) ? wholeNumber(entry[key]) : std::nullopt; };
    const std::optional<uint32_t> mesh = number("mesh"), primitive = number("primitive"), triangle = number("triangle");
    const auto isWeight = [](const PointsJson& value) { return value.is_number(); };
    if (!mesh || !primitive || !triangle || !entry.contains("weights") || !entry["weights"].is_array() ||
        entry["weights"].size() != 3 || !std::all_of(entry["weights"].begin(), entry["weights"].end(), isWeight)) {
        return std::nullopt;
    }
    const auto weights = entry["weights"].get<std::array<float, 3>>();
    if (!(std::abs(weights[0] + weights[1] + weights[2] - 1.0f) < 1e-3f)) {
        return std::nullopt;
    }
    return SuppleGltfPoint{*mesh, *primitive, *triangle, weights[1], weights[2]};
}

/// The fault of one entry, or an empty text.
std::string takePoint(const PointsJson& entry, const cage::Character& character, GivenPoints& out) {
    const auto has = [&](const char* key) { return entry.is_object() && entry.contains(key); };
    if (has("triangle")) {
        const std::optional<SuppleGltfPoint> point = gltfPoint(entry);
        if (!point) {
            return "needs mesh, primitive, triangle and weights that add up to 1: "
                   R"({"mesh":0,"primitive":0,"triangle":7,"weights":[0.2,0.3,0.5]})";
        }
        out.gltf.emplace_back(out.points.size(), *point);
        return takeTangent(entry, SuppleSurfacePoint{}, out);
    }
    const std::optional<uint32_t> face = has("face") ? wholeNumber(entry["face"]) : std::nullopt;
    if (!face || !has("u") || !has("v") || !entry["u"].is_number() || !entry["v"].is_number()) {
        return "needs face, u and v: {\"part\":0,\"face\":12,\"u\":0.5,\"v\":0.25}";
    }
    SuppleSurfacePoint point{*face, 0, entry["u"].get<float>(), entry["v"].get<float>()};
    if (has("side")) {
        const std::optional<uint32_t> side = wholeNumber(entry["side"]);
        if (!side) {
            return "side is no whole number";
        }
        point.side = *side;
    }
    if (has("part")) {
        const std::string text = entry["part"].is_string() ? entry["part"].get<std::string>() : entry["part"].dump();
        const Result<uint32_t> part = host::findNamed(character.name, "part", host::partNames(character), text);
        if (!part) {
            return part.error().message;
        }
        const cage::Part& of = character.parts[*part];
        if (point.face < of.firstFace || point.face >= cage::endFace(character, *part)) {
            return "face " + std::to_string(point.face) + " is not of part " + text + ", which has the faces " +
                   std::to_string(of.firstFace) + " to " + std::to_string(cage::endFace(character, *part) - 1);
        }
    }
    return takeTangent(entry, point, out);
}

Result<GivenPoints> readPoints(const std::string& path, const cage::Character& character) {
    std::ifstream file(utf8Path(path), std::ios::binary);
    if (!file) {
        return Error{ErrorCode::io, path + ": cannot be read"};
    }
    const PointsJson json = PointsJson::parse(file, nullptr, false);
    if (!json.is_array()) {
        return Error{ErrorCode::asset, path + ": is no JSON list of points"};
    }
    if (json.empty()) {
        return Error{ErrorCode::asset, path + ": has no points"};
    }
    GivenPoints points;
    for (size_t p = 0; p < json.size(); ++p) {
        if (const std::string fault = takePoint(json[p], character, points); !fault.empty()) {
            std::string reason = path + ": point ";
            reason += std::to_string(p) + ": " + fault;
            return Error{ErrorCode::asset, std::move(reason)};
        }
    }
    return points;
}

/// Puts the points of the file's triangles among the others.
Status findGltf(host::Context& context, SuppleGroup group, GivenPoints& given) {
    std::vector<SuppleGltfPoint> asked;
    for (const auto& [number, point] : given.gltf) {
        asked.push_back(point);
    }
    std::vector<SuppleSurfacePoint> found(asked.size());
    SupplePointQuery query{};
    query.structSize = sizeof query;
    query.kind = SUPPLE_FIND_GLTF;
    query.count = static_cast<uint32_t>(asked.size());
    query.gltf = asked.data();
    Status status = context.check(suppleFindPoints(context.handle(), group, &query, found.data()), "suppleFindPoints");
    for (size_t k = 0; k < found.size() && status; ++k) {
        if (found[k].face == SUPPLE_NO_FACE) {
            return Error{ErrorCode::argument,
                         "point " + std::to_string(given.gltf[k].first) + ": no face has the triangle"};
        }
        given.points[given.gltf[k].first] = found[k];
    }
    return status;
}

/// The sets that a group gets for the frame.
struct PointSets {
    SupplePointSet frames{}, derivatives{};

    [[nodiscard]] Status create(host::Context& context, SuppleGroup group, const GivenPoints& points, bool onVertices) {
        SupplePointSetDesc desc{};
        desc.structSize = sizeof desc;
        desc.group = group;
        desc.points = points.points.data();
        desc.pointCount = static_cast<uint32_t>(points.points.size());
        desc.tangents = points.tangents.data();
        desc.flags = onVertices ? SUPPLE_POINT_SET_ON_VERTICES : 0;
        desc.format = SUPPLE_POINT_FRAME_64;
        Status status = context.check(suppleCreatePointSet(context.handle(), &desc, &frames), "suppleCreatePointSet");
        desc.flags = 0;
        desc.format = SUPPLE_POINT_DERIVATIVES_32;
        return status
                   ? context.check(suppleCreatePointSet(context.handle(), &desc, &derivatives), "suppleCreatePointSet")
                   : status;
    }
};

/// Elements of four floats that a set has for the one instance.
Result<std::vector<glm::vec4>> readSet(Session& session, SupplePointSet set) {
    SupplePointOutput output{};
    output.structSize = sizeof output;
    const Status status =
        session.context->check(suppleGetPointOutput(session.context->handle(), set, &output), "suppleGetPointOutput");
    if (!status) {
        return status.error();
    }
    const Result<std::vector<std::byte>> bytes = session.device->readBuffer(output.frames);
    if (!bytes) {
        return bytes.error();
    }
    std::vector<glm::vec4> elements(bytes->size() / sizeof(glm::vec4));
    std::memcpy(elements.data(), bytes->data(), elements.size() * sizeof(glm::vec4));
    return elements;
}

void writeVector(TextFile& file, const char* name, const glm::vec3& v) {
    file.text(",\"").text(name).text("\":[").number(v.x).text(",").number(v.y).text(",").number(v.z).text("]");
}

Status writePoints(const std::string& path, const GivenPoints& given, const std::vector<glm::vec4>& frames,
                   const std::vector<glm::vec4>& derivatives) {
    TextFile file(path);
    for (size_t p = 0; p < given.points.size(); ++p) {
        const SuppleSurfacePoint& point = given.points[p];
        const glm::vec4* const rows = &frames[4 * p];
        const auto column = [&](int c) { return glm::vec3(rows[0][c], rows[1][c], rows[2][c]); };
        file.text(p == 0 ? "[" : ",\n ").text("{\"face\":").number(uint64_t{point.face});
        file.text(",\"side\":").number(uint64_t{point.side});
        file.text(",\"u\":").number(point.a).text(",\"v\":").number(point.b);
        writeVector(file, "position", column(3));
        writeVector(file, "normal", column(2));
        writeVector(file, "tangent", column(0));
        writeVector(file, "bitangent", column(1));
        writeVector(file, "du", glm::vec3(derivatives[2 * p]));
        writeVector(file, "dv", glm::vec3(derivatives[2 * p + 1]));
        file.text(",\"area\":").number(rows[3].w).text("}");
    }
    return file.text("]\n").close();
}

Status evaluatePoints(Session& session, const host::CharacterFile& file, const PointsOptions& options, const Pose& pose,
                      GivenPoints given) {
    const Result<SuppleAsset> asset = host::createAsset(*session.context, file);
    if (!asset) {
        return asset.error();
    }
    PointSets sets;
    const Result<Evaluation> evaluated =
        evaluate(session, *asset, file.character, options.surface, pose, 0, [&](SuppleGroup group) {
            Status found = given.gltf.empty() ? success() : findGltf(*session.context, group, given);
            return found ? sets.create(*session.context, group, given, options.onVertices) : found;
        });
    if (!evaluated) {
        return evaluated.error();
    }
    const Result<std::vector<glm::vec4>> frames = readSet(session, sets.frames);
    const Result<std::vector<glm::vec4>> derivatives = frames ? readSet(session, sets.derivatives) : frames.error();
    return derivatives ? writePoints(options.output, given, *frames, *derivatives) : Status(derivatives.error());
}

int runPoints(const PointsOptions& options) {
    const Result<PosedFile> posed =
        readPosed(options.file, options.surface.reading, options.clip, options.time, options.morphs);
    if (!posed) {
        return fail(kExitBadInput, posed.error().message);
    }
    const Result<GivenPoints> given = readPoints(options.points, posed->file.character);
    if (!given) {
        return fail(kExitBadInput, given.error().message);
    }
    const int code = withSession(options.device, [&](Session& session) {
        return evaluatePoints(session, posed->file, options, posed->pose, *given);
    });
    if (code == kExitOk) {
        tellWritten(options.output);
    }
    return code;
}

} // namespace

void bindPoints(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<PointsOptions>();
    CLI::App* command = app.add_subcommand("points", "Frames at points of the surface, in a pose");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command
        ->add_option(
            "--points", options->points,
            "JSON list of points: {\"part\":name or index,\"face\":source face,\"u\":..,\"v\":..}; with faces of "
            "five and more sides also \"side\"; of a glTF file also "
            "{\"mesh\":..,\"primitive\":..,\"triangle\":..,\"weights\":[..]}; \"tangent\":[x,y,z] of the bind pose on "
            "request")
        ->required()
        ->type_name("P.json");
    command->add_option("-o,--output", options->output, "JSON: position, normal, tangent, bitangent, du, dv, area")
        ->required()
        ->type_name("OUT.json");
    command->add_flag("--on-vertices", options->onVertices,
                      "Points that lie where a surface vertex is have its position, to the bit");
    bindSurface(*command, options->surface, {"cage"});
    bindPose(*command, options->clip, options->time);
    bindMorphs(*command, options->morphs);
    bindDevice(*command, options->device);
    command->callback([options, &exitCode] {
        std::vector<std::string> inputs = inputsOf(options->file, options->surface.reading.clipFiles);
        inputs.push_back(options->points);
        checkOutputs(inputs, {{"--output", options->output}});
        exitCode = runPoints(*options);
    });
}

} // namespace supple::tools
