#include "characters.h"

#include <QFile>
#include <QFileInfo>
#include <QLocale>
#include <QMatrix4x4>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace qt_quick {

namespace {

constexpr float kHeight = 1.7f;   // of everybody, whatever the units of the file
constexpr float kLength = 2.1f;   // and no longer or wider than this
constexpr float kSpacing = 1.55f; // between two of them

std::atomic<int> errorCount = 0;

/// The places of a honeycomb, from the middle outwards: ring k has 6 k.
QVector3D place(uint32_t i) {
    uint32_t ring = 0, first = 0;
    for (uint32_t size = 1; i >= first + size; size = 6 * ring) {
        first += size;
        ++ring;
    }
    if (ring == 0)
        return {};
    const float turn = static_cast<float>(i - first) / static_cast<float>(6 * ring) * 6.2831853f;
    const float radius = kSpacing * static_cast<float>(ring);
    return {radius * std::sin(turn), 0.0f, radius * std::cos(turn)};
}

} // namespace

void Characters::onLog(SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
    if (severity == SUPPLE_SEVERITY_INFO)
        return;
    std::fprintf(stderr, "supple %d: %s\n", static_cast<int>(message), text);
    if (severity == SUPPLE_SEVERITY_ERROR) {
        ++errorCount;
        static_cast<Characters*>(user)->lastError_ = QString::fromUtf8(text);
    }
}

int Characters::errors() {
    return errorCount;
}

Characters::Characters(const Device& device, uint32_t framesInFlight, const QString& recording)
    : recording_(recording) {
    shown_.character = -1;
    auto desc = supple::sized<SuppleContextDesc>();
    desc.instance = device.instance();
    desc.physicalDevice = device.physical();
    desc.device = device.handle();
    desc.queueFamily = device.queueFamily();
    desc.getInstanceProcAddr = vkGetInstanceProcAddr;
    desc.enabledFeatures = device.enabledFeatures();
    desc.framesInFlight = framesInFlight;
    desc.log = onLog;
    desc.logUser = this;
    must(supple::Context::create(desc, context_), "suppleCreateContext");
    if (!recording.isEmpty())
        startRecording();
}

void Characters::startRecording() {
    if (!recording_.open(QIODevice::WriteOnly))
        fail(qPrintable(recording_.fileName() + " cannot be written"));
    auto desc = supple::sized<SuppleRecordingDesc>();
    desc.flags = SUPPLE_RECORDING_HASHES;
    desc.user = &recording_;
    desc.write = [](const void* bytes, size_t count, void* user) {
        const auto size = static_cast<qint64>(count);
        return static_cast<QFile*>(user)->write(static_cast<const char*>(bytes), size) == size ? 1 : 0;
    };
    must(context_.startRecording(desc), "suppleStartRecording");
}

bool Characters::choose(const Settings& settings) {
    const bool loads = settings.character != shown_.character;
    if (loads)
        load(settings.files[settings.character]);
    const bool remakes = loads || settings.scheme != shown_.scheme || settings.rate != shown_.rate;
    bool made = false;
    if (remakes) {
        const auto rate = static_cast<uint32_t>(settings.rate);
        refusal_.clear();
        made = makeGroup(static_cast<SuppleScheme>(settings.scheme), rate);
        if (!made) {
            refusal_ = lastError_;
            // Another character must not stand there with the old one's surface.
            if (loads && !(made = makeGroup(SUPPLE_SCHEME_AUTO, rate)))
                fail("no surface can be made");
        }
    }
    shown_ = settings;
    stand(std::min(static_cast<uint32_t>(settings.count), info_.capacity));
    return made;
}

void Characters::load(const QString& path) {
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        fail(qPrintable(path + " cannot be read"));
    const QByteArray bytes = file.readAll();
    const QByteArray name = QFileInfo(path).fileName().toUtf8();
    const QByteArray folder = QFileInfo(path).absolutePath().toUtf8();
    auto desc = supple::sized<SuppleAssetDesc>();
    desc.name = name.constData();
    desc.bytes = bytes.constData();
    desc.byteCount = static_cast<size_t>(bytes.size());
    desc.baseDirectory = folder.constData();
    must(supple::Asset::create(context_, desc, asset_), "suppleCreateAsset");
    must(asset_.info(assetInfo_), "suppleGetAssetInfo");
    clips_.clear();
    for (uint32_t i = 0; i < assetInfo_.clipCount; ++i) {
        SuppleClipInfo clip{};
        must(asset_.clipInfo(i, clip), "suppleGetClipInfo");
        clips_ += QString::fromUtf8(clip.name);
    }
    must(asset_.clipBounds(SUPPLE_REST_POSE, box_), "suppleGetClipBounds");
}

