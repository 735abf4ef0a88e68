// supple inspect: what a character file holds, and which schemes take it. Needs no device; --compare, which evaluates
// every scheme's surface, and --memory do.
#include "cage/message.h"
#include "cage/topology.h"
#include "skinning/clip_packer.h"
#include "skinning/clip_table.h"
#include "skinning/contacts.h"
#include "skinning/packed_clip.h"
#include "skinning/update_errors.h"
#include "surface/schemes.h"
#include "tools/common/character_file.h"
#include "tools/common/formatted.h"
#include "tools/supple/command.h"
#include "tools/supple/compare.h"
#include "tools/supple/folds.h"
#include "tools/supple/inspect_drivers.h"
#include "tools/supple/inspect_materials.h"
#include "tools/supple/inspect_parts.h"
#include "tools/supple/inspect_soft.h"
#include "tools/supple/memory_report.h"
#include "tools/supple/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::tools {
namespace {

struct InspectOptions {
    std::string file;
    bool json = false;
    bool compare = false;
    bool memory = false;
    SurfaceFlags surface; ///< of its fields those that --compare and --memory have flags for; `reading` always
    std::string clip;     ///< name or index; empty: the bind pose
    ClipPacking packing;
    double time = 0.0;
    DeviceFlags device;
};

using Histogram = std::map<uint32_t, uint32_t>; ///< value -> how many

struct SchemeVerdict {
    const char* scheme;
    std::string refusal;                     ///< empty: accepted
    std::vector<uint32_t> refusedFaces;      ///< where the reason lies in single faces
    std::map<std::string, uint32_t> patches; ///< class -> how many
    std::vector<std::string> notes;
    Folds folds; ///< P_m
};

/// The crease sets by name, and how many creases each has.
std::vector<std::pair<std::string, size_t>> creaseSetSizes(const cage::Cage& cage) {
    std::vector<std::pair<std::string, size_t>> sizes;
    for (uint32_t set = 0; set < cage.creaseSets.size(); ++set) {
        sizes.emplace_back(cage.creaseSets[set],
                           std::count_if(cage.creases.begin(), cage.creases.end(),
                                         [&](const cage::Crease& crease) { return crease.set == set; }));
    }
    return sizes;
}

/// What is not stored in the character itself but counted from it.
struct Findings {
    Histogram sides;
    std::optional<cage::Topology> topology;
    std::string topologyFault;
    Histogram interiorValences;
    Histogram boundaryValences; ///< faces round a boundary vertex
    uint32_t boundaryEdges = 0;
    uint32_t mostInfluences = 0;
    std::vector<SchemeVerdict> schemes;
};

SchemeVerdict judge(const Scheme& scheme, const cage::Cage& cage) {
    SchemeVerdict verdict{scheme.name, "", {}, {}, {}, {}};
    surface::Recipe recipe;
    recipe.scheme = static_cast<surface::SchemeId>(scheme.scheme);
    recipe.rate = SurfaceFlags{}.rate;
    const Result<surface::Tables> tables = surface::buildTables(recipe, cage);
    if (!tables) {
        verdict.refusal = tables.error().message;
        for (uint32_t face = 0; scheme.scheme == SUPPLE_SCHEME_PREP && face < cage.faceCount(); ++face) {
            if (cage.sides(face) != 4) {
                verdict.refusedFaces.push_back(face);
            }
        }
        return verdict;
    }
    for (const surface::PatchInfo& patch : tables->patches) {
        ++verdict.patches[surface::className(patch.patchClass)];
    }
    verdict.notes = tables->notes;
    if (scheme.scheme == SUPPLE_SCHEME_PM) {
        if (const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage)) {
            verdict.folds = findFolds(*mesh);
        }
    }
    return verdict;
}

Findings examine(const cage::Character& character) {
    const cage::Cage& cage = character.cage;
    Findings findings;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        ++findings.sides[cage.sides(face)];
    }
    for (size_t v = 0; v + 1 < character.weights.starts.size(); ++v) {
        findings.mostInfluences =
            std::max(findings.mostInfluences, character.weights.starts[v + 1] - character.weights.starts[v]);
    }
    Result<cage::Topology> topology = cage::buildTopology(cage);
    if (topology) {
        for (uint32_t vertex = 0; vertex < cage.vertexCount(); ++vertex) {
            Histogram& valences =
                topology->boundary[vertex] != 0 ? findings.boundaryValences : findings.interiorValences;
            ++valences[topology->sectorCount(vertex)];
        }
        for (const cage::Topology::Edge& edge : topology->edges) {
            findings.boundaryEdges += edge.twin == cage::kNone ? 1 : 0;
        }
        findings.topology = std::move(*topology);
    } else {
        findings.topologyFault = topology.error().message;
    }
    for (const Scheme& scheme : kSchemes) {
        findings.schemes.push_back(judge(scheme, cage));
    }
    return findings;
}

