#include "tools/supple/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace supple::tools {
namespace {

std::string finiteNumber(const std::string& text) {
    double value = 0.0;
    return CLI::detail::lexical_cast(text, value) && std::isfinite(value) ? "" : text + " is not a finite number";
}

} // namespace

HelpGroup::HelpGroup(CLI::App& command, const char* heading)
    : command_(command), before_(command.option_defaults()->get_group()) {
    command.option_defaults()->group(heading);
}

HelpGroup::~HelpGroup() {
    command_.option_defaults()->group(before_);
}

void bindDevice(CLI::App& command, std::string& device, std::string& mapping, bool& validate) {
    const HelpGroup heading(command, "Device");
    command.add_option("--device", device, "Device by name or index")->type_name("NAME|INDEX");
    command.add_option("--mapping", mapping, "How work is laid on the device")
        ->check(CLI::IsMember({"auto", "narrow", "wide"}))
        ->capture_default_str();
    command.add_flag("--validate", validate, "Vulkan validation layer on; any message fails the command");
}

void bindDevice(CLI::App& command, DeviceFlags& flags) {
    bindDevice(command, flags.device, flags.mapping, flags.validate);
}

void bindRecord(CLI::App& command, std::string& record) {
    const HelpGroup heading(command, "Device");
    command.add_option("--record", record, "Write a recording of all calls, for supple replay")
        ->type_name("OUT.supprec");
}

SuppleMapping mappingOf(const DeviceFlags& flags) {
    return flags.mapping == "narrow" ? SUPPLE_MAPPING_NARROW
           : flags.mapping == "wide" ? SUPPLE_MAPPING_WIDE
                                     : SUPPLE_MAPPING_AUTO;
}

namespace {

void bindRetargeting(CLI::App& command, host::ReadOptions& reading) {
    command
        .add_option("--retarget", reading.retargeting,
                    "Which of --clips are retargeted: those of another skeleton, none, all, or all, with feet that go "
                    "where the legs take them")
        ->check(CLI::IsMember(std::vector<std::string>(std::begin(host::kRetargetings), std::end(host::kRetargetings))))
        ->capture_default_str();
    command
        .add_option("--retarget-map", reading.retargetMap,
                    "JSON that says which joints of --clips are which of the character (docs/gltf.md)")
        ->type_name("MAP.json");
}

} // namespace

void bindReading(CLI::App& command, host::ReadOptions& reading) {
    const HelpGroup heading(command, "Reading the file");
    CLI::Option* const pair = command.add_flag("--pair-quads", reading.pairQuads,
                                               "Pair plain triangles into quads also where few of them make good ones");
    command.add_flag("--keep-triangles", reading.keepTriangles, "Never pair plain triangles into quads")
        ->excludes(pair);
    command
        .add_option("--clips", reading.clipFiles,
                    "glTF files whose clips the character takes: they move the nodes of their names, or are retargeted")
        ->type_name("CLIPS.glb");
    bindRetargeting(command, reading);
    command.add_option("--scene", reading.scene, "Read this scene of a glTF file, counted from 0");
    command
        .add_option("--variant", reading.variant,
                    "Take the materials of this variant of a glTF file; inspect lists the variants")
        ->type_name("NAME");
    command.add_flag("--parts-apart", reading.partsApart, "Do not sew parts together where their boundaries coincide");
    command.add_flag("--vertices-apart", reading.verticesApart,
                     "Do not weld vertices of an OBJ file that lie in one place");
    CLI::Option* const creases =
        command.add_flag("--creases-from-normals", reading.creasesFromNormals,
                         "Make all edges hard creases where the normals of the file are split. Without it this is done "
                         "for parts of plain triangles of which some edges are split");
    command.add_flag("--smooth", reading.smooth, "Make no edge a crease because its normals are split")
        ->excludes(creases);
    command
        .add_option("--memory-limit", reading.memoryLimit,
                    "Most memory that reading a glTF file may take at a time; without it 16 MiB, and 64 bytes for each "
                    "byte of the file and of those that it names")
        ->type_name("MIB")
        ->check(CLI::Range(1u, 1u << 20));
    command.add_flag("--strict", reading.strict,
                     "Refuse a file with faults or a damaged cage, and name them all, instead of mending them");
}

