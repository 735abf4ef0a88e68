#include "tools/bench/papers.h"

#include "host/figure.h"
#include "host/patches.h"
#include "host/surface_renderer.h"
#include "runtime/arrays/character_arrays.h"
#include "surface/patch_class.h"
#include "tools/bench/acc.h"
#include "tools/bench/acc_kernel.h"
#include "tools/bench/blend_cpu.h"
#include "tools/bench/clocks.h"
#include "tools/bench/plain_cages.h"
#include "tools/bench/printed_figures.h"
#include "tools/bench/replay.h"
#include "tools/bench/workbench.h"
#include "tools/common/figure_file.h"
#include "tools/common/formatted.h"
#include "tools/common/gallery_cages.h"
#include "tools/common/schemes.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace supple::bench {

using Json = nlohmann::ordered_json;
using tools::formatted;

namespace {

constexpr VkExtent2D kPicture{512, 512};
/// Seconds of processor time that frames are counted for; or four times that by the clock.
constexpr double kTurn = 0.3;
constexpr uint32_t kBlendRate = 29;

struct PaperModel {
    const char* name;
    const char* what;
    cage::Cage cage;
};

std::vector<PaperModel> paperModels() {
    return {
        {"triple donuts", "ten blocks with three holes", cage::makeRow(cage::makeTripleDonut(), 10)},
        {"shaft", "a shaft with keys", cage::makeShaft()},
        {"frog", "a creature with limbs", cage::makeFrog()},
        {"dodecahedra", "ten dodecahedra", cage::makeRow(dodecahedron(), 10)},
        {"polar gallery", "cages round vertices of valence 3 and 5, and polar ones of 6 and 12", cage::makeGallery()}};
}

struct PaperScheme {
    const char* name;
    SuppleScheme scheme;
    SuppleFragmentRules rules = SUPPLE_RULES_CATMULL_CLARK;
};
constexpr PaperScheme kPaperSchemes[] = {{"prep", SUPPLE_SCHEME_PREP},
                                         {"pm", SUPPLE_SCHEME_PM},
                                         {"fragments, Loop", SUPPLE_SCHEME_FRAGMENTS, SUPPLE_RULES_LOOP},
                                         {"blend", SUPPLE_SCHEME_BLEND}};

host::CharacterFile characterOf(const PaperModel& model) {
    host::CharacterFile file;
    file.path = model.name;
    file.character.name = model.name;
    file.character.cage = model.cage;
    return file;
}

Json classesOf(const std::vector<SupplePatchInfo>& patches) {
    std::map<SupplePatchClass, uint32_t> counts;
    for (const SupplePatchInfo& patch : patches)
        ++counts[patch.patchClass];
    Json json = Json::object();
    for (const auto& [patchClass, count] : counts)
        json[surface::className(static_cast<surface::PatchClass>(patchClass))] = count;
    return json;
}

/// What a turn takes, by both clocks.
struct Seconds {
    double cpu = 0.0;  ///< of the process, the mean
    double wall = 0.0; ///< the least
};
/// Takes as many turns as fill the time.
template <class Work>
Result<Seconds> secondsOf(bool once, const Work& work) {
    if (const Status status = work(); !status) // what is made at first is not counted
        return status.error();
    const double begin = processSeconds(), start = wallSeconds();
    Seconds seconds{0.0, 1e9};
    uint32_t turns = 0;
    do {
        const double turn = wallSeconds();
        if (const Status status = work(); !status)
            return status.error();
        seconds.wall = std::min(seconds.wall, wallSeconds() - turn);
        ++turns;
    } while (!once && processSeconds() - begin < kTurn && wallSeconds() - start < 4.0 * kTurn);
    seconds.cpu = (processSeconds() - begin) / turns;
    return seconds;
}

class Papers {
public:
    Papers(host::Device& device, const PapersOptions& options) : device_(device), options_(options) {}