double share(uint64_t part, uint64_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
}

/// Faces named in the report of folds.
constexpr size_t kWorstFaces = 5;

nlohmann::ordered_json toJson(const Folds& folds) {
    nlohmann::ordered_json json;
    json["faces"] = folds.faces.size();
    json["flippedShare"] = share(folds.flipped, folds.triangles);
    json["all"] = nlohmann::ordered_json::array();
    for (const Folds::Face& face : folds.faces) {
        json["all"].push_back(face.face);
    }
    json["worst"] = nlohmann::ordered_json::array();
    for (size_t i = 0; i < std::min(kWorstFaces, folds.faces.size()); ++i) {
        const Folds::Face& face = folds.faces[i];
        json["worst"].push_back({{"face", face.face}, {"flippedShare", share(face.flipped, face.triangles)}});
    }
    return json;
}

nlohmann::ordered_json toJson(const Histogram& histogram) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [value, count] : histogram) {
        json[std::to_string(value)] = count;
    }
    return json;
}

/// What is compared is written as fractions of the extent, and in asset units beside them.
nlohmann::ordered_json toJson(const InspectOptions& options, const Comparison& comparison) {
    using Json = nlohmann::ordered_json;
    Json json;
    json["reference"] = "catmull-clark";
    json["rate"] = options.surface.rate;
    json["clip"] = options.clip.empty() ? Json() : Json(options.clip);
    json["time"] = options.time;
    json["extent"] = comparison.extent;
    json["measuringError"] = comparison.measuringError / comparison.extent;
    for (const SchemeDeviation& scheme : comparison.schemes) {
        Json& entry = json["schemes"][scheme.scheme];
        entry["accepted"] = scheme.refusal.empty();
        if (!scheme.refusal.empty()) {
            entry["reason"] = scheme.refusal;
            continue;
        }
        entry["patches"] = scheme.patches;
        entry["samples"] = scheme.samples;
        entry["distance"] = {{"max", scheme.max / comparison.extent}, {"mean", scheme.mean / comparison.extent}};
        entry["distanceInUnits"] = {{"max", scheme.max}, {"mean", scheme.mean}};
        entry["worstFace"] = scheme.worstFace;
        entry["normals"] = scheme.normals;
        entry["normalDegrees"] = {{"max", scheme.maxDegrees}, {"mean", scheme.meanDegrees}};
        entry["worstNormalFace"] = scheme.worstNormalFace;
        entry["notes"] = scheme.notes;
    }
    return json;
}

/// What one character takes, under the scheme that each part is given by itself.
struct MemoryFindings {
    SuppleMemoryUse asset{}, group{};
};

Result<MemoryFindings> measureMemory(Session& session, const host::CharacterFile& file, const SurfaceFlags& surface) {
    host::Context& context = *session.context;
    const Result<SuppleAsset> asset = host::createAsset(context, file);
    if (!asset) {
        return asset.error();
    }
    SuppleGroupDesc desc{};
    desc.structSize = sizeof desc;
    desc.asset = *asset;
    desc.capacity = 1;
    desc.rate = surface.rate;
    desc.uvInterpolation = uvInterpolationOf(surface.uvMode);
    desc.flags = SUPPLE_GROUP_ATTRIBUTES;
    SuppleGroup group{};
    MemoryFindings found;
    found.asset.structSize = found.group.structSize = sizeof(SuppleMemoryUse);
    Status status = context.check(suppleCreateGroup(context.handle(), &desc, &group), "suppleCreateGroup");
    status = status ? context.evaluate({&group, 1}) : status; // uploads the tables
    if (status) {                                             // and frees what they were staged in
        const uint64_t frame = context.nextFrame();
        status = context.check(suppleBeginFrame(context.handle(), frame, frame - 1), "suppleBeginFrame");
    }
    if (status) {
        status = context.check(suppleGetAssetMemory(context.handle(), *asset, &found.asset), "suppleGetAssetMemory");
    }
    if (status) {
        status = context.check(suppleGetGroupMemory(context.handle(), group, &found.group), "suppleGetGroupMemory");
    }
    if (!status) {
        return status.error();
    }
    return found;
}