void bindRate(CLI::App& command, uint32_t& rate) {
    const HelpGroup heading(command, "Surface");
    command
        .add_option("--rate", rate,
                    "Segments along a patch edge. catmull-clark, blend and fragments: along an edge of the cage; "
                    "fragments round it up to a power of two")
        ->check(CLI::Range(1u, SUPPLE_MAX_RATE))
        ->capture_default_str();
}

namespace {

/// By SuppleSkinning.
constexpr const char* kSkinnings[] = {"linear", "dual-quaternion", "centers", "mush", "mush-light", "file"};
static_assert(SUPPLE_SKINNING_FROM_FILE == std::size(kSkinnings) - 1);

constexpr const char* kUvModes[] = {"file", "none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"};

/// An option that may be given again: each text is parsed into one more setting.
template <class T>
void bindSettings(CLI::App& command, const char* name, std::vector<T>& settings, Result<T> (*parse)(const std::string&),
                  const char* help, const char* type) {
    const auto fault = [parse](const std::string& text) {
        const Result<T> setting = parse(text);
        return setting ? "" : setting.error().message;
    };
    command
        .add_option_function<std::vector<std::string>>(
            name,
            [&settings, parse](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    settings.push_back(*parse(text));
                }
            },
            help)
        ->check(CLI::Validator(fault, ""))
        ->allow_extra_args(false)
        ->type_name(type);
}

} // namespace

void bindScheme(CLI::App& command, std::string& scheme, std::vector<host::PartScheme>& partSchemes, uint32_t& rate,
                std::string& skinning, host::ReadOptions& reading, const std::vector<std::string>& extraSchemes) {
    const HelpGroup heading(command, "Surface");
    std::vector<std::string> names{"auto"};
    for (const Scheme& known : kSchemes) {
        names.emplace_back(known.name);
    }
    names.insert(names.end(), extraSchemes.begin(), extraSchemes.end());
    const auto renamed = [](const std::string& text) {
        return std::string(text == "exact" ? "exact is called catmull-clark now" : "");
    };
    command.add_option("--scheme", scheme, "Surface scheme; auto: the one that suits each part")
        ->check(CLI::Validator(renamed, ""))
        ->check(CLI::IsMember(names))
        ->capture_default_str();
    bindSettings(command, "--part-scheme", partSchemes, host::parsePartScheme,
                 "The scheme of a part, by name or index, instead of --scheme. May be given again", "PART=SCHEME");
    bindRate(command, rate);
    bindSkinning(command, skinning);
    bindReading(command, reading);
}

Result<VkExtent2D> parseSize(const std::string& text) {
    constexpr uint32_t kMaxSide = 16384;
    VkExtent2D extent{};
    int read = 0;
    const int values = std::sscanf(text.c_str(), "%ux%u%n", &extent.width, &extent.height, &read);
    const auto isSide = [](uint32_t side) { return side > 0 && side <= kMaxSide; };
    if (values != 2 || static_cast<size_t>(read) != text.size() || !isSide(extent.width) || !isSide(extent.height)) {
        return Error{ErrorCode::argument, text + " is not WxH in pixels"};
    }
    return extent;
}

void bindSize(CLI::App& command, const char* name, std::string& size, const char* description) {
    const auto check = [](const std::string& text) {
        const Result<VkExtent2D> extent = parseSize(text);
        return extent ? std::string() : extent.error().message;
    };
    command.add_option(name, size, description)->check(CLI::Validator(check, "WxH"))->capture_default_str();
}

void bindSkinning(CLI::App& command, std::string& skinning) {
    const HelpGroup heading(command, "Pose");
    command.add_option("--skinning", skinning, "How joints move the cage; file: as the file says, or linearly")
        ->check(CLI::IsMember(std::vector<std::string>(std::begin(kSkinnings), std::end(kSkinnings))))
        ->capture_default_str();
}

void bindSurface(CLI::App& command, SurfaceFlags& flags, const std::vector<std::string>& extraSchemes) {
    const HelpGroup heading(command, "Surface");
    bindScheme(command, flags.scheme, flags.partSchemes, flags.rate, flags.skinning, flags.reading, extraSchemes);
    command.add_option("--tangents", flags.tangents, "Tangent length at extraordinary vertices")
        ->check(CLI::IsMember({"default", "printed"}))
        ->capture_default_str();
    command.add_option("--corners", flags.corners, "Boundary vertices of one face")
        ->check(CLI::IsMember({"sharp", "smooth"}))
        ->capture_default_str();
    bindSharpEdges(command, flags.creases, flags.sharpThreshold);
    bindRules(command, flags.rules);
    bindUvMode(command, flags.uvMode);
}