    Result<Json> run();

private:
    Status prepare();
    Result<Json> measure(const PaperModel& model, const PaperScheme& scheme, uint32_t samples);
    Result<Json> frames(host::FigureGroup& group, uint32_t samples);
    Result<Json> blendRow(const char* name, const cage::Cage& cage);
    Result<Json> accRow(const PaperModel& model);
    Result<std::vector<uint32_t>> facesOfVertices(host::FigureGroup& group);
    Result<Json> distances(const PaperModel& model, SuppleScheme scheme, const MeasureDistance& measure);
    /// What recorded work of the device takes.
    Result<double> replaySeconds(Replay& replay) const;
    Result<double> evaluateSeconds(const PaperModel& model, SuppleScheme scheme, uint32_t rate, uint64_t& points);
    /// What counts as a second: on CPU devices one of processor time, so that other processes do not count.
    [[nodiscard]] double counted(const Seconds& seconds) const { return device_.isCpu() ? seconds.cpu : seconds.wall; }

    host::Device& device_;
    const PapersOptions& options_;
    std::unique_ptr<host::Context> context_;
    std::unique_ptr<host::SurfaceRenderer> renderer_;
    host::DrawTarget target_;
    std::unique_ptr<Workbench> workbench_;
};

Status Papers::prepare() {
    host::ContextOptions options;
    options.mapping = options_.mapping;
    options.printWarnings = false;
    Result<std::unique_ptr<host::Context>> context = host::Context::create(device_, options);
    if (!context)
        return context.error();
    context_ = std::move(*context);
    host::RendererOptions look;
    look.quality = {.key = 1, .rim = 0, .sky = 0, .shadowSize = 64, .passes = 1, .multisample = false};
    Result<std::unique_ptr<host::SurfaceRenderer>> renderer = host::SurfaceRenderer::create(device_, look);
    if (!renderer)
        return renderer.error();
    renderer_ = std::move(*renderer);
    Result<host::DrawTarget> target = host::DrawTarget::create(device_, kPicture, renderer_->samples());
    if (!target)
        return target.error();
    target_ = std::move(*target);
    SuppleContextDesc desc = host::contextDesc(device_);
    desc.mapping = options_.mapping;
    Result<std::unique_ptr<Workbench>> workbench = Workbench::create(desc);
    if (!workbench)
        return workbench.error();
    workbench_ = std::move(*workbench);
    return success();
}

/// A frame constructs, evaluates and draws: each pixel by its normal, without lights and shadows.
Result<Json> Papers::frames(host::FigureGroup& group, uint32_t samples) {
    const SuppleGroup groups[] = {group.handle()};
    Status status = group.pose(0, SUPPLE_REST_POSE, 0.0);
    if (status)
        status = context_->evaluate(groups);
    const Result<std::vector<glm::vec3>> points =
        status ? group.readSurface() : Result<std::vector<glm::vec3>>(status.error());
    Result<host::FigureBinding> binding = points ? renderer_->bind(group) : Result<host::FigureBinding>(points.error());
    if (!binding)
        return binding.error();
    host::Scene scene;
    scene.group = &group;
    scene.binding = &*binding;
    scene.view = host::shared::kViewNormals;
    scene.bounds = host::boundsOf(*points);
    scene.camera = host::frameCamera(*points, 0.5f, 0.3f, 1.0f, 0.05f);
    scene.quality =
        host::StudioQuality{.key = 0, .rim = 0, .sky = 0, .shadowSize = 64, .passes = 1, .multisample = false};
    scene.backdrop = glm::vec3(0.0f);
    if (const Status prepared = renderer_->prepare(scene); !prepared)
        return prepared.error();
    const Result<Seconds> turn = secondsOf(options_.quick, [&] {
        const Status made = context_->evaluate(groups);
        return made ? device_.submitAndWait(
                          [&](VkCommandBuffer commands) { renderer_->record(commands, 0, target_, scene); })
                    : made;
    });
    if (!turn)
        return turn.error();
    const double seconds = counted(*turn);
    uint64_t triangles = 0;
    for (const host::FigureSurface& surface : group.surfaces()) {
        for (uint32_t r = 0; r < surface.output.grid.drawRangeCount; ++r) {
            const SuppleDrawRange& range = surface.output.grid.drawRanges[r];
            triangles += uint64_t{range.patchCount} * range.indexCount / 3;
        }
    }
    return Json{{"samples", samples},
                {"framesPerSecond", 1.0 / seconds},
                {"triangles", triangles},
                {"trianglesPerSecond", static_cast<double>(triangles) / seconds}};
}

Result<Json> Papers::measure(const PaperModel& model, const PaperScheme& scheme, uint32_t samples) {
    Result<std::unique_ptr<host::Figure>> figure = host::createFigure(*context_, characterOf(model));
    if (!figure)
        return figure.error();
    host::GroupOptions options{.scheme = scheme.scheme, .rate = samples - 1};
    options.fragmentRules = scheme.rules;
    Result<std::unique_ptr<host::FigureGroup>> group = host::FigureGroup::create(**figure, options);
    if (!group)
        return group.error();
    Result<Json> row = frames(**group, samples);
    if (row) {
        const Result<std::vector<SupplePatchInfo>> patches = host::patchesOf(*context_, (*group)->handle(), 0);
        if (!patches)
            return patches.error();
        (*row)["patches"] = classesOf(*patches);
    }
    return row;
}

Result<Json> Papers::blendRow(const char* name, const cage::Cage& cage) {
    Result<std::unique_ptr<BlendCpu>> cpu = BlendCpu::create(cage, kBlendRate);
    if (!cpu)
        return cpu.error();
    const PaperModel model{name, "", cage};
    Result<std::unique_ptr<host::Figure>> figure = host::createFigure(*context_, characterOf(model));
    if (!figure)
        return figure.error();
    Result<std::unique_ptr<host::FigureGroup>> group = host::FigureGroup::create(
        **figure, {.scheme = SUPPLE_SCHEME_BLEND, .rate = kBlendRate, .vertexFormat = SUPPLE_VERTEX_24});
    if (!group)
        return group.error();
    const SuppleGroup groups[] = {(*group)->handle()};
    if (const Status status = (*group)->pose(0, SUPPLE_REST_POSE, 0.0); !status)
        return status.error();
    const Result<Seconds> device = secondsOf(options_.quick, [&] { return context_->evaluate(groups); });
    const Result<Seconds> oneCore = secondsOf(options_.quick, [&] {
        (*cpu)->run(false);
        return success();
    });
    const Result<Seconds> allCores = secondsOf(options_.quick, [&] {
        (*cpu)->run(true);
        return success();
    });
    const Result<std::vector<glm::vec3>> points = (*group)->readSurface();
    const Result<std::vector<uint32_t>> faces = facesOfVertices(**group);
    if (!device || !points || !faces)
        return !device ? device.error() : !points ? points.error() : faces.error();
    const std::span<const float> own = (*cpu)->vertices();
    if (points->size() * 6 != own.size())
        return Error{ErrorCode::asset, std::string(name) + ": the CPU's blend has other samples"};
    constexpr size_t kSamples = size_t{kBlendRate + 1} * (kBlendRate + 1);
    float apart = 0.0f;
    for (size_t i = 0; i < points->size(); ++i) {
        const float* p = &own[6 * ((*faces)[i] * kSamples + i % kSamples)];
        apart = std::max(apart, glm::length((*points)[i] - glm::vec3(p[0], p[1], p[2])));
    }
    const float extent = 2.0f * host::boundsOf(*points).radius();
    if (!(apart <= 1e-5f * extent))
        return Error{ErrorCode::asset, std::string(name) + ": the CPU's blend is another surface"};
    return Json{{"model", name},
                {"faces", cage.faceCount()},
                {"samples", kBlendRate + 1},
                {"device", 1.0 / counted(*device)},
                {"oneCore", 1.0 / oneCore->cpu},
                {"allCores", 1.0 / allCores->wall},
                {"apart", apart / extent}};
}

/// The face of the cage that each vertex is of. Patches stand class by class.
Result<std::vector<uint32_t>> Papers::facesOfVertices(host::FigureGroup& group) {
    const Result<std::vector<SupplePatchInfo>> patches = host::patchesOf(*context_, group.handle(), 0);
    if (!patches)
        return patches.error();
    const SuppleGridOutput& grid = group.surfaces().front().output.grid;
    std::vector<uint32_t> faces(grid.vertexCount);
    for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = grid.drawRanges[r];
        for (size_t i = 0; i < size_t{range.patchCount} * range.samplesPerPatch; ++i)
            faces[range.firstVertex + i] = (*patches)[range.firstPatch + i / range.samplesPerPatch].face;
    }
    return faces;
}