/// What a packed clip takes in the clip table, and how much less that is than before. Its twin comes on top.
struct PackedFacts {
    size_t bytes = 0;
    double ratio = 1.0;
    size_t segmentBytes = 0, twinBytes = 0; ///< of a clip with a twin
};
PackedFacts packedFacts(const skinning::NodeOrder& order, const cage::Clip& clip) {
    PackedFacts facts;
    facts.twinBytes = clip.packed.coarseWords.size() * sizeof(uint32_t);
    facts.segmentBytes = facts.twinBytes > 0 ? skinning::segmentWords(clip.packed.words) * sizeof(uint32_t) : 0;
    facts.bytes = skinning::clipBytes(order, clip) - facts.twinBytes;
    facts.ratio = static_cast<double>(clip.packed.unpackedBytes) / static_cast<double>(facts.bytes);
    return facts;
}
nlohmann::ordered_json packedIn(const skinning::NodeOrder& order, const cage::Clip& clip) {
    const PackedFacts facts = packedFacts(order, clip);
    nlohmann::ordered_json json = {{"bytes", facts.bytes}, {"ratio", facts.ratio}, {"error", clip.packed.error}};
    if (facts.twinBytes > 0) {
        json["segmentBytes"] = facts.segmentBytes;
        json["twin"] = {{"bytes", facts.twinBytes}, {"error", clip.packed.coarseError}};
    }
    return json;
}
/// When a clip's feet stand: where a --plant of theirs holds them.
nlohmann::ordered_json contactsIn(const cage::Character& character, const skinning::Contacts& contacts, size_t clip) {
    auto list = nlohmann::ordered_json::array();
    for (size_t foot = 0; foot < contacts.feet.size(); ++foot) {
        for (const skinning::Contact& contact : contacts.of(clip, foot)) {
            nlohmann::ordered_json entry = {{"begin", contact.begin}, {"end", contact.end}};
            entry["joint"] = character.skeleton.nodes[contacts.feet[foot].node].name;
            list.push_back(std::move(entry));
        }
    }
    return list;
}

/// How far off it is to be posed every 2, 4 or 8 steps of 1/60 s; null if nobody knows.
nlohmann::ordered_json updateErrors(const skinning::UpdateErrors& errors) {
    nlohmann::ordered_json every = {{"closes", errors.closes}};
    for (size_t n = 0; n < errors.every.size(); ++n) {
        every["every" + std::to_string(size_t{2} << n)] = errors.every[n]; // infinity becomes null
    }
    return every;
}

/// What was measured on a device, if asked for.
struct Measured {
    std::optional<Comparison> comparison;
    std::optional<MemoryFindings> memory;
};