void bindUvMode(CLI::App& command, std::string& uvMode) {
    const HelpGroup heading(command, "Surface");
    command
        .add_option("--uv-mode", uvMode,
                    "How texture coordinates are interpolated, by OpenSubdiv's names: which vertices on seams and "
                    "borders keep their values. file: as the file says")
        ->check(CLI::IsMember(std::vector<std::string>(std::begin(kUvModes), std::end(kUvModes))))
        ->capture_default_str();
}

SuppleUvInterpolation uvInterpolationOf(const std::string& name) {
    return static_cast<SuppleUvInterpolation>(std::find(std::begin(kUvModes), std::end(kUvModes), name) -
                                              std::begin(kUvModes));
}

void bindSharpEdges(CLI::App& command, std::string& creases, float& sharpThreshold) {
    const HelpGroup heading(command, "Surface");
    command.add_option("--creases", creases, "blend: sharp edges as cuts, or as curves in one sheet")
        ->check(CLI::IsMember({"cut", "curve"}))
        ->capture_default_str();
    command.add_option("--sharp", sharpThreshold, "blend: the sharpness from which on edges are sharp")
        ->check(CLI::Range(1e-3f, 10.0f))
        ->capture_default_str();
}

void bindRules(CLI::App& command, std::string& rules) {
    const HelpGroup heading(command, "Surface");
    command.add_option("--rules", rules, "fragments: whose rules they are refined by; loop: on triangles")
        ->check(CLI::IsMember({"catmull-clark", "loop"}))
        ->capture_default_str();
}

Status describeSurface(const SurfaceFlags& flags, const cage::Character& character, SchemeOptions& options,
                       SuppleGroupDesc& desc) {
    Result<std::vector<SuppleScheme>> partSchemes =
        host::partSchemes(character.name, host::partNames(character), flags.partSchemes);
    if (!partSchemes) {
        return partSchemes.error();
    }
    options.partSchemes = std::move(*partSchemes);
    desc.partSchemes = options.partSchemes.data();
    desc.partSchemeCount = static_cast<uint32_t>(options.partSchemes.size());
    options.prep = {sizeof options.prep,
                    flags.tangents == "printed" ? SUPPLE_TANGENTS_PRINTED : SUPPLE_TANGENTS_DEFAULT,
                    flags.corners == "smooth" ? SUPPLE_CORNERS_SMOOTH : SUPPLE_CORNERS_SHARP};
    options.blend = {sizeof options.blend, creaseModeOf(flags.creases), flags.sharpThreshold};
    desc.prep = &options.prep;
    desc.blend = &options.blend;
    options.fragments = {sizeof options.fragments, rulesOf(flags.rules)};
    desc.fragments = &options.fragments;
    desc.skinning = skinningOf(flags.skinning);
    desc.uvInterpolation = uvInterpolationOf(flags.uvMode);
    return success();
}

SuppleCreaseMode creaseModeOf(const std::string& name) {
    return name == "curve" ? SUPPLE_CREASES_CURVE : SUPPLE_CREASES_CUT;
}

SuppleFragmentRules rulesOf(const std::string& name) {
    return name == "loop" ? SUPPLE_RULES_LOOP : SUPPLE_RULES_CATMULL_CLARK;
}

SuppleSkinning skinningOf(const std::string& name) {
    return static_cast<SuppleSkinning>(std::find(std::begin(kSkinnings), std::end(kSkinnings), name) -
                                       std::begin(kSkinnings));
}

const char* skinningName(SuppleSkinning skinning) {
    return kSkinnings[skinning];
}

void bindPose(CLI::App& command, std::string& clip, double& time, const std::string& without) {
    const HelpGroup heading(command, "Pose");
    command.add_option("--clip", clip, "Clip by name or index; without it " + without)->type_name("NAME|INDEX");
    command.add_option("--time", time, "Seconds into the clip, clamped to it")
        ->check(CLI::Validator(finiteNumber, "SECONDS"))
        ->capture_default_str();
}