/// How far what the device evaluates at rate 8 lies from what `measure` compares it with.
Result<Json> Papers::distances(const PaperModel& model, SuppleScheme scheme, const MeasureDistance& measure) {
    Result<std::unique_ptr<host::Figure>> figure = host::createFigure(*context_, characterOf(model));
    if (!figure)
        return figure.error();
    Result<std::unique_ptr<host::FigureGroup>> group =
        host::FigureGroup::create(**figure, {.scheme = scheme, .rate = 8});
    if (!group)
        return group.error();
    const SuppleGroup groups[] = {(*group)->handle()};
    Status status = (*group)->pose(0, SUPPLE_REST_POSE, 0.0);
    if (status)
        status = context_->evaluate(groups);
    const Result<std::vector<glm::vec3>> points =
        status ? (*group)->readSurface() : Result<std::vector<glm::vec3>>(status.error());
    const Result<std::vector<uint32_t>> faces = points ? facesOfVertices(**group) : points.error();
    if (!faces)
        return faces.error();
    const PaperDistance distance = measure(*faces, std::vector<glm::dvec3>(points->begin(), points->end()));
    return Json{{"largest", distance.largest}, {"mean", distance.mean}};
}

Result<double> Papers::replaySeconds(Replay& replay) const {
    if (!device_.isCpu() && replay.hasTimestamps())
        return replay.deviceSeconds(options_.quick ? 1 : 20);
    const Result<Seconds> seconds = secondsOf(options_.quick, [&] { return replay.run(1); });
    return seconds ? Result<double>(counted(*seconds)) : seconds.error();
}