void printJson(const InspectOptions& options, const cage::Character& character, const Findings& findings,
               const Measured& measured) {
    using Json = nlohmann::ordered_json;
    const cage::Cage& cage = character.cage;
    Json json;
    json["file"] = options.file;
    json["polygonSource"] = cage::polygonSourceName(character.parts[0].polygonSource);
    json["weldSource"] = cage::weldSourceName(character.parts[0].weldSource);
    const std::optional<cage::UvMode> uvMode = character.parts[0].uvMode;
    json["uvMode"] = uvMode ? Json(cage::uvModeName(*uvMode)) : Json();
    const std::optional<cage::SkinningMode> skinning = character.parts[0].skinning;
    json["skinning"] = skinning ? Json(cage::skinningModeName(*skinning)) : Json();
    const std::optional<cage::Smoothing> smoothing = character.parts[0].smoothing;
    json["smoothing"] =
        smoothing ? Json({{"lambda", smoothing->lambda}, {"iterations", smoothing->iterations}}) : Json();
    json["parts"] = partsToJson(character);
    json["vertices"] = cage.vertexCount();
    json["faces"] = cage.faceCount();
    json["corners"] = cage.cornerCount();
    json["sides"] = toJson(findings.sides);
    if (findings.topology) {
        json["edges"] = findings.topology->edges.size();
        json["boundaryEdges"] = findings.boundaryEdges;
        json["valences"] = {{"interior", toJson(findings.interiorValences)},
                            {"boundary", toJson(findings.boundaryValences)}};
    } else {
        json["topologyFault"] = findings.topologyFault;
    }
    json["sourceVertices"] = character.sourceVertexCount;
    json["seamVertices"] = character.seamVertexCount;
    json["uvSets"] = (cage.cornerUvs.empty() ? 0 : 1) + (cage.cornerUvs1.empty() ? 0 : 1);
    json["creases"] = cage.creases.size();
    json["creaseSets"] = Json::array();
    for (const auto& [name, edges] : creaseSetSizes(cage)) {
        json["creaseSets"].push_back({{"name", name}, {"edges", edges}});
    }
    json["creaseScalars"] = cage.creaseScalars.size();
    json["sharpVertices"] = cage.sharpVertices.size();
    json["holes"] = cage.holes.size();
    json["morphTargets"] = Json::array();
    for (const cage::MorphTarget& target : character.morphs.targets) {
        json["morphTargets"].push_back({{"name", target.name}, {"vertices", target.vertices.size()}});
    }
    json["expressions"] = Json::array();
    for (const cage::Expression& expression : character.expressions) {
        json["expressions"].push_back({{"name", expression.name}, {"morphTargets", expression.targets.size()}});
    }
    json["drivers"] = driversToJson(character);
    json["jiggles"] = jigglesToJson(character);
    json["cloths"] = clothsToJson(character);
    json["springs"] = Json::array();
    for (const cage::Spring& spring : character.springBones.springs) {
        json["springs"].push_back({{"name", spring.name}, {"joints", spring.joints.size()}});
    }
    json["springColliders"] = character.springBones.colliders.size();
    json["colors"] = !cage.cornerColors.empty();
    json["joints"] = character.skin.joints.size();
    json["mostInfluences"] = findings.mostInfluences;
    json["clips"] = Json::array();
    const skinning::Contacts contacts = skinning::findContacts(character);
    const skinning::UpdateFacts updates = skinning::measureUpdates(character);
    const skinning::NodeOrder order = skinning::nodeOrder(character);
    for (const cage::Clip& clip : character.clips) {
        Json markers = Json::array();
        for (const cage::Marker& marker : clip.markers) {
            markers.push_back({{"name", marker.name}, {"time", marker.time}});
        }
        Json entry = {{"name", clip.name}, {"duration", clip.duration}};
        entry["markers"] = std::move(markers);
        if (!clip.packed.words.empty()) {
            entry["packed"] = packedIn(order, clip);
        }
        entry["contacts"] = contactsIn(character, contacts, json["clips"].size());
        entry["updateErrors"] = updateErrors(updates.ofClips[json["clips"].size()]);
        json["clips"].push_back(std::move(entry));
    }
    json["materials"] = Json::array();
    for (const cage::Material& material : character.materials) {
        json["materials"].push_back(materialJson(material));
    }
    json["materialVariants"] = character.materialVariants;
    json["images"] = Json::array();
    for (const cage::Image& image : character.images) {
        json["images"].push_back({{"name", image.name}, {"mimeType", image.mimeType}, {"bytes", image.bytes.size()}});
    }
    json["warnings"] = character.warnings;
    json["schemes"] = Json::object();
    for (const SchemeVerdict& verdict : findings.schemes) {
        Json& entry = json["schemes"][verdict.scheme];
        entry["accepted"] = verdict.refusal.empty();
        if (!verdict.refusal.empty()) {
            entry["reason"] = verdict.refusal;
            entry["faces"] = verdict.refusedFaces;
            continue;
        }
        entry["patches"] = Json::object();
        for (const auto& [name, count] : verdict.patches) {
            entry["patches"][name] = count;
        }
        entry["notes"] = verdict.notes;
        if (!verdict.folds.faces.empty()) {
            entry["folds"] = toJson(verdict.folds);
        }
    }
    if (measured.memory) {
        json["memory"] = {{"rate", options.surface.rate},
                          {"asset", memoryJson(measured.memory->asset)},
                          {"group", memoryJson(measured.memory->group)}};
    }
    if (measured.comparison) {
        json["comparison"] = toJson(options, *measured.comparison);
    }
    // Names come from the file as they are: replace what is not UTF-8 rather than refuse to print it.
    std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

std::string toText(const Histogram& histogram) {
    std::string text;
    for (const auto& [value, count] : histogram) {
        text += (text.empty() ? "" : ", ") + std::to_string(value) + ": " + std::to_string(count);
    }
    return text.empty() ? "none" : text;
}

std::string percent(uint64_t part, uint64_t whole) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share(part, whole));
    return text;
}

