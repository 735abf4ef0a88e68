#include "tools/bench/bench.h"

#include "tools/bench/agreement.h"
#include "tools/bench/avx2_evaluation.h"
#include "tools/bench/heat.h"
#include "tools/bench/loading.h"
#include "tools/bench/plain_evaluation.h"
#include "tools/bench/scheme_names.h"
#include "tools/bench/targets.h"
#include "tools/host/context.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr double kTurnSeconds = 0.02, kQuickTurnSeconds = 0.002;
constexpr uint32_t kLoads = 9, kQuickLoads = 2;

class Run {
public:
    Run(host::Device& device, const BenchOptions& options) : device_(device), options_(options) {}

    Result<Json> all(const tools::Machine& machine) {
        Status status = prepare();
        if (status) {
            describe(machine);
            status = agree();
        }
        if (status) {
            status = heats();
        }
        if (status) {
            status = load();
        }
        if (!status) {
            return status.error();
        }
        result_["targets"] = judge(result_);
        return std::move(result_);
    }

private:
    Status prepare();
    void describe(const tools::Machine& machine);
    Status agree();
    Status heats();
    Status load();

    host::Device& device_;
    const BenchOptions& options_;
    std::vector<BenchCage> cages_;
    std::unique_ptr<Workbench> workbench_;
    OpensubdivPeers peers_;
    std::vector<float> yardstick_;
    Json result_;
};

Status Run::prepare() {
    for (const std::string& name : options_.cages) {
        Result<BenchCage> cage = makeCage(name);
        if (!cage) {
            return cage.error();
        }
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
        std::erase_if(cage.schemes, [&](SuppleScheme scheme) {
            return !options_.schemes.empty() && std::find(options_.schemes.begin(), options_.schemes.end(),
                                                          schemeName(scheme)) == options_.schemes.end();
        });
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
    result_["machine"] = {
        {"device", machine.device},   {"driver", machine.driver}, {"driverInfo", machine.driverInfo},
        {"mapping", machine.mapping}, {"cpu", machine.cpu},       {"threads", std::thread::hardware_concurrency()}};
    result_["cpuDevice"] = device_.isCpu();
    result_["rounds"] = options_.rounds;
    result_["peers"] = {{"plain C++", std::string("-O3 for ") + plainEvaluationTarget() + ", one thread"},
                        {"AVX2", hasAvx2Evaluation() ? "AVX2 and FMA by hand, one thread" : "not on this CPU"},
                        {"OpenSubdiv CPU", peers_.cpu()},
                        {"OpenSubdiv GLSL", peers_.glsl()}};
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
        if (cages_[c].peers) {
            Result<std::vector<Agreement>> peers = comparePeers(device_, *workbench_, peers_, cages_[c]);
            if (!peers) {
                return peers.error();
            }
            all->insert(all->end(), peers->begin(), peers->end());
        }
    }
    if (!all) {
        return all.error();
    }
    for (const Agreement& one : *all) {
        result_["agreement"].push_back({{"what", one.what}, {"difference", one.difference}, {"bound", one.bound}});
        if (!one.holds()) {
            return Error{ErrorCode::asset, "contestants differ: " + one.what + ": " + std::to_string(one.difference)};
        }
    }
    return success();
}

Status Run::heats() {
    result_["rows"] = Json::array();
    for (const BenchCage& cage : cages_) {
        for (const uint32_t rate : options_.rates) {
            HeatDesc desc;
            desc.cage = &cage;
            desc.rate = rate;
            desc.yardstick = yardstick_;
            desc.rounds.rounds = options_.rounds;
            desc.rounds.turnSeconds = options_.quick ? kQuickTurnSeconds : kTurnSeconds;
            desc.rounds.timestampsAreCheap = !device_.isCpu();
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
        }
    }
    return success();
}

Status Run::load() {
    result_["loading"] = Json::array();
    result_["pipelines"] = Json::array();
    std::set<SuppleScheme> compiled;
    // The demo characters, the last of the built-in cages, have patches of all classes: pipelines are taken from the
    // first in this order that has the scheme.
    std::vector<const BenchCage*> order;
    for (const BenchCage& cage : cages_) {
        order.push_back(&cage);
    }
    std::reverse(order.begin(), order.begin() + static_cast<ptrdiff_t>(options_.cages.size()));
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
                 {"untilRecordedUsPerFace", aFace(1e3 * times.untilRecorded())},
                 {"deformBytesPerFace", aFace(static_cast<double>(loading->bytes.deform))},
                 {"tableBytesPerFace", aFace(static_cast<double>(loading->bytes.tables))},
                 {"staticBytesPerFace", aFace(static_cast<double>(loading->bytes.deform + loading->bytes.tables))},
                 {"groupBytes", loading->bytes.group}});
            if (!compiled.insert(scheme).second) {
                continue;
            }
            std::fprintf(stderr, "\rpipelines of %s   ", loading->scheme.c_str());
            const Result<Pipelines> pipelines = measurePipelines(device_, options_.mapping, *cage, scheme);
            if (!pipelines) {
                return pipelines.error();
            }
            Json list = Json::array();
            for (const PipelineTime& one : pipelines->pipelines) {
                list.push_back(
                    {{"name", one.name}, {"spirvBytes", one.spirvBytes}, {"coldMs", one.cold}, {"warmMs", one.warm}});
            }
            result_["pipelines"].push_back({{"scheme", pipelines->scheme},
                                            {"cage", pipelines->cage},
                                            {"count", pipelines->pipelines.size()},
                                            {"coldMs", pipelines->cold},
                                            {"warmMs", pipelines->warm},
                                            {"coldFirstFrameMs", pipelines->coldFirstFrame},
                                            {"coldSecondFrameMs", pipelines->coldSecondFrame},
                                            {"warmFirstFrameMs", pipelines->warmFirstFrame},
                                            {"warmSecondFrameMs", pipelines->warmSecondFrame},
                                            {"createdWhileRecording", pipelines->createdWhileRecording},
                                            {"pipelines", list}});
        }
    }
    std::fprintf(stderr, "\n");
    return success();
}

} // namespace

void disableDriverCaches() {
    // Mesa's, and NVIDIA's which is OpenGL's and Vulkan's alike. What the user has set stands.
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
    setenv("__GL_SHADER_DISK_CACHE", "0", 0);
}

Result<Json> runBench(host::Device& device, const tools::Machine& machine, const BenchOptions& options) {
    return Run(device, options).all(machine);
}

} // namespace supple::bench