Result<double> Papers::evaluateSeconds(const PaperModel& model, SuppleScheme scheme, uint32_t rate, uint64_t& points) {
    const host::CageArrays arrays(model.cage);
    Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, model.name);
    if (!character)
        return character.error();
    Result<SuppleAsset> asset = workbench_->createAsset(std::move(*character));
    if (!asset)
        return asset.error();
    SuppleGroupDesc desc{};
    desc.asset = *asset;
    desc.scheme = scheme;
    desc.rate = rate;
    desc.vertexFormat = SUPPLE_VERTEX_16;
    const Result<SuppleGroup> group = workbench_->createGroup(desc);
    workbench_->destroy(*asset);
    if (!group)
        return group.error();
    Status recorded = success();
    const Status submitted =
        device_.submitAndWait([&](VkCommandBuffer commands) { recorded = workbench_->recordFrame(*group, commands); });
    Result<std::unique_ptr<Replay>> replay =
        recorded && submitted
            ? Replay::create(device_, [&](VkCommandBuffer commands) { workbench_->recordEvaluate(*group, commands); })
            : Result<std::unique_ptr<Replay>>(recorded ? submitted.error() : recorded.error());
    if (!replay)
        return replay.error();
    points = workbench_->output(*group).grid.vertexCount;
    const Result<double> seconds = replaySeconds(**replay);
    replay->reset();
    workbench_->destroy(*group);
    return seconds;
}