std::string toText(const Folds& folds) {
    std::string text = std::to_string(folds.faces.size()) + (folds.faces.size() == 1 ? " face, " : " faces, ") +
                       percent(folds.flipped, folds.triangles) + " of the surface's grid turned over; worst:";
    for (size_t i = 0; i < std::min(kWorstFaces, folds.faces.size()); ++i) {
        const Folds::Face& face = folds.faces[i];
        text += (i == 0 ? " face " : ", face ") + std::to_string(face.face) + " (" +
                percent(face.flipped, face.triangles) + ")";
    }
    return text;
}

void printLine(const char* label, const std::string& text) {
    std::printf("%-18s %s\n", label, printable(text).c_str());
}

void printPacked(const skinning::NodeOrder& order, const cage::Clip& clip) {
    const PackedFacts facts = packedFacts(order, clip);
    char text[128];
    std::snprintf(text, sizeof text, "     packed: %zu bytes, %.1f:1, error %.2g extents", facts.bytes, facts.ratio,
                  clip.packed.error);
    printLine("", text);
    if (facts.twinBytes > 0) {
        std::snprintf(text, sizeof text,
                      "     streamed: %zu bytes of segments; coarse twin: %zu bytes, error %.2g extents",
                      facts.segmentBytes, facts.twinBytes, clip.packed.coarseError);
        printLine("", text);
    }
}

/// What VRM files have besides.
void printVrm(const cage::Character& character) {
    if (!character.expressions.empty()) {
        printLine("expressions", std::to_string(character.expressions.size()));
    }
    for (const cage::Expression& expression : character.expressions) {
        printLine("", expression.name + "  " + std::to_string(expression.targets.size()) + " morph targets");
    }
    const cage::SpringBones& bones = character.springBones;
    if (!bones.springs.empty()) {
        printLine("spring bones", std::to_string(bones.springs.size()) + ", with " +
                                      std::to_string(bones.colliders.size()) + " colliders");
    }
    for (const cage::Spring& spring : bones.springs) {
        printLine("", (spring.name.empty() ? character.skeleton.nodes[spring.joints[0].node].name : spring.name) +
                          "  " + std::to_string(spring.joints.size()) + " joints");
    }
}

void printText(const InspectOptions& options, const Comparison& comparison) {
    const auto pose = [&] {
        char time[32];
        std::snprintf(time, sizeof time, " at %.3f s", options.time);
        return options.clip.empty() ? std::string("bind pose") : "clip " + options.clip + time;
    };
    std::printf(
        "\nAgainst the Catmull-Clark limit surface: %s, rate %u. Distances as fractions of the extent, %.6g, and"
        " in asset\nunits; measured to %.0e of the extent.\n\n",
        printable(pose()).c_str(), options.surface.rate, comparison.extent,
        comparison.measuringError / comparison.extent);
    std::printf("  %-14s %9s %9s  %10s %10s  %9s %9s %9s  %s\n", "scheme", "largest", "mean", "largest", "mean",
                "normals", "mean", "samples", "largest at");
    for (const SchemeDeviation& scheme : comparison.schemes) {
        if (!scheme.refusal.empty()) {
            std::printf("  %-14s %s\n", scheme.scheme.c_str(), printable("refused: " + scheme.refusal).c_str());
            continue;
        }
        std::printf("  %-14s %9.1e %9.1e  %10.3g %10.3g  %8.2f\u00b0 %8.3f\u00b0 %9llu  face %u, normals face %u\n",
                    scheme.scheme.c_str(), scheme.max / comparison.extent, scheme.mean / comparison.extent, scheme.max,
                    scheme.mean, scheme.maxDegrees, scheme.meanDegrees, static_cast<unsigned long long>(scheme.samples),
                    scheme.worstFace, scheme.worstNormalFace);
    }
    std::printf("\n");
    for (const SchemeDeviation& scheme : comparison.schemes) {
        for (const std::string& note : scheme.notes) {
            std::printf("  %s: %s\n", scheme.scheme.c_str(), printable(note).c_str());
        }
    }
}

