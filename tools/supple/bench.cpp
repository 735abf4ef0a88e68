// supple bench: the permanent benchmark. All contestants of a row run in interleaved rounds of one process, so that a
// slow phase of the machine meets them all; what counts is the ratio within a round.
#include "cage/procedural.h"
#include "runtime/context.h"
#include "tools/host/cage_arrays.h"
#include "tools/supple/command.h"
#include "tools/supple/plain_evaluation.h"
#include "tools/supple/session.h"
#include "tools/supple/statistics.h"
#include "tools/supple/text_file.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <nlohmann/json.hpp>

namespace supple::tools {
namespace {

struct BenchOptions {
    DeviceFlags device;
    std::string json;
    uint32_t rounds = 15;
    std::vector<uint32_t> rates = {4, 8, 16};
};

/// CPU time of the whole process: on a CPU device it covers the driver's threads, and other load does not count.
double processSeconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
double wallSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Cost {
    double cpu = 0.0;  ///< seconds
    double wall = 0.0; ///< seconds
};

/// One thing measured: work that is repeated often enough for the clock.
struct Contestant {
    std::string name;
    uint64_t points = 0;
    std::function<Status(uint32_t repeats)> run;
    uint32_t repeats = 1;
    std::vector<double> cpuPerPoint, wallPerPoint; ///< nanoseconds, one a round
};

Status measure(Contestant& c, Cost& cost) {
    const double cpu = processSeconds(), wall = wallSeconds();
    Status status = c.run(c.repeats);
    cost = {processSeconds() - cpu, wallSeconds() - wall};
    return status;
}

/// Compute work submitted again and again from one command buffer.
class Replay {
public:
    Replay(host::Device& device, const std::function<void(VkCommandBuffer)>& record) : device_(device) {
        VkCommandBufferAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = device.commandPool();
        info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        info.commandBufferCount = 1;
        result_ = vkAllocateCommandBuffers(device.handle(), &info, &commands_);
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        if (result_ == VK_SUCCESS) {
            result_ = vkCreateFence(device.handle(), &fence, nullptr, &fence_);
        }
        if (result_ != VK_SUCCESS) {
            return;
        }
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        vkBeginCommandBuffer(commands_, &begin);
        record(commands_);
        result_ = vkEndCommandBuffer(commands_);
    }
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;
    ~Replay() {
        vkDestroyFence(device_.handle(), fence_, nullptr);
        if (commands_ != VK_NULL_HANDLE) {
            vkFreeCommandBuffers(device_.handle(), device_.commandPool(), 1, &commands_);
        }
    }
    Status run(uint32_t repeats) {
        for (uint32_t i = 0; i < repeats && result_ == VK_SUCCESS; ++i) {
            VkSubmitInfo submit{};
            submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
            submit.commandBufferCount = 1;
            submit.pCommandBuffers = &commands_;
            vkResetFences(device_.handle(), 1, &fence_);
            result_ = vkQueueSubmit(device_.queue(), 1, &submit, fence_);
            if (result_ == VK_SUCCESS) {
                result_ = vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
            }
        }
        return result_ == VK_SUCCESS ? success() : Status(host::vulkanError(result_, "replaying a benchmark frame"));
    }

private:
    host::Device& device_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkResult result_ = VK_SUCCESS;
};

/// A cage as a group of one instance on an internal context: the benchmark times single passes, which the public
/// interface does not record apart.
struct Subject {
    std::string name;
    runtime::Context* context = nullptr;
    uint64_t group = 0;
    [[nodiscard]] runtime::Group& get() const { return *context->groups.find(group); }
};

constexpr SuppleSyncScope kNoScope{VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};

/// A cage under a scheme.
struct Course {
    const char* name;
    cage::Cage cage;
    SuppleScheme scheme;
};

/// Every quad cut along a diagonal: what P_m makes P_3 patches of.
cage::Cage triangulated(const cage::Cage& quads) {
    cage::Cage cage;
    cage.positions = quads.positions;
    cage.faceStarts.push_back(0);
    for (uint32_t f = 0; f < quads.faceCount(); ++f) {
        const uint32_t* v = &quads.faceVertices[quads.faceStarts[f]];
        for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) {
            cage.faceVertices.push_back(v[corner]);
        }
        cage.faceStarts.push_back(cage.faceStarts.back() + 3);
        cage.faceStarts.push_back(cage.faceStarts.back() + 3);
    }
    return cage;
}

Result<Subject> makeSubject(runtime::Context& context, const Course& course, uint32_t rate, SuppleVertexFormat format) {
    const std::string name = course.name;
    const cage::Cage& cage = course.cage;
    const host::CageArrays arrays(cage);
    Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, name);
    if (!character) {
        return character.error();
    }
    Result<uint64_t> asset = context.createAsset(std::move(*character));
    if (!asset) {
        return asset.error();
    }
    SuppleGroupDesc groupDesc{};
    groupDesc.structSize = sizeof(groupDesc);
    // The yardstick's input; subdivision has none.
    groupDesc.flags = course.scheme == SUPPLE_SCHEME_PREP ? SUPPLE_GROUP_PATCHES : 0;
    groupDesc.asset = {*asset};
    groupDesc.capacity = 1;
    groupDesc.scheme = course.scheme;
    groupDesc.rate = rate;
    groupDesc.vertexFormat = format;
    Result<uint64_t> group = context.createGroup(groupDesc);
    if (!group) {
        return group.error();
    }
    (void)context.groups.find(*group)->slots().create();
    context.assets.remove(*asset);
    return Subject{name, &context, *group};
}

