#include "tools/supple/view.h"

#include "base/utf8_path.h"
#include "tools/supple/command.h"

#if !SUPPLE_HAS_WINDOW

namespace supple::tools {

int runView(const ViewOptions&) {
    return fail(kExitUsage, "view: this supple was built without GLFW and Dear ImGui");
}

} // namespace supple::tools

#else

#include "host/overlay.h"
#include "host/window.h"
#include "tools/supple/view_overlay.h"
#include "tools/supple/view_panel.h"
#include "tools/supple/view_pictures.h"
#include "tools/supple/view_stage.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <utility>

namespace supple::tools {

namespace {

/// With --frames every frame is a fixed step and the panel shows no timings: the same frame is always the same picture.
constexpr double kFixedStep = 1.0 / 30.0;

constexpr VkImageSubresourceRange kWholeImage{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
constexpr SuppleSyncScope kCopyRead{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr SuppleSyncScope kCopyWrite{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr SuppleSyncScope kColor{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                 VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};

/// The same bits, read as sRGB: the renderer writes linear light, the window shows what is stored.
VkFormat srgbFormat(VkFormat format) {
    return format == VK_FORMAT_B8G8R8A8_UNORM ? VK_FORMAT_B8G8R8A8_SRGB : VK_FORMAT_R8G8B8A8_SRGB;
}

/// The same frames are to be the same pictures, and good ones.
Look lookOf(const ViewOptions& options) {
    if (options.look == "auto" && options.frames == 0)
        return Look::automatic;
    return options.look == "fast" ? Look::fast : Look::studio;
}

std::string fileName(const std::string& path) {
    return printable(utf8Text(utf8Path(path).filename()));
}

/// Everything of the viewer, in the order it is made; it goes in the opposite order.
class Viewer {
public:
    explicit Viewer(const ViewOptions& options) : options_(options) {}

    [[nodiscard]] Status open(VkExtent2D size);
    [[nodiscard]] Status run();
    [[nodiscard]] std::shared_ptr<const host::ValidationLog> validation() const { return validation_; }
    /// Whether a file of the command line was refused, which has been said.
    [[nodiscard]] bool hasRefused() const {
        const size_t given = panel_ ? options_.files.size() : 0;
        return given > 0 &&
               std::any_of(panel_->files.begin(), panel_->files.begin() + static_cast<std::ptrdiff_t>(given),
                           [](const PanelFile& file) { return file.refused; });
    }

private:
    void startPanel();
    [[nodiscard]] Status openFirst(float shape);
    void refuse(size_t file, const Error& error);
    /// Opens a file that is shown then; on failure says why and leaves the old one.
    [[nodiscard]] Status show(const std::string& path);
    /// Files that were dropped on the window: the last one is shown. A folder is browsed.
    [[nodiscard]] Status takeDropped();
    /// Figures are framed beside the panel, unless it takes half of the window and more.
    void coverByPanel(uint32_t width);
    /// Frames that are counted leave nothing behind and depend on nothing.
    [[nodiscard]] bool remembers() const { return options_.frames == 0; }
    void remember(const std::string& path);
    [[nodiscard]] Status fitTarget();
    [[nodiscard]] Status attachPicked();
    [[nodiscard]] Status fulfil(const PanelWishes& wishes);
    [[nodiscard]] Status drawFrame(const host::WindowFrame& frame, bool readBack);
    /// Shows what is being done while the window does not answer: over the last picture, or over nothing.
    [[nodiscard]] Status announce(const std::string& what);
    void clearWindow(const host::WindowFrame& frame) const;
    void copyToWindow(const host::WindowFrame& frame) const;
    void copyToHost(const host::WindowFrame& frame) const;
    [[nodiscard]] Status writeScreenshot(const std::string& path) const;
    [[nodiscard]] double secondsSinceLast();
    [[nodiscard]] float aspect() const {
        return static_cast<float>(window_->swapchain().extent().width) /
               static_cast<float>(window_->swapchain().extent().height);
    }

    const ViewOptions& options_;
    std::shared_ptr<const host::ValidationLog> validation_;
    std::unique_ptr<host::Device> device_;
    std::unique_ptr<host::Context> context_;
    std::unique_ptr<host::Window> window_;
    std::unique_ptr<host::Overlay> overlay_;
    std::unique_ptr<host::SurfaceRenderer> renderer_;
    std::unique_ptr<ViewPictures> pictures_;
    std::optional<LookPace> pace_;
    std::optional<ViewStage::Shown> lastShown_;
    double seconds_ = 0.0; ///< since the last frame began
    uint32_t targetGeneration_ = 0;
    host::Buffer screenshot_;
    std::unique_ptr<ViewStage> stage_;
    std::optional<PanelState> panel_;
    ViewExport export_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Moves a made thing to where it is kept, or passes the error on.
template <class T>
Status keep(Result<T> made, T& place) {
    if (!made)
        return made.error();
    place = std::move(*made);
    return success();
}

Status Viewer::open(VkExtent2D size) {
    const DeviceFlags flags = deviceFlags(options_.draw);
    if (const Status status =
            keep(host::Device::create({.device = flags.device, .validation = flags.validate, .window = true}), device_);
        !status)
        return status.error();
    validation_ = device_->validation();
    if (const Status status = keep(host::Context::create(*device_, {.mapping = mappingOf(flags),
                                                                    .framesInFlight = host::kFramesInFlight,
                                                                    .record = flags.record}),
                                   context_);
        !status)
        return status.error();
    if (const Status status = keep(host::Window::create(*device_, "supple", size), window_); !status)
        return status.error();
    if (const Status status = keep(host::Overlay::create(*device_, *window_), overlay_); !status)
        return status.error();
    if (const Status status = announce("starting"); !status)
        return status.error();
    // The largest maps that a look of view_look.h has.
    host::StudioQuality quality = host::StudioQuality::interactive(device_->isCpu());
    quality.shadowSize = std::max(quality.shadowSize, host::StudioQuality::refining().shadowSize);
    const host::RendererOptions rendererOptions{.colorFormat = srgbFormat(window_->swapchain().format()),
                                                .quality = quality,
                                                .framesInFlight = host::kFramesInFlight};
    if (const Status status = keep(host::SurfaceRenderer::create(*device_, rendererOptions), renderer_); !status)
        return status.error();
    if (const Status status = keep(ViewPictures::create(*device_, *renderer_), pictures_); !status)
        return status.error();
    pace_.emplace(device_->isCpu(), host::StudioQuality::refining().passes, options_.frames > 0);
    if (const Status status = keep(ViewStage::create(*context_, *renderer_, options_.draw), stage_); !status)
        return status.error();
    startPanel();
    coverByPanel(size.width);
    if (const Status status = openFirst(static_cast<float>(size.width) / static_cast<float>(size.height)); !status)
        return status.error();
    window_->waitIdle(context_->lastFrame()); // opening evaluates frames of its own
    return success();
}

void Viewer::startPanel() {
    panel_.emplace();
    for (const std::string& file : options_.files)
        panel_->files.push_back({file, false});
    panel_->device = device_->name();
    panel_->timings = options_.frames == 0;
    panel_->exportSize[0] = static_cast<int>(window_->swapchain().extent().width);
    panel_->exportSize[1] = static_cast<int>(window_->swapchain().extent().height);
    if (remembers())
        panel_->recent = readRecentFiles(recentFilesPath());
    std::error_code fault;
    panel_->browser.enter(std::filesystem::current_path(fault));
    panel_->browser.open = options_.files.empty();
    stage_->settings.look = lookOf(options_);
}

/// Shows the first file that can be opened, and says which of the others cannot be read.
Status Viewer::openFirst(float shape) {
    for (size_t i = 0; i < options_.files.size(); ++i) {
        if (stage_->hasFigure()) {
            const Result<host::CharacterFile> file = host::readCharacterFile(options_.files[i], options_.draw.reading);
            if (!file)
                refuse(i, file.error());
            continue;
        }
        if (const Status told = announce("opening " + fileName(options_.files[i])); !told)
            return told.error();
        const Status status = stage_->open(options_.files[i], options_.clip, shape);
        if (status) {
            panel_->file = i;
            remember(options_.files[i]);
            continue;
        }
        const bool more = i + 1 < options_.files.size();
        if (!more || status.error().code == ErrorCode::deviceLost)
            return status.error();
        refuse(i, status.error());
    }
    return success();
}

void Viewer::coverByPanel(uint32_t width) {
    const float share = kPanelRight / static_cast<float>(width);
    stage_->setCovered(stage_->settings.panel && share < 0.5f ? share : 0.0f);
}

void Viewer::refuse(size_t file, const Error& error) {
    panel_->files[file].refused = true;
    panel_->message = error.message;
    fail(error);
}

double Viewer::secondsSinceLast() {
    const auto now = std::chrono::steady_clock::now();
    seconds_ = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    panel_->frameMilliseconds += 0.1 * (seconds_ * 1e3 - panel_->frameMilliseconds);
    return options_.frames > 0 ? kFixedStep : seconds_;
}

Status Viewer::run() {
    if (const Status status = announce("compiling shaders; the first time takes longest"); !status)
        return status.error();
    uint32_t drawn = 0;
    bool windowPicture = false;
    while (!window_->shouldClose()) {
        // A picture that stays costs nothing until something happens; timings go on.
        constexpr double kPatience = 0.1;
        Result<std::optional<host::WindowFrame>> begun =
            window_->begin(panel_->step.kind == LookStep::Kind::keep ? kPatience : 0.0);
        if (!begun)
            return begun.error();
        if (!begun->has_value())
            continue;
        if (const Status status = fitTarget(); !status)
            return status.error();
        stage_->retire(window_->completedFrame());
        coverByPanel(window_->swapchain().extent().width);
        stage_->advance(secondsSinceLast());
        panel_->keys = window_->takeKeys();
        panel_->exported = export_.report();
        if (const Status status = overlay_->showText(panelText(*panel_, *stage_)); !status)
            return status.error();
        overlay_->beginPanels();
        const PanelWishes wishes = buildPanel(*panel_, *stage_, aspect());
        overlay_->endPanels();

        const bool isLast = options_.frames > 0 && drawn + 1 == options_.frames;
        const bool readBack = windowPicture || (isLast && !options_.screenshot.empty());
        if (const Status status = drawFrame(**begun, readBack); !status)
            return status.error();
        ++drawn;
        if (readBack) {
            window_->waitIdle(context_->lastFrame());
            const std::string path = windowPicture ? freeName("window", ".png") : options_.screenshot;
            if (const Status status = writeScreenshot(path); !status)
                return status.error();
            if (windowPicture)
                note("wrote " + path);
            windowPicture = false;
        }
        windowPicture = wishes.windowPicture;
        if (isLast || wishes.close)
            break;
        // Between frames, so that nothing half recorded refers to what is exchanged.
        for (const Status& status : {takeDropped(), fulfil(wishes)}) {
            if (!status)
                panel_->message = status.error().message;
        }
    }
    window_->waitIdle(context_->lastFrame());
    return success();
}

Status Viewer::fitTarget() {
    if (targetGeneration_ == window_->swapchain().generation())
        return success();
    window_->waitIdle(context_->lastFrame());
    if (const Status status = pictures_->fit(window_->swapchain().extent(), srgbFormat(window_->swapchain().format()));
        !status)
        return status.error();
    lastShown_.reset();
    targetGeneration_ = window_->swapchain().generation();
    return success();
}

Status Viewer::show(const std::string& path) {
    const auto known = std::find_if(panel_->files.begin(), panel_->files.end(),
                                    [&](const PanelFile& file) { return file.path == path; });
    const auto index = static_cast<size_t>(known - panel_->files.begin());
    if (known == panel_->files.end())
        panel_->files.push_back({path, false});
    if (const Status status = announce("opening " + fileName(path)); !status)
        return status.error();
    window_->waitIdle(context_->lastFrame());
    if (const Status status = stage_->open(path, {}, aspect()); !status) {
        refuse(index, status.error());
        return status.error();
    }
    window_->waitIdle(context_->lastFrame());
    panel_->files[index].refused = false;
    panel_->file = index;
    panel_->message.clear();
    panel_->browser.open = false;
    remember(path);
    return success();
}

Status Viewer::takeDropped() {
    std::string last;
    for (const std::string& path : window_->takeDropped()) {
        std::error_code unknown;
        if (std::filesystem::is_directory(utf8Path(path), unknown)) {
            panel_->browser.enter(utf8Path(path));
            panel_->browser.open = true;
        } else {
            last = path;
        }
    }
    return last.empty() ? success() : show(last);
}

void Viewer::remember(const std::string& path) {
    if (!remembers())
        return;
    rememberFile(recentFilesPath(), path);
    panel_->recent = readRecentFiles(recentFilesPath());
}

/// What clicks attach, where the last one met the surface.
Status Viewer::attachPicked() {
    if (!panel_->picked || stage_->settings.prop == Prop::none)
        return success();
    const Status attached = stage_->attach({stage_->settings.prop, panel_->picked->point});
    if (attached)
        panel_->message.clear();
    return attached;
}

Status Viewer::fulfil(const PanelWishes& wishes) {
    if (wishes.file) {
        if (const Status status = show(*wishes.file); !status)
            return status.error();
    }
    if (!stage_->hasFigure())
        return success();
    if (wishes.pick) {
        window_->waitIdle(context_->lastFrame());
        Result<std::optional<ViewPick>> picked = pickAt(*stage_, *wishes.pick, aspect());
        if (!picked)
            return picked.error();
        panel_->picked = std::move(*picked);
        if (const Status attached = attachPicked(); !attached)
            return attached.error();
    }
    if (wishes.takeOff) {
        if (const Status status = stage_->takeOff(context_->lastFrame()); !status)
            return status.error();
    }
    if (wishes.save) {
        export_.start(*stage_, options_.draw, *wishes.save);
        if (wishes.save->kind == ExportKind::commandLine)
            window_->copyText(export_.report());
    }
    Status remade = success();
    const bool otherScheme = wishes.scheme && *wishes.scheme != stage_->scheme();
    const bool otherRate = wishes.rate && *wishes.rate != stage_->group().edgeRate();
    if (otherScheme || wishes.skinning || otherRate || wishes.tune || stage_->needsOtherGroup())
        remade = announce("making the surface");
    if (!remade)
        return remade.error();
    if (otherScheme)
        remade = stage_->setScheme(*wishes.scheme, context_->lastFrame());
    else if (wishes.skinning && *wishes.skinning != stage_->skinning())
        remade = stage_->setSkinning(*wishes.skinning, context_->lastFrame());
    if (!remade)
        return remade.error();
    if (wishes.tune) {
        if (const Status status = stage_->tune(context_->lastFrame()); !status)
            return status.error();
    }
    if (wishes.scheme || wishes.skinning || wishes.tune)
        panel_->message.clear();
    if (stage_->needsOtherGroup()) {
        if (const Status status = stage_->changeGroup(context_->lastFrame()); !status) {
            stage_->settings.levels = stage_->settings.simulate = false;
            stage_->settings.view = host::shared::kViewShaded;
            return status.error();
        }
    }
    if (stage_->needsValues()) {
        window_->waitIdle(context_->lastFrame());
        const Status measured = stage_->measureValues(options_.frames > 0);
        window_->waitIdle(context_->lastFrame()); // it evaluates frames of its own
        if (!measured)
            return measured.error();
    }
    const uint32_t before = stage_->group().edgeRate();
    if (wishes.rate && *wishes.rate == before)
        stage_->settings.rate = static_cast<int>(before); // the slider may have been let go between two rates
    if (wishes.rate && *wishes.rate != before) {
        if (const Status status = stage_->setRate(*wishes.rate, context_->lastFrame()); !status) {
            stage_->settings.rate = static_cast<int>(before);
            return status.error();
        }
        panel_->message.clear();
    }
    return success();
}

Status Viewer::drawFrame(const host::WindowFrame& frame, bool readBack) {
    const uint64_t number = context_->nextFrame();
    if (const Status status =
            stage_->evaluate(frame.commands, number, window_->completedFrame(), window_->swapchain().extent().height);
        !status)
        return status.error();
    ViewStage::Shown shown = stage_->shown();
    panel_->step = pace_->next(shown.settings.look, lastShown_ == shown, seconds_);
    lastShown_ = std::move(shown);
    const host::Scene scene = stage_->scene(window_->swapchain().extent());
    if (const Status status = pictures_->record(frame.commands, frame.slot, scene, panel_->step); !status)
        return status.error();
    copyToWindow(frame);
    if (const Status status = overlay_->record(frame); !status)
        return status.error();
    if (readBack) {
        if (!window_->swapchain().canRead())
            return Error{ErrorCode::unsupported, "the window's pictures cannot be read back"};
        const VkDeviceSize size =
            VkDeviceSize{4} * window_->swapchain().extent().width * window_->swapchain().extent().height;
        Result<host::Buffer> buffer =
            device_->createBuffer(size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, host::MemoryKind::readback);
        if (!buffer)
            return buffer.error();
        screenshot_ = std::move(*buffer);
        copyToHost(frame);
    }
    return window_->end(frame, number);
}

Status Viewer::announce(const std::string& what) {
    if (options_.frames > 0) // counted frames are always the same
        return success();
    const Result<std::optional<host::WindowFrame>> begun = window_->begin();
    if (!begun || !begun->has_value())
        return begun ? success() : begun.error();
    const host::WindowFrame& frame = **begun;
    const uint64_t number = context_->nextFrame();
    if (const Status status = context_->check(suppleBeginFrame(context_->handle(), number, window_->completedFrame()),
                                              "suppleBeginFrame");
        !status)
        return status.error();
    if (const Status status = overlay_->showText(what); !status)
        return status.error();
    overlay_->beginPanels();
    drawAnnouncement(what);
    overlay_->endPanels();
    if (lastShown_ && targetGeneration_ == window_->swapchain().generation())
        copyToWindow(frame);
    else
        clearWindow(frame);
    if (const Status status = overlay_->record(frame); !status)
        return status.error();
    return window_->end(frame, number);
}

void Viewer::clearWindow(const host::WindowFrame& frame) const {
    const VkImage image = window_->swapchain().image(frame.image);
    host::imageBarrier(frame.commands, image, kWholeImage,
                       {VK_IMAGE_LAYOUT_UNDEFINED, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0}},
                       {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kCopyWrite});
    const VkClearColorValue color{{0.35f, 0.36f, 0.38f, 1.0f}}; // about the studio's wall
    vkCmdClearColorImage(frame.commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1, &kWholeImage);
    host::imageBarrier(frame.commands, image, kWholeImage, {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kCopyWrite},
                       {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kColor});
}

void Viewer::copyToWindow(const host::WindowFrame& frame) const {
    const VkImage image = window_->swapchain().image(frame.image);
    // The transfer stage is where the submission waits for the image.
    host::imageBarrier(frame.commands, image, kWholeImage,
                       {VK_IMAGE_LAYOUT_UNDEFINED, {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0}},
                       {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kCopyWrite});
    VkImageCopy region{};
    region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.dstSubresource = region.srcSubresource;
    region.extent = {window_->swapchain().extent().width, window_->swapchain().extent().height, 1};
    vkCmdCopyImage(frame.commands, pictures_->shown().handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    host::imageBarrier(frame.commands, image, kWholeImage, {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kCopyWrite},
                       {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kColor});
}

void Viewer::copyToHost(const host::WindowFrame& frame) const {
    const VkImage image = window_->swapchain().image(frame.image);
    host::imageBarrier(frame.commands, image, kWholeImage, {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, kCopyRead},
                       {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kCopyRead});
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {window_->swapchain().extent().width, window_->swapchain().extent().height, 1};
    vkCmdCopyImageToBuffer(frame.commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, screenshot_.handle(), 1,
                           &region);
    host::imageBarrier(frame.commands, image, kWholeImage, {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kCopyRead},
                       {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, {}});
    host::memoryBarrier(frame.commands, kCopyWrite, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

Status Viewer::writeScreenshot(const std::string& path) const {
    host::Picture picture =
        host::Picture::blank(window_->swapchain().extent().width, window_->swapchain().extent().height);
    std::memcpy(picture.rgba.data(), screenshot_.mapped(), picture.rgba.size());
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        if (window_->swapchain().format() == VK_FORMAT_B8G8R8A8_UNORM)
            std::swap(picture.rgba[i], picture.rgba[i + 2]);
        picture.rgba[i + 3] = 255;
    }
    return host::writePng(picture, path);
}

} // namespace

int runView(const ViewOptions& options) {
    const Result<VkExtent2D> size = parseSize(options.size);
    if (!size)
        return fail(kExitUsage, "--size: " + size.error().message);
    std::shared_ptr<const host::ValidationLog> validation;
    bool refused = false;
    {
        Viewer viewer(options);
        Status status = viewer.open(*size);
        if (status)
            status = viewer.run();
        validation = viewer.validation();
        refused = viewer.hasRefused();
        if (!status)
            return fail(status.error());
    }
    if (validation->messageCount() != 0)
        return fail(kExitBadInput, std::to_string(validation->messageCount()) + " validation messages");
    return refused ? kExitBadInput : kExitOk;
}

} // namespace supple::tools

#endif
