#include "tools/bench/bench.h"

#include "host/context.h"
#include "host/operating_system.h"
#include "tools/bench/agreement.h"
#include "tools/bench/avx2_evaluation.h"
#include "tools/bench/classical.h"
#include "tools/bench/crowd.h"
#include "tools/bench/crowd_character.h"
#include "tools/bench/heat.h"
#include "tools/bench/kernels.h"
#include "tools/bench/loading.h"
#include "tools/bench/plain_evaluation.h"
#include "tools/bench/points.h"
#include "tools/bench/queries.h"
#include "tools/bench/scene.h"
#include "tools/bench/skinning.h"
#include "tools/bench/targets.h"
#include "tools/bench/update_rates.h"
#include "tools/bench/views.h"
#include "tools/common/schemes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr double kTurnSeconds = 0.02, kQuickTurnSeconds = 0.002, kWarmSeconds = 0.3;
constexpr uint32_t kLoads = 9, kQuickLoads = 2;
/// On CPU devices a crowd is no game's: so many show that it works and what a character costs.
constexpr uint32_t kGpuCrowd = 1000, kCpuCrowd = 16, kQuickCpuCrowd = 4;
constexpr uint32_t kViewCrowd = 100;
constexpr uint32_t kQuickScene = 3;
/// Of those that are seen from several views.
constexpr uint32_t kViewedCharacters = 10;

class Run {
public:
    Run(host::Device& device, const BenchOptions& options) : device_(device), options_(options) {}

    Result<Json> all(const tools::Machine& machine) {
        describe(machine);
        Status status = prepare();
        if (status) {
            status = agree();
        }
        if (status) {
            status = keep();
        }
        if (status) {
            status = crowd();
        }
        if (status && options_.kernels > 0) {
            status = kernels();
        }
        if (status) {
            status = views();
        }
        if (status) {
            status = updateRates();
        }
        if (status) {
            status = points();
        }
        if (status) {
            status = queries();
        }
        if (status) {
            status = scene();
        }
        if (status) {
            status = skinning();
        }
        if (status) {
            status = classical();
        }
        if (status) {
            status = heats();
        }
        if (status && options_.loading) {
            status = load();
        }
        if (!status) {
            return status.error();
        }
        result_["targets"] = judge(result_);
        result_["complete"] = true;
        return std::move(result_);
    }

private:
    Status prepare();
    void describe(const tools::Machine& machine);
    Status agree();
    /// Writes them down; fails if one does not hold.
    Status agreed(const std::vector<Agreement>& all);
    Status crowd();
    Status kernels();
    Status views();
    Status updateRates();
    Status points();
    Status queries();
    Status scene();
    Status skinning();
    Status classical();
    Status heats();
    Status load();
    Status pipelines(const BenchCage& cage, SuppleScheme scheme);
    Status keep();
    /// Ends the line of progress, and keeps what was measured.
    Status keepAs(const char* key, Result<Json> measured);
    [[nodiscard]] RoundOptions roundOptions() const;
    [[nodiscard]] uint32_t mostCharacters() const {
        return options_.crowd.value_or(!device_.isCpu() ? kGpuCrowd : options_.quick ? kQuickCpuCrowd : kCpuCrowd);
    }
    [[nodiscard]] uint32_t crowdSize() const;
    [[nodiscard]] uint32_t sceneSize() const;
    [[nodiscard]] bool measuresSphere() const {
        return std::find(options_.cages.begin(), options_.cages.end(), "sphere") != options_.cages.end();
    }
    [[nodiscard]] Result<std::vector<BenchCage>> classicalCages() const;
    /// Of --schemes.
    [[nodiscard]] std::vector<SuppleScheme> keepWanted(std::vector<SuppleScheme> schemes) const;
    [[nodiscard]] std::vector<SuppleScheme> crowdSchemes() const {
        return keepWanted({SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM});
    }