struct Row {
    std::string cage;
    uint32_t rate = 0;
    std::vector<Contestant> contestants;
    double checksum = 0.0; ///< of the plain evaluation, so that the compiler cannot leave it out
};

double medianRatio(const Contestant& a, const Contestant& b) {
    std::vector<double> ratios;
    for (size_t i = 0; i < a.cpuPerPoint.size(); ++i) {
        ratios.push_back(a.cpuPerPoint[i] / b.cpuPerPoint[i]);
    }
    return summarize(ratios).median;
}

class Bench {
public:
    Bench(Session& session, const BenchOptions& options) : session_(session), options_(options) {}

    Status run() {
        SuppleContextDesc desc = host::contextDesc(*session_.device);
        desc.mapping = mappingOf(options_.device);
        Result<std::unique_ptr<runtime::Context>> context = runtime::Context::create(desc);
        if (!context) {
            return context.error();
        }
        context_ = std::move(*context);

        for (const uint32_t rate : options_.rates) {
            Status status = runRate(rate);
            if (!status) {
                return status;
            }
        }
        report();
        return options_.json.empty() ? success() : writeJson();
    }

private:
    /// Records a whole frame of `subject` once, so that statics are uploaded.
    Status warmUp(const Subject& subject) {
        Status status = success();
        const Status submitted = session_.device->submitAndWait(
            [&](VkCommandBuffer commands) { status = recordFrame(subject, commands, 0); });
        return status ? submitted : status;
    }
    Status recordFrame(const Subject& subject, VkCommandBuffer commands, uint32_t flags) {
        ++frame_;
        Status status = context_->beginFrame(frame_, frame_ - 1);
        if (!status) {
            return status;
        }
        const SuppleGroup group{subject.group};
        SuppleRecordDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = flags;
        desc.groups = &group;
        desc.groupCount = 1;
        desc.before = kNoScope;
        desc.after = {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
        return context_->record(commands, desc);
    }

    Status runRate(uint32_t rate) {
        const uint32_t samples = (rate + 1) * (rate + 1);
        struct Form {
            const char* name;
            SuppleVertexFormat format;
        };
        const Form forms[] = {{"24 B", SUPPLE_VERTEX_24}, {"16 B", SUPPLE_VERTEX_16}};
        const Course courses[] = {
            {"cube sphere 1350", cage::makeCubeSphere(15), SUPPLE_SCHEME_PREP},
            {"irregular 1296", cage::makeSplitTorus(18, 12), SUPPLE_SCHEME_PREP},
            {"P_m irregular 1296", cage::makeSplitTorus(18, 12), SUPPLE_SCHEME_PM},
            {"P_m triangles 2700", triangulated(cage::makeCubeSphere(15)), SUPPLE_SCHEME_PM},
            {"Catmull-Clark sphere 1350", cage::makeCubeSphere(15), SUPPLE_SCHEME_CATMULL_CLARK},
            {"Loop sphere 2700", triangulated(cage::makeCubeSphere(15)), SUPPLE_SCHEME_LOOP},
            {"blend sphere 1350", cage::makeCubeSphere(15), SUPPLE_SCHEME_BLEND},
        };
        std::vector<std::unique_ptr<Replay>> replays;
        std::vector<Subject> subjects;
        Row row;
        row.rate = rate;
        for (const Course& course : courses) {
            const std::string name = course.name;
            for (const Form& form : forms) {
                Result<Subject> subject = makeSubject(*context_, course, rate, form.format);
                if (!subject) {
                    return subject.error();
                }
                subjects.push_back(*subject);
                Status status = warmUp(*subject);
                if (!status) {
                    return status;
                }
                runtime::Group& group = subject->get();
                replays.push_back(std::make_unique<Replay>(
                    *session_.device, [&](VkCommandBuffer commands) { group.recordEvaluate(commands); }));
                Replay* evaluate = replays.back().get();
                Status recorded = success();
                replays.push_back(std::make_unique<Replay>(*session_.device, [&](VkCommandBuffer commands) {
                    recorded = recordConstruction(group, commands);
                }));
                Replay* frame = replays.back().get();
                if (!recorded) {
                    return recorded;
                }
                const uint64_t points = group.output().vertexCount;
                row.contestants.push_back({name + ", evaluate " + form.name,
                                           points,
                                           [evaluate](uint32_t n) { return evaluate->run(n); },
                                           1,
                                           {},
                                           {}});
                row.contestants.push_back(
                    {name + ", frame " + form.name, points, [frame](uint32_t n) { return frame->run(n); }, 1, {}, {}});
            }
        }
        // The yardstick evaluates the sphere's patches from the coefficients the GPU gathered.
        Result<std::vector<std::byte>> bytes =
            session_.device->readBuffer(subjects.front().get().output().patchCoefficients);
        if (!bytes) {
            return bytes.error();
        }
        std::vector<float> coefficients;
        for (size_t p = 0; p < bytes->size() / 512; ++p) {
            const size_t first = coefficients.size();
            coefficients.resize(first + 64);
            std::memcpy(coefficients.data() + first, bytes->data() + 512 * p, 256);
        }
        std::vector<float> out;
        row.contestants.push_back({"cube sphere 1350, plain C++ bi-3 24 B",
                                   uint64_t{coefficients.size() / 64} * samples,
                                   [&](uint32_t n) {
                                       for (uint32_t i = 0; i < n; ++i) {
                                           evaluatePlain(coefficients, rate, out);
                                       }
                                       return success();
                                   },
                                   1,
                                   {},
                                   {}});

        for (Contestant& c : row.contestants) { // about 20 ms a turn
            Cost cost;
            for (int i = 0; i < 2; ++i) {
                Status status = measure(c, cost);
                if (!status) {
                    return status;
                }
            }
            c.repeats = static_cast<uint32_t>(std::clamp(0.02 / std::max(cost.cpu, 1e-6), 1.0, 1000.0));
        }
        for (uint32_t round = 0; round < options_.rounds; ++round) {
            for (Contestant& c : row.contestants) {
                Cost cost;
                Status status = measure(c, cost);
                if (!status) {
                    return status;
                }
                const double scale = 1e9 / (static_cast<double>(c.points) * c.repeats);
                c.cpuPerPoint.push_back(cost.cpu * scale);
                c.wallPerPoint.push_back(cost.wall * scale);
            }
            std::fprintf(stderr, "\rrate %u: round %u of %u", rate, round + 1, options_.rounds);
        }
        std::fprintf(stderr, "\n");
        for (const float x : out) {
            row.checksum += std::abs(x); // a plain sum of a symmetric shape says nothing
        }
        for (Contestant& c : row.contestants) {
            c.run = nullptr;
        }
        rows_.push_back(std::move(row));
        for (const Subject& subject : subjects) {
            context_->destroyGroup(subject.group);
        }
        return success();
    }

    /// deform .. evaluate with the barriers of a frame; the palette stays as it was uploaded.
    Status recordConstruction(runtime::Group& group, VkCommandBuffer commands) {
        const auto barrier = [&] {
            host::memoryBarrier(commands,
                                {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                                {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                                                             VK_ACCESS_2_SHADER_SAMPLED_READ_BIT |
                                                                             VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
        };
        group.recordDeform(commands);
        barrier();
        group.recordStage(commands, surface::Stage::vertex);
        barrier();
        if (group.tables().has(surface::Stage::edge)) {
            group.recordStage(commands, surface::Stage::edge);
            barrier();
        }
        group.recordEvaluate(commands);
        return success();
    }

    static const Contestant& find(const Row& row, const std::string& name) {
        for (const Contestant& c : row.contestants) {
            if (c.name == name) {
                return c;
            }
        }
        return row.contestants.front();
    }

    struct NamedRatio {
        const char* name;
        std::string a, b;
    };
    static std::vector<NamedRatio> ratios() {
        const std::string sphere = "cube sphere 1350, ", irregular = "irregular 1296, ";
        const std::string quads = "P_m irregular 1296, ", triangles = "P_m triangles 2700, ";
        const std::string catmullClark = "Catmull-Clark sphere 1350, ", loop = "Loop sphere 2700, ";
        const std::string blend = "blend sphere 1350, ";
        return {{"frame / evaluate, cube sphere, 24 B", sphere + "frame 24 B", sphere + "evaluate 24 B"},
                {"frame / evaluate, cube sphere, 16 B", sphere + "frame 16 B", sphere + "evaluate 16 B"},
                {"frame / evaluate, irregular, 24 B", irregular + "frame 24 B", irregular + "evaluate 24 B"},
                {"frame / evaluate, irregular, 16 B", irregular + "frame 16 B", irregular + "evaluate 16 B"},
                {"bi-5 / bi-3 evaluation, 24 B", irregular + "evaluate 24 B", sphere + "evaluate 24 B"},
                {"bi-5 / bi-3 evaluation, 16 B", irregular + "evaluate 16 B", sphere + "evaluate 16 B"},
                {"P_4 / bi-3 evaluation, 24 B", quads + "evaluate 24 B", sphere + "evaluate 24 B"},
                {"P_4 / bi-3 evaluation, 16 B", quads + "evaluate 16 B", sphere + "evaluate 16 B"},
                {"P_3 / bi-3 evaluation, 24 B", triangles + "evaluate 24 B", sphere + "evaluate 24 B"},
                {"Catmull-Clark / bi-3 evaluation, 24 B", catmullClark + "evaluate 24 B", sphere + "evaluate 24 B"},
                {"Loop / bi-3 evaluation, 24 B", loop + "evaluate 24 B", sphere + "evaluate 24 B"},
                {"blend / bi-3 evaluation, 24 B", blend + "evaluate 24 B", sphere + "evaluate 24 B"},
                {"frame / evaluate, P_m irregular, 24 B", quads + "frame 24 B", quads + "evaluate 24 B"},
                {"frame / evaluate, P_m triangles, 24 B", triangles + "frame 24 B", triangles + "evaluate 24 B"},
                {"bi-3 evaluation 24 B / plain C++", sphere + "evaluate 24 B", sphere + "plain C++ bi-3 24 B"},
                {"bi-3 evaluation 16 B / plain C++", sphere + "evaluate 16 B", sphere + "plain C++ bi-3 24 B"}};
    }

    void report() const {
        std::printf("device    %s\n", session_.device->name().c_str());
        std::printf("yardstick plain C++ -O3 for %s, one thread\n", plainEvaluationTarget());
        std::printf("times     medians of %u interleaved rounds, timestamps off, no pose sampling\n\n",
                    options_.rounds);
        for (const Row& row : rows_) {
            std::printf("rate %u (checksum of the yardstick %.6g)\n", row.rate, row.checksum);
            std::printf("  %-40s %10s %10s %12s\n", "", "CPU ns/pt", "wall ns/pt", "wall ms");
            for (const Contestant& c : row.contestants) {
                const double wall = summarize(c.wallPerPoint).median;
                std::printf("  %-40s %10.2f %10.2f %12.3f\n", c.name.c_str(), summarize(c.cpuPerPoint).median, wall,
                            wall * static_cast<double>(c.points) * 1e-6);
            }
            for (const NamedRatio& ratio : ratios()) {
                std::printf("  %-40s %10.2f\n", ratio.name, medianRatio(find(row, ratio.a), find(row, ratio.b)));
            }
            std::printf("\n");
        }
        std::printf(
            "CPU time is the process's: on a CPU device it covers the driver's threads; on a GPU read wall times.\n");
    }

    Status writeJson() const {
        nlohmann::json json;
        json["device"] = session_.device->name();
        json["yardstick"] = plainEvaluationTarget();
        json["rounds"] = options_.rounds;
        for (const Row& row : rows_) {
            nlohmann::json entry{{"rate", row.rate}, {"checksum", row.checksum}};
            for (const Contestant& c : row.contestants) {
                entry["contestants"].push_back({{"name", c.name},
                                                {"points", c.points},
                                                {"cpuNanosecondsPerPoint", summarize(c.cpuPerPoint).median},
                                                {"wallNanosecondsPerPoint", summarize(c.wallPerPoint).median}});
            }
            for (const NamedRatio& ratio : ratios()) {
                entry["ratios"][ratio.name] = medianRatio(find(row, ratio.a), find(row, ratio.b));
            }
            json["rows"].push_back(entry);
        }
        TextFile file(options_.json);
        file.text(json.dump(2)).text("\n");
        return file.close();
    }

    Session& session_;
    const BenchOptions& options_;
    std::unique_ptr<runtime::Context> context_;
    std::vector<Row> rows_;
    uint64_t frame_ = 0;
};

} // namespace

void bindBench(CLI::App& app, int& exitCode) {
    CLI::App* command = app.add_subcommand("bench", "Measure construction and evaluation against a plain C++ loop");
    auto options = std::make_shared<BenchOptions>();
    bindDevice(*command, options->device);
    command->add_option("--json", options->json, "Write the figures to this file");
    command->add_option("--rounds", options->rounds, "Interleaved rounds")->check(CLI::Range(1u, 1000u));
    command->add_option("--rates", options->rates, "Tessellation rates")->check(CLI::Range(1u, SUPPLE_MAX_RATE));
    command->callback([options, &exitCode] {
        exitCode = withSession(options->device, [&](Session& session) { return Bench(session, *options).run(); });
    });
}

} // namespace supple::tools