void printText(const InspectOptions& options, const cage::Character& character, const Findings& findings,
               const Measured& measured) {
    const cage::Cage& cage = character.cage;
    printLine("file", options.file);
    printLine("parts", std::to_string(character.parts.size()));
    for (const std::string& line : partLines(character)) {
        printLine("", line);
    }
    printLine("polygons from", cage::polygonSourceName(character.parts[0].polygonSource));
    printLine("welded by", cage::weldSourceName(character.parts[0].weldSource));
    if (const std::optional<cage::UvMode> uvMode = character.parts[0].uvMode) {
        printLine("UV interpolation", cage::uvModeName(*uvMode));
    }
    if (const std::optional<cage::SkinningMode> skinning = character.parts[0].skinning) {
        printLine("skinning", cage::skinningModeName(*skinning));
    }
    if (const std::optional<cage::Smoothing> smoothing = character.parts[0].smoothing) {
        printLine("smoothing",
                  formatted("lambda %g, %u iterations", static_cast<double>(smoothing->lambda), smoothing->iterations));
    }
    printLine("vertices", std::to_string(cage.vertexCount()) + " (" + std::to_string(character.sourceVertexCount) +
                              " in the file, " + std::to_string(character.seamVertexCount) + " merged at seams)");
    printLine("faces", std::to_string(cage.faceCount()));
    printLine("  by sides", toText(findings.sides));
    if (findings.topology) {
        printLine("edges", std::to_string(findings.topology->edges.size()) + ", " +
                               std::to_string(findings.boundaryEdges) + " on the boundary");
        printLine("interior valences", toText(findings.interiorValences));
        printLine("boundary valences", toText(findings.boundaryValences));
    } else {
        printLine("topology", "not a manifold: " + findings.topologyFault);
    }
    printLine(
        "creases",
        std::to_string(cage.creases.size()) + ", sharp vertices " + std::to_string(cage.sharpVertices.size()) +
            ", holes " + std::to_string(cage.holes.size()) +
            (cage.creaseScalars.empty() ? "" : ", crease scalars of P_m " + std::to_string(cage.creaseScalars.size())));
    for (const auto& [name, edges] : creaseSetSizes(cage)) {
        printLine("", "set " + cage::quoted(name) + ": " + std::to_string(edges) + (edges == 1 ? " edge" : " edges"));
    }
    printLine("morph targets", std::to_string(character.morphs.targets.size()));
    if (!character.drivers.empty()) {
        printLine("pose drivers", std::to_string(character.drivers.size()));
    }
    for (const std::string& line : driverLines(character)) {
        printLine("", line);
    }
    if (!character.jiggles.empty()) {
        printLine("jiggles", std::to_string(character.jiggles.size()));
    }
    for (const std::string& line : jiggleLines(character)) {
        printLine("", line);
    }
    if (!character.cloths.empty()) {
        printLine("cloths", std::to_string(character.cloths.size()));
    }
    for (const std::string& line : clothLines(character)) {
        printLine("", line);
    }
    printVrm(character);
    printLine("joints", std::to_string(character.skin.joints.size()) + ", at most " +
                            std::to_string(findings.mostInfluences) + " a vertex");
    printLine("clips", std::to_string(character.clips.size()));
    const skinning::NodeOrder order = skinning::nodeOrder(character);
    for (size_t i = 0; i < character.clips.size(); ++i) {
        char duration[32];
        std::snprintf(duration, sizeof duration, "  %.3f s", character.clips[i].duration);
        printLine("", std::to_string(i) + "  " + character.clips[i].name + duration);
        if (!character.clips[i].packed.words.empty()) {
            printPacked(order, character.clips[i]);
        }
        for (const cage::Marker& marker : character.clips[i].markers) {
            char time[32];
            std::snprintf(time, sizeof time, "%.3f s", marker.time);
            printLine("", "   marker " + marker.name + "  " + time);
        }
    }
    printLine("materials", std::to_string(character.materials.size()));
    for (const cage::Material& material : character.materials) {
        printLine("", materialText(material));
    }
    if (!character.materialVariants.empty()) {
        printLine("variants", std::to_string(character.materialVariants.size()));
        for (const std::string& name : character.materialVariants) {
            printLine("", name);
        }
    }
    printLine("images", std::to_string(character.images.size()));
    for (const cage::Image& image : character.images) {
        printLine("", image.name + "  " + image.mimeType + "  " + std::to_string(image.bytes.size()) + " bytes");
    }
    for (const std::string& warning : character.warnings) {
        printLine("warning", warning);
    }
    for (const SchemeVerdict& verdict : findings.schemes) {
        std::string text = verdict.refusal.empty() ? "accepted:" : "refused: " + verdict.refusal;
        for (const auto& [name, count] : verdict.patches) {
            text.append(" ").append(std::to_string(count)).append(" ").append(name);
        }
        printLine((std::string("scheme ") + verdict.scheme).c_str(), text);
        for (const std::string& note : verdict.notes) {
            printLine("", note);
        }
        if (!verdict.folds.faces.empty()) {
            printLine("  folds", toText(verdict.folds));
        }
    }
    if (measured.memory) {
        printLine("memory, asset", memoryText(measured.memory->asset));
        printLine("memory, group", memoryText(measured.memory->group));
        printLine("", "one instance at rate " + std::to_string(options.surface.rate) + ", with attributes");
    }
    if (measured.comparison) {
        printText(options, *measured.comparison);
    }
}