    host::Device& device_;
    const BenchOptions& options_;
    std::vector<BenchCage> cages_; ///< built-in ones first
    size_t builtIn_ = 0;
    std::unique_ptr<Workbench> workbench_;
    OpensubdivPeers peers_;
    std::vector<float> yardstick_;
    Json result_;
};

Status Run::prepare() {
    for (const std::string& name : options_.cages) {
        Result<BenchCage> cage = makeCage(name);
        if (!cage && cage.error().code == ErrorCode::io) {
            result_["leftOut"].push_back({{"what", name}, {"reason", cage.error().message}});
            continue;
        }
        if (!cage) {
            return cage.error();
        }
        ++builtIn_;
        cages_.push_back(std::move(*cage));
    }
    for (const std::string& path : options_.files) {
        Result<BenchCage> cage = readCage(path);
        if (!cage) {
            return cage.error();
        }
        cages_.push_back(std::move(*cage));
    }
    for (BenchCage& cage : cages_) {
        cage.schemes = keepWanted(cage.schemes);
    }
    SuppleContextDesc desc = host::contextDesc(device_);
    desc.mapping = options_.mapping;
    Result<std::unique_ptr<Workbench>> workbench = Workbench::create(desc);
    if (!workbench) {
        return workbench.error();
    }
    workbench_ = std::move(*workbench);
    return success();
}

void Run::describe(const tools::Machine& machine) {
    result_["version"] = std::to_string(SUPPLE_VERSION_MAJOR) + "." + std::to_string(SUPPLE_VERSION_MINOR) + "." +
                         std::to_string(SUPPLE_VERSION_PATCH);
    result_["complete"] = false;
    result_["machine"] = {
        {"device", machine.device},   {"driver", machine.driver}, {"driverInfo", machine.driverInfo},
        {"mapping", machine.mapping}, {"cpu", machine.cpu},       {"threads", std::thread::hardware_concurrency()}};
    result_["cpuDevice"] = device_.isCpu();
    result_["rounds"] = options_.rounds;
    result_["quick"] = options_.quick;
    result_["peers"] = {{"plain C++", std::string("-O3 for ") + plainEvaluationTarget() + ", one thread"},
                        {"AVX2", hasAvx2Evaluation() ? "AVX2 and FMA by hand, one thread" : "not on this CPU"},
                        {"OpenSubdiv CPU", peers_.cpu()},
                        {"OpenSubdiv GLSL", peers_.glsl()}};
    for (const char* list :
         {"leftOut", "agreement", "skinning", "classical", "kernels", "rows", "loading", "pipelines"}) {
        result_[list] = Json::array();
    }
}

Status Run::keep() {
    if (!options_.keep) {
        return success();
    }
    result_["targets"] = judge(result_);
    return options_.keep(result_);
}

Status Run::keepAs(const char* key, Result<Json> measured) {
    std::fprintf(stderr, "\n");
    if (!measured) {
        return measured.error();
    }
    result_[key] = std::move(*measured);
    return keep();
}

RoundOptions Run::roundOptions() const {
    RoundOptions rounds;
    rounds.rounds = options_.rounds;
    rounds.turnSeconds = options_.quick ? kQuickTurnSeconds : kTurnSeconds;
    rounds.timestampsAreCheap = !device_.isCpu();
    rounds.warmSeconds = device_.isCpu() ? 0.0 : kWarmSeconds;
    return rounds;
}

uint32_t Run::crowdSize() const {
    return options_.crowd || measuresSphere() ? mostCharacters() : 0;
}

uint32_t Run::sceneSize() const {
    return options_.scene.value_or(!measuresSphere() ? 0 : options_.quick ? kQuickScene : kSceneCharacters);
}

std::vector<SuppleScheme> Run::keepWanted(std::vector<SuppleScheme> schemes) const {
    const std::vector<std::string>& wanted = options_.schemes;
    std::erase_if(schemes, [&](SuppleScheme scheme) {
        return !wanted.empty() && std::find(wanted.begin(), wanted.end(), tools::schemeName(scheme)) == wanted.end();
    });
    return schemes;
}