/// False if the scheme refuses the cage; what was shown before stays. The old group may go while frames still draw it.
bool Characters::makeGroup(SuppleScheme scheme, uint32_t rate) {
    auto desc = supple::sized<SuppleGroupDesc>();
    desc.asset = asset_.handle();
    desc.capacity = kMaxCount;
    desc.scheme = scheme;
    desc.rate = rate;
    // Texture coordinates and colors. Of windows there shall be one: then a shader gets the vertices as one buffer.
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_WINDOWS;
    for (;;) {
        supple::Group group;
        if (supple::Group::create(context_, desc, group) != SUPPLE_OK)
            return false;
        SuppleGroupInfo info{};
        must(group.info(info), "suppleGetGroupInfo");
        if (info.windowCount > 1) { // fewer instances
            desc.capacity = info.windowSize;
            continue;
        }
        std::vector<Surface> surfaces(info.surfaceCount);
        for (uint32_t i = 0; i < info.surfaceCount; ++i) {
            must(group.vertexStreams(surfaces[i].streams, i), "suppleGetVertexStreams");
            must(group.gridOutput(surfaces[i].grid, i), "suppleGetGridOutput");
        }
        instances_.clear();
        group_ = std::move(group);
        info_ = info;
        surfaces_ = std::move(surfaces);
        return true;
    }
}

/// As many instances as are asked for, each at its place of the honeycomb.
void Characters::stand(uint32_t count) {
    while (instances_.size() > count)
        instances_.pop_back();
    const QVector3D least(box_.min[0], box_.min[1], box_.min[2]), most(box_.max[0], box_.max[1], box_.max[2]);
    const QVector3D size = most - least;
    const float scale = std::min(kHeight / std::max(size.y(), 1e-6f), kLength / std::max({size.x(), size.z(), 1e-6f}));
    while (instances_.size() < count) {
        const QVector3D at = place(static_cast<uint32_t>(instances_.size()));
        const auto variant =
            static_cast<float>(instances_.size() * 5 % 7) / 3.0f - 1.0f; // -1 to 1: nobody is quite alike
        QMatrix4x4 transform;
        transform.translate(at);
        transform.rotate(16.0f * variant, 0.0f, 1.0f, 0.0f);
        transform.scale(scale * (1.0f - 0.08f * variant));
        transform.translate(-0.5f * (least.x() + most.x()), -least.y(), -0.5f * (least.z() + most.z()));
        supple::Instance& instance = instances_.emplace_back();
        must(supple::Instance::create(group_, instance), "suppleCreateInstance");
        must(instance.setTransform(supple::MatrixSpan<const float>(transform.constData())), "suppleSetTransform");
    }
    feet_.clear();
    for (uint32_t i = 0; i < count; ++i) {
        const QVector3D at = place(i);
        feet_.push_back({at.x(), at.y(), at.z(), 0.5f});
    }
}

void Characters::record(VkCommandBuffer commands, const Settings& settings, uint64_t frame, uint64_t completed) {
    must(context_.beginFrame(frame, completed), "suppleBeginFrame");
    for (size_t i = 0; i < instances_.size(); ++i) {
        if (settings.clip >= clips_.size()) {
            must(instances_[i].setClipPose(SUPPLE_REST_POSE, 0.0), "suppleSetClipPose");
            continue;
        }
        SuppleClipLayer layer{};
        layer.clip = static_cast<uint32_t>(settings.clip);
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = 1.0f;
        layer.time = settings.time + 0.37 * static_cast<double>(i); // no two in step
        must(instances_[i].setPose({&layer, 1}), "suppleSetPose");
    }
    const SuppleGroup groups[] = {group_.handle()};
    must(context_.record(commands, groups, kDraws, kDraws, SUPPLE_RECORD_TIMINGS), "suppleRecord");
}

void Characters::report(Report& out) const {
    out.clips = clips_;
    out.refusal = refusal_;
    uint32_t vertices = 0;
    for (const Surface& surface : surfaces_)
        vertices += surface.grid.vertexCount;
    const QLocale locale(QLocale::English);
    out.summary = QStringLiteral("%1 polygons become %2 vertices, %3 times in every frame")
                      .arg(locale.toString(assetInfo_.faceCount), locale.toString(vertices))
                      .arg(instances_.size());
    out.passes.clear();
    if (context_.timings(timings_) != SUPPLE_OK)
        return;
    for (const SuppleTiming& timing : timings_) {
        const QString name = QString::fromLatin1(suppleGetPassName(timing.pass));
        if (out.passes.isEmpty() || out.passes.last().name != name) // a pass may have several entries
            out.passes.append({name, 0.0});
        out.passes.last().milliseconds += (timing.gpuEnd - timing.gpuBegin) * 1e-6;
    }
}

} // namespace qt_quick