void bindClipPacking(CLI::App& command, ClipPacking& packing) {
    command
        .add_option("--clip-error", packing.error,
                    "How far packing a clip may move a vertex, as a part of the character's extent; 0: clips are not "
                    "packed")
        ->check(CLI::Range(0.0, 0.1))
        ->type_name("EXTENTS")
        ->capture_default_str();
    command
        .add_option("--coarse-clip-error", packing.coarseError,
                    "How far the coarse twin of a clip may be from it, for clips that are streamed; 0: there is none")
        ->check(CLI::Range(0.0, 0.1))
        ->type_name("EXTENTS")
        ->capture_default_str();
}

void bindMorphs(CLI::App& command, std::vector<host::MorphSetting>& morphs) {
    const HelpGroup heading(command, "Pose");
    bindSettings(command, "--morph", morphs, host::parseMorph,
                 "Weight of the morph targets of a name, in all parts; the others keep those of the file, also in "
                 "clips. May be given again",
                 "NAME=WEIGHT");
    bindSettings(command, "--expression", morphs, host::parseExpression,
                 "Weight of an expression of a VRM file (supple inspect lists them), from 0 to 1. May be given again",
                 "NAME=WEIGHT");
}

void bindModifiers(CLI::App& command, ModifierFlags& flags) {
    const HelpGroup heading(command, "Pose");
    bindSettings(command, "--set", flags.settings, host::parseSet,
                 "Rotation of a joint in model space, instead of the clip's. May be given again", "JOINT=qx,qy,qz,qw");
    bindSettings(
        command, "--aim", flags.settings, host::parseAim,
        "Point of model space to which a joint turns what looks along +Z in the rest pose, behind what is set. "
        "May be given again",
        "JOINT=x,y,z");
    bindSettings(
        command, "--two-bone", flags.settings, host::parseTwoBone,
        "Point of model space to which the two bones above a joint bring it, behind what aims. May be given again",
        "JOINT=x,y,z");
    bindSettings(command, "--lower", flags.settings, host::parseLower,
                 "Joint, the hips, that goes down as far as the feet of --plant need, and by the distance at most; 0: "
                 "0.3 of the longest leg",
                 "JOINT=distance");
    bindSettings(command, "--plant", flags.settings, host::parsePlant,
                 "Foot that stands on the plane through a point with a normal, both in model space. May be given again",
                 "JOINT=x,y,z,nx,ny,nz");
    command.add_option("--weight", flags.weight, "How much of --set, --aim, --two-bone, --lower and --plant is done")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
}

void bindTransition(CLI::App& command, host::TransitionSetting& setting) {
    const HelpGroup heading(command, "Pose");
    CLI::Option* const transition =
        command
            .add_option_function<std::string>(
                "--transition",
                [&setting](const std::string& text) {
                    if (const Status parsed = host::parseTransition(text, setting); !parsed) {
                        throw CLI::ValidationError("--transition", parsed.error().message);
                    }
                },
                "Instead of --clip: a clip from the beginning, and from a time on another one, with what the device "
                "makes of the change. Both loop")
            ->type_name("CLIP@SECONDS->CLIP")
            ->excludes(command.get_option("--clip"));
    command.add_option("--transition-seconds", setting.seconds, "How long the change takes")
        ->check(CLI::Range(0.001, 60.0))
        ->capture_default_str()
        ->needs(transition);
    command.add_option("--transition-kind", setting.method, "How it is made; crossfade: both clips play meanwhile")
        ->check(CLI::IsMember(host::transitionMethods()))
        ->capture_default_str()
        ->needs(transition);
}

void bindSimulate(CLI::App& command, double& seconds) {
    const HelpGroup heading(command, "Pose");
    command
        .add_option("--simulate", seconds,
                    "Joints swing by the springs of the file, vertices jiggle, cloth hangs: the clip has played, in a "
                    "loop, for so long before")
        ->check(CLI::Range(0.001, 3600.0))
        ->type_name("SECONDS");
}

bool hasCoefficients(SuppleScheme wanted) {
    return std::any_of(std::begin(kSchemes), std::end(kSchemes),
                       [&](const Scheme& scheme) { return scheme.scheme == wanted && scheme.coefficients; });
}

} // namespace supple::tools