Status Run::crowd() {
    CrowdDesc desc;
    desc.characters = crowdSize();
    desc.schemes = crowdSchemes();
    if (desc.characters == 0 || desc.schemes.empty()) {
        return success();
    }
    desc.rates = options_.quick ? std::vector<uint32_t>{4} : std::vector<uint32_t>{4, 8, 16};
    desc.rounds = roundOptions();
    desc.progress = [](const std::string& what) { std::fprintf(stderr, "\rcrowd: %s   ", what.c_str()); };
    return keepAs("crowd", measureCrowd(device_, *workbench_, desc));
}

Status Run::kernels() {
    const Result<KernelWays> ways = KernelWays::create(device_);
    if (!ways) {
        return ways.error();
    }
    const std::vector<uint32_t> rates = options_.quick ? std::vector<uint32_t>{4} : std::vector<uint32_t>{4, 8, 16};
    const auto take = [&](Result<Json> row) {
        std::fprintf(stderr, "\n");
        if (!row) {
            return Status(row.error());
        }
        result_["kernels"].push_back(std::move(*row));
        return keep();
    };
    Status status = success();
    for (const KernelSubject& subject : kernelSubjects()) {
        const bool wanted = !keepWanted({subject.scheme}).empty();
        for (size_t r = 0; wanted && status && r < rates.size(); ++r) {
            std::fprintf(stderr, "\rkernels: %s, %s, rate %u   ", subject.cage, tools::schemeName(subject.scheme),
                         rates[r]);
            status = take(measureKernels(device_, *ways, {subject, options_.kernels, rates[r], roundOptions()}));
        }
        if (wanted && status && !options_.quick && *subject.patchClass != '\0') { // drivers take seconds for a view
            std::fprintf(stderr, "\rkernels: %s, %s, levels   ", subject.cage, tools::schemeName(subject.scheme));
            status = take(measureLevelKernels(device_, *ways, {subject, options_.kernels, 3 * options_.rounds}));
        }
    }
    return status;
}

Status Run::views() {
    ViewsDesc desc;
    desc.characters = crowdSize() == 0 ? 0 : options_.quick ? kQuickCpuCrowd : kViewCrowd;
    desc.schemes = keepWanted({SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK});
    if (desc.characters == 0 || desc.schemes.empty()) {
        return success();
    }
    if (options_.quick) { // drivers take seconds to compile a view
        desc.schemes.resize(1);
    }
    desc.frames = 3 * options_.rounds;
    desc.progress = [](const std::string& what) { std::fprintf(stderr, "\rview: %s   ", what.c_str()); };
    return keepAs("views", measureViews(device_, *workbench_, desc));
}

Status Run::updateRates() {
    if (crowdSize() == 0) {
        return success();
    }
    UpdateRatesDesc desc;
    desc.characters = {100, 1000};
    if (options_.crowd || options_.quick) {
        desc.characters = {options_.crowd.value_or(kQuickCpuCrowd)};
    }
    desc.frames = 8 * (options_.quick ? 1 : options_.rounds);
    desc.progress = [](const std::string& what) { std::fprintf(stderr, "\rupdate rates: %s   ", what.c_str()); };
    return keepAs("updateRates", measureUpdateRates(device_, *workbench_, desc));
}

Status Run::points() {
    if (crowdSize() == 0) {
        return success();
    }
    PointsDesc desc;
    desc.characters = {1, options_.quick ? 2u : 100u};
    desc.points = options_.quick ? 500 : 10'000;
    desc.frames = 4 * (options_.quick ? 1 : options_.rounds);
    desc.progress = [](const std::string& what) { std::fprintf(stderr, "\rpoints: %s   ", what.c_str()); };
    return keepAs("points", measurePoints(device_, *workbench_, desc));
}