int runInspect(const InspectOptions& options) {
    Result<host::CharacterFile> file = host::readCharacterFile(options.file, options.surface.reading);
    if (!file) {
        return fail(kExitBadInput, file.error().message);
    }
    const auto [error, coarseError] = options.packing;
    if (coarseError > 0.0 && !(error > 0.0 && coarseError > error)) {
        return fail(kExitUsage, "--coarse-clip-error needs a --clip-error, and must be more than that");
    }
    if (error > 0.0) {
        for (std::string& warning : skinning::packClips(file->character, error, coarseError)) {
            file->character.warnings.push_back(std::move(warning));
        }
    }
    const auto print = [&](const Measured& measured) {
        const Findings findings = examine(file->character);
        if (options.json) {
            printJson(options, file->character, findings, measured);
        } else {
            printText(options, file->character, findings, measured);
        }
    };
    if (!options.compare && !options.memory) {
        print({});
        return kExitOk;
    }
    const Result<uint32_t> clip = host::findClip(file->character, options.clip);
    if (!clip) {
        return fail(kExitBadInput, clip.error().message);
    }
    return withSession(options.device, [&](Session& session) -> Status {
        Measured measured;
        if (options.memory) {
            const Result<MemoryFindings> memory = measureMemory(session, *file, options.surface);
            if (!memory) {
                return memory.error();
            }
            measured.memory = *memory;
        }
        if (options.compare) {
            Result<Comparison> comparison = compareSchemes(session, *file, options.surface, {*clip, options.time});
            if (!comparison) {
                return comparison.error();
            }
            measured.comparison = std::move(*comparison);
        }
        print(measured);
        return success();
    });
}

} // namespace

void bindInspect(CLI::App& app, int& exitCode) {
    auto options = std::make_shared<InspectOptions>();
    CLI::App* command = app.add_subcommand("inspect", "What a character file holds, and which schemes take it");
    command->add_option("FILE", options->file, "glTF, GLB or OBJ")->required();
    command->add_flag("--json", options->json, "Print JSON");
    bindClipPacking(*command, options->packing);
    bindReading(*command, options->surface.reading);
    command->add_flag("--compare", options->compare,
                      "Also evaluate every scheme that takes the cage, and say how far its surface is from the "
                      "Catmull-Clark limit");
    command->add_flag("--memory", options->memory,
                      "Also make a group of one instance, with the scheme that suits each part, and say what asset and "
                      "group take of the device's memory, by purpose");
    bindRate(*command, options->surface.rate);
    bindUvMode(*command, options->surface.uvMode);
    command->get_option("--uv-mode")->needs("--memory");
    bindPose(*command, options->clip, options->time);
    bindDevice(*command, options->device);
    for (const char* flag : {"--clip", "--time"}) {
        command->get_option(flag)->needs("--compare");
    }
    command->callback([command, options, &exitCode] {
        for (const char* flag : {"--rate", "--device", "--mapping", "--validate"}) {
            if (command->count(flag) > 0 && !options->compare && !options->memory) {
                throw CLI::RequiresError(flag, "--compare or --memory");
            }
        }
        exitCode = runInspect(*options);
    });
}

} // namespace supple::tools