/// Cost of evaluation alone, and the distance to the limit, at rate 8.
Result<Json> Papers::accRow(const PaperModel& model) {
    constexpr uint32_t kRate = 8;
    const Result<std::vector<AccPatch>> patches = makeAcc(model.cage);
    if (!patches)
        return patches.error();
    std::vector<uint32_t> faces;
    std::vector<glm::dvec3> points;
    for (uint32_t f = 0; f < patches->size(); ++f) {
        for (uint32_t s = 0; s < (kRate + 1) * (kRate + 1); ++s) {
            points.push_back(evaluateAcc((*patches)[f], static_cast<double>(s % (kRate + 1)) / kRate,
                                         static_cast<double>(s / (kRate + 1)) / kRate)
                                 .position);
            faces.push_back(f);
        }
    }
    const Result<MeasureDistance> measure = options_.limitOf(model.cage);
    if (!measure)
        return measure.error();
    const PaperDistance distance = (*measure)(faces, points);
    Result<std::unique_ptr<AccKernel>> kernel = AccKernel::create(device_, *patches, kRate);
    if (!kernel)
        return kernel.error();
    Result<std::unique_ptr<Replay>> replay =
        Replay::create(device_, [&](VkCommandBuffer commands) { (*kernel)->record(commands); });
    if (!replay)
        return replay.error();
    const Result<double> seconds = replaySeconds(**replay);
    const Result<double> apart = (*kernel)->apartFrom(points);
    if (!seconds || !apart)
        return !seconds ? seconds.error() : apart.error();
    Json row{{"model", model.name}, {"rate", kRate}, {"schemes", Json::array()}};
    row["schemes"].push_back({{"scheme", "ACC"},
                              {"coefficients", 40},
                              {"nanosecondsPerPoint", 1e9 * *seconds / static_cast<double>(points.size())},
                              {"largest", distance.largest},
                              {"mean", distance.mean},
                              {"apart", *apart}});
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_CATMULL_CLARK}) {
        uint64_t count = 0;
        const Result<double> own = evaluateSeconds(model, scheme, kRate, count);
        Result<Json> entry = own ? distances(model, scheme, *measure) : Result<Json>(own.error());
        if (!entry)
            return entry.error();
        (*entry)["scheme"] = tools::schemeName(scheme);
        (*entry)["nanosecondsPerPoint"] = 1e9 * *own / static_cast<double>(count);
        row["schemes"].push_back(std::move(*entry));
    }
    return row;
}

Result<Json> Papers::run() {
    if (const Status status = prepare(); !status)
        return status.error();
    Json result{
        {"picture", {kPicture.width, kPicture.height}}, {"cpuDevice", device_.isCpu()}, {"models", Json::array()}};
    const std::vector<PaperModel> models = paperModels();
    for (const PaperModel& model : models) {
        Json entry{{"name", model.name}, {"what", model.what}, {"faces", model.cage.faceCount()}};
        entry["schemes"] = Json::array();
        for (const PaperScheme& scheme : kPaperSchemes) {
            Json of{{"scheme", scheme.name}, {"rows", Json::array()}};
            for (const uint32_t samples : {5u, 9u, 17u, 33u, 65u}) {
                if (options_.quick && samples > 5)
                    break;
                if (options_.progress)
                    options_.progress(formatted("%s, %s, N = %u", model.name, scheme.name, samples));
                Result<Json> row = measure(model, scheme, samples);
                if (!row && (row.error().code == ErrorCode::asset || row.error().code == ErrorCode::limit)) {
                    of["refused"] = row.error().message;
                    break;
                }
                if (!row)
                    return row.error();
                of["patches"] = std::move((*row)["patches"]);
                row->erase("patches");
                of["rows"].push_back(std::move(*row));
            }
            entry["schemes"].push_back(std::move(of));
        }
        result["models"].push_back(std::move(entry));
    }
    for (const char* name : {"triple donuts", "frog"}) {
        const auto model = std::find_if(models.begin(), models.end(),
                                        [&](const PaperModel& each) { return each.name == std::string(name); });
        Result<Json> blend = blendRow(model->name, model->cage);
        Result<Json> acc = blend ? accRow(*model) : Result<Json>(blend.error());
        if (!acc)
            return acc.error();
        result["blend"].push_back(std::move(*blend));
        result["acc"].push_back(std::move(*acc));
        if (options_.quick)
            break;
    }
    return result;
}

} // namespace

Result<Json> runPapers(host::Device& device, const PapersOptions& options) {
    return Papers(device, options).run();
}

} // namespace supple::bench