Status Run::queries() {
    if (crowdSize() == 0) {
        return success();
    }
    QueriesDesc desc;
    desc.characters = {1, options_.quick ? 2u : 100u};
    desc.rays = options_.quick ? std::vector<uint32_t>{1, 40} : std::vector<uint32_t>{1, 16, 1000, 10'000};
    desc.frames = 4 * (options_.quick ? 1 : options_.rounds);
    desc.progress = [](const std::string& what) { std::fprintf(stderr, "\rqueries: %s   ", what.c_str()); };
    return keepAs("queries", measureQueries(device_, *workbench_, desc));
}

Status Run::scene() {
    SceneDesc desc;
    const uint32_t most = sceneSize();
    if (most == 0 || keepWanted({SUPPLE_SCHEME_PM}).empty()) {
        return success();
    }
    desc.characters = options_.quick ? std::vector<uint32_t>{1} : std::vector<uint32_t>{1, 10, 30};
    std::erase_if(desc.characters, [&](uint32_t count) { return count >= most; });
    desc.characters.push_back(most);
    desc.viewedCharacters = std::min(options_.quick ? 1 : kViewedCharacters, most);
    desc.frames = options_.rounds;
    desc.everyUse = !options_.quick;
    desc.mapping = options_.mapping;
    desc.progress = [](const std::string& what) { std::fprintf(stderr, "\rscene: %s   ", what.c_str()); };
    return keepAs("scene", measureScene(device_, desc));
}

/// The crowd's character and all that have joints.
Status Run::skinning() {
    std::vector<BenchCage> cages;
    if (crowdSize() > 0) {
        Result<BenchCage> character = makeCrowdCharacter();
        if (!character) {
            return character.error();
        }
        character->name = "crowd";
        cages.push_back(std::move(*character));
    }
    cages.insert(cages.end(), cages_.begin(), cages_.end());
    std::erase_if(cages, [&](const BenchCage& cage) { // one joint moves the others
        return mostCharacters() == 0 || cage.character.skin.joints.size() < 2;
    });
    for (const BenchCage& cage : cages) {
        SkinningDesc desc;
        desc.cage = &cage;
        desc.characters = mostCharacters();
        desc.rounds = roundOptions();
        desc.rounds.progress = [&](uint32_t round) {
            std::fprintf(stderr, "\rskinning, %s: round %u of %u   ", cage.name.c_str(), round, options_.rounds);
        };
        Result<Json> row = measureSkinning(device_, *workbench_, desc);
        std::fprintf(stderr, "\n");
        if (!row) {
            return row.error();
        }
        result_["skinning"].push_back(std::move(*row));
    }
    return keep();
}

/// The crowd's character and all that have a clip and quads alone.
Result<std::vector<BenchCage>> Run::classicalCages() const {
    std::vector<BenchCage> cages;
    if (crowdSize() > 0) {
        Result<BenchCage> character = makeCrowdCharacter();
        if (!character) {
            return character.error();
        }
        character->name = "crowd";
        cages.push_back(std::move(*character));
        cages.back().schemes = keepWanted(cages.back().schemes);
    }
    cages.insert(cages.end(), cages_.begin(), cages_.end());
    std::erase_if(cages, [&](const BenchCage& cage) { return mostCharacters() == 0 || !hasClassicalPath(cage); });
    return cages;
}

Status Run::classical() {
    const Result<std::vector<BenchCage>> cages = classicalCages();
    if (!cages) {
        return cages.error();
    }
    for (const BenchCage& cage : *cages) {
        ClassicalDesc desc;
        desc.cage = &cage;
        desc.characters = mostCharacters();
        desc.rates = options_.quick ? std::vector<uint32_t>{4} : std::vector<uint32_t>{1, 2, 4, 8, 16};
        desc.rounds = roundOptions();
        desc.progress = [](const std::string& what) { std::fprintf(stderr, "\rclassical: %s   ", what.c_str()); };
        desc.leaveOut = [&](const std::string& what, const std::string& reason) {
            result_["leftOut"].push_back({{"what", what}, {"reason", reason}});
        };
        Result<std::vector<Agreement>> agreement = compareClassical(device_, *workbench_, cage);
        const Status same = agreement ? agreed(*agreement) : Status(agreement.error());
        Result<Json> measured = same ? measureClassical(device_, *workbench_, desc) : Result<Json>(same.error());
        std::fprintf(stderr, "\n");
        if (!measured) {
            return measured.error();
        }
        result_["classical"].insert(result_["classical"].end(), measured->begin(), measured->end());
        Status kept = keep();
        if (!kept) {
            return kept;
        }
    }
    return success();
}

Status Run::agreed(const std::vector<Agreement>& all) {
    for (const Agreement& one : all) {
        result_["agreement"].push_back({{"what", one.what}, {"difference", one.difference}, {"bound", one.bound}});
        if (!one.holds()) {
            return Error{ErrorCode::asset, "contestants differ: " + one.what + ": " + std::to_string(one.difference)};
        }
    }
    return success();
}

Status Run::agree() {
    Result<BenchCage> sphere = makeCage("sphere");
    if (!sphere) {
        return sphere.error();
    }
    Result<std::vector<float>> coefficients = bicubicCoefficients(device_, *workbench_, *sphere);
    if (!coefficients) {
        return coefficients.error();
    }
    yardstick_ = std::move(*coefficients);
    Result<std::vector<Agreement>> all = compareEvaluations(device_, *workbench_, *sphere, yardstick_);
    for (size_t c = 0; all && c < cages_.size(); ++c) {
        for (const PeerRules rules : cages_[c].peers) {
            const Result<std::vector<Agreement>> peers = comparePeers(device_, *workbench_, peers_, cages_[c], rules);
            if (!peers) {
                return peers.error();
            }
            all->insert(all->end(), peers->begin(), peers->end());
        }
    }
    for (const SuppleScheme scheme : crowdSize() > 0 ? crowdSchemes() : std::vector<SuppleScheme>()) {
        const Result<std::vector<Agreement>> crowd =
            all ? compareCrowd(device_, *workbench_, scheme) : Result<std::vector<Agreement>>(all.error());
        if (!crowd) {
            return crowd.error();
        }
        all->insert(all->end(), crowd->begin(), crowd->end());
    }
    if (!all) {
        return all.error();
    }
    return agreed(*all);
}

Status Run::heats() {
    for (const BenchCage& cage : cages_) {
        for (const uint32_t rate : options_.rates) {
            HeatDesc desc;
            desc.cage = &cage;
            desc.rate = rate;
            desc.yardstick = yardstick_;
            desc.rounds = roundOptions();
            desc.rounds.progress = [&](uint32_t round) {
                std::fprintf(stderr, "\r%s, rate %u: round %u of %u   ", cage.name.c_str(), rate, round,
                             options_.rounds);
            };
            Result<Json> row = runHeat(device_, *workbench_, peers_, desc);
            std::fprintf(stderr, "\n");
            if (!row) {
                return row.error();
            }
            result_["rows"].push_back(std::move(*row));
            Status kept = keep();
            if (!kept) {
                return kept;
            }
        }
    }
    return success();
}

Status Run::load() {
    std::set<SuppleScheme> compiled;
    // The demo characters, the last of the built-in cages, have patches of all classes: pipelines are taken from the
    // first in this order that has the scheme.
    std::vector<const BenchCage*> order;
    for (const BenchCage& cage : cages_) {
        order.push_back(&cage);
    }
    std::reverse(order.begin(), order.begin() + static_cast<ptrdiff_t>(builtIn_));
    for (const BenchCage* cage : order) {
        for (const SuppleScheme scheme : cage->schemes) {
            Result<Loading> loading =
                measureLoading(device_, *workbench_, *cage, scheme, options_.quick ? kQuickLoads : kLoads);
            if (!loading && loading.error().code == ErrorCode::asset) {
                continue; // the heats have named it
            }
            if (!loading) {
                return loading.error();
            }
            const LoadTimes& times = loading->times;
            const auto aFace = [&](double value) { return value / loading->faces; };
            result_["loading"].push_back(
                {{"cage", loading->cage},
                 {"scheme", loading->scheme},
                 {"faces", loading->faces},
                 {"patches", loading->patches},
                 {"createAssetMs", times.createAsset},
                 {"createGroupMs", times.createGroup},
                 {"recordMs", times.record},
                 {"firstSubmitMs", times.submit},
                 {"secondSubmitMs", times.secondSubmit},
                 {"prepareMs", times.prepare},
                 {"hitchMs", times.hitch},
                 {"arriveMs", times.arrive},
                 {"parseMs", times.parse},
                 {"cookedMs", times.cooked},
                 {"untilRecordedUsPerFace", aFace(1e3 * times.untilRecorded())},
                 {"untilDoneUsPerFace", aFace(1e3 * times.untilDone())},
                 {"deformBytesPerFace", aFace(static_cast<double>(loading->bytes.deform))},
                 {"tableBytesPerFace", aFace(static_cast<double>(loading->bytes.tables))},
                 {"staticBytesPerFace", aFace(static_cast<double>(loading->bytes.deform + loading->bytes.tables))},
                 {"indexBytes", loading->bytes.indices},
                 {"groupBytes", loading->bytes.group}});
            Status status = keep();
            if (status && compiled.insert(scheme).second) {
                status = pipelines(*cage, scheme);
            }
            if (!status) {
                return status;
            }
        }
    }
    std::fprintf(stderr, "\n");
    return success();
}

Status Run::pipelines(const BenchCage& cage, SuppleScheme scheme) {
    for (const PipelineUse use : {PipelineUse::plain, PipelineUse::inView}) {
        if (use == PipelineUse::inView && options_.quick && scheme != SUPPLE_SCHEME_PREP) {
            continue; // drivers take seconds to compile them
        }
        std::fprintf(stderr, "\rpipelines of %s   ", tools::schemeName(scheme));
        const Result<Pipelines> made = measurePipelines(device_, options_.mapping, cage, scheme, use);
        if (!made) {
            return made.error();
        }
        Json list = Json::array();
        for (const PipelineTime& one : made->pipelines) {
            list.push_back(
                {{"name", one.name}, {"spirvBytes", one.spirvBytes}, {"coldMs", one.cold}, {"warmMs", one.warm}});
        }
        result_["pipelines"].push_back({{"scheme", made->scheme},
                                        {"use", use == PipelineUse::inView ? "in a view" : ""},
                                        {"cage", made->cage},
                                        {"count", made->pipelines.size()},
                                        {"coldMs", made->cold},
                                        {"warmMs", made->warm},
                                        {"sideBySideMs", made->sideBySide},
                                        {"coldCpuMs", made->coldCpu},
                                        {"warmCpuMs", made->warmCpu},
                                        {"coldFirstFrameMs", made->coldFirstFrame},
                                        {"coldSecondFrameMs", made->coldSecondFrame},
                                        {"warmFirstFrameMs", made->warmFirstFrame},
                                        {"warmSecondFrameMs", made->warmSecondFrame},
                                        {"warmUpMs", made->warmUp},
                                        {"preparedFirstFrameMs", made->preparedFirstFrame},
                                        {"preparedSecondFrameMs", made->preparedSecondFrame},
                                        {"createdWhileRecording", made->createdWhileRecording},
                                        {"pipelines", list}});
    }
    return keep();
}

} // namespace

void disableDriverCaches() {
    // Mesa's, and NVIDIA's which is OpenGL's and Vulkan's alike. What the user has set stands.
    host::setEnvironmentDefault("MESA_SHADER_CACHE_DISABLE", "true");
    host::setEnvironmentDefault("__GL_SHADER_DISK_CACHE", "0");
}

Result<Json> runBench(host::Device& device, const tools::Machine& machine, const BenchOptions& options) {
    return Run(device, options).all(machine);
}

} // namespace supple::bench
